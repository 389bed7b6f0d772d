"""How figures are shown: targets beside what was measured, and one JSON document."""

import json

import pytest

from bench.report import Figure, quantity, show


@pytest.mark.parametrize(
    ("value", "unit", "words"),
    [
        (2.1e-6, "s", "2.10 µs"),
        (962e-9, "s", "962 ns"),
        (12.0, "s", "12 s"),
        (3.7e6, "1/s", "3.70 M1/s"),
        (66, "", "66"),
        (1.149, "×", "1.15 ×"),
        (0, "s", "0 s"),
        (None, "s", "—"),
    ],
)
def test_a_quantity_has_three_digits_and_a_prefix(
    value: float | None, unit: str, words: str
) -> None:
    assert quantity(value, unit) == words


@pytest.mark.parametrize(
    ("value", "at_most", "at_least", "met"),
    [
        (2.0, 2.0, None, True),
        (2.1, 2.0, None, False),
        (2.0, None, 2.0, True),
        (1.9, None, 2.0, False),
        (3.0, 2.5, 2.0, False),
        (float("nan"), 2.0, None, False),
        (3.0, None, None, None),
        (None, 2.0, None, None),
    ],
)
def test_a_target_is_met_or_missed_or_there_is_none(
    value: float | None, at_most: float | None, at_least: float | None, met: bool | None
) -> None:
    assert Figure("ratio", "", value, "×", at_most, at_least).met is met


FIGURES = [
    Figure("wakeup_median_s", "wake-up, median", 5e-6, "s", at_most=2e-6),
    Figure("longest_s", "longest", None, "s", note="over 999 µs"),
]


def test_json_is_one_document_with_the_unrounded_values(capsys: pytest.CaptureFixture[str]) -> None:
    show("loop", FIGURES, ["a note"], as_json=True)
    document = json.loads(capsys.readouterr().out)
    assert document["bench"] == "loop"
    assert document["notes"] == ["a note"]
    first, second = document["figures"]
    assert (first["name"], first["value"], first["met"]) == ("wakeup_median_s", 5e-6, False)
    assert (second["value"], second["met"], second["note"]) == (None, None, "over 999 µs")


def test_a_table_shows_the_target_beside_what_was_measured(
    capsys: pytest.CaptureFixture[str],
) -> None:
    show("loop", FIGURES, ["a note"], as_json=False)
    printed = capsys.readouterr().out
    row = next(line for line in printed.splitlines() if "median" in line)
    assert [cell.strip() for cell in row.split("│")[2:5]] == ["5 µs", "≤ 2 µs", "missed"]
    assert "a note" in printed
