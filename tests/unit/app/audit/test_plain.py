"""What the audit keeps of data: JSON that any database takes, and no secret."""

import json
from dataclasses import dataclass
from enum import IntEnum, StrEnum

import pytest
from hypothesis import given
from hypothesis import strategies as st

from app.audit.plain import REDACTED, is_secret, plain
from tests.unit.app.audit.entries import JSON


class Mode(IntEnum):
    OFF = 0


class Word(StrEnum):
    PASS = "pass"


@dataclass
class Asked:
    name: str
    password: str


@given(st.dictionaries(st.text(), JSON))
def test_it_is_json_without_what_a_database_refuses(data: object) -> None:
    text = json.dumps(plain(data), allow_nan=False, ensure_ascii=False)
    assert "\\u0000" not in text
    text.encode("utf-8")


@pytest.mark.parametrize(
    "name",
    ["password", "new_password", "token", "tokens", "apiToken", "password_hash", "client-secret"],
)
def test_secrets_are_redacted_wherever_they_are(name: str) -> None:
    assert plain({"user": [{name: "hunter2"}]}) == {"user": [{name: REDACTED}]}


@pytest.mark.parametrize(
    "name", ["token_id", "token_name", "tokenizer", "secretary", "passing", ""]
)
def test_what_only_sounds_like_one_is_kept(name: str) -> None:
    assert not is_secret(name)


def test_a_secret_that_is_not_there_may_be_said_to_be_absent() -> None:
    assert plain({"password": None, "token": False}) == {"password": None, "token": False}


def test_things_of_ours_are_told_in_words() -> None:
    found = plain(
        {"mode": Mode.OFF, "verdict": Word.PASS, "asked": Asked("ada", "hunter2"), "n": (1, 2)}
    )
    asked = {"name": "ada", "password": REDACTED}
    assert found == {"mode": "off", "verdict": "pass", "asked": asked, "n": [1, 2]}
