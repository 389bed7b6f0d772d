"""What the loop makes of a definition: against closed forms, through the loop's own generator."""

from typing import Any

import numpy as np
import numpy.typing as npt
import pytest

from app.definitions.definition import Definition
from app.definitions.expansion import expand
from app.definitions.outline import outline
from app.definitions.reading import definition_from
from rtcore.program.segments import MAX_SEGMENTS, Branch, Segment
from tests.unit.app.definitions import bad
from tests.unit.app.definitions.playing import PERIOD_S, Played, play

RATE_HZ = 4000
Values = npt.NDArray[np.float64]


def _definition(*blocks: bad.Data, **others: object) -> Definition:
    definition = definition_from(bad.with_blocks(*blocks, **others))
    assert isinstance(definition, Definition), definition.detail
    return definition


def _played(*blocks: bad.Data, extra_ticks: int = 10) -> Played:
    definition = _definition(*blocks)
    ticks = round(outline(definition).duration_s * RATE_HZ)
    return play(expand(definition).force, ticks + extra_ticks)


def _table(definition: Definition) -> Any:
    """The one array of segments of a force course that fits."""
    (table,) = expand(definition).force.segments
    return table


def _blend(ticks: int) -> Values:
    """Half a cosine from 0 to 1 in so many ticks, its end left out."""
    return 0.5 - 0.5 * np.cos(np.pi * np.arange(ticks) / ticks)


def test_a_hold_at_a_force_is_led_in_along_half_a_cosine() -> None:
    played = _played(bad.hold(force_n=5000, duration_s=0.2))
    assert played.ticks == 400 + 800  # 0.1 s of lead-in
    np.testing.assert_allclose(played.value[:400], 5000 * _blend(400), atol=1e-9)
    np.testing.assert_allclose(played.value[400:], 5000)


def test_a_hold_without_a_force_stays_where_it_is() -> None:
    played = _played(bad.ramp(to_n=1234, rate_n_s=1e5), bad.hold(duration_s=0.1))
    assert played.ticks == 50 + 400  # 1234 N at 25 N a tick
    np.testing.assert_allclose(played.value[50:], 1234)


@pytest.mark.parametrize(
    ("timing", "ticks"), [({"rate_n_s": 20000}, 400), ({"rate_n_s": None, "duration_s": 0.05}, 200)]
)
def test_a_ramp_is_a_straight_line_by_rate_or_by_duration(timing: bad.Data, ticks: int) -> None:
    played = _played(bad.ramp(to_n=-2000, **timing))
    assert played.ticks == ticks
    np.testing.assert_allclose(played.value[:ticks], np.linspace(0, -2000, ticks + 1)[:-1])
    np.testing.assert_allclose(played.value[ticks:], -2000)


def test_a_step_is_sudden_and_one_with_a_rise_time_is_half_a_cosine() -> None:
    sudden = _played({"kind": "step", "to_n": 2000, "hold_s": 0.1})
    assert sudden.ticks == 400
    np.testing.assert_allclose(sudden.value, 2000)
    rising = _played({"kind": "step", "to_n": 2000, "hold_s": 0.1, "rise_s": 0.01})
    assert rising.ticks == 440
    np.testing.assert_allclose(rising.value[:40], 2000 * _blend(40), atol=1e-9)


@pytest.mark.parametrize("taper_cycles", [0.5, 2, 5])
@pytest.mark.parametrize("phase_deg", [0, 90, -30])
def test_a_harmonic_tapers_in_and_out_around_its_cycles(
    taper_cycles: float, phase_deg: float
) -> None:
    mean, amplitude, hz, cycles = 500.0, 2000.0, 50.0, 10
    played = _played(
        bad.sine(
            mean_n=mean,
            amplitude_n=amplitude,
            frequency_hz=hz,
            cycles=cycles,
            taper_cycles=taper_cycles,
            phase_deg=phase_deg,
        )
    )
    taper, steady = round(taper_cycles * 80), cycles * 80
    assert played.ticks == taper + steady + taper
    time_s = (np.arange(played.ticks) - taper) * PERIOD_S  # the phase holds where it is steady
    grown = np.concatenate([_blend(taper), np.ones(steady), 1 - _blend(taper)])
    means = np.concatenate([mean * _blend(taper), np.full(steady + taper, mean)])
    expected = means + amplitude * grown * np.sin(2 * np.pi * hz * time_s + np.radians(phase_deg))
    np.testing.assert_allclose(played.value[: played.ticks], expected, atol=1e-6)
    np.testing.assert_allclose(played.value[played.ticks :], mean, atol=1e-6)


def test_only_full_cycles_count() -> None:
    played = _played(bad.sine(cycles=10, taper_cycles=5))
    assert played.cycle[400 : 400 + 800 : 80].tolist() == list(range(10))
    assert played.cycle[:400].max() == 0
    assert set(played.cycle[1200:]) == {10}


def test_a_harmonic_without_tapers_is_led_in_to_where_it_starts() -> None:
    played = _played(bad.sine(taper_cycles=0, phase_deg=90, cycles=10, mean_n=1000))
    assert played.ticks == 400 + 800
    np.testing.assert_allclose(played.value[:400], 3000 * _blend(400), atol=1e-9)
    time_s = np.arange(800) * PERIOD_S
    expected = 1000 + 2000 * np.cos(2 * np.pi * 50 * time_s)
    np.testing.assert_allclose(played.value[400:1200], expected, atol=1e-6)


