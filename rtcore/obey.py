"""Obey: take one command a tick, and answer it: refused where it cannot be done now, never kept for later.

Only the adoption of a program takes several ticks, and only while no test runs.
"""

import math

import numpy as np

from rtcore.codes import EventKind, Opcode, Reply
from rtcore.compiled import Record, kernel, load_acquire, offset_of
from rtcore.control.law import adopt_gains, gains_are_valid
from rtcore.interlocks import interlocks_are_valid
from rtcore.memory.commands import acknowledge, pending
from rtcore.memory.layout import BLOCK, COMMAND_SLOTS, model_address
from rtcore.memory.playing import rewind
from rtcore.memory.rings import publish_event
from rtcore.modes import Event, Mode, is_pressurised, is_run
from rtcore.program.segments import Segment
from rtcore.program.skipping import can_skip, skip
from rtcore.program.validate import (
    is_played_once,
    repeat_is_too_deep,
    segment_is_valid,
    table_is_bounded,
)
from rtcore.rig.faults import KINDS, amount_within
from rtcore.rig.model import model_is_valid
from rtcore.sample import sensors_are_sound
from rtcore.supervise import apply_event, clear_trips, keep_trips, start_run

# The event of the mode that a command is, by opcode; -1 for those that are none.
_EVENT_OF = np.full(len(Opcode) + 1, -1)
for _opcode, _event in (
    (Opcode.PRESSURISE, Event.PRESSURISE),
    (Opcode.DEPRESSURISE, Event.DEPRESSURISE),
    (Opcode.START, Event.START),
    (Opcode.HOLD, Event.HOLD),
    (Opcode.RESUME, Event.RESUME),
    (Opcode.STOP, Event.STOP),
    (Opcode.SHUTDOWN, Event.TRIP),
):
    _EVENT_OF[_opcode] = _event
_STOP_ASKED = offset_of(BLOCK, "stop_asked_ns")
SEGMENTS_A_TICK = 32
TARE_REST_S = 2.0  # eight time constants of the tare's running mean
TARE_BLED_PA = 1e6
TARE_SHARE = 0.02  # of the load cell's range: more is a load, not an offset
TARE_SCATTER_SHARE = 0.002


@kernel
def _done(happened: bool) -> int:
    return Reply.ACCEPTED if happened else Reply.WRONG_MODE


@kernel
def _reset(core: Record, block: Record, block_address: int) -> int:
    """Clear what is latched, by a press and not by a key held down, where its cause is gone. Starts nothing."""
    held = core.tick - core.last_reset_tick < core.settings.reset_edge_ticks
    core.last_reset_tick = core.tick
    if held:
        return Reply.NOT_AN_EDGE
    if core.acting != 0 or core.trip_after_stop != 0:
        return Reply.CAUSE_PRESENT
    if core.mode == Mode.TRIPPED:
        apply_event(core, block_address, Event.RESET)
    clear_trips(core, block)
    return Reply.ACCEPTED


@kernel
def _tare(core: Record) -> int:
    """Make the mean of the load cell the new zero, where it is unloaded, at rest and to be believed."""
    if core.mode != Mode.OFF:
        return Reply.WRONG_MODE
    offset_n = core.sample.untared_mean_n
    settings = core.settings
    rested = core.mode_ticks * settings.period_s >= TARE_REST_S
    bled = core.inputs.supply_pressure_pa <= TARE_BLED_PA
    small = abs(offset_n) <= TARE_SHARE * settings.force_range_n
    scatter_n = abs(core.inputs.force_n - offset_n)
    steady = scatter_n <= TARE_SCATTER_SHARE * settings.force_range_n
    if not (sensors_are_sound(core.sample) and rested and bled and small and steady):
        return Reply.CAUSE_PRESENT
    core.sample.tare_n = core.sample.untared_mean_n
    return Reply.ACCEPTED


