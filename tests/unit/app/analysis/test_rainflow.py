"""Turning points and rainflow counts against the standard's example, plain definitions and their symmetries."""

import itertools
from collections import Counter
from collections.abc import Sequence

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from app.analysis.damage import class_width_n, damages, matrix, spectrum
from app.analysis.rainflow_counting import count_cycles, iter_cycles
from app.analysis.turning_points import TurningPoints, turning_points

ASTM = [-2.0, 1.0, -3.0, 5.0, -1.0, 3.0, -4.0, 4.0, -2.0]  # E1049, figure 6
WHOLE = st.lists(st.integers(-20, 20).map(float), min_size=2, max_size=60)


def counted(values: Sequence[float], gate: float = 0.0) -> Counter[tuple[float, float]]:
    """Cycles by range and mean."""
    found: Counter[tuple[float, float]] = Counter()
    for extent, mean, count in iter_cycles([np.array(values)], gate):
        found[extent, mean] += count  # type: ignore[assignment]  # half cycles are counted too
    return found


def plainly_turned(values: Sequence[float]) -> list[float]:
    """The plain definition: where the sign of the change changes, and both ends."""
    moved = [v for i, v in enumerate(values) if i == 0 or v != values[i - 1]]
    inner = [
        b for a, b, c in zip(moved, moved[1:], moved[2:], strict=False) if (b - a) * (c - b) < 0
    ]
    return [] if len(moved) < 2 else [moved[0], *inner, moved[-1]]


def test_the_example_of_the_standard() -> None:
    ranges: Counter[float] = Counter()
    for (extent, _), count in counted(ASTM).items():
        ranges[extent] += count
    assert ranges == {3: 0.5, 4: 1.5, 6: 0.5, 8: 1.0, 9: 0.5}


@given(WHOLE)
def test_turning_points_are_those_of_the_plain_definition(values: list[float]) -> None:
    assert list(turning_points([np.array(values)])) == plainly_turned(values)


@given(WHOLE, st.lists(st.integers(0, 60), max_size=5), st.floats(0, 10))
def test_chunks_do_not_matter(values: list[float], cuts: list[int], gate: float) -> None:
    chunks = np.split(np.array(values), sorted(cuts))
    assert list(turning_points(chunks, gate)) == list(turning_points([np.array(values)], gate))


@given(WHOLE, st.floats(0.1, 30))
def test_a_gate_leaves_no_smaller_range_and_no_extreme_out(
    values: list[float], gate: float
) -> None:
    found = list(turning_points([np.array(values)], gate))
    assert all(abs(a - b) >= gate for a, b in itertools.pairwise(found))
    if found:
        assert (max(found), min(found)) == (max(values), min(values))
    else:
        assert max(values) - min(values) < gate


@given(WHOLE)
def test_turned_upside_down_it_counts_the_same_ranges(values: list[float]) -> None:
    mirrored = counted([-v for v in values])
    assert mirrored == Counter({(r, -m): n for (r, m), n in counted(values).items()})


@given(WHOLE, st.sampled_from([2.0, 8.0]), st.integers(-3, 3))
def test_scaled_and_shifted_it_counts_scaled_and_shifted(
    values: list[float], scale: float, shift: int
) -> None:
    found = counted([scale * v + shift for v in values])
    assert found == Counter(
        {(scale * r, scale * m + shift): n for (r, m), n in counted(values).items()}
    )


@given(WHOLE)
def test_every_range_is_counted_once(values: list[float]) -> None:
    """A cycle is as long as two of its ranges, a half cycle as one: nothing of the way is lost."""
    points = list(turning_points([np.array(values)]))
    way = sum(abs(a - b) for a, b in itertools.pairwise(points))
    assert sum(2 * r * n for (r, _), n in counted(values).items()) == pytest.approx(way)


@given(WHOLE, st.integers(2, 5))
def test_a_history_played_again_from_where_it_ended_counts_its_closed_cycles_again(
    values: list[float], times: int
) -> None:
    """From the highest point to the highest point all cycles close (ASTM E1049, 5.4.5)."""
    start = int(np.argmax(values))
    closed = [*values[start:], *values[:start], values[start]]
    once = Counter[float]()
    for (extent, _), count in counted(closed).items():
        once[extent] += count
    again = Counter[float]()
    for (extent, _), count in counted(closed + closed[1:] * (times - 1)).items():
        again[extent] += count
    assert again == Counter({extent: times * count for extent, count in once.items()})


def test_what_is_no_number_is_passed_over_and_counted() -> None:
    turning = TurningPoints()
    found = [*turning.take(np.array([0.0, 1.0, np.nan, 0.5, 2.0])), *turning.close()]
    assert (found, turning.lost) == ([0, 1, 0.5, 2], 1)


def test_damage_of_a_sine_is_that_of_its_amplitude() -> None:
    time_s = np.arange(40_001) / 4000
    asked = count_cycles([3000 * np.cos(2 * np.pi * 10 * time_s)])
    applied = count_cycles([1000 + 3300 * np.cos(2 * np.pi * 10 * time_s)])
    assert asked.cycles == 100
    for damage in damages(asked, applied):
        assert damage.asked_amplitude_n == pytest.approx(3000)
        assert damage.applied_amplitude_n == pytest.approx(3300)
        assert damage.ratio == pytest.approx(1.1**damage.exponent)
    width_n = class_width_n(asked, applied)
    (cell,) = matrix(applied, width_n)
    assert cell.range_n <= 6600 < cell.range_n + width_n
    assert cell.mean_n <= 1000 < cell.mean_n + width_n
    rows = spectrum(asked, applied)
    assert sum(row.asked for row in rows) == sum(row.applied for row in rows) == 100
    assert (rows[0].from_n, rows[-1].applied) == (0, 100)


def test_noise_of_the_load_cell_makes_no_cycles() -> None:
    noise_n = 8 * np.random.default_rng(5).standard_normal(1_000_000)
    assert count_cycles(np.array_split(noise_n, 7)).cycles == 0
