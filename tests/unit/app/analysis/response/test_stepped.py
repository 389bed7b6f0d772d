"""Stepped sines: made-up runs of a known response, against a fit by numpy of everything at once."""

import math
from itertools import pairwise

import numpy as np
import numpy.typing as npt
import pytest
from scipy import signal

from app.analysis.evidence import Stretch
from app.analysis.response.point import ResponsePoint
from app.analysis.response.stepped import SteppedSine, channels_of
from app.analysis.response.transfers import TRANSFERS
from app.analysis.walk import Walk
from rtcore.modes import Mode
from tests.unit.app.analysis.made_up import FIRST_TICK, PERIOD_S, Records, cycles, run_of

FORCE = {"force": TRANSFERS["force"]}
GAIN, LAG_DEG = 0.75, -28.6


def _phase(frequency_hz: float, ticks: int) -> npt.NDArray[np.float64]:
    return np.asarray(2 * np.pi * frequency_hz * PERIOD_S * np.arange(ticks))


def _ticks(frequency_hz: float, count: float) -> int:
    return round(count / frequency_hz / PERIOD_S)


def _run(frequency_hz: float, count: float, noise: npt.ArrayLike = 0.0) -> Records:
    """2,000 N on 5,000 N, followed by 1,500 N that lag 28.6°, with 3 % of second harmonic."""
    phase = _phase(frequency_hz, _ticks(frequency_hz, count))
    first = np.sin(phase + math.radians(LAG_DEG))
    force = 4000 + 2000 * GAIN * (first + 0.03 * np.cos(2 * phase)) + np.asarray(noise)
    return run_of(len(phase), force_command_n=5000 + 2000 * np.sin(phase), force_n=force)


def _points(
    records: Records, program: list[Stretch], cuts: tuple[int, ...] = ()
) -> list[ResponsePoint]:
    walk = Walk(iter(program), PERIOD_S, also=channels_of(FORCE.values()))
    stepped = SteppedSine(PERIOD_S, FORCE)
    for first, last in pairwise((0, *cuts, len(records))):
        for part in walk.take(records[first:last]):
            stepped.take(part)
    return stepped.points()


def _point(records: Records, frequency_hz: float, cuts: tuple[int, ...] = ()) -> ResponsePoint:
    [point] = _points(records, [cycles(0, len(records), frequency_hz, 2000)], cuts)
    return point


@pytest.mark.parametrize("frequency_hz", [0.5, 10.0, 33.7, 97.3, 400.0])
@pytest.mark.parametrize("count", [1, 5, 7.4, 150])
def test_a_known_response_is_found_over_whole_cycles_or_not(
    frequency_hz: float, count: float
) -> None:
    point = _point(_run(frequency_hz, count), frequency_hz)
    assert point.gain == pytest.approx(GAIN, rel=1e-5)
    assert point.phase_deg == pytest.approx(LAG_DEG, abs=1e-3)
    assert point.distortion_percent == pytest.approx(3, rel=1e-3)
    told = count >= 2  # of a single cycle nothing tells noise from response
    assert point.coherence == (pytest.approx(1, abs=1e-6) if told else None)
    assert point.cycles == math.floor(count)
    assert (point.frequency_hz, point.amplitude_n) == (frequency_hz, 2000)


def test_it_is_the_fit_that_numpy_makes_of_everything_at_once() -> None:
    frequency_hz, count = 17.3, 6.3
    rng = np.random.default_rng(4)
    run = _run(frequency_hz, count, rng.normal(0, 100, _ticks(frequency_hz, count)))
    phase = _phase(frequency_hz, len(run))
    columns = [np.ones(len(run))]
    columns += [wave(k * phase) for k in range(1, 11) for wave in (np.cos, np.sin)]
    design = np.stack(columns, 1)
    parts = []
    for name in ("force_n", "force_command_n"):
        found = np.linalg.lstsq(design, run[name].astype(np.float64), rcond=None)[0]
        parts.append(complex(found[1], -found[2]))
    point = _point(run, frequency_hz)
    assert point.gain == pytest.approx(abs(parts[0] / parts[1]), rel=1e-9)
    assert point.phase_deg == pytest.approx(np.degrees(np.angle(parts[0] / parts[1])), abs=1e-7)


