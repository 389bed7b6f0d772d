"""Acquisitions against what numpy has of the whole run; cut into chunks anywhere they are the same."""

from collections.abc import Callable, Sequence

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from app.analysis.acquisition.cycles import LogarithmicCycles, PeakValley
from app.analysis.acquisition.intervals import MaxMin, Timed
from app.analysis.acquisition.table import Acquisition, Rows, measured_channels
from app.analysis.evidence import Kind
from rtcore.channels import CHANNEL
from rtcore.modes import Mode
from tests.unit.app.analysis.made_up import (
    FIRST_TICK,
    PERIOD_S,
    Records,
    cycles,
    run_of,
    stretch,
)

PROGRAM = (
    stretch(Kind.COURSE, 0, 300),
    cycles(300, 4300, 20.0, block=1),
    stretch(Kind.LEAD, 4300, 4400, block=1),
    cycles(4400, 6400, 40.0, block=2),
)
CHANNELS = ("force_n", "displacement_m")


def _run() -> Records:
    rng = np.random.default_rng(2)
    run = run_of(7003)
    run["force_n"] = rng.normal(0, 100, len(run)).cumsum()
    run["displacement_m"] = rng.normal(0, 1e-4, len(run)).cumsum()
    run["cycle"][300:4300] = np.arange(4000) // 200
    run["cycle"][4300:4400] = 20
    run["cycle"][4400:6400] = np.arange(2000) // 100
    run["block"][300:4400] = 1
    run["block"][4400:] = 2
    run["mode"][6400:] = Mode.STOPPING
    return run


RUN = _run()
GAPPED = np.delete(RUN, np.r_[1000:1210, 2000:2001])
MAKERS: dict[str, Callable[[], Acquisition]] = {
    "timed": lambda: Timed(CHANNELS, 300.0, PERIOD_S, FIRST_TICK),
    "max_min": lambda: MaxMin(CHANNELS, 0.0301, PERIOD_S, FIRST_TICK),
    "peak_valley": lambda: PeakValley(iter(PROGRAM), PERIOD_S, FIRST_TICK),
    "logarithmic": lambda: LogarithmicCycles(iter(PROGRAM), CHANNELS, PERIOD_S, FIRST_TICK),
}


def _acquire(made: Acquisition, run: Records, cuts: Sequence[int] = ()) -> Rows:
    pieces = []
    for chunk in np.split(run, sorted(cuts)):
        pieces.append(made.take({name: chunk[name] for name in made.needs}))
    pieces.append(made.close())
    assert list(pieces[0]) == [column.name for column in made.columns]
    return {name: np.concatenate([piece[name] for piece in pieces]) for name in pieces[0]}


@pytest.mark.parametrize("kind", MAKERS)
@settings(max_examples=30)
@given(cuts=st.lists(st.integers(0, len(GAPPED)), max_size=80))
def test_chunks_change_nothing(kind: str, cuts: list[int]) -> None:
    whole = _acquire(MAKERS[kind](), GAPPED)
    pieces = _acquire(MAKERS[kind](), GAPPED, cuts)
    assert len(next(iter(whole.values()))) > 5
    for name, values in whole.items():
        np.testing.assert_array_equal(pieces[name], values, err_msg=name)


def test_timed_gives_the_sample_at_each_instant_and_the_extremes_since_the_last() -> None:
    found = _acquire(Timed(CHANNELS, 300.0, PERIOD_S, FIRST_TICK), RUN)
    instants = np.floor(np.arange(0, 7003 * 3 / 40) * 40 / 3 + 0.5).astype(int)
    instants = instants[instants < len(RUN)]
    assert found["time_s"] == pytest.approx(instants * PERIOD_S)
    assert found["force_n"].tolist() == RUN["force_n"][instants].tolist()
    for k in range(1, len(instants)):
        between = RUN["displacement_m"][instants[k - 1] + 1 : instants[k] + 1]
        assert found["min_displacement_m"][k] == between.min()
        assert found["max_displacement_m"][k] == between.max()


def test_timed_at_the_rate_of_the_loop_is_every_tick() -> None:
    found = _acquire(Timed(CHANNELS, 4000.0, PERIOD_S, FIRST_TICK), RUN)
    assert found["force_n"].tolist() == RUN["force_n"].tolist()
    assert found["max_force_n"].tolist() == RUN["force_n"].tolist()
    assert found["time_s"] == pytest.approx(np.arange(7003) * PERIOD_S)


