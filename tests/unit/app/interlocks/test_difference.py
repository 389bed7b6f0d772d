"""What two tables differ in is told detector by detector, with units."""

from typing import Any

import pytest

from app.interlocks.defaults import default_interlocks
from app.interlocks.difference import difference, in_a_line
from app.interlocks.table import Interlocks
from rtcore.interlocks import Action
from rtcore.modes import Mode
from tests.unit.app.interlocks.test_safeguards import table

SHIPPED = default_interlocks()
BY_NAME = {detector.name: detector for detector in SHIPPED.detectors}


def test_the_same_table_differs_in_nothing() -> None:
    assert difference(SHIPPED, SHIPPED).detectors == ()
    assert not difference(SHIPPED, SHIPPED).reordered


@pytest.mark.parametrize(
    ("name", "changes", "lines"),
    [
        ("force", {"threshold": 30e3}, ["limit: limit 30,000 N, was limit 55,000 N"]),
        ("displacement", {"persistence_s": 0.05}, ["persistence: after 50 ms, was at once"]),
        ("lvdt", {"action": Action.SHUTDOWN}, ["action: shutdown, was stop"]),
        ("slow_pressure", {"armed": tuple(Mode)}, ["armed: always, was pressurising"]),
        ("underpeak", {"enabled": False, "latching": True}, ["latches: yes, was no", "switched: off, was on"]),
        ("force_ahead", {"horizon_s": 0.002}, ["watches: Force in 2 ms, was Force in 1 ms"]),
        ("force_rate", {"smoothing_s": None}, ["smoothed over: none, was 0.5 ms"]),
        ("storage", {"text": ""}, [f"text: none, was {BY_NAME['storage'].text}"]),
    ],
)  # fmt: skip
def test_each_change_is_a_line(name: str, changes: dict[str, Any], lines: list[str]) -> None:
    (change,) = difference(SHIPPED, table(name, **changes)).detectors
    assert (change.detector, change.kind) == (name, "changed")
    assert list(change.lines) == lines


def test_what_is_new_or_gone_is_told_whole() -> None:
    without = table("force")
    (gone,) = difference(SHIPPED, without).detectors
    (come,) = difference(without, SHIPPED).detectors
    assert (gone.kind, come.kind) == ("removed", "added")
    assert gone.lines == come.lines == (
        "Force, limit 55,000 N, at once: shutdown; armed when pressurising, ready, running, holding, stopping",
    )  # fmt: skip


def test_another_order_is_told() -> None:
    turned = Interlocks(detectors=tuple(reversed(SHIPPED.detectors)))
    found = difference(SHIPPED, turned)
    assert (found.detectors, found.reordered) == ((), True)


def test_named_values_have_no_limit_of_a_half() -> None:
    load_cell = next(d for d in SHIPPED.detectors if d.name == "load_cell")
    assert in_a_line(load_cell) == "Load cell, at once: shutdown; armed always"
