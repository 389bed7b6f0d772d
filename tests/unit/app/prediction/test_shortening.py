"""A long test cut down: the same peak, the same blocks, nothing that does not meet any more."""

from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from app.definitions.definition import Definition
from app.definitions.outline import outline
from app.definitions.reading import definition_from
from app.prediction.shortening import WHOLE_S, shorten


def _definition(blocks: list[dict[str, Any]], motion: list[dict[str, Any]] | None = None) -> Any:
    data = {"schema": 1, "name": "long", "blocks": blocks, "motion": motion or []}
    return definition_from(data)


def _valid(blocks: list[dict[str, Any]], motion: list[dict[str, Any]] | None = None) -> Definition:
    found = _definition(blocks, motion)
    assert isinstance(found, Definition), found.detail
    return found


SINE = {"kind": "harmonic", "amplitude_n": 2000, "frequency_hz": 50}


def test_a_test_of_a_minute_is_predicted_whole() -> None:
    whole = _valid([SINE | {"duration_s": WHOLE_S - 1}])
    assert shorten(whole).definition is whole
    assert shorten(whole).cuts == ()


@pytest.mark.parametrize(
    ("block", "says"),
    [
        (SINE | {"cycles": 1_000_000}, "block 1: 250 of 1,000,000 cycles"),
        (SINE | {"duration_s": 20_000.0}, "block 1: 250 of 1,000,000 cycles"),
        ({"kind": "hold", "duration_s": 3600.0}, "block 1: 5 s of 3,600 s at rest"),
        (
            {"kind": "ramp", "to_n": 50_000, "rate_n_s": 10},
            "block 1: its way in 60 s instead of 5,000 s",
        ),
        ({"kind": "step", "to_n": 1000, "hold_s": 600.0}, "block 1: 5 s of 600 s at rest"),
        (
            {"kind": "repeat", "times": 1_000_000, "blocks": [SINE | {"cycles": 400}]},
            "block 1: one of 1,000,000 passes",
        ),
        (
            {
                "kind": "repeat",
                "times": 1000,
                "blocks": [{"kind": "hold", "force_n": 500, "duration_s": 8.0}],
            },
            "block 1: 2 of 1,000 passes",  # the first leads in from 0 N, those after it do not
        ),
        (
            {
                "kind": "layers",
                "repeats": 500,
                "transition_s": 0.5,
                "layers": [{"amplitude_n": 1000, "frequency_hz": 20, "cycles": 200}],
            },
            "block 1: 2 of 500 passes",
        ),
    ],
)
def test_one_of_whatever_repeats_is_kept(block: dict[str, Any], says: str) -> None:
    found = shorten(_valid([block]))
    assert [cut.text for cut in found.cuts] == [says]
    assert found.cuts[0].path == "blocks[0]"
    assert outline(found.definition).duration_s < 70


def test_what_is_within_a_block_is_named() -> None:
    layer = {"amplitude_n": 1000, "frequency_hz": 20, "cycles": 20_000}
    layers = {"kind": "layers", "transition_s": 0.5, "layers": [layer]}
    whole = _valid(
        [{"kind": "hold", "duration_s": 1.0}, {"kind": "repeat", "times": 2, "blocks": [layers]}]
    )
    (cut,) = shorten(whole).cuts[:1]
    assert cut.path == "blocks[1].blocks[0].layers[0]"
    assert cut.text == "block 2.1, layer 1: 100 of 20,000 cycles"


def test_a_motion_lasts_as_long_as_the_load_beside_it() -> None:
    motion = [{"kind": "harmonic", "amplitude_m": 0.002, "frequency_hz": 4, "duration_s": 1000.0}]
    blocks = [SINE | {"duration_s": 400.0}, {"kind": "hold", "force_n": 0, "duration_s": 600.0}]
    found = shorten(_valid(blocks, motion))
    assert found.apart == ()
    plan = outline(found.definition)
    assert plan.duration_s < 12
    assert plan.motion_duration_s >= plan.duration_s


def test_every_motion_meets_the_load_that_it_met() -> None:
    def at(hz: float) -> dict[str, Any]:
        return {"kind": "harmonic", "amplitude_m": 0.002, "frequency_hz": hz, "duration_s": 500.0}

    found = shorten(_valid([SINE | {"duration_s": 1500.0}], [at(1), at(4), at(8)]))
    assert found.apart == ()
    assert outline(found.definition).duration_s < 60


def test_what_does_not_meet_any_more_is_told() -> None:
    ends = SINE | {"duration_s": 5.0}
    blocks = [ends, {"kind": "hold", "duration_s": 3000.0}, ends]
    swing = {"kind": "harmonic", "amplitude_m": 0.002, "frequency_hz": 4, "duration_s": 20.0}
    found = shorten(_valid(blocks, [{"kind": "hold", "duration_s": 3004.9}, swing]))
    assert found.apart == ((2, 1),)


def test_what_would_come_apart_is_predicted_whole_where_that_is_quick() -> None:
    ends = SINE | {"duration_s": 5.0}
    blocks = [ends, {"kind": "hold", "duration_s": 1000.0}, ends]
    swing = {"kind": "harmonic", "amplitude_m": 0.002, "frequency_hz": 4, "duration_s": 20.0}
    whole = _valid(blocks, [{"kind": "hold", "duration_s": 1004.9}, swing])
    assert shorten(whole).definition is whole
    assert shorten(whole).apart == ()


def _swing(hz: float, seconds: float) -> dict[str, Any]:
    return {"kind": "harmonic", "amplitude_m": 0.02, "frequency_hz": hz, "duration_s": seconds}


