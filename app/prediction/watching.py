"""What a prediction sees of each tick: beside the loop's own tick, from the loop's own numbers.

A detector trips once its quantity has been beyond its threshold for p armed ticks on end. So what counts is,
over all such stretches, the greatest of the least excess within: it is above zero exactly where the loop trips.
"""

import math
from typing import Any

import numpy as np
import numpy.typing as npt

from rtcore.compiled import Array, Record, carray, entry, kernel, pointer
from rtcore.core import CORE
from rtcore.interlocks import Comparison
from rtcore.modes import Mode
from rtcore.rig.plant import Q_PUMP
from rtcore.rig.world import WORLD
from rtcore.virtual import run_ticks

SATURATED_WITHIN = 1e-6

EXTREME = np.dtype(
    [
        ("excess", "f8"),  # beyond the threshold, the greatest least of a stretch; -inf for none
        ("tick", "i8"),  # of the run, from 0
        ("block", "i8"),
        ("below", "i8"),  # whether it was at the lower end of a band
        ("armed", "i8"),  # ticks on end, until now
        ("ever_armed", "i8"),
        ("place", "i8"),  # of its stretch in the memory of all
        ("room", "i8"),
        ("head", "i8"),
        ("tail", "i8"),
    ],
    align=True,
)
TALLY = np.dtype(  # of a block, over the ticks in which its program went on
    [
        ("ticks", "i8"),
        ("error_squares", "f8"),
        ("error_peak_n", "f8"),
        ("peak_force_n", "f8"),
        ("saturated", "i8"),
        ("longest_saturated", "i8"),
        ("swing_asked", "f8"),  # squares about the mean, where amplitude and mean stand still
        ("swing_had", "f8"),
    ],
    align=True,
)
WATCH = np.dtype(
    [
        ("run", "i8"),  # which run to look at
        ("detectors", "i8"),
        ("valve_limit", "f8"),
        ("ticks", "i8"),  # of the run, until now
        ("loaded", "i8"),  # of them, those of the program, with those that were skipped
        ("position", "i8"),  # in the program, of the tick before
        ("kept", "i8"),  # ticks of the program whose force and displacement are kept
        ("saturated", "i8"),
        ("saturated_now", "i8"),
        ("longest_saturated", "i8"),
        ("longest_ended", "i8"),  # tick of the run
        ("longest_block", "i8"),
        ("valve", "f8"),
        ("force_n", "f8"),
        ("displacement_m", "f8"),
        ("velocity_m_s", "f8"),
        ("force_error_n", "f8"),
        ("supply_flow_m3_s", "f8"),
        ("least_supply_pa", "f8"),
        ("amplitude", "f8"),  # of the tick before
        ("mean", "f8"),
    ],
    align=True,
)


@kernel
def excess_of(detector: Record, value: float) -> float:
    """How far a value is beyond a threshold: above zero exactly where the detector is violated."""
    if math.isnan(value):
        return math.inf
    if detector.comparison == Comparison.ABOVE:
        return float(value - detector.threshold)
    if detector.comparison == Comparison.BELOW:
        return float(detector.threshold - value)
    if detector.comparison == Comparison.OUTSIDE:
        return float(max(value - detector.threshold, detector.low - value))
    return float(abs(value) - detector.threshold)


@kernel
def is_at_lower_end(detector: Record, value: float) -> bool:
    """Whether the lower end of a band is the nearer one."""
    band = detector.comparison == Comparison.OUTSIDE
    return bool(band and detector.low - value > value - detector.threshold)


@kernel
def _least_of_stretch(
    e: Record, lows: Array, ends: Array, excess: float, below: bool, now: int
) -> tuple[float, bool]:
    """The least of the last `room` values and its end of the band.

    `lows` and `ends` keep those that may yet be it: `ends` twice the tick, and 1 more at the lower end.
    """
    room, place = e.room, e.place
    while e.tail > e.head and lows[place + (e.tail - 1) % room] >= excess:
        e.tail -= 1
    if e.tail > e.head and ends[place + e.head % room] // 2 <= now - room:
        e.head += 1
    lows[place + e.tail % room] = excess
    ends[place + e.tail % room] = 2 * now + int(below)
    e.tail += 1
    least = place + e.head % room
    return float(lows[least]), ends[least] % 2 == 1


@kernel
def _watch_detectors(
    w: Record, core: Record, mode: int, block: int, detectors: Any, extremes: Any, lows: Any, ends: Any
) -> None:  # fmt: skip
    for i in range(w.detectors):
        d, e = detectors[i], extremes[i]
        if e.room == 0:
            continue
        if (d.armed_modes >> mode) & 1 == 0:
            e.armed = 0
            e.head = e.tail
            continue
        e.armed += 1
        e.ever_armed += 1
        excess, below = excess_of(d, core.judged[i]), is_at_lower_end(d, core.judged[i])
        if e.room > 1:
            excess, below = _least_of_stretch(e, lows, ends, excess, below, w.ticks)
        if e.armed >= e.room and excess > e.excess:
            e.excess = excess
            e.below = below
            e.tick = w.ticks
            e.block = block


