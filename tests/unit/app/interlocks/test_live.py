"""What each detector sees, read off the block of a loop on the virtual clock."""

from typing import Any

import pytest

from app.errors import Code, Refusal
from app.interlocks.defaults import default_interlocks
from app.interlocks.schemas import DetectorState, LiveDetector, LiveInterlocks
from app.interlocks.table import Interlocks
from rtcore.interlocks import Action, Comparison, Form
from rtcore.modes import Mode
from tests.unit.app.interlocks.test_safeguards import table
from tests.unit.app.interlocks.virtual_loop import VirtualLoop

SHIPPED = default_interlocks()


@pytest.fixture
def loop() -> VirtualLoop:
    made = VirtualLoop()
    made.rig.bring_to_ready()
    made.rig.advance(8000)  # the pressure comes up to its last bar
    made.beat()
    return made


def seen(loop: VirtualLoop, interlocks: Interlocks = SHIPPED) -> dict[str, LiveDetector]:
    found = loop.live(interlocks).read()
    assert isinstance(found, LiveInterlocks)
    return {d.name: d for d in found.detectors}


def test_values_margins_and_states_of_a_rig_at_rest(loop: VirtualLoop) -> None:
    found = seen(loop)
    assert list(found) == [d.name for d in SHIPPED.detectors]
    supply = found["supply_pressure"]
    assert supply.value is not None
    assert supply.value == pytest.approx(21e6, rel=0.02)
    assert supply.margin == supply.value - 15e6
    assert supply.margin_share == supply.margin / 15e6
    assert (supply.unit, supply.limit) == ("Pa", "limit at least 150 bar")
    assert supply.text == f"{supply.value / 1e5:.0f} bar"
    assert supply.state is DetectorState.CONTENT
    assert found["force_error"].state is DetectorState.NOT_ARMED
    assert (found["load_cell"].text, found["load_cell"].limit) == ("sound", "")
    assert found["hard_wired_chain"].text == "closed"
    assert found["force_rate"].unit == "N/s"
    assert {d.trips for d in found.values()} == {0}


def test_one_that_is_off_says_so_and_one_beyond_its_limit_counts_until_it_trips(
    loop: VirtualLoop,
) -> None:
    changes: dict[str, Any] = {
        "threshold": 25e6,
        "persistence_s": 0.5,
        "action": Action.INDICATE,
        "latching": False,
    }
    wanted = table("supply_pressure", **changes)
    wanted = wanted.model_copy(
        update={
            "detectors": tuple(
                d.model_copy(update={"enabled": d.name != "underpeak"}) for d in wanted.detectors
            )
        }
    )
    assert loop.adopt(wanted) is None
    loop.rig.advance(400)
    supply = seen(loop, wanted)["supply_pressure"]
    assert (supply.state, supply.trips) == (DetectorState.COUNTING, 0)
    assert supply.violated_s == pytest.approx(0.1, abs=0.001)
    assert supply.margin is not None
    assert supply.margin < 0
    assert seen(loop, wanted)["underpeak"].state is DetectorState.OFF
    live = loop.live(wanted)
    loop.rig.advance(2000)
    loop.beat()
    found = live.read()
    assert isinstance(found, LiveInterlocks)
    tripped = next(d for d in found.detectors if d.name == "supply_pressure")
    assert (tripped.state, tripped.trips, tripped.first_out) == (DetectorState.TRIPPED, 1, False)


def test_what_tripped_before_a_change_counts_for_the_name_that_it_had(loop: VirtualLoop) -> None:
    wanted = table("force", threshold=0.001)
    live = loop.live(SHIPPED)
    assert loop.adopt(wanted) is None
    live.turn_to(wanted)
    loop.rig.advance(10)
    assert loop.rig.mode == Mode.TRIPPED
    turned = Interlocks(detectors=tuple(reversed(wanted.detectors)))
    live.turn_to(turned)
    assert loop.adopt(turned) is None
    loop.rig.advance(1)
    loop.beat()
    found = live.read()
    assert isinstance(found, LiveInterlocks)
    counted = {d.name: d.trips for d in found.detectors if d.trips}
    assert counted["force"] == 1


def test_a_band_has_the_margin_to_its_nearer_end(loop: VirtualLoop) -> None:
    band: dict[str, Any] = {
        "comparison": Comparison.OUTSIDE,
        "low": 20e6,
        "threshold": 30e6,
        "form": Form.VALUE,
    }
    wanted = table("supply_pressure", **band, action=Action.INDICATE, latching=False)
    assert loop.adopt(wanted) is None
    loop.rig.advance(4)
    supply = seen(loop, wanted)["supply_pressure"]
    assert supply.value is not None
    assert supply.margin == supply.value - 20e6
    assert supply.margin_share == supply.margin / 5e6
    assert supply.limit == "limits 200 bar … 300 bar"


def test_without_a_loop_or_with_another_table_nothing_is_made_up(loop: VirtualLoop) -> None:
    other = loop.live(table("force", threshold=30e3)).read()
    assert isinstance(other, Refusal)
    assert other.code is Code.BUSY
    loop.rig.block.fields["loop_heartbeat_ns"] = 1
    lost = loop.live(SHIPPED).read()
    assert isinstance(lost, Refusal)
    assert lost.code is Code.LOOP_LOST