@pytest.mark.parametrize("cuts", [(1,), (57, 58, 1000), tuple(range(64, 9000, 64))])
def test_chunks_make_no_difference(cuts: tuple[int, ...]) -> None:
    rng = np.random.default_rng(5)
    run = _run(20.0, 50, rng.normal(0, 100, 10_000))
    whole, parted = _point(run, 20.0), _point(run, 20.0, cuts)
    assert parted.gain == pytest.approx(whole.gain, rel=1e-10)
    assert parted.gain_95 == pytest.approx(whole.gain_95, rel=1e-7)


def test_later_by_a_tick_is_later_by_its_phase_and_twice_is_twice_the_gain() -> None:
    frequency_hz = 40.0
    run = _run(frequency_hz, 21)[100:]
    shifted = run.copy()[:-5]
    shifted["force_n"] = 2 * _run(frequency_hz, 21)["force_n"][95:-5][: len(shifted)]
    before, after = _point(run, frequency_hz), _point(shifted, frequency_hz)
    turn_deg = 360 * frequency_hz * 5 * PERIOD_S
    assert after.phase_deg == pytest.approx(before.phase_deg - turn_deg, abs=1e-3)
    assert after.gain == pytest.approx(2 * before.gain, rel=1e-5)


def _held(colour: list[float], count: int, seeds: int = 600) -> float:
    """Share of the intervals of the gain that hold it, in noise (colour) of a resonance."""
    frequency_hz, held = 80.0, 0
    ticks = _ticks(frequency_hz, count)
    rng = np.random.default_rng(6)
    for _ in range(seeds):
        noise = signal.lfilter([1.0], colour, rng.normal(0, 5, ticks + 1000))[1000:]
        interval = _point(_run(frequency_hz, count, noise), frequency_hz).gain_95
        held += interval.low <= GAIN <= interval.high
    return held / seeds


@pytest.mark.parametrize("count", [3, 12])
@pytest.mark.parametrize("colour", [[1.0], [1.0, -1.9, 0.93]])
def test_intervals_hold_the_truth_in_white_and_in_coloured_noise(
    colour: list[float], count: int
) -> None:
    assert _held(colour, count) == pytest.approx(0.95, abs=0.03)  # 3 sigma of 600 draws


def test_a_response_that_drifts_is_not_settled_and_noise_is_no_drift() -> None:
    frequency_hz, count = 25.0, 20
    ticks = _ticks(frequency_hz, count)
    rng = np.random.default_rng(7)
    steady = _run(frequency_hz, count, rng.normal(0, 50, ticks))
    drifting = steady.copy()
    drifting["force_n"] += (
        100 * np.linspace(0, 1, ticks) * np.sin(_phase(frequency_hz, ticks))
    ).astype(np.float32)
    assert _point(steady, frequency_hz).settled
    assert not _point(drifting, frequency_hz).settled


def test_a_hold_in_the_middle_changes_nothing() -> None:
    run = _run(10.0, 30)
    plain = _point(run[:8000], 10.0)
    run["mode"][3000:6000] = Mode.HOLDING
    run["force_n"][3000:6999] = 17
    held = _points(run, [cycles(0, 12_000 - 3999, 10.0, 2000)])[0]
    assert held.gain == pytest.approx(plain.gain, rel=1e-6)
    assert held.cycles == 20


def test_stretches_of_the_same_sine_are_one_point() -> None:
    parts = [_run(20.0, 10), _run(20.0, 10)[37:]]
    run = np.concatenate(parts)
    run["tick"] = FIRST_TICK + np.arange(len(run))
    at = len(parts[0])
    [point] = _points(run, [cycles(0, at, 20.0, 2000), cycles(at, len(run), 20.0, 2000)])
    assert point.gain == pytest.approx(GAIN, rel=1e-5)
    assert point.phase_deg == pytest.approx(LAG_DEG, abs=1e-3)
    assert point.cycles == 19


def test_less_than_a_cycle_is_no_point_and_one_cycle_has_no_interval() -> None:
    run = _run(10.0, 2)
    assert _points(run[:390], [cycles(0, 800, 10.0, 2000)]) == []
    [point] = _points(run[:400], [cycles(0, 800, 10.0, 2000)])
    assert point.gain_95 == (0.0, math.inf)
    assert not point.settled


def test_a_transfer_whose_input_stands_still_has_no_point() -> None:
    records = _run(10.0, 20)
    records["displacement_command_m"] = 0.002
    walk = Walk(
        iter([cycles(0, len(records), 10.0, 2000)]), PERIOD_S, also=channels_of(TRANSFERS.values())
    )
    stepped = SteppedSine(PERIOD_S)
    for part in walk.take(records):
        stepped.take(part)
    assert [p.transfer for p in stepped.points()] == ["force", "compliance"]
