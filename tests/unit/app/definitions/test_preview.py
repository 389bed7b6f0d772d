"""A preview shows what the loop will play, from wherever it begins."""

from itertools import pairwise
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from app.definitions.definition import Definition
from app.definitions.expansion import expand
from app.definitions.limits import RIG
from app.definitions.outline import outline
from app.definitions.preview import LONGEST_S, preview
from app.definitions.reading import definition_from
from tests.unit.app.definitions import bad, strategies
from tests.unit.app.definitions.playing import play

RATE_HZ = 4000
ROUNDING = 2e-9  # of the range: the phase of a sine many cycles into a test is rounded
SOME = settings(max_examples=60, deadline=None)
anything = strategies.definitions(strategies.every_block)


def _read(data: Any) -> Definition:
    definition = definition_from(data)
    assert isinstance(definition, Definition), definition.detail
    return definition


@SOME
@given(anything, st.floats(0, 1), st.integers(1, 700), st.integers(1, 300))
def test_a_window_shows_what_is_played_in_it(
    data: Any, begin: float, length: int, points: int
) -> None:
    definition = _read(data)
    whole = max(round(outline(definition).duration_s * RATE_HZ), 1)
    first = min(round(begin * whole), whole - 1)
    last = min(first + length, whole)
    found = preview(definition, first / RATE_HZ, last / RATE_HZ, points)
    program = expand(definition)
    force, motion = (play(course, last).value[first:] for course in (program.force, program.motion))
    bins = min(points, last - first)
    assert len(found.time_s) == bins
    assert found.decimated == (bins < last - first)
    edges = [-(-i * (last - first) // bins) for i in range(bins + 1)]
    np.testing.assert_allclose(found.time_s, [(first + edge) / RATE_HZ for edge in edges[:-1]])
    for low, high, values, within in (
        (found.force_min_n, found.force_max_n, force, ROUNDING * RIG.force_limit_n),
        (found.displacement_min_m, found.displacement_max_m, motion, ROUNDING * RIG.stroke_limit_m),
    ):
        parts = [values[a:b] for a, b in pairwise(edges)]
        np.testing.assert_allclose(low, [part.min() for part in parts], rtol=0, atol=within)
        np.testing.assert_allclose(high, [part.max() for part in parts], rtol=0, atol=within)
    assert found.peaks.force_n == pytest.approx(
        np.abs(force).max(), rel=0, abs=ROUNDING * RIG.force_limit_n
    )
    assert found.peaks.displacement_m == pytest.approx(
        np.abs(motion).max(), rel=0, abs=ROUNDING * RIG.stroke_limit_m
    )
    steepest = np.abs(np.diff(force)).max(initial=0.0) * RATE_HZ
    assert found.peaks.force_rate_n_s == pytest.approx(steepest, rel=1e-6, abs=0.01)


def test_peaks_say_when() -> None:
    ramps = [bad.ramp(to_n=3000, rate_n_s=30_000), bad.ramp(to_n=0, rate_n_s=60_000)]
    found = preview(_read(bad.with_blocks(bad.hold(), *ramps)))
    assert found.from_s == 0
    assert found.to_s == found.duration_s == pytest.approx(1.15)
    assert found.peaks.force_n == pytest.approx(3000)
    assert found.peaks.force_at_s == pytest.approx(1.1)
    assert found.peaks.force_rate_n_s == pytest.approx(60_000)
    assert found.peaks.force_rate_at_s == pytest.approx(1.1, abs=0.051)
    assert set(found.block) == {0, 1, 2}


def test_a_window_far_into_a_long_test_is_where_it_says() -> None:
    # 0.1 s of lead-in before the first pass only: no pass is played to get there
    block = bad.repeat(1_000_000, bad.sine(cycles=100, frequency_hz=25, taper_cycles=5))
    definition = _read(bad.with_blocks(block))
    pass_s = 4.4
    first = preview(definition, pass_s, 2 * pass_s, 500)
    late = preview(definition, 654_321 * pass_s, 654_322 * pass_s, 500)
    np.testing.assert_allclose(late.force_max_n, first.force_max_n, atol=1e-6)
    assert late.from_s == pytest.approx(654_321 * pass_s)


def test_layers_go_on_in_phase_from_pass_to_pass() -> None:
    layer = {"mean_n": 0, "amplitude_n": 1000, "frequency_hz": 30, "cycles": 1}
    block = {"kind": "layers", "layers": [layer], "repeats": 5000, "transition_s": 0.01}
    definition = _read(bad.with_blocks(block))
    ticks = 4000 * (40 + 133) + 77
    found = preview(definition, ticks / RATE_HZ, (ticks + 100) / RATE_HZ, 100)
    played = play(expand(definition).force, ticks + 100)
    np.testing.assert_allclose(found.force_min_n, played.value[ticks:], atol=1e-4)


def test_a_window_that_is_too_long_is_shortened_and_says_so() -> None:
    definition = _read(bad.with_blocks(bad.hold(duration_s=1e6)))
    found = preview(definition, 500.0, None, 10)
    assert found.shortened
    assert found.to_s - found.from_s == LONGEST_S
    assert not preview(definition, 500.0, 600.0, 10).shortened


@pytest.mark.parametrize(("from_s", "to_s"), [(-5.0, 2.0), (0.5, 0.1), (9.0, 99.0), (0.0, 1e300)])
def test_a_window_beyond_the_test_is_moved_into_it(from_s: float, to_s: float) -> None:
    found = preview(_read(bad.with_blocks(bad.hold())), from_s, to_s)
    assert 0 <= found.from_s < found.to_s <= 1