@kernel
def _adopt_small(core: Record, block: Record, opcode: int, bank: int) -> int:
    """Gains and interlocks: checked and adopted within this tick, whole or not at all."""
    if not 0 <= bank <= 1:
        return Reply.INVALID_BANK
    if is_run(core.mode):
        return Reply.WRONG_MODE
    if opcode == Opcode.ADOPT_GAINS:
        if not gains_are_valid(block.gains[bank], core.settings.period_s):
            return Reply.INVALID_BANK
        block.active_gains = bank
        core.has_gains = 1
        adopt_gains(block.gains[bank], core.law, core.settings.period_s)
        return Reply.ACCEPTED
    if not interlocks_are_valid(block.interlocks[bank]):
        return Reply.INVALID_BANK
    keep_trips(core, block, block.interlocks[block.active_interlocks], block.interlocks[bank])
    block.active_interlocks = bank
    core.has_interlocks = 1
    core.violated_ticks[:] = 0
    for i in range(len(core.trends)):  # of another quantity, maybe
        core.trends[i].last = np.nan
        core.trends[i].rate_1_s = 0.0
    return Reply.ACCEPTED


@kernel
def _adopt_model(core: Record, block: Record, block_address: int, bank: int) -> int:
    """What the twin is of from its next move on, while there is no pressure: it begins at rest."""
    if not 0 <= bank <= 1:
        return Reply.INVALID_BANK
    if is_pressurised(core.mode):
        return Reply.WRONG_MODE
    if not model_is_valid(model_address(block_address, bank)):
        return Reply.INVALID_BANK
    block.active_model = bank
    core.model_due = 1
    return Reply.ACCEPTED


@kernel
def _check_next_segments(core: Record, table: Record, first: int, limit: float) -> int:
    """Check a share of a table; -1 invalid, else how many segments of it are checked."""
    last = min(table.count, first + SEGMENTS_A_TICK)
    for i in range(first, last):
        s = table.segments[i]
        if not segment_is_valid(s, i, limit, 0.5 / core.settings.period_s):
            return -1
        if s.kind == Segment.REPEAT and (table.streamed != 0 or repeat_is_too_deep(table, i)):
            return -1
    return last


@kernel
def _adopt_program(core: Record, block: Record, block_address: int, bank: int) -> int:
    """Check a few segments each tick, adopt when all are good. BUSY meanwhile."""
    if not 0 <= bank <= 1 or (bank == block.active_program and core.has_program != 0):
        return Reply.INVALID_BANK
    if is_run(core.mode):
        return Reply.WRONG_MODE
    program = block.programs[bank]
    if not (table_is_bounded(program.force) and table_is_bounded(program.motion)):
        return Reply.INVALID_BANK
    if core.checking_command != core.commands_seen:
        core.checking_command = core.commands_seen
        core.checked_segments = 0
    checked = core.checked_segments
    forces = program.force.count
    if checked < forces:
        checked = _check_next_segments(core, program.force, checked, core.settings.force_limit_n)
    else:
        checked = _check_next_segments(
            core, program.motion, checked - forces, core.settings.displacement_limit_m
        )
        checked = checked + forces if checked >= 0 else checked
    core.checked_segments = checked
    if checked < 0:
        return Reply.INVALID_BANK
    if checked < forces + program.motion.count:
        return Reply.BUSY
    block.active_program = bank
    core.has_program = 1
    rewind(core, block, block_address)
    return Reply.ACCEPTED


@kernel
def _adopt(core: Record, block: Record, block_address: int, opcode: int, bank: int) -> int:
    if opcode == Opcode.ADOPT_PROGRAM:
        return _adopt_program(core, block, block_address, bank)
    if opcode == Opcode.ADOPT_MODEL:
        return _adopt_model(core, block, block_address, bank)
    return _adopt_small(core, block, opcode, bank)


@kernel
def _start(core: Record, block: Record, block_address: int, run: int) -> int:
    """Begin the adopted program. What is streamed to the loop is played once."""
    if core.has_program == 0 or run < 1:
        return Reply.NO_PROGRAM
    program = block.programs[block.active_program]
    if not start_run(core, program, block_address, _EVENT_OF[Opcode.START], run):
        return Reply.WRONG_MODE
    block.program_ticks = 0
    if is_played_once(program):
        core.has_program = 0
    return Reply.ACCEPTED


@kernel
def _skip(core: Record, block: Record, block_address: int, segment: int) -> int:
    """End the present sine and go on with a segment further on in its chain."""
    if core.mode != Mode.RUNNING:
        return Reply.WRONG_MODE
    table = block.programs[block.active_program].force
    if not can_skip(core.force, table, segment):
        return Reply.INVALID_BANK
    left_out = skip(core.force, table, segment, core.settings.period_s)
    block.program_ticks += left_out
    publish_event(block_address, core.tick, EventKind.SKIPPED, segment, left_out, 0.0)
    return Reply.ACCEPTED


