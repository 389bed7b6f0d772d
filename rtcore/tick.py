"""One tick of the loop, in the one order in which everything happens.

sample → check → mode → setpoint → law → limit → actuate → publish
"""

from rtcore.channels import TELEMETRY
from rtcore.check import check_detectors
from rtcore.codes import EventKind
from rtcore.compiled import Record, carray, kernel, pointer
from rtcore.control.law import closed_loop, open_loop
from rtcore.interlocks import Action
from rtcore.memory.playing import publish_playing, see_what_has_come
from rtcore.memory.rings import next_record_address, publish_event, publish_record
from rtcore.memory.snapshot import write_snapshot
from rtcore.modes import Event, Mode, is_closed_loop, is_run
from rtcore.obey import take_command, take_stop
from rtcore.program.generator import generate, rest
from rtcore.program.validate import plays_within
from rtcore.quantities import observe
from rtcore.sample import take_sample
from rtcore.supervise import apply_event, progress, react, wanted_supply

RETURN_M_S = 0.01  # at which the unit under test goes back to its middle when the rig is ready


@kernel
def tick(
    core: Record,
    block: Record,
    block_address: int,
    now_ns: int,
    wakeup_latency_ns: int,
    tick_time_ns: int,
    missed: int,
) -> None:
    """From the inputs in `core.inputs` to the outputs in `core.outputs`, and a record of both.

    Times in ns; `missed` deadlines were skipped just before this tick. Allocates nothing and waits for nobody.
    """
    gains = block.gains[block.active_gains]
    settings = core.settings
    count_missed(core, block_address, missed, wakeup_latency_ns)

    # sample
    take_sample(settings, core.inputs, core.sample)

    # check
    silence_s = (now_ns - block.app_heartbeat_ns) * 1e-9
    unrecorded_s = (block.telemetry_published - block.recorded) * settings.period_s
    observe(core, gains.valve_limit, silence_s, missed, unrecorded_s)
    action = check_detectors(block.interlocks[block.active_interlocks], core, block, block_address)

    # mode
    react(core, block_address, action)
    progress(core, block_address)
    take_stop(core, block, block_address)
    take_command(core, block, block_address, now_ns)

    # setpoint
    set_points(core, block, block_address)

    # law, limit
    if is_closed_loop(core.mode):
        core.outputs.valve_command = closed_loop(
            gains,
            core.law,
            core.force.value,
            core.sample.force_n,
            core.sample.velocity_m_s,
            core.force.frequency_hz,
            core.force.branch,
            settings.period_s,
        )
    if not abs(core.outputs.valve_command) <= 1.0:  # no number: nothing that a valve should see
        apply_event(core, block_address, Event.TRIP)
    if not is_closed_loop(core.mode):
        open_loop(core.law, core.force.value, core.sample.force_n)
        core.outputs.valve_command = 0.0

    # actuate
    core.outputs.displacement_command_m = core.motion.value
    core.outputs.supply = wanted_supply(core)

    # publish
    address = next_record_address(block_address)
    fill_record(carray(pointer(address), 1, TELEMETRY)[0], core, wakeup_latency_ns, tick_time_ns)
    write_snapshot(block_address, address)
    publish_record(block_address)
    core.tick += 1


@kernel
def count_missed(core: Record, block_address: int, missed: int, latency_ns: int) -> None:
    """Count the deadlines missed, and report them once a second: events must not bury events."""
    core.deadlines_missed += missed
    core.missed_unreported += missed
    if missed > 0:
        core.latest_unreported_ns = max(core.latest_unreported_ns, latency_ns)
    if core.missed_unreported == 0 or core.tick < core.next_report_tick:
        return
    publish_event(
        block_address,
        core.tick,
        EventKind.DEADLINES_MISSED,
        core.missed_unreported,
        core.latest_unreported_ns,
        0.0,
    )
    core.missed_unreported = 0
    core.latest_unreported_ns = 0
    core.next_report_tick = core.tick + int(1.0 / core.settings.period_s)


@kernel
def set_points(core: Record, block: Record, block_address: int) -> None:
    """Force and motion commanded in this tick."""
    settings = core.settings
    if not is_run(core.mode):
        if core.mode == Mode.READY:
            step = RETURN_M_S * settings.period_s
            rest(core.motion, core.motion.value - min(max(core.motion.value, -step), step))
        return
    program = block.programs[block.active_program]
    see_what_has_come(core, block, block_address)
    before = core.force.block
    holding, stopping = core.mode == Mode.HOLDING, core.mode == Mode.STOPPING
    hold, stop, period_s = settings.hold_fade_ticks, settings.stop_fade_ticks, settings.period_s
    generate(core.force, program.force, holding, stopping, hold, stop, period_s)
    generate(core.motion, program.motion, holding, stopping, hold, stop, period_s)
    watch_program(core, program, block_address)
    publish_playing(core, block, block_address)
    if core.mode == Mode.RUNNING and core.force.hold_ticks == 0:
        block.program_ticks += 1
    if core.force.block != before:
        publish_event(block_address, core.tick, EventKind.BLOCK, core.force.block, core.run, 0.0)


@kernel
def watch_program(core: Record, program: Record, block_address: int) -> None:
    """What is streamed has not all been checked before: stop where it does not come, trip where it leads astray."""
    settings = core.settings
    rate_limit_hz = 0.5 / settings.period_s
    astray = not (
        plays_within(core.force, program.force, settings.force_limit_n, rate_limit_hz)
        and plays_within(core.motion, program.motion, settings.displacement_limit_m, rate_limit_hz)
    )
    starved = core.mode == Mode.RUNNING and core.force.starved + core.motion.starved > 0
    if not (astray or starved):
        return
    publish_event(block_address, core.tick, EventKind.PROGRAM_FAULT, int(astray), core.run, 0.0)
    if astray:
        apply_event(core, block_address, Event.TRIP)
    else:
        react(core, block_address, Action.STOP)


@kernel
def fill_record(record: Record, core: Record, wakeup_latency_ns: int, tick_time_ns: int) -> None:
    """Everything that is known of this tick."""
    record.tick = core.tick
    record.time_s = core.tick * core.settings.period_s
    record.trips = core.trips
    record.run = core.run
    record.program_tick = core.force.position if is_run(core.mode) else -1
    record.force_command_n = core.force.value
    record.force_n = core.sample.force_n
    record.force_error_n = core.force.value - core.sample.force_n
    record.displacement_m = core.sample.displacement_m
    record.displacement_command_m = core.motion.value
    record.velocity_m_s = core.sample.velocity_m_s
    record.valve_command = core.outputs.valve_command
    record.spool_position = core.inputs.spool_position
    record.pressure_1_pa = core.inputs.pressure_1_pa
    record.pressure_2_pa = core.inputs.pressure_2_pa
    record.supply_pressure_pa = core.inputs.supply_pressure_pa
    record.compensation_velocity = core.law.compensation.velocity_term
    record.compensation_acceleration = core.law.compensation.acceleration_term
    record.wakeup_latency_s = wakeup_latency_ns * 1e-9
    record.tick_time_s = tick_time_ns * 1e-9
    record.cycle = core.force.cycle
    record.deadlines_missed = core.deadlines_missed
    record.block = core.force.block
    record.mode = core.mode