def test_all_of_a_motion_is_seen_under_a_block_however_steady_that_is() -> None:
    hold = {"kind": "hold", "force_n": 10e3, "duration_s": 3600.0}
    samples = [0.0] * 6000 + [0.0005, 0.0]  # the unit moves in the sixtieth second only
    jolt = {"kind": "time_history", "samples_m": samples, "rate_hz": 100.0}
    for motion, needs_s in ((jolt, 60.0), (_swing(0.05, 3600.0), 60.0)):
        found = shorten(_valid([hold], [motion]))
        assert found.apart == ()
        assert needs_s <= outline(found.definition).duration_s < 600


def _steps(hold_s: float, times: int) -> dict[str, Any]:
    up, down = ({"kind": "step", "to_n": to, "hold_s": hold_s} for to in (5e3, -5e3))
    return {"kind": "repeat", "times": times, "blocks": [up, down]}


def test_what_repeats_out_of_step_with_a_motion_is_predicted_at_every_phase() -> None:
    drifting = [_steps(0.505, 100)], [_swing(1.0, 101.0)]
    assert shorten(_valid(*drifting)).cuts == ()  # a minute or two: all of it
    long = shorten(_valid([_steps(0.505, 5000)], [_swing(1.0, 5050.0)]))
    assert long.apart == ()
    assert outline(long.definition).duration_s > 90  # once about


def test_what_is_always_at_the_same_phases_of_a_motion_is_cut_short() -> None:
    sine = SINE | {"frequency_hz": 50.0, "duration_s": 3600.0}
    for block in (_steps(0.5, 5000), sine):
        found = shorten(_valid([block], [_swing(1.0, 5000.0)]))
        assert found.apart == ()
        assert outline(found.definition).duration_s < 10


def test_a_phase_that_cannot_be_predicted_is_told() -> None:
    sine = SINE | {"frequency_hz": 4.00001, "duration_s": 36000.0}
    swing = _swing(4.0, 36000.0) | {"amplitude_m": 0.002}
    assert shorten(_valid([sine], [swing])).apart == ((0, 0),)


def test_what_comes_after_a_cut_meets_the_motion_at_the_phase_that_it_had() -> None:
    blocks = [SINE | {"frequency_hz": 10.0, "duration_s": 3600.0}, _steps(0.5, 1)]
    found = shorten(_valid(blocks, [_swing(0.23, 4000.0)]))
    whole = outline(_valid(blocks)).blocks[1].start_s * 0.23
    kept = outline(found.definition).blocks[1].start_s * 0.23
    apart = abs((whole - kept + 0.5) % 1.0 - 0.5)
    assert apart < 0.07 or found.apart != ()


_SINES = st.builds(
    lambda amplitude, hz, seconds, mean: {
        "kind": "harmonic",
        "mean_n": mean,
        "amplitude_n": amplitude,
        "frequency_hz": hz,
        "duration_s": seconds,
    },
    st.floats(1, 20e3),
    st.floats(0.1, 100),
    st.floats(0.5, 5000),
    st.floats(-20e3, 20e3),
)
_HOLDS = st.builds(
    lambda to, seconds: {"kind": "hold", "force_n": to, "duration_s": seconds},
    st.floats(-50e3, 50e3),
    st.floats(0.1, 5000),
)
_RAMPS = st.builds(
    lambda to, rate: {"kind": "ramp", "to_n": to, "rate_n_s": rate},
    st.floats(-50e3, 50e3),
    st.floats(1, 1e5),
)
_LAYERS = st.builds(
    lambda layers, repeats: {
        "kind": "layers",
        "repeats": repeats,
        "transition_s": 1.0,
        "layers": [
            {"mean_n": m, "amplitude_n": a, "frequency_hz": f, "cycles": n} for m, a, f, n in layers
        ],
    },
    st.lists(
        st.tuples(
            st.floats(-2e4, 2e4), st.floats(0, 2e4), st.floats(0.5, 100), st.integers(1, 10**5)
        ),
        min_size=1,
        max_size=3,
    ),
    st.integers(1, 10**4),
)
_LEAVES = st.one_of(_SINES, _HOLDS, _RAMPS, _LAYERS)
_BLOCKS = st.recursive(
    _LEAVES,
    lambda inner: st.builds(
        lambda times, blocks: {"kind": "repeat", "times": times, "blocks": blocks},
        st.integers(1, 10**6),
        st.lists(inner, min_size=1, max_size=3),
    ),
    max_leaves=4,
)


@given(st.lists(_BLOCKS, min_size=1, max_size=4))
def test_peak_and_blocks_are_those_of_the_whole(blocks: list[dict[str, Any]]) -> None:
    whole = _definition(blocks)
    if not isinstance(whole, Definition):
        return  # longer than a year
    found = shorten(whole)
    before, after = outline(whole), outline(found.definition)
    assert after.peak_force_n == pytest.approx(before.peak_force_n, rel=1e-9)
    assert [b.kind for b in after.blocks] == [b.kind for b in before.blocks]
    for short, long in zip(after.blocks, before.blocks, strict=True):
        assert short.max_force_n == pytest.approx(long.max_force_n, rel=1e-6, abs=1e-3)
        assert short.min_force_n == pytest.approx(long.min_force_n, rel=1e-6, abs=1e-3)
    assert after.duration_s <= before.duration_s
    assert bool(found.cuts) == (found.definition is not whole)
    assert shorten(found.definition).definition.blocks == found.definition.blocks or (
        outline(shorten(found.definition).definition).peak_force_n
        == pytest.approx(before.peak_force_n, rel=1e-9)
    )