@kernel
def _inject(core: Record, block: Record, block_address: int, kind: int, amount: float) -> int:
    """Have the simulated rig break, or mend it again with an amount of 0. What is told is what is in force."""
    if core.settings.simulated == 0:
        return Reply.NOT_SIMULATED
    if not (0 < kind < KINDS and math.isfinite(amount)):
        return Reply.UNKNOWN
    held = amount_within(kind, amount)
    core.injected[kind] = block.injected[kind] = held
    publish_event(block_address, core.tick, EventKind.FAULT, kind, held, 0.0)
    return Reply.ACCEPTED


@kernel
def _clear_faults(core: Record, block: Record, block_address: int) -> int:
    for kind in range(KINDS):
        if core.injected[kind] != 0.0:
            _inject(core, block, block_address, kind, 0.0)
    return Reply.ACCEPTED


@kernel
def _take_lease(core: Record, block: Record, block_address: int, epoch: int) -> int:
    """Obey only this epoch from now on. Epochs only grow: what an earlier holder sent comes too late."""
    if not epoch > core.lease:
        return Reply.STALE_LEASE
    core.lease = block.lease = epoch
    publish_event(block_address, core.tick, EventKind.LEASE, epoch, 0.0, 0.0)
    return Reply.ACCEPTED


@kernel
def _carry_out(core: Record, block: Record, block_address: int, command: Record) -> int:
    opcode, argument = command.opcode, command.argument
    if opcode in (
        Opcode.ADOPT_GAINS,
        Opcode.ADOPT_INTERLOCKS,
        Opcode.ADOPT_MODEL,
        Opcode.ADOPT_PROGRAM,
    ):
        return _adopt(core, block, block_address, opcode, argument)
    if opcode == Opcode.INJECT_FAULT:
        return _inject(core, block, block_address, argument, command.value)
    if opcode == Opcode.CLEAR_FAULTS:
        return _clear_faults(core, block, block_address)
    if opcode == Opcode.SKIP:
        return _skip(core, block, block_address, argument)
    if opcode == Opcode.RESET:
        return _reset(core, block, block_address)
    if opcode == Opcode.TARE:
        return _tare(core)
    if not 0 <= opcode < len(_EVENT_OF) or _EVENT_OF[opcode] < 0:
        return Reply.UNKNOWN
    if opcode == Opcode.PRESSURISE and (core.has_gains == 0 or core.has_interlocks == 0):
        return Reply.NOT_CONFIGURED
    if core.blocking != 0 and opcode in (Opcode.PRESSURISE, Opcode.START, Opcode.RESUME):
        return Reply.CAUSE_PRESENT
    if opcode == Opcode.START:
        return _start(core, block, block_address, argument)
    return _done(apply_event(core, block_address, _EVENT_OF[opcode]))


@kernel
def take_stop(core: Record, block: Record, block_address: int) -> None:
    """Stop where it was asked for on the path of its own. Without a test there is nothing to stop."""
    asked_ns = load_acquire(block_address + _STOP_ASKED)
    if asked_ns == core.stops_seen_ns:
        return
    core.stops_seen_ns = asked_ns
    stopped = apply_event(core, block_address, Event.STOP)
    publish_event(block_address, core.tick, EventKind.STOP_ASKED, int(stopped), core.run, 0.0)


@kernel
def take_command(core: Record, block: Record, block_address: int, now_ns: int) -> None:
    """Take the next command, if there is one. Stopping needs neither lease nor haste."""
    if not pending(block_address):
        return
    command = block.commands[core.commands_seen % COMMAND_SLOTS]
    stops = command.opcode == Opcode.STOP or command.opcode == Opcode.SHUTDOWN
    if command.sequence != core.commands_seen:
        reply: int = Reply.REPLAYED
    elif now_ns > command.expires_ns and not stops:
        reply = Reply.EXPIRED
    elif command.opcode == Opcode.TAKE_LEASE:
        reply = _take_lease(core, block, block_address, command.lease)
    elif command.lease != core.lease and not stops:
        reply = Reply.STALE_LEASE
    else:
        reply = _carry_out(core, block, block_address, command)
    if reply != Reply.BUSY:
        core.commands_seen += 1
        core.last_reply = reply
        publish_event(
            block_address,
            core.tick,
            EventKind.COMMAND,
            command.opcode,
            core.last_reply,
            command.argument,
        )
        acknowledge(block_address, reply, core.tick)
