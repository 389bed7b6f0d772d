"""What has to be so for a test to start, and what to do about it where it is not."""

from dataclasses import replace

import pytest

from app.rigs.permissives import Readiness, permissives
from rtcore.modes import Mode

READY = Readiness(
    mode=Mode.READY,
    trip=None,
    supply_pressure_pa=20.8e6,
    recorder_follows=True,
    recorder_trouble=None,
    disk_is_full=False,
)
NAMES = ["loop", "interlocks", "pressure", "recorder", "storage", "idle"]


def test_all_are_met_on_a_rig_that_is_ready() -> None:
    found = permissives(READY)
    assert [p.name for p in found] == NAMES
    assert all(p.met for p in found)
    assert found[2].text == "Supply pressure 208 bar"


@pytest.mark.parametrize(
    ("now", "name", "says"),
    [
        (replace(READY, mode=None), "loop", "does not run"),
        (replace(READY, mode=Mode.TRIPPED), "interlocks", "Press Reset: the rig starts latched"),
        (replace(READY, trip="Force 60,000 N"), "interlocks", "Press Reset: Force 60,000 N"),
        (
            replace(READY, mode=Mode.OFF, supply_pressure_pa=0.3e6),
            "pressure",
            "Supply pressure 3 bar, 190 bar needed: press Pressurise",
        ),
        (replace(READY, mode=Mode.PRESSURISING), "pressure", "needed: wait"),
        (replace(READY, recorder_follows=False), "recorder", "still reading"),
        (
            replace(READY, recorder_trouble="The disk does not answer"),
            "recorder",
            "does not answer",
        ),
        (replace(READY, disk_is_full=True), "storage", "The disk is full"),
        (replace(READY, mode=Mode.HOLDING), "idle", "A test is running"),
    ],
)
def test_what_is_missing_says_what_to_do(now: Readiness, name: str, says: str) -> None:
    found = {p.name: p for p in permissives(now)}
    assert not found[name].met
    assert says in found[name].text
    met = {p.name for p in found.values() if p.met}
    if now.mode is not None:
        assert met >= set(NAMES) - {name, "pressure", "interlocks"}