@kernel
def _tally(w: Record, t: Record, core: Record, force_n: float, saturated: bool) -> None:
    error = core.force.value - force_n
    t.ticks += 1
    t.error_squares += error * error
    t.error_peak_n = max(t.error_peak_n, abs(error))
    t.peak_force_n = max(t.peak_force_n, abs(force_n))
    if saturated:
        t.saturated += 1
        t.longest_saturated = max(t.longest_saturated, w.saturated_now)
    g = core.force
    if g.frequency_hz > 0.0 and g.amplitude == w.amplitude and g.mean == w.mean:
        t.swing_asked += (g.value - g.mean) ** 2
        t.swing_had += (force_n - g.mean) ** 2


@kernel
def _watch_rig(w: Record, core: Record, world: Record) -> None:
    """Peaks of what is measured, while the loop is closed in the run."""
    sample = core.sample
    w.force_n = max(w.force_n, abs(sample.force_n))
    w.displacement_m = max(w.displacement_m, abs(sample.displacement_m))
    w.velocity_m_s = max(w.velocity_m_s, abs(sample.velocity_m_s))
    w.supply_flow_m3_s = max(w.supply_flow_m3_s, world.work.q[Q_PUMP])
    w.least_supply_pa = min(w.least_supply_pa, core.inputs.supply_pressure_pa)
    w.valve = max(w.valve, abs(core.outputs.valve_command))
    w.force_error_n = max(w.force_error_n, abs(core.force.value - sample.force_n))


@kernel
def _watch_load(w: Record, core: Record, tallies: Any, force: Any, displacement: Any) -> None:
    """What the program did in this tick, and the valve for it."""
    block, force_n = core.force.block, core.sample.force_n
    saturated = abs(core.outputs.valve_command) >= w.valve_limit - SATURATED_WITHIN
    w.saturated_now = w.saturated_now + 1 if saturated else 0
    position = core.force.position
    w.loaded += max(1, position - w.position)
    w.position = position
    if saturated:
        w.saturated += 1
        if w.saturated_now > w.longest_saturated:
            w.longest_saturated = w.saturated_now
            w.longest_ended = w.ticks
            w.longest_block = block
    if 0 <= block < len(tallies):
        _tally(w, tallies[block], core, force_n, saturated)
    w.amplitude = core.force.amplitude
    w.mean = core.force.mean
    if core.force.hold_ticks == 0 and position == w.loaded - 1 and position < len(force):
        force[w.kept : position] = np.nan  # skipped
        displacement[w.kept : position] = np.nan
        force[position] = force_n
        displacement[position] = core.sample.displacement_m
        w.kept = position + 1


@entry
def watch_ticks(
    block_address: int,
    core_address: int,
    world_address: int,
    twin_address: int,
    first_tick: int,
    ticks: int,
    app_beats: bool,
    states_address: int,
    watch: npt.NDArray[Any],
    detectors: npt.NDArray[Any],
    extremes: npt.NDArray[Any],
    lows: npt.NDArray[np.float64],
    ends: npt.NDArray[np.int64],
    tallies: npt.NDArray[Any],
    force: npt.NDArray[np.float32],
    displacement: npt.NDArray[np.float32],
) -> None:
    """`rtcore.virtual.run_ticks`, each tick of the watched run looked at once it is done."""
    core = carray(pointer(core_address), 1, CORE)[0]
    world = carray(pointer(world_address), 1, WORLD)[0]
    w = watch[0]
    for k in range(ticks):
        mode, run, block = core.mode, core.run, core.force.block
        place = states_address + 8 * k * len(world.y) if states_address != 0 else 0
        run_ticks(
            block_address, core_address, world_address, twin_address,
            first_tick + k, 1, app_beats, place,
        )  # fmt: skip
        if run != w.run and core.run != w.run:
            continue
        _watch_detectors(
            w, core, mode, max(block, core.force.block), detectors, extremes, lows, ends
        )
        if core.run == w.run:
            if core.mode >= Mode.RUNNING:
                _watch_rig(w, core, world)
            if core.mode == Mode.RUNNING:
                _watch_load(w, core, tallies, force, displacement)
        w.ticks += 1


def make_extremes(
    detectors: Any, violated_ticks: Any, modes: int, longest: int
) -> npt.NDArray[Any]:
    """(n,) EXTREME as a run begins.

    `violated_ticks` is for how long the loop has found each detector violated already; `modes` the bit mask of
    the modes that a run may be in, and `longest` how many ticks it may take: longer stretches are not kept.
    """
    extremes = np.zeros(len(detectors), EXTREME)
    extremes["excess"] = -np.inf
    extremes["tick"] = extremes["block"] = -1
    extremes["armed"] = violated_ticks[: len(detectors)]
    for e, d in zip(extremes, detectors, strict=True):
        armed = bool(d["enabled"]) and int(d["armed_modes"]) & modes
        left = int(d["persistence_ticks"]) - int(e["armed"])
        e["room"] = int(d["persistence_ticks"]) if armed and left <= longest else 0
    extremes["place"] = np.cumsum(extremes["room"]) - extremes["room"]
    return extremes
