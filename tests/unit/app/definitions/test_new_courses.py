"""Sweeps, frequency responses and time histories as the loop plays them: against closed forms and scipy."""

import math
import tracemalloc
from itertools import islice
from pathlib import Path

import numpy as np
import numpy.typing as npt
import pytest
from scipy.interpolate import PchipInterpolator
from scipy.signal import chirp

from app.definitions.definition import Definition
from app.definitions.expansion import expand
from app.definitions.outline import outline
from app.definitions.reading import definition_from
from app.histories.store import Store, import_history
from rtcore.program.segments import KNOT, MAX_KNOTS, MAX_SEGMENTS, SEGMENT, Segment
from tests.unit.app.definitions import bad
from tests.unit.app.definitions.playing import PERIOD_S, Played, play

RATE_HZ = 4000
Values = npt.NDArray[np.float64]


def _definition(*blocks: bad.Data, **others: object) -> Definition:
    definition = definition_from(bad.with_blocks(*blocks, **others))
    assert isinstance(definition, Definition), definition.detail
    return definition


def _played(*blocks: bad.Data) -> Played:
    definition = _definition(*blocks)
    return play(expand(definition).force, round(outline(definition).duration_s * RATE_HZ) + 10)


@pytest.mark.parametrize(("from_hz", "to_hz"), [(2, 200), (200, 2), (10, 10.5)])
@pytest.mark.parametrize("law", ["log", "linear"])
def test_a_sweep_is_a_chirp(from_hz: float, to_hz: float, law: str) -> None:
    block = bad.sweep(from_hz=from_hz, to_hz=to_hz, mean_n=300, law=law, duration_s=2)
    played = _played(block)
    taper_in, taper_out = round(2 / from_hz * RATE_HZ), round(2 / to_hz * RATE_HZ)
    assert played.ticks == taper_in + 8000 + taper_out
    time_s = np.arange(8000) * PERIOD_S
    if law == "log":
        independent = chirp(time_s, from_hz, 2.0, to_hz, "logarithmic", phi=-90)
    else:
        independent = chirp(time_s, from_hz, 2.0, to_hz, "linear", phi=-90)
    steady = played.value[taper_in : taper_in + 8000]
    np.testing.assert_allclose(steady, 300 + 1000 * independent, atol=1e-5)
    assert played.value[-1] == pytest.approx(300, abs=1e-6)


def test_a_sweep_lasts_as_long_as_its_octaves_take() -> None:
    octaves = bad.sweep(from_hz=100, to_hz=12.5, duration_s=None, rate_octaves_s=2, taper_cycles=0)
    assert outline(_definition(octaves)).duration_s == pytest.approx(0.1 + 1.5)
    counted = outline(_definition(octaves)).cycles
    assert counted == math.floor((100 - 12.5) / math.log(8) * 1.5)  # the integral of the frequency


def test_a_stepped_sine_settles_and_then_counts_at_each_frequency() -> None:
    block = bad.response(
        amplitudes_n=[500, 1000], frequencies_hz=[20, 50], settle_cycles=3, measure_cycles=4
    )
    played = _played(block)
    # 0.1 s to blend, then 3 + 4 cycles of 200 or 80 ticks; twice, and out
    each = {20: (400, 600, 800), 50: (400, 240, 320)}
    tick, counted = 0, 0
    for amplitude in (500, 1000):
        for hz in (20, 50):
            blend, settle, measure = each[hz]
            steady = played.value[tick + blend : tick + blend + settle + measure]
            fitted = _fitted(steady, hz)
            assert np.abs(fitted) == pytest.approx(amplitude, rel=1e-6)
            quiet = played.cycle[tick : tick + blend + settle]
            assert set(quiet.tolist()) == {counted}
            tick += blend + settle + measure
            counted += 4
            assert played.cycle[tick] == counted
    assert played.ticks == tick + 400


def _fitted(values: Values, hz: float) -> complex:
    """The complex amplitude of a sine in whole cycles of samples."""
    turns = np.exp(-2j * np.pi * hz * np.arange(len(values)) * PERIOD_S)
    return complex(2 * np.mean(values * turns))


@pytest.mark.parametrize(
    "frequencies", [[10, 20, 50, 90], [12.5, 20], {"from_hz": 5, "to_hz": 100, "points": 9}]
)
def test_a_multisine_holds_its_lines_and_no_others(frequencies: object) -> None:
    block = bad.response(
        method="multisine",
        amplitudes_n=[2000],
        mean_n=500,
        frequencies_hz=frequencies,
        settle_cycles=1,
        measure_cycles=2,
    )
    definition = _definition(block)
    grid = definition.blocks[0].grid()  # type: ignore[union-attr]
    played = _played(block)
    period = grid.period_ticks
    assert played.ticks == 400 + 3 * period
    steady = played.value[400 : 400 + 3 * period].reshape(3, period)
    np.testing.assert_allclose(steady[1:], [steady[0]] * 2, atol=1e-9)
    spectrum = np.abs(np.fft.rfft(steady[0] - 500)) / (period / 2)
    lines = list(grid.lines)
    others = np.delete(spectrum, lines)
    assert np.ptp(spectrum[lines]) < 1e-6
    assert others.max() < 1e-6
    assert np.abs(steady[0] - 500).max() == pytest.approx(2000)
    crest = 2000 / np.sqrt(np.mean((steady[0] - 500) ** 2))
    assert crest < {2: 2.01, 4: 2.1, 9: 2.3}[len(lines)]  # of phases at random: 2.0, 2.8, 4.2


