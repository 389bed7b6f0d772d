"""What is written is read back the same, as YAML and as JSON."""

from typing import Any

import yaml
from hypothesis import assume, given, settings

from app.definitions.definition import Definition
from app.definitions.reading import definition_from, parse_definition
from app.documents.writing import to_json, to_yaml
from app.errors import Refusal
from tests.unit.app.definitions import strategies

SOME = settings(max_examples=40, deadline=None)  # reading YAML is slow
any_definition = strategies.definitions(strategies.smooth_blocks | strategies.step)


def _read(data: Any) -> Definition:
    definition = definition_from(data)
    assume(not isinstance(definition, Refusal))
    assert isinstance(definition, Definition)
    return definition


@SOME
@given(any_definition)
def test_a_definition_survives_yaml(data: strategies.Data) -> None:
    definition = _read(data)
    assert parse_definition(to_yaml(definition)) == definition


@SOME
@given(any_definition)
def test_a_definition_survives_json(data: strategies.Data) -> None:
    definition = _read(data)
    assert parse_definition(to_json(definition), json=True) == definition


@SOME
@given(any_definition)
def test_our_yaml_says_the_same_to_a_reader_of_yaml_1_1(data: strategies.Data) -> None:
    definition = _read(data)
    assert definition_from(yaml.safe_load(to_yaml(definition))) == definition


def test_text_with_the_line_ends_of_other_alphabets_stays_as_it_is() -> None:
    for name in ("a\x85b", "\u2028", "a\u2029", "one\ntwo\n", "\ttab ", "\ufeff", "\x00"):
        data = {"schema": 1, "name": name, "blocks": [{"kind": "hold", "duration_s": 1}]}
        definition = definition_from(data)
        assert isinstance(definition, Definition)
        assert parse_definition(to_yaml(definition)) == definition


def test_text_that_looks_like_a_number_stays_text() -> None:
    for name in ("2e4", "1:30", "off", "null", "0x10", ".nan", "~", "1_000", "=", "010"):
        data = {"schema": 1, "name": name, "blocks": [{"kind": "hold", "duration_s": 1}]}
        definition = definition_from(data)
        assert isinstance(definition, Definition)
        again = parse_definition(to_yaml(definition))
        assert isinstance(again, Definition)
        assert again.name == name