def test_a_duration_that_is_no_whole_tick_goes_to_the_nearest() -> None:
    assert _played(bad.sine(frequency_hz=30, cycles=200, taper_cycles=0)).ticks == 400 + 26_667
    assert _played(bad.hold(duration_s=0.000_01)).ticks == 1


def test_layers_blend_mean_amplitude_and_frequency_into_one_another() -> None:
    first = {"mean_n": 1000, "amplitude_n": 2000, "frequency_hz": 50, "cycles": 5}
    second = {"mean_n": -3000, "amplitude_n": 500, "frequency_hz": 80, "cycles": 8}
    block = {"kind": "layers", "layers": [first, second], "repeats": 2, "transition_s": 0.1}
    played = _played(block)
    steady, blend = 400, _blend(400)  # each part takes 0.1 s
    path = [first, second, first, second]
    means: list[Values] = []
    amplitudes: list[Values] = []
    frequencies: list[Values] = []
    before = {"mean_n": 0, "amplitude_n": 0, "frequency_hz": 50}
    for layer in [*path, second | {"amplitude_n": 0}]:
        for values, key in ((means, "mean_n"), (amplitudes, "amplitude_n")):
            values.append(before[key] + (layer[key] - before[key]) * blend)
        share = np.arange(400) / 400
        change = layer["frequency_hz"] - before["frequency_hz"]
        # what the phase gains in a tick is the frequency in the middle of it
        frequencies.append(before["frequency_hz"] + change * (share + 0.5 / 400))
        if layer["amplitude_n"]:
            means.append(np.full(steady, float(layer["mean_n"])))
            amplitudes.append(np.full(steady, float(layer["amplitude_n"])))
            frequencies.append(np.full(steady, float(layer["frequency_hz"])))
        before = layer
    turned = np.cumsum(np.concatenate(frequencies)) * PERIOD_S
    phase = np.concatenate([[0.0], turned[:-1]])
    expected = np.concatenate(means) + np.concatenate(amplitudes) * np.sin(2 * np.pi * phase)
    assert played.ticks == len(expected) == 9 * 400
    np.testing.assert_allclose(played.value[: played.ticks], expected, atol=1e-6)
    assert played.cycle[-1] == 2 * (5 + 8)


def test_a_repeat_plays_its_blocks_so_many_times() -> None:
    step = {"kind": "step", "to_n": 1000, "hold_s": 0.01}
    back = {"kind": "step", "to_n": 0, "hold_s": 0.02}
    played = _played(bad.repeat(3, bad.repeat(2, step, back), bad.hold(duration_s=0.03)))
    once = np.concatenate([np.full(40, 1000.0), np.zeros(80)])
    expected = np.tile(np.concatenate([once, once, np.zeros(120)]), 3)
    assert played.ticks == len(expected)
    np.testing.assert_allclose(played.value[: len(expected)], expected)


def test_a_million_repeats_take_one_segment_more() -> None:
    one = _table(_definition(bad.repeat(1, bad.hold(duration_s=0.01))))
    million = _table(_definition(bad.repeat(1_000_000, bad.hold(duration_s=0.01))))
    assert len(one) == len(million) == 3
    assert million[1]["times"] == 1_000_000


def test_the_block_of_a_segment_is_the_top_level_block() -> None:
    played = _played(bad.hold(duration_s=0.01), bad.repeat(2, bad.hold(duration_s=0.01)))
    assert played.block[:40].tolist() == [0] * 40
    assert set(played.block[40:]) == {1}


EXCLUDED, WITHOUT, WITH = Branch.EXCLUDED, Branch.WITHOUT_NOTCH, Branch.WITH_NOTCH


@pytest.mark.parametrize(
    ("compensation", "others", "harmonics"),
    [("auto", EXCLUDED, WITH), ("on", WITHOUT, WITH), ("off", EXCLUDED, EXCLUDED)],
)
def test_compensation_depends_on_the_kind_of_block(
    compensation: str, others: Branch, harmonics: Branch
) -> None:
    blocks = (
        bad.hold(),
        bad.ramp(),
        bad.sine(),
        bad.layers(),
        bad.repeat(2, bad.sine(), bad.hold()),
    )
    definition = _definition(*blocks, controller={"compensation": compensation})
    segments = _table(definition)
    used = segments[(segments["kind"] != Segment.REPEAT) & (segments["kind"] != Segment.END)]
    for segment in used:
        harmonic = segment["kind"] == Segment.HARMONIC
        assert segment["branch"] == (harmonics if harmonic else others)
    assert {int(kind) for kind in used["kind"]} >= {Segment.HARMONIC, Segment.HOLD, Segment.LINEAR}


def test_motion_has_a_table_of_its_own() -> None:
    definition = _definition(
        bad.hold(),
        motion=[{"kind": "harmonic", "amplitude_m": 0.002, "frequency_hz": 4, "cycles": 2}],
    )
    program = expand(definition)
    played = play(program.motion, 4010)
    assert played.ticks == 4000  # a cycle of taper on either side
    steady = 0.002 * np.sin(2 * np.pi * 4 * np.arange(2000) * PERIOD_S)
    np.testing.assert_allclose(played.value[1000:3000], steady, atol=1e-12)
    assert set(played.branch) == {Branch.EXCLUDED}


def test_a_table_ends_with_its_end_and_may_be_full() -> None:
    (nothing,) = expand(_definition(bad.hold())).motion.segments
    assert nothing["kind"].tolist() == [Segment.END]
    blocks = [bad.repeat(1, *[bad.hold(duration_s=0.01)] * 818)] * 5
    full = _table(_definition(*blocks))
    assert len(full) == MAX_SEGMENTS
    assert full[-1]["kind"] == Segment.END
