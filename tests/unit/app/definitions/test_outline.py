"""What a test comes to is what the loop will do; whatever a test says, it never jumps but by steps."""

import math
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings

from app.definitions.definition import Definition
from app.definitions.expansion import expand
from app.definitions.outline import outline
from app.definitions.reading import definition_from
from app.definitions.windows import windows
from tests.unit.app.definitions import bad, strategies
from tests.unit.app.definitions.playing import PERIOD_S, play

RATE_HZ = 4000
RATE_LIMIT_N_S = 2e6
STEEPEST_RISE_N = math.pi / 2 * 4000 / 12  # a step of 4 kN with a rise time of 3 ms, in a tick
SOME = settings(max_examples=100, deadline=None)
smooth = strategies.definitions(strategies.smooth_blocks)
sudden = strategies.definitions(strategies.smooth_blocks | strategies.step)


def _read(data: Any) -> Definition:
    definition = definition_from(data)
    assert isinstance(definition, Definition), definition.detail
    return definition


def _sines(blocks: list[Any]) -> list[tuple[float, float]]:
    """Amplitude and frequency of every harmonic in blocks."""
    found = []
    for block in blocks:
        if block["kind"] in ("harmonic", "layers"):
            layers = block.get("layers", [block])
            found += [(layer["amplitude_n"], layer["frequency_hz"]) for layer in layers]
        found += _sines(block.get("blocks", []))
    return found


def _most_in_a_tick_n(data: strategies.Data) -> float:
    """What a setpoint may move in a tick: the swing of the strongest sine, and what blends."""
    sines = _sines(data["blocks"])
    amplitude = max((a for a, _ in sines), default=0.0)
    swing = 2 * math.pi * amplitude * max((f for _, f in sines), default=0.0)
    return (swing + max(swing, RATE_LIMIT_N_S) + RATE_LIMIT_N_S) * PERIOD_S


def _steps(blocks: list[Any]) -> int:
    """How many sudden steps there are."""
    total = 0
    for block in blocks:
        total += block["kind"] == "step"
        total += block.get("times", 1) * _steps(block.get("blocks", []))
    return total


@SOME
@given(smooth)
def test_no_block_makes_the_setpoint_jump(data: strategies.Data) -> None:
    definition = _read(data)
    ticks = round(outline(definition).duration_s * RATE_HZ)
    played = play(expand(definition).force, ticks + 2)
    moved = np.abs(np.diff(played.value, prepend=0.0))
    assert moved.max() <= _most_in_a_tick_n(data) + 1e-6


@SOME
@given(sudden)
def test_only_steps_make_it_jump(data: strategies.Data) -> None:
    definition = _read(data)
    ticks = round(outline(definition).duration_s * RATE_HZ)
    played = play(expand(definition).force, ticks + 2)
    moved = np.abs(np.diff(played.value, prepend=0.0))
    sudden = moved > _most_in_a_tick_n(data) + STEEPEST_RISE_N
    assert np.sum(sudden) <= _steps(data["blocks"])


@SOME
@given(sudden)
def test_durations_cycles_and_peaks_are_what_the_generator_does(data: strategies.Data) -> None:
    definition = _read(data)
    found = outline(definition)
    ticks = round(found.duration_s * RATE_HZ)
    played = play(expand(definition).force, ticks + 5)
    assert played.ticks == ticks
    assert abs(found.peak_force_n) <= 50e3
    for block in found.blocks:
        first = round(block.start_s * RATE_HZ)
        last = first + round(block.duration_s * RATE_HZ)
        values = played.value[first:last]
        if len(values) == 0:  # a ramp to where it is already
            continue
        assert set(played.block[first:last]) == {block.index}
        assert values.min() >= block.min_force_n - 1e-6
        assert values.max() <= block.max_force_n + 1e-6
        assert abs(int(played.cycle[last - 1]) - block.cycles) <= 1


@SOME
@given(sudden)
def test_motion_lasts_and_reaches_what_the_outline_says(data: strategies.Data) -> None:
    definition = _read(data)
    found = outline(definition)
    ticks = round(found.motion_duration_s * RATE_HZ)
    played = play(expand(definition).motion, ticks + 5)
    assert played.ticks == ticks
    assert np.abs(played.value).max() <= found.peak_displacement_m + 1e-12


@SOME
@given(sudden)
def test_windows_hold_exactly_the_ticks_that_count(data: strategies.Data) -> None:
    definition = _read(data)
    found = outline(definition)
    ticks = round(found.duration_s * RATE_HZ)
    data_windows = windows(definition, ticks)
    assert data_windows.ticks == ticks
    played = play(expand(definition).force, ticks + 1)
    counting = np.flatnonzero(np.diff(played.cycle))
    counts_up = counting[played.cycle[counting + 1] > played.cycle[counting]] + 1
    for tick in counts_up:
        # the last cycle of a stretch is counted at its end, in the first tick after it
        assert any(first <= tick <= last for first, last in data_windows.cycles)
    assert len(data_windows.steps) == _steps(data["blocks"])
    for step in data_windows.steps:
        assert step.end_n == pytest.approx(played.value[step.last - 1], abs=1e-9)


def test_windows_leave_out_what_tapers_blends_and_leads() -> None:
    blocks = (
        bad.sine(cycles=10, taper_cycles=5),  # 400 + 800 + 400 ticks
        bad.sine(cycles=10, taper_cycles=0),  # 400 + 800
        bad.layers() | {"repeats": 2},  # twice 400 + 400, then 400
        {"kind": "step", "to_n": 100, "hold_s": 0.1},  # 400
    )
    found = windows(_read(bad.with_blocks(*blocks)), 100_000)
    assert list(found.cycles) == [(400, 1200), (2000, 2800), (3200, 3600), (4000, 4400)]
    assert list(found.steps) == [(4800, 5200, 0.0, 100.0)]


def test_windows_end_where_the_run_did() -> None:
    endless = _read(bad.with_blocks(bad.repeat(1_000_000, bad.sine(cycles=10, taper_cycles=5))))
    assert list(windows(endless, 2500).cycles) == [(400, 1200), (2000, 2800)]


def test_a_million_repeats_are_outlined_in_closed_form() -> None:
    ramps = (bad.ramp(to_n=1000, rate_n_s=100_000), bad.ramp(to_n=200, rate_n_s=100_000))
    found = outline(_read(bad.with_blocks(bad.repeat(1_000_000, *ramps))))
    # up from 0 once, from 200 N ever after; 1000 N take 40 ticks, 800 N 32
    assert round(found.duration_s * RATE_HZ) == (40 + 32) + 999_999 * (32 + 32)
    assert (found.blocks[0].min_force_n, found.blocks[0].max_force_n) == (0, 1000)


def test_a_million_layers_are_outlined_in_closed_form() -> None:
    block = bad.layers() | {"repeats": 1_000_000}
    found = outline(_read(bad.with_blocks(block)))
    assert found.cycles == 10_000_000
    assert round(found.duration_s * RATE_HZ) == 1_000_000 * (400 + 400) + 400
    assert found.peak_force_n == 1000


def test_deep_repeats_are_outlined_at_once() -> None:
    block = bad.hold(force_n=100, duration_s=0.01)
    for _ in range(8):
        block = bad.repeat(3, bad.ramp(to_n=0), block, bad.ramp(to_n=50))
    assert outline(_read(bad.with_blocks(block))).peak_force_n == 100
