"""The envelope against the plain definition of it: least and greatest of each stretch of ticks."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from app.recording.samples import Columns
from app.runs.envelope import envelope


@given(
    ticks=st.lists(st.integers(0, 400), min_size=1, max_size=200, unique=True),
    points=st.integers(1, 500),
    chunk=st.integers(1, 60),
    seed=st.integers(0, 1000),
)
def test_it_is_the_least_and_the_greatest_of_every_stretch(
    ticks: list[int], points: int, chunk: int, seed: int
) -> None:
    at = np.array(sorted(ticks))
    values = np.random.default_rng(seed).normal(size=len(at))
    values[seed % len(at)] = np.nan
    parts: list[Columns] = [
        {"tick": at[i : i + chunk], "force_n": values[i : i + chunk]}
        for i in range(0, len(at), chunk)
    ]
    first, last = int(at[0]), int(at[-1])
    found = envelope(parts, ["force_n"], first, last, points)
    width = found.bin_ticks
    assert len(found.ticks) <= points
    assert (width == 1) == (last - first + 1 <= points)
    starts = list(range(first, last + 1, width))
    inside = [(at >= start) & (at < start + width) for start in starts]
    kept = [(start, values[i]) for start, i in zip(starts, inside, strict=True) if i.any()]
    assert found.ticks.tolist() == [start for start, _ in kept]
    for i, (_, stretch) in enumerate(kept):
        finite = stretch[~np.isnan(stretch)]
        if len(finite) == 0:
            assert np.isnan(found.low["force_n"][i])
            continue
        assert found.low["force_n"][i] == finite.min()
        assert found.high["force_n"][i] == finite.max()


def test_nothing_in_the_window_gives_nothing() -> None:
    empty = envelope([], ["force_n"], 10, 5, 100)
    assert (len(empty.ticks), len(empty.low["force_n"])) == (0, 0)
