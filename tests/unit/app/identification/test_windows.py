"""Which stretches of a recording a model is held against."""

import numpy as np
import pytest

from app.identification.model import DISPLACEMENT, FORCE, Model
from app.identification.windows import BEFORE, LENGTH, RUN_UP, Source, candidates, read
from rtcore.modes import Mode
from rtcore.rig.parameters import load_rig
from tests.unit.app.identification.made_up import PERIOD_S, SHORT, Kept, recorded


@pytest.fixture(scope="module")
def kept() -> Kept:
    """Three seconds under load, the unit moving."""
    data = {
        **SHORT,
        "blocks": [{"kind": "harmonic", "amplitude_n": 3000, "frequency_hz": 20, "duration_s": 3}],
    }
    return recorded(load_rig(), data)


def test_the_model_driven_by_what_was_recorded_gives_what_was_recorded(kept: Kept) -> None:
    window = read([Source(1, kept, 16)], 0, kept.first_tick + 6000, PERIOD_S)
    assert window is not None
    assert window.driving.shape == (RUN_UP + LENGTH, 2)
    found = Model(load_rig(), PERIOD_S).driven(window.start, window.driving)[RUN_UP:]
    apart = window.measured - found
    assert np.std(apart[:, FORCE]) == pytest.approx(8.0, rel=0.05)  # the load cell's own noise
    assert np.abs(np.mean(apart[:, FORCE])) < 1.0
    assert np.max(np.abs(apart[:, DISPLACEMENT])) < 1e-6  # a step of its converter
    late = np.std(window.measured[1:, FORCE] - found[:-1, FORCE])
    assert late > 9.0  # a tick of delay too much would show


def test_windows_are_spread_over_all_runs(kept: Kept) -> None:
    sources = [Source(7, kept, 16), Source(8, kept, 16)]
    found = list(candidates(sources, 12, PERIOD_S))
    assert {w.source for w in found} == {0, 1}
    first = [w.first_tick for w in found if w.source == 0]
    assert first == sorted(first)
    assert min(np.diff(first)) > 0
    assert first[-1] + LENGTH < kept.last_tick


@pytest.mark.parametrize(
    ("channel", "value"), [("mode", Mode.HOLDING), ("trips", 1), ("force_n", np.nan)]
)
def test_a_disturbed_stretch_is_left_out(kept: Kept, channel: str, value: float) -> None:
    records = kept.records.copy()
    records[channel][6000] = value
    disturbed = [Source(1, Kept(records), 16)]
    at = kept.first_tick + 6000
    assert read(disturbed, 0, at - 100, PERIOD_S) is None
    assert read(disturbed, 0, at - LENGTH - 2, PERIOD_S) is not None
    assert read(disturbed, 0, at + BEFORE + 1, PERIOD_S) is not None


def test_a_gap_is_left_out(kept: Kept) -> None:
    torn = [Source(1, Kept(np.delete(kept.records, 6000)), 16)]
    assert read(torn, 0, kept.first_tick + 5900, PERIOD_S) is None
