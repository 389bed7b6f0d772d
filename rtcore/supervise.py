"""Mode: what detectors, the program's end and commands do to the state of the loop."""

import numpy as np

from rtcore.codes import EventKind
from rtcore.compiled import Record, kernel
from rtcore.interlocks import MAX_DETECTORS, Action
from rtcore.io import SUPPLY_HIGH, SUPPLY_LOW, SUPPLY_OFF
from rtcore.memory.rings import publish_event
from rtcore.modes import NO_TRANSITION, Event, Mode, is_pressurised, is_run, next_mode
from rtcore.program.generator import rest, start

RUN_TAIL_S = 0.5  # a run that trips is recorded this much longer


@kernel
def apply_event(core: Record, block_address: int, event: int) -> bool:
    """Move the mode; False where the event means nothing in this one."""
    after = next_mode(core.mode, event)
    if after == NO_TRANSITION:
        return False
    if after != core.mode:
        publish_event(block_address, core.tick, EventKind.MODE, after, core.mode, 0.0)
        core.mode = after
        core.mode_ticks = 0
    if not is_run(after):
        rest(core.force, 0.0)
        core.force.block = -1
        core.force.cycle = 0
        core.trip_after_stop = 0
        if after == Mode.READY:
            core.run = 0
        elif core.run != 0 and core.tail_ticks == 0:
            core.tail_ticks = int(RUN_TAIL_S / core.settings.period_s)
    return True


@kernel
def start_run(core: Record, program: Record, block_address: int, event: int, run: int) -> bool:
    """Begin the adopted program; the setpoint starts where it is."""
    if not apply_event(core, block_address, event):
        return False
    core.run = run
    core.tail_ticks = 0
    start(core.force, program.force, 0.0, core.settings.period_s)
    start(core.motion, program.motion, core.motion.value, core.settings.period_s)
    publish_event(block_address, core.tick, EventKind.BLOCK, core.force.block, run, 0.0)
    return True


@kernel
def react(core: Record, block_address: int, action: int) -> None:
    """What the strongest detector that tripped in this tick demands."""
    if action == Action.SHUTDOWN or (action == Action.STOP and not is_run(core.mode)):
        apply_event(core, block_address, Event.TRIP)
    elif action == Action.STOP:
        apply_event(core, block_address, Event.STOP)
        core.trip_after_stop = 1
    elif action == Action.HOLD:
        apply_event(core, block_address, Event.HOLD)


@kernel
def progress(core: Record, block_address: int) -> None:
    """What follows from the state of the rig itself: pressure reached, program ended, load taken off."""
    core.mode_ticks += 1
    settings = core.settings
    if core.mode == Mode.PRESSURISING and core.inputs.supply_pressure_pa >= settings.ready_pa:
        apply_event(core, block_address, Event.PRESSURE_REACHED)
    elif core.mode == Mode.RUNNING and core.force.ended != 0:
        publish_event(block_address, core.tick, EventKind.PROGRAM_ENDED, core.run, 0.0, 0.0)
        apply_event(core, block_address, Event.STOP)
    elif core.mode == Mode.STOPPING and core.force.stop_ticks >= settings.stop_fade_ticks:
        apply_event(core, block_address, Event.TRIP if core.trip_after_stop != 0 else Event.STOPPED)
    if core.tail_ticks > 0:
        core.tail_ticks -= 1
        if core.tail_ticks == 0:
            core.run = 0


@kernel
def wanted_supply(core: Record) -> int:
    """Off, low or high: low first, until the hoses and chambers are filled."""
    if not is_pressurised(core.mode):
        return SUPPLY_OFF
    settings = core.settings
    filled = (
        core.inputs.supply_pressure_pa >= settings.low_reached_pa
        and core.mode_ticks >= settings.low_ticks
    )
    if core.mode == Mode.PRESSURISING and not filled and core.outputs.supply != SUPPLY_HIGH:
        return SUPPLY_LOW
    return SUPPLY_HIGH


@kernel
def keep_trips(core: Record, block: Record, before: Record, after: Record) -> None:
    """Under a new table a latched bit stays only where it still means the same detector."""
    for i in range(MAX_DETECTORS):
        bit = np.uint64(1) << np.uint64(i)
        old, new = before.detectors[i], after.detectors[i]
        same = old.quantity == new.quantity and old.comparison == new.comparison
        same = same and old.form == new.form and old.action == new.action
        if core.trips & bit and not (i < after.count and same):
            core.trips ^= bit
            core.blocking &= ~bit
            if block.first_out == i:
                block.first_out = -1


@kernel
def clear_trips(core: Record, block: Record) -> None:
    """Forget what is latched; the caller has made sure that no cause is present."""
    core.trips = np.uint64(0)
    core.blocking = np.uint64(0)
    block.first_out = -1