def test_the_lines_of_a_band_lie_near_what_was_asked_for() -> None:
    block = bad.response(
        method="multisine", frequencies_hz={"from_hz": 1, "to_hz": 100, "points": 30}
    )
    response = _definition(block).blocks[0]
    asked, found = response.frequencies(), response.grid().frequencies_hz()  # type: ignore[union-attr]
    assert len(found) == 30
    np.testing.assert_allclose(found, asked, rtol=0.09)


@pytest.mark.parametrize("rate_hz", [4000, 1000, 333.3, 61, 10])
def test_a_time_history_is_the_monotone_curve_through_its_samples(rate_hz: float) -> None:
    places = np.arange(200)
    samples = np.round(100 * np.sin(places * 0.05) * places / 200, 2)
    played = _played(bad.history(samples_n=samples.tolist(), rate_hz=rate_hz, gain=-2))
    ticks = math.ceil(199 / rate_hz * RATE_HZ - 1e-9)
    assert played.ticks == 400 + ticks
    truth = -2 * PchipInterpolator(places, samples)(
        np.minimum(np.arange(ticks) * PERIOD_S * rate_hz, 199)
    )
    np.testing.assert_allclose(played.value[400 : 400 + ticks], truth, atol=1e-9)
    assert played.value[-1] == -2 * samples[-1]


@pytest.mark.parametrize(("samples", "between"), [([5, 9, 5], 0), ([5, 9, 7], 400)])
def test_repeats_join_where_they_can_and_are_led_back_where_not(
    samples: list[float], between: int
) -> None:
    played = _played(bad.history(samples_n=samples, rate_hz=100, repeats=3))
    assert played.ticks == 400 + 3 * 80 + 2 * between
    moved = np.abs(np.diff(played.value, prepend=0))
    assert moved.max() < 0.25


def test_the_unit_follows_samples_too() -> None:
    definition = definition_from(bad.moving_history())
    assert isinstance(definition, Definition)
    lead_ticks = round(math.pi / 2 * 2 * 0.03 / 0.2 * RATE_HZ)
    played = play(expand(definition).motion, lead_ticks + 810)
    truth = PchipInterpolator([0, 0.05, 0.1, 0.15, 0.2], [0, 0.001, 0.002, 0.001, 0])
    found = played.value[lead_ticks : lead_ticks + 800]
    np.testing.assert_allclose(found, truth(np.arange(800) * PERIOD_S), atol=1e-12)


def test_a_course_that_does_not_fit_is_unrolled_with_its_repeats() -> None:
    few = [bad.ramp(to_n=100 * (i % 3), rate_n_s=1e5) for i in range(30)]
    short = bad.repeat(2, bad.repeat(3, *few), bad.history())
    long = bad.repeat(1, *[bad.hold(duration_s=0.001)] * 900)
    table = list(expand(_definition(short)).force.segments)
    assert len(table) == 1
    streamed = expand(_definition(short, *[long] * 5)).force
    arrays = list(streamed.segments)
    segments = np.concatenate(arrays)
    assert segments.dtype == SEGMENT
    assert Segment.REPEAT not in segments["kind"]
    assert len(segments) == 2 * (3 * 30 + 2) + 4500 + 1 > MAX_SEGMENTS
    assert segments["kind"][-1] == Segment.END
    assert segments["block"].tolist() == sorted(segments["block"].tolist())
    assert max(len(array) for array in arrays) < MAX_SEGMENTS
    alone = _played(short)
    together = play(streamed, alone.ticks + 4500 * 4 + 5)
    np.testing.assert_array_equal(together.value[: alone.ticks], alone.value[: alone.ticks])
    assert together.ticks == alone.ticks + 4500 * 4


def test_a_course_can_be_given_again() -> None:
    course = expand(_definition(*[bad.repeat(1, *[bad.hold()] * 900)] * 5, bad.history())).force
    for records in (course.segments, course.knots):
        first, second = (np.concatenate(list(records)).tobytes() for _ in range(2))
        assert first == second


def test_knots_come_in_the_order_of_playing_and_loops_without_any_are_not_turned() -> None:
    endless = bad.repeat(10_000_000, bad.hold(duration_s=0.001))
    body = bad.repeat(3, bad.history(repeats=2, samples_n=[1, 2]), endless)
    knots = np.concatenate(
        list(expand(_definition(endless, body, bad.history(gain=3))).force.knots)
    )
    assert knots.dtype == KNOT
    assert knots["value"].tolist() == [1, 2] * 6 + [0, 1200, 1500, 1200, 0, -300]


def test_a_day_s_history_takes_no_more_memory_than_a_minute_s(tmp_path: Path) -> None:
    lines = "\n".join(str(i % 600) for i in range(10_000)) + "\n"
    hours = 24
    parts = (lines.encode() for _ in range(hours * 3600 * 100 // 10_000))
    import_history(parts, "day.csv", tmp_path, rate_hz=100.0)
    block = {"kind": "time_history", "file": "day.csv"}
    definition = definition_from(bad.with_blocks(block), histories=Store(tmp_path))
    assert isinstance(definition, Definition), definition.detail
    assert outline(definition).duration_s == pytest.approx(hours * 3600, abs=0.2)
    tracemalloc.start()
    try:
        course = expand(definition).force
        given = sum(len(knots) for knots in course.knots)
        most = tracemalloc.get_traced_memory()[1]
    finally:
        tracemalloc.stop()
    assert given == hours * 3600 * 100 > 100 * MAX_KNOTS
    assert most < 10e6
    first = next(iter(course.knots))
    assert first["value"][:3].tolist() == [0, 1, 2]
    assert len(list(islice(course.knots, 3))) == 3
