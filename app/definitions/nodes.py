"""From blocks and motions to the pieces and loops they are made of: one function a kind."""

from collections.abc import Callable, Iterable
from dataclasses import replace
from typing import Any, Literal

from app.definitions import blocks as force
from app.definitions import motions as motion
from app.definitions.building import (
    course,
    harmonic,
    hold,
    layers,
    lead_in_s,
    ramp,
    step,
    stepped,
    sweep,
)
from app.definitions.limits import RIG
from app.definitions.multisine import period_of
from app.definitions.pieces import Loop, Node, Piece, Sine, Track
from app.definitions.response_points import planned_points, slowest_at_end
from app.definitions.responses import FrequencyResponse
from app.documents.tree import Path
from rtcore.program.segments import Branch

Compensation = Literal["auto", "on", "off"]

FORCE_LEAD_S = lead_in_s(RIG.force_limit_n, RIG.force_rate_limit_n_s)
MOTION_LEAD_S = lead_in_s(RIG.stroke_limit_m, RIG.velocity_limit_m_s)


def force_nodes(
    blocks: Iterable[force.Block], compensation: Compensation, path: Path = ("blocks",)
) -> list[list[Node]]:
    """The nodes of each block."""
    return [_of_block(block, compensation, (*path, i)) for i, block in enumerate(blocks)]


def motion_nodes(motions: Iterable[motion.Motion]) -> list[list[Node]]:
    """The nodes of each motion."""
    made = [_MOTIONS[type(m)](m) for m in motions]
    return [_stamped(nodes, ("motion", i), Branch.EXCLUDED) for i, nodes in enumerate(made)]


def _of_block(block: force.Block, compensation: Compensation, path: Path) -> list[Node]:
    if isinstance(block, force.Repeat):
        inner = force_nodes(block.blocks, compensation, (*path, "blocks"))
        return [Loop(block.times, tuple(node for nodes in inner for node in nodes), path)]
    return _stamped(_BLOCKS[type(block)](block), path, _branch(block, compensation))


def _branch(block: force.Block, compensation: Compensation) -> Branch:
    """The notch belongs to a harmonic load; `auto` excludes the branch for every other one."""
    if compensation == "off":
        return Branch.EXCLUDED
    if isinstance(block, force.Harmonic | force.Layers | force.Sweep) or _is_stepped(block):
        return Branch.WITH_NOTCH
    return Branch.WITHOUT_NOTCH if compensation == "on" else Branch.EXCLUDED


def _is_stepped(block: force.Block) -> bool:
    return isinstance(block, FrequencyResponse) and block.method == "stepped_sine"


def _stamped(nodes: Iterable[Node], origin: Path, branch: Branch) -> list[Node]:
    """The nodes, told which block they serve."""
    stamped: list[Node] = []
    for node in nodes:
        if isinstance(node, Piece):
            stamped.append(replace(node, origin=origin, branch=branch))
        else:
            stamped.append(Loop(node.times, tuple(_stamped(node.body, origin, branch)), origin))
    return stamped


def _duration_s(cycles: int | None, frequency_hz: float, duration_s: float | None) -> float:
    return duration_s if duration_s is not None else (cycles or 0) / frequency_hz


def _harmonic(b: force.Harmonic) -> list[Node]:
    sine = Sine(b.mean_n, b.amplitude_n, b.frequency_hz)
    duration_s = _duration_s(b.cycles, b.frequency_hz, b.duration_s)
    return harmonic(sine, duration_s, b.phase_deg, b.taper_cycles, FORCE_LEAD_S)


def _layers(b: force.Layers) -> list[Node]:
    sines = [
        (Sine(layer.mean_n, layer.amplitude_n, layer.frequency_hz), layer.cycles)
        for layer in b.layers
    ]
    timed = [(sine, cycles / sine.frequency_hz) for sine, cycles in sines]
    return layers(timed, b.repeats, b.transition_s)


def _sweep(b: force.Sweep) -> list[Node]:
    first = Sine(b.mean_n, b.amplitude_n, b.from_hz)
    log = b.law == "log"
    return sweep(first, b.to_hz, b.lasts_s, b.taper_cycles, FORCE_LEAD_S, log=log)


def _response(b: FrequencyResponse) -> list[Node]:
    if b.method == "multisine":
        return _multisine(b)
    planned = planned_points(b)
    points = [(point.sine, point.slower_hz) for point in planned]
    last_hz = slowest_at_end(planned)
    settle_cycles = b.settle_cycles if b.settle is None else b.settle.at_most_cycles
    return stepped(points, last_hz, settle_cycles, b.measure_cycles, FORCE_LEAD_S)


def _multisine(b: FrequencyResponse) -> list[Node]:
    several = b.realisations > 1
    grids = [replace(b.grid(), realisation=i + several) for i in range(b.realisations)]
    periods = b.settle_cycles + b.measure_cycles
    tracks = [
        Track(period_of(grid), amplitude_n, mean_n, held=mean_n)
        for mean_n in b.means()
        for amplitude_n in b.amplitudes_n
        for grid in grids
    ]
    return [node for track in tracks for node in course(track, periods, FORCE_LEAD_S)]


def _motion_multisine(m: motion.MotionMultisine) -> list[Node]:
    times = m.settle_cycles + m.measure_cycles
    tracks = [Track(period, m.amplitude_m, m.mean_m, held=m.mean_m) for period in m.periods()]
    return [node for track in tracks for node in course(track, times, MOTION_LEAD_S)]


def _motion_harmonic(m: motion.MotionHarmonic) -> list[Node]:
    sine = Sine(m.mean_m, m.amplitude_m, m.frequency_hz)
    duration_s = _duration_s(m.cycles, m.frequency_hz, m.duration_s)
    return harmonic(sine, duration_s, m.phase_deg, m.taper_cycles, MOTION_LEAD_S)


# A step of force is meant to be sudden even where it has a rise time; the unit under test may be
# told to jump, and then goes as fast as its own servo allows, but a rise time has to be possible.
_BLOCKS: dict[type, Callable[[Any], list[Node]]] = {
    force.Hold: lambda b: hold(b.force_n, b.duration_s, FORCE_LEAD_S),
    force.Ramp: lambda b: ramp(b.to_n, b.rate_n_s, b.duration_s),
    force.Step: lambda b: step(b.to_n, b.rise_s, b.hold_s, is_step=True),
    force.Harmonic: _harmonic,
    force.Layers: _layers,
    force.Sweep: _sweep,
    FrequencyResponse: _response,
    force.TimeHistory: lambda b: course(Track(b.history, b.gain), b.repeats, FORCE_LEAD_S),
}
_MOTIONS: dict[type, Callable[[Any], list[Node]]] = {
    motion.MotionHold: lambda m: hold(m.displacement_m, m.duration_s, MOTION_LEAD_S),
    motion.MotionRamp: lambda m: ramp(m.to_m, m.rate_m_s, m.duration_s),
    motion.MotionStep: lambda m: step(m.to_m, m.rise_s, m.hold_s, is_step=m.rise_s == 0),
    motion.MotionHarmonic: _motion_harmonic,
    motion.MotionMultisine: _motion_multisine,
    motion.MotionHistory: lambda m: course(Track(m.history, m.gain), m.repeats, MOTION_LEAD_S),
}
