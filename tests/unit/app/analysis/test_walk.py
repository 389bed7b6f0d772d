"""Where in its program each tick of a run is, whatever of it was held or is missing."""

import numpy as np
import pytest

from app.analysis.evidence import Kind
from app.analysis.walk import Walk
from rtcore.modes import Mode
from tests.unit.app.analysis.made_up import FIRST_TICK, PERIOD_S, Records, run_of, stretch

PROGRAM = (stretch(Kind.COURSE, 0, 3000), stretch(Kind.COURSE, 3000, 100_000, block=1))


def _positions(run: Records, first_tick: int | None = None) -> dict[int, int]:
    """The tick of the program for each tick of the run that is measured."""
    parts = list(Walk(iter(PROGRAM), PERIOD_S, first_tick).take(run))
    found: dict[int, int] = {}
    for part in parts:
        assert part.positions[0] >= part.stretch.first
        assert part.positions[-1] < part.stretch.last
        found |= dict(zip(part.columns["tick"].tolist(), part.positions.tolist(), strict=True))
    return found


def _held() -> Records:
    run = run_of(8000)
    run["mode"][1000:1600] = Mode.HOLDING  # and 599 ticks of fading in
    run["mode"][4000:6500] = Mode.HOLDING  # and 999
    run["mode"][6600:6650] = Mode.HOLDING  # while it fades in: from 900 back up to 950
    return run


def test_held_and_fading_ticks_are_none_of_the_program() -> None:
    at = _positions(_held())
    assert at[FIRST_TICK + 999] == 999
    assert at[FIRST_TICK + 2199] == 1000
    assert not [tick for tick in at if 1000 <= tick - FIRST_TICK < 2199]
    # 1199 ticks were frozen before; 2500 held, 100 fading, 50 held, 949 fading
    assert at[FIRST_TICK + 7599] == 4000 - 1199
    assert sorted(at.values()) == list(range(len(at)))


@pytest.mark.parametrize(
    ("first", "last"),
    [
        (100, 300),
        (1100, 1300),
        (1700, 1800),
        (2000, 2150),
        (5000, 6000),
        (6000, 6400),
        (7600, 7700),
    ],
)
def test_missing_ticks_change_the_place_of_none(first: int, last: int) -> None:
    run = _held()
    whole, gapped = _positions(run), _positions(np.delete(run, np.r_[first:last]))
    missing = range(FIRST_TICK + first, FIRST_TICK + last)
    assert gapped == {tick: at for tick, at in whole.items() if tick not in missing}


def test_a_run_whose_first_ticks_are_missing_begins_where_it_did() -> None:
    run = run_of(500)[120:]
    assert _positions(run)[FIRST_TICK + 120] == 0
    assert _positions(run, FIRST_TICK)[FIRST_TICK + 120] == 120


def test_where_the_loop_says_what_it_skipped_the_rest_is_in_its_place() -> None:
    run = run_of(2000)
    run["program_tick"] = np.arange(2000)
    run["program_tick"][500:] += 2600  # from within the first stretch into the second
    parts = list(Walk(iter(PROGRAM), PERIOD_S).take(run))
    assert [(p.stretch.block, p.begins, len(p.positions)) for p in parts] == [
        (0, True, 500),
        (1, True, 1500),
    ]
    assert parts[1].positions[0] == 3100
    assert parts[1].columns["tick"][0] == FIRST_TICK + 500


def test_a_hold_beside_a_skip_is_left_out_as_ever() -> None:
    counted = _held()
    told = counted.copy()
    at = _positions(counted)
    for i, tick in enumerate(told["tick"].tolist()):
        told["program_tick"][i] = at.get(tick, at.get(tick - 1, 0) + 1)
    assert _positions(told) == at
