"""A first-out once more on the virtual rig: the same again where nothing is changed, and what a change does."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from app.db import Database
from app.errors import Refusal
from app.first_outs.account import Account
from app.first_outs.changes import InForceThen, change, settings_then
from app.first_outs.rerunning import Played, play
from app.first_outs.reruns import Rerun, Reruns
from app.first_outs.scene import scene_of
from app.first_outs.words import rerun_text
from app.prediction.play import ignore
from app.prediction.schemas import Computing
from rtcore.codes import Opcode
from rtcore.rig.faults import Fault
from tests.unit.app.first_outs.lived import HARMONIC, SECOND, Lived, definition

LONG: dict[str, Any] = {
    **HARMONIC,
    "motion": [
        {
            "kind": "harmonic",
            "mean_m": 0,
            "amplitude_m": 0.002,
            "frequency_hz": 0.5,
            "duration_s": 600,
        }
    ],
}


@pytest.fixture
def lived(database: Database, tmp_path: Path) -> Lived:
    return Lived(database, tmp_path)


def then_of(account: Account) -> InForceThen:
    then = settings_then(account.settings)
    assert isinstance(then, InForceThen)
    return then


def played(account: Account, path: str | None = None, value: object = None) -> Played:
    """The re-run of a harmonic, with a value changed or none."""
    then = then_of(account)
    if path is not None:
        found = change(then, path, value)
        assert not isinstance(found, Refusal), found
        then = found.settings
    return play(scene_of(account, definition(HARMONIC)), then, ignore)


def reversed_in_the_midst(lived: Lived) -> Account:
    """The load cell is reversed 1.5 s into a test."""
    lived.start()
    lived.advance(round(1.5 * SECOND))
    lived.inject(Fault.LOAD_CELL_SIGN)
    account, _ = lived.kept()
    return account


def test_the_same_fault_at_the_same_tick_trips_the_same_detector(lived: Lived) -> None:
    account = reversed_in_the_midst(lived)
    again = played(account)
    assert again.first_out is not None
    assert again.first_out.detector == account.first.detector
    assert abs(again.first_out.time_s) < 0.01  # only the noise is another
    ticks = again.records["tick"]
    assert (ticks[0], ticks[-1]) == (again.tick - 2 * SECOND, again.tick + 2 * SECOND)
    other = played(account)
    assert np.array_equal(again.records, other.records)  # bit for bit


def test_a_change_does_what_it_would_do_on_the_rig(lived: Lived) -> None:
    account = reversed_in_the_midst(lived)
    path = f"interlocks.{account.first.detector}.enabled"
    unchanged, changed = played(account), played(account, path, False)
    assert changed.first_out is None or changed.first_out.detector != account.first.detector
    made = change(then_of(account), path, False)
    assert not isinstance(made, Refusal)
    outcomes = ((p.first_out, p.peaks) for p in (unchanged, changed))
    told = " ".join(rerun_text(made, account.first, *outcomes))
    assert f"Unchanged, {account.first.detector} trips on the virtual rig too" in told
    assert "in place of" in told or "nothing trips" in told
    assert "eak force" in told


def test_a_first_out_outside_a_run_is_run_again_from_ready(lived: Lived) -> None:
    lived.bring_to_ready()
    lived.advance(25 * SECOND)
    lived.inject(Fault.LVDT_OPEN)
    account, _ = lived.kept()
    assert account.run_tick is None
    again = played(account)
    assert again.first_out is not None
    assert (again.first_out.detector, again.first_out.time_s) == (account.first.detector, 0.0)


def test_a_hold_before_it_is_held_again(lived: Lived) -> None:
    lived.start()
    lived.advance(SECOND)
    lived.command(Opcode.HOLD)
    lived.advance(2 * SECOND)
    lived.inject(Fault.LOAD_CELL_OPEN)
    account, _ = lived.kept()
    assert account.mode_before == "holding"
    again = played(account)
    before = again.records[again.records["tick"] == again.tick - 1]
    assert float(before["force_command_n"][0]) == pytest.approx(500.0, abs=1.0)
    assert again.first_out is not None
    assert again.first_out.time_s == 0.0


def test_a_long_test_begins_shortly_before_where_it_was(lived: Lived) -> None:
    """Its setpoints are, tick for tick, those of the whole test."""
    lived.start(data=LONG)
    lived.advance(3 * SECOND)
    lived.command(Opcode.HOLD)
    lived.advance(2 * SECOND)
    lived.command(Opcode.RESUME)
    lived.advance(121 * SECOND)
    lived.inject(Fault.LOAD_CELL_OPEN)
    account, samples = lived.kept()
    scene = scene_of(account, definition(LONG))
    assert scene.begun is not None
    assert scene.trip_tick == 20 * SECOND
    again = play(scene, then_of(account), ignore)
    assert again.first_out is not None
    assert again.first_out.time_s == 0.0
    names = ("force_command_n", "displacement_command_m")
    before = list(samples.chunks(names, account.tick - SECOND, account.tick - 1))
    for name in names:
        recorded = np.concatenate([columns[name] for columns in before])
        ticks = again.records["tick"]
        at = (ticks >= again.tick - SECOND) & (ticks < again.tick)
        assert np.allclose(again.records[name][at], recorded, rtol=0, atol=1e-6 * 2500)


def test_who_asks_again_gets_the_same_and_a_wrong_path_is_refused(lived: Lived) -> None:
    account = reversed_in_the_midst(lived).model_copy(update={"run_id": 1})
    reruns = Reruns(lambda run_id: definition())
    try:
        asked = (1, account, "controller.k_p", 1e-5)
        first = reruns.of(*asked, wait_s=0.0)
        assert isinstance(first, Computing)
        found = reruns.of(*asked, wait_s=600.0)
        assert isinstance(found, Rerun)
        assert reruns.of(*asked, wait_s=0.0) is found
        for path, value, said in (
            ("controler.k_p", 1.0, "did you mean controller?"),
            ("controller.kp", 1.0, "did you mean k_p?"),
            ("controller.compensator.ffv", 1.0, "did you mean compensator.ff_v?"),
            ("controller.k_p", 2.0, "must be at most 1"),
            ("rig.load_actuator.bypass_diameter_m", 1.0, "must be at most 0.01 m"),
            ("rig.load_actuator", 1.0, "name one value of it"),
            ("interlocks.force.thresh", 1.0, "did you mean threshold?"),
            ("", 1.0, "it begins with one of controller, interlocks, rig"),
        ):
            refused = reruns.of(1, account, path, value, 0.0)
            assert isinstance(refused, Refusal), path
            assert said in refused.detail
            assert refused.faults[0].path == path
    finally:
        reruns.close()
