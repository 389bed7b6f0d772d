"""What Resume would do: the loop's own generators, played on from where the hold has left them."""

from typing import Any

import numpy as np
import numpy.typing as npt

from app.errors import Code, Refusal
from app.link.life import Life
from app.rigs.schemas import ResumePreview
from rtcore.compiled import Record, address_of, carray, entry, kernel, pointer
from rtcore.core import make_core
from rtcore.modes import Mode
from rtcore.program.generator import GENERATOR, generate, refresh
from rtcore.program.segments import PROGRAM

LEAST_S, CYCLES, MOST_S = 2.0, 2, 20.0  # after the fade
POINTS = 400
_NOT_HELD = Refusal(Code.WRONG_MODE, "Nothing is held: there is nothing to resume")
Setpoints = tuple[npt.NDArray[np.float64], npt.NDArray[np.float64]]


@kernel
def _next(g: Record, table: Record, holding: bool, fade: int, stop: int, period_s: float) -> float:
    refresh(g, table.count, table.knot_count)
    generate(g, table, holding, False, fade, stop, period_s)
    return float(g.value)


@entry
def _play_on(
    states_address: int,
    program_address: int,
    held_ticks: int,
    fade: int,
    stop: int,
    period_s: float,
    force: npt.NDArray[np.float64],
    motion: npt.NDArray[np.float64],
) -> None:
    """So many ticks of hold more, then as many of the test as `force` and `motion` have room for."""
    states = carray(pointer(states_address), 2, GENERATOR)
    program = carray(pointer(program_address), 1, PROGRAM)[0]
    for _ in range(held_ticks):
        _next(states[0], program.force, True, fade, stop, period_s)
        _next(states[1], program.motion, True, fade, stop, period_s)
    for k in range(len(force)):
        force[k] = _next(states[0], program.force, False, fade, stop, period_s)
        motion[k] = _next(states[1], program.motion, False, fade, stop, period_s)


def resumed(
    states: npt.NDArray[Any],
    program: npt.NDArray[Any],
    ticks: int,
    period_s: float,
    held_ticks: int = 0,
) -> Setpoints:
    """Force (N) and displacement (m) commanded in so many ticks, (ticks,) each, from a resume on.

    `states` is (2,) GENERATOR of force and motion as a tick of the hold left them, `program` (1,) PROGRAM.
    The oscillators run on during a hold: `held_ticks` is how much longer it lasts.
    """
    settings = make_core(period_s, {})[0]["settings"]
    fade, stop = int(settings["hold_fade_ticks"]), int(settings["stop_fade_ticks"])
    own, program = states.copy(), np.ascontiguousarray(program)
    force, motion = np.zeros(ticks), np.zeros(ticks)
    addresses = address_of(own), address_of(program)
    _play_on(*addresses, held_ticks, fade, stop, period_s, force, motion)
    return force, motion


def preview(life: Life | None) -> ResumePreview | Refusal:
    """What a resume at this moment would do."""
    if life is None or not life.alive or life.mode() is not Mode.HOLDING:
        return _NOT_HELD
    playing = life.playing()
    if playing is None:
        return _NOT_HELD
    states, program = playing
    period_s = life.period_ns * 1e-9
    ticks = _ticks(states, period_s)
    force, motion = resumed(states, program, ticks, period_s)
    edges = np.linspace(0, ticks, min(POINTS, ticks) + 1).astype(np.int64)
    (force_low, force_high), (motion_low, motion_high) = (
        (np.minimum.reduceat(x, edges[:-1]), np.maximum.reduceat(x, edges[:-1]))
        for x in (force, motion)
    )
    return ResumePreview(
        time_s=(edges[:-1] * period_s).round(9).tolist(),
        force_min_n=force_low.tolist(),
        force_max_n=force_high.tolist(),
        displacement_min_m=motion_low.tolist(),
        displacement_max_m=motion_high.tolist(),
        block=int(states[0]["block"]),
        cycle=int(states[0]["cycle"]),
        text=_text(states[0], force, ticks * period_s),
    )


def _ticks(states: npt.NDArray[Any], period_s: float) -> int:
    fade_s = float(make_core(period_s, {})[0]["settings"]["hold_fade_ticks"]) * period_s
    swinging = [float(hz) for hz in states["frequency_hz"] if hz > 0]
    cycles_s = CYCLES / min(swinging) if swinging else 0.0
    return round((fade_s + min(max(LEAST_S, cycles_s), MOST_S)) / period_s)


def _text(state: Any, force: npt.NDArray[np.float64], lasting_s: float) -> str:
    low, high = float(force.min()), float(force.max())
    where = f"block {int(state['block']) + 1} goes on"
    if state["frequency_hz"] > 0:
        where += f" with cycle {int(state['cycle']) + 1}, at the phase of that moment"
    return (
        f"Resume: {where}; within {lasting_s:,.1f} s the force is commanded between"
        f" {low:,.0f} N and {high:,.0f} N"
    )
