"""Differences say what a person would: one block more is one change."""

from typing import Any

from hypothesis import given, settings
from hypothesis import strategies as st

from app.definitions.difference import Change, applied, data_differences, text_difference
from tests.unit.app.definitions import bad, strategies

SOME = settings(max_examples=100, deadline=None)
some_data = strategies.definitions(strategies.every_block)


def _said(before: Any, after: Any) -> list[tuple[str, str, Any, Any]]:
    changes = data_differences(before, after)
    return [(change.kind, change.path, change.before, change.after) for change in changes]


BLOCKS = [bad.ramp(), bad.sine(), bad.hold(), bad.layers()]


def test_nothing_changed() -> None:
    assert _said(bad.with_blocks(*BLOCKS), bad.with_blocks(*BLOCKS)) == []


def test_a_number_changed() -> None:
    after = [bad.ramp(), bad.sine(frequency_hz=60), bad.hold(), bad.layers()]
    said = _said(bad.with_blocks(*BLOCKS), bad.with_blocks(*after))
    assert said == [("changed", "blocks[1].frequency_hz", 50, 60)]


def test_an_inserted_block_is_one_change() -> None:
    new = bad.hold(duration_s=9)
    said = _said(bad.with_blocks(*BLOCKS), bad.with_blocks(new, *BLOCKS))
    assert said == [("added", "blocks[0]", None, new)]


def test_a_removed_block_is_one_change() -> None:
    said = _said(bad.with_blocks(*BLOCKS), bad.with_blocks(*BLOCKS[:2], *BLOCKS[3:]))
    assert said == [("removed", "blocks[2]", BLOCKS[2], None)]


def test_a_block_put_before_one_that_changed_does_not_become_it() -> None:
    after = [bad.ramp(), bad.sine(amplitude_n=1, frequency_hz=7, cycles=3), bad.sine(cycles=201)]
    said = _said(bad.with_blocks(bad.ramp(), bad.sine()), bad.with_blocks(*after))
    assert said == [
        ("added", "blocks[1]", None, after[1]),
        ("changed", "blocks[2].cycles", 200, 201),
    ]


def test_a_block_of_another_kind_is_another_block() -> None:
    said = _said(bad.with_blocks(bad.ramp()), bad.with_blocks(bad.hold()))
    assert [kind for kind, *_ in said] == ["removed", "added"]


def test_a_change_within_a_repeat_is_named_where_it_is_now() -> None:
    before = bad.with_blocks(bad.repeat(2, bad.hold(), bad.sine()))
    after = bad.with_blocks(bad.ramp(), bad.repeat(3, bad.hold(), bad.sine(cycles=1)))
    assert _said(before, after) == [
        ("added", "blocks[0]", None, bad.ramp()),
        ("changed", "blocks[1].times", 2, 3),
        ("changed", "blocks[1].blocks[1].cycles", 200, 1),
    ]


def test_a_list_of_numbers_changes_as_a_whole() -> None:
    before, after = bad.history(samples_n=[0, 1, 0]), bad.history(samples_n=[0, 2, 0])
    said = _said(bad.with_blocks(before), bad.with_blocks(after))
    assert said == [("changed", "blocks[0].samples_n", [0, 1, 0], [0, 2, 0])]


def test_keys_come_and_go() -> None:
    before, after = bad.with_blocks(bad.hold()), bad.with_blocks(bad.hold(force_n=5), name="b")
    assert _said(before, after | {"description": "d"}) == [
        ("changed", "name", "bad", "b"),
        ("added", "blocks[0].force_n", None, 5),
        ("added", "description", None, "d"),
    ]


@SOME
@given(some_data, some_data)
def test_differences_applied_give_the_other_definition(before: Any, after: Any) -> None:
    assert applied(data_differences(before, after), before) == after


def _edited(data: Any, moves: list[tuple[int, int]]) -> Any:
    """A definition with some blocks taken out and put elsewhere."""
    blocks = list(data["blocks"])
    for take, put in moves:
        block = blocks.pop(take % len(blocks))
        blocks.insert(put % (len(blocks) + 1), block)
    return data | {"blocks": blocks, "name": data["name"] + "!"}


@SOME
@given(some_data, st.lists(st.tuples(st.integers(0, 9), st.integers(0, 9)), max_size=4))
def test_differences_of_what_was_moved_apply_too(data: Any, moves: Any) -> None:
    after = _edited(data, moves)
    changes: list[Change] = data_differences(data, after)
    assert applied(changes, data) == after
    assert len(changes) <= 1 + 2 * len(moves)


def test_texts_differ_by_lines() -> None:
    assert text_difference("a\nb\n", "a\nb\n") == ""
    assert "-b\n+c\n" in text_difference("a\nb\n", "a\nc\n")
