"""Passwords: what one must be, and hashing that holds up nobody."""

import asyncio

import pytest

from app.access.passwords import Passwords, weak
from app.errors import Code, Refusal
from tests.unit.app.access.at_a_time import LONG, code


@pytest.mark.parametrize(
    ("password", "why"),
    [
        ("eleven char", "at least 12"),
        ("", "at least 12"),
        ("Karl-Ludwig M", "than the name"),
        ("KARL-LUDWIG M", "than the name"),
        ("aaaaaaaaaaaaaaa", "again and again"),
        ("a" * 1001, "at most 1000"),
    ],
)
def test_a_weak_password_is_refused_with_what_would_be_right(password: str, why: str) -> None:
    refusal = weak("Karl-Ludwig M", password)
    assert refusal is not None
    assert refusal.code is Code.WEAK_PASSWORD
    assert why in refusal.detail
    assert not password or password not in repr(refusal)


@pytest.mark.parametrize("password", [LONG, "twelve chars", "ÄÖÜ äöü ßßß 12", "𝄞" * 11 + "♯"])
def test_there_are_no_rules_of_composition(password: str) -> None:
    assert weak("KL", password) is None


def test_a_hash_is_argon2_of_its_own_salt_and_fits_its_password_only(passwords: Passwords) -> None:
    first, second = passwords.hash(LONG), passwords.hash(LONG)
    assert first.startswith("$argon2id$")
    assert len(first) <= 200
    assert first != second
    assert passwords.is_right(LONG, first)
    assert not passwords.is_right(LONG + " ", first)
    assert not passwords.is_right(LONG, None)
    assert not passwords.is_right(LONG, "what somebody wrote by hand")


def test_the_event_loop_goes_on_while_a_password_is_compared(passwords: Passwords) -> None:
    kept = passwords.hash(LONG)

    async def turns_meanwhile() -> tuple[int, bool | Refusal]:
        comparing = asyncio.ensure_future(passwords.compare(LONG, kept))
        turns = 0
        while not comparing.done():
            await asyncio.sleep(0)
            turns += 1
        return turns, await comparing

    turns, right = asyncio.run(turns_meanwhile())
    assert right is True
    assert turns > 10  # on the loop itself it would be two


def test_no_more_wait_for_it_than_memory_allows(passwords: Passwords) -> None:
    async def many() -> list[bool | Refusal]:
        return await asyncio.gather(*(passwords.compare("wrong", None) for _ in range(25)))

    found = asyncio.run(many())
    refused = [one for one in found if isinstance(one, Refusal)]
    assert len(refused) == 5
    assert {code(one) for one in refused} == {Code.TOO_MANY_ATTEMPTS}
    assert found.count(False) == 20
