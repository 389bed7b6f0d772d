"""However a run is cut into chunks, what is measured is the same, and is what numpy has of it whole."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from app.analysis.evidence import Kind, Stretch
from app.analysis.measurements import Values
from app.analysis.predicted import Predicted
from rtcore.modes import Mode
from tests.unit.app.analysis.made_up import PERIOD_S, Records, cycles, in_chunks, run_of, step

TICKS = 12_000
PROGRAM = (
    step(0, 2000, 0, 500),
    Stretch(2000, 2400, Kind.LEAD, ("blocks", 1)),
    cycles(2400, 6400, 20.0, 900, block=1),
    Stretch(6400, 7000, Kind.COURSE, ("blocks", 2)),
    cycles(7000, 9000, 37.0, 400, block=3),
    Stretch(9000, 9500, Kind.SWEEP, ("blocks", 4), cycles=7),
)


def _noisy_run() -> Records:
    rng = np.random.default_rng(11)
    run = run_of(TICKS)
    for name in ("force_n", "force_command_n", "displacement_m", "velocity_m_s", "valve_command"):
        run[name] = rng.normal(0, 1, TICKS).cumsum()
    run["force_error_n"] = run["force_command_n"] - run["force_n"]
    run["valve_command"] /= np.max(np.abs(run["valve_command"]))
    run["mode"][3000:3500] = Mode.HOLDING
    run["mode"][8000:8010] = Mode.HOLDING
    run["mode"][10_600:] = Mode.STOPPING
    run["cycle"] = np.arange(TICKS) // 200
    return np.delete(run, np.r_[500:520, 5000:5001])


RUN = _noisy_run()
PREDICTED_N = np.random.default_rng(5).normal(0, 1, 9500)


def _predicted(size: int) -> Predicted:
    ticks = np.arange(9500)
    pieces = [ticks[i : i + size] for i in range(0, len(ticks), size)]
    return Predicted({"program_tick": p, "force_n": PREDICTED_N[p]} for p in pieces)


WHOLE = in_chunks(RUN, PROGRAM, [], valve_limit=0.8, predicted=_predicted(9500))


def _assert_same(found: Values, expected: Values) -> None:
    for name, value in expected.items():
        if value is None:
            assert found[name] is None, name
        else:
            assert found[name] == pytest.approx(value, rel=1e-9, nan_ok=True), name


@settings(max_examples=60)
@given(st.lists(st.integers(0, len(RUN)), max_size=60), st.integers(500, 9500))
def test_chunks_change_nothing(cuts: list[int], size: int) -> None:
    measured = in_chunks(RUN, PROGRAM, cuts, valve_limit=0.8, predicted=_predicted(size))
    _assert_same(measured.run, WHOLE.run)
    assert measured.blocks.keys() == WHOLE.blocks.keys()
    for block, values in measured.blocks.items():
        _assert_same(values, WHOLE.blocks[block])
    assert measured.finished == WHOLE.finished


def test_the_whole_is_what_numpy_has_of_it() -> None:
    frozen = np.zeros(TICKS, np.bool_)
    frozen[3000 : 3500 + 499] = True  # the fade after a hold takes as long, less a tick
    frozen[8000 : 8010 + 9] = True
    position = np.arange(TICKS) - np.cumsum(frozen)
    recorded = ~np.isin(np.arange(TICKS), np.r_[500:520, 5000:5001])
    kept = recorded & ~frozen & (position < 9500)
    whole = kept[recorded]
    at = position[kept]
    run = RUN[whole]
    data = ((at >= 2400) & (at < 6400)) | ((at >= 7000) & (at < 9500))
    error_n = run["force_error_n"][data].astype(np.float64)
    assert WHOLE.run["force_error_rms_n"] == pytest.approx(np.sqrt(np.mean(error_n**2)))
    assert WHOLE.run["force_error_peak_n"] == pytest.approx(np.max(np.abs(error_n)))
    assert WHOLE.run["peak_force_n"] == pytest.approx(np.max(np.abs(run["force_n"])))
    saturated = np.abs(run["valve_command"]) >= 0.8 - 1e-6
    assert WHOLE.run["valve_saturation_share"] == pytest.approx(np.mean(saturated))
    ramp = run["force_error_n"][(at >= 6400) & (at < 7000)].astype(np.float64)
    assert WHOLE.blocks[2]["force_error_rms_n"] == pytest.approx(np.sqrt(np.mean(ramp**2)))
    assert PERIOD_S == 250e-6