def test_timed_has_no_sample_where_the_instant_was_not_recorded() -> None:
    found = _acquire(Timed(CHANNELS, 40.0, PERIOD_S, FIRST_TICK), GAPPED)  # 100 ticks
    at = {round(t / PERIOD_S): i for i, t in enumerate(found["time_s"])}
    assert np.isnan(found["force_n"][at[1000]])
    assert found["max_force_n"][at[1000]] == RUN["force_n"][901:1000].max()
    assert 1100 not in at  # nothing was recorded since the instant before
    assert found["force_n"][at[1300]] == RUN["force_n"][1300]


def test_max_min_has_the_extremes_of_every_interval_the_last_shorter_one_too() -> None:
    found = _acquire(MaxMin(CHANNELS, 0.25, PERIOD_S, FIRST_TICK), RUN)
    pieces = [RUN[i : i + 1000] for i in range(0, len(RUN), 1000)]
    assert found["max_force_n"].tolist() == [piece["force_n"].max() for piece in pieces]
    assert found["min_displacement_m"].tolist() == [p["displacement_m"].min() for p in pieces]
    assert found["from_s"] == pytest.approx(0.25 * np.arange(8))
    assert found["to_s"] == pytest.approx([*(0.25 * np.arange(1, 8)), 7003 * PERIOD_S])


def test_every_counted_cycle_has_its_peak_and_valley() -> None:
    found = _acquire(MAKERS["peak_valley"](), RUN)
    assert found["block"].tolist() == [1] * 20 + [2] * 20
    assert found["cycle"].tolist() == [*range(1, 21), *range(1, 21)]
    assert found["whole"].all()
    for row in range(40):
        first = 300 + 200 * row if row < 20 else 4400 + 100 * (row - 20)
        cycle = RUN[first : first + (200 if row < 20 else 100)]
        assert found["peak_force_n"][row] == cycle["force_n"].max()
        assert found["valley_displacement_m"][row] == cycle["displacement_m"].min()
        lowest_s = (first + np.argmin(cycle["force_n"])) * PERIOD_S
        assert found["valley_force_time_s"][row] == pytest.approx(lowest_s)


def test_a_cycle_that_was_held_is_marked_and_one_that_was_cut_is_left_out() -> None:
    run = np.concatenate([RUN[:1000], RUN[1000:1599], RUN[1000:3299]])
    run["tick"] = FIRST_TICK + np.arange(len(run))
    run["mode"][1000:1300] = Mode.HOLDING  # and 299 ticks of fading in
    found = _acquire(MAKERS["peak_valley"](), run)
    assert found["cycle"].tolist() == list(range(1, 15))  # the 15th lacks its last tick
    assert np.flatnonzero(found["whole"] == 0).tolist() == [3]  # ticks 900 to 1100


def test_chosen_cycles_are_there_tick_by_tick_with_their_extremes() -> None:
    found = _acquire(MAKERS["logarithmic"](), RUN)
    chosen = [1, 2, 5, 10, 20]
    assert np.unique(found["cycle"]).tolist() == chosen
    parts = [RUN[300 + 200 * (n - 1) : 300 + 200 * n] for n in chosen]
    parts += [RUN[4400 + 100 * (n - 1) : 4400 + 100 * n] for n in chosen]
    expected = np.concatenate(parts)
    assert found["force_n"].tolist() == expected["force_n"].tolist()
    assert found["time_s"] == pytest.approx((expected["tick"] - FIRST_TICK) * PERIOD_S)
    peaks = [part["force_n"].max() for part in parts]
    assert found["force_n"][found["extreme"] == 1].tolist() == peaks
    valleys = [part["force_n"].min() for part in parts]
    assert found["force_n"][found["extreme"] == -1].tolist() == valleys


def test_counters_and_clocks_are_no_measured_channels() -> None:
    names = measured_channels(CHANNEL)
    assert "force_n" in names
    assert "supply_pressure_pa" in names
    assert not {"tick", "cycle", "mode", "tick_time_s", "time_s"} & set(names)
