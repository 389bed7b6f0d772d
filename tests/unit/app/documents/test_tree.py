"""Text becomes plain data as YAML 1.2 and JSON have it, within limits, each key's line known."""

import math
from contextlib import suppress

import pytest
from hypothesis import given
from hypothesis import strategies as st

from app.documents.tree import MAX_NODES, Malformed, parse_json, parse_yaml


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("off", "off"),  # false in YAML 1.1
        ("yes", "yes"),
        ("1:30", "1:30"),  # 90 in YAML 1.1
        ("2e4", 20000.0),  # text in YAML 1.1
        ("1_000", "1_000"),
        ("010", 10),  # 8 in YAML 1.1
        ("0x10", 16),
        ("0o10", 8),
        ("-.5", -0.5),
        ("+1.", 1.0),
        ("true", True),
        ("~", None),
        ("2024-01-01", "2024-01-01"),
        ("'1'", "1"),
        ("-.inf", -math.inf),
        (".INF", math.inf),
    ],
)
def test_scalars_are_those_of_yaml_1_2(text: str, value: object) -> None:
    parsed = parse_yaml(f"key: {text}").data["key"]
    assert parsed == value
    assert type(parsed) is type(value)


def test_not_a_number_is_read_as_such() -> None:
    assert math.isnan(parse_yaml("a: .NaN").data["a"])


def test_each_key_remembers_its_line() -> None:
    tree = parse_yaml("a: 1\nb:\n  - c: 2\n  -\n    d: 3\n")
    assert tree.lines["a",] == 1
    assert tree.lines["b", 0, "c"] == 3
    assert tree.lines["b", 1, "d"] == 5


@pytest.mark.parametrize(
    ("text", "message", "line"),
    [
        ("a: 1\nb: 2\na: 3", "a is given twice, first on line 1", 3),
        ("a: [1, 2", "not YAML", 1),
        ("a: 1\n b: 2", "not YAML", 2),
        ("a: !!python/object:os.system x", "means nothing here", 1),
        ("? [1, 2]\n: 3", "a key must be a name", 1),
        ("a: &b [*b]", "larger than the limit", 1),
        ("---\na: 1\n---\nb: 2", "not YAML", 3),
        ("<<: {a: 1}", "", None),
    ],
)
def test_what_is_no_document_is_refused_with_its_line(
    text: str, message: str, line: int | None
) -> None:
    if not message:
        assert parse_yaml(text).data == {"<<": {"a": 1}}  # no merging: the model refuses the key
        return
    with pytest.raises(Malformed, match=message) as refused:
        parse_yaml(text)
    assert refused.value.line == line


def test_a_few_aliases_cannot_become_a_million_values() -> None:
    bomb = "a: &a [x, x, x, x, x, x, x, x, x, x]\n"
    for last, name in zip("abcde", "bcdef", strict=True):
        bomb += f"{name}: &{name} [{', '.join([f'*{last}'] * 10)}]\n"
    with pytest.raises(Malformed, match=f"{MAX_NODES:,} values"):
        parse_yaml(bomb)


@pytest.mark.parametrize("parse", [parse_yaml, parse_json])
def test_deep_nesting_is_refused(parse: object) -> None:
    assert callable(parse)
    with pytest.raises(Malformed, match=r"deep|levels"):
        parse("[" * 5_000 + "]" * 5_000)


def test_json_refuses_keys_given_twice_and_says_where_it_stopped() -> None:
    with pytest.raises(Malformed, match="a is given twice"):
        parse_json('{"a": 1, "a": 2}')
    with pytest.raises(Malformed, match="not JSON") as refused:
        parse_json('{"a": 1,\n "b" 2}')
    assert refused.value.line == 2


@given(st.text(alphabet=st.sampled_from("ab:-[]{}&*!|>'\"\n #,?1.e%@`\t\\")) | st.text())
def test_any_text_is_read_or_refused(text: str) -> None:
    for parse in (parse_yaml, parse_json):
        with suppress(Malformed):
            parse(text)
