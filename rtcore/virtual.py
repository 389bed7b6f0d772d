"""The virtual clock: the very tick of the loop, on the simulated rig, as fast as the processor goes.

The same seed gives the same run, bit for bit. Commands pass through the same ring as on the real clock.
"""

from typing import Any

import numpy as np
import numpy.typing as npt

from rtcore.channels import TELEMETRY
from rtcore.codes import Opcode, Reply
from rtcore.compiled import address_of, carray, entry, offset_of, pointer
from rtcore.core import CORE
from rtcore.io.simulated import SimulatedIo, cycle
from rtcore.memory.commands import acknowledgement, post
from rtcore.memory.layout import BLOCK
from rtcore.memory.playing import read_playing
from rtcore.memory.rings import event_reader
from rtcore.memory.segment import private_block
from rtcore.modes import Mode
from rtcore.program.play import START, set_down
from rtcore.program.segments import TABLE
from rtcore.program.stream import Program, ProgramWriter, resident
from rtcore.rig.failing import lateness_ns
from rtcore.rig.parameters import RigParameters, load_rig
from rtcore.rig.plant import STATES
from rtcore.rig.world import WORLD

RING_SECONDS = 1.0
PERIOD_S = 250e-6
FEED_TICKS = 1024  # between two looks at what a streamed program needs: its rings hold more


@entry
def run_ticks(
    block_address: int,
    core_address: int,
    world_address: int,
    twin_address: int,
    first_tick: int,
    ticks: int,
    app_beats: bool,
    states_address: int,
) -> None:
    """Run so many ticks on end; where `states_address` is not 0, the plant's state at each goes there."""
    block = carray(pointer(block_address), 1, BLOCK)[0]
    world = carray(pointer(world_address), 1, WORLD)[0]
    for k in range(ticks):
        late_ns = lateness_ns(world)  # nobody keeps the processor here: what it would cost is told
        missed = max(late_ns // block.period_ns - 1, 0)
        now_ns = (first_tick + k) * block.period_ns
        if app_beats:
            block.app_heartbeat_ns = now_ns
            block.recorded = block.telemetry_published
        addresses = block_address, core_address, world_address, twin_address
        cycle(*addresses, now_ns, missed * block.period_ns, late_ns, missed)
        if states_address != 0:
            states = carray(pointer(states_address), (ticks, STATES), np.float64)
            states[k, :] = world.y


class Virtual:
    """A rig and its loop on a virtual clock.

    `gains` is a GAINS record, `interlocks` an INTERLOCKS record. `twin` has the twin run beside it, which takes
    as long again. `app_beats` is whether somebody is there to keep the heartbeat and the record; `keep_states`
    keeps the plant's state at each tick in `states`, (n, STATES) float64.
    """

    def __init__(
        self,
        gains: Any,
        interlocks: Any,
        rig: RigParameters | None = None,
        seed: int = 1,
        period_s: float = PERIOD_S,
        settings: dict[str, float] | None = None,
        *,
        twin: bool = False,
    ) -> None:
        self.block = private_block(round(period_s * 1e9), RING_SECONDS)
        self.io = SimulatedIo(rig or load_rig(), seed, self.block, settings, twin=twin)
        self.period_s = period_s
        self.app_beats = True
        self.keep_states = False
        self.states: npt.NDArray[np.float64] = np.empty((0, STATES))
        self._events = event_reader(self.block)
        self._writer: ProgramWriter | None = None
        self.block.fields["gains"][1] = gains
        self.block.fields["interlocks"][1] = interlocks
        for opcode in (Opcode.ADOPT_GAINS, Opcode.ADOPT_INTERLOCKS):
            if self.command(opcode, 1) != Reply.ACCEPTED:
                raise ValueError(f"the loop does not take these {opcode.name[6:].lower()}")

    @property
    def tick(self) -> int:
        return int(self.io.core["tick"])

    @property
    def mode(self) -> Mode:
        return Mode(int(self.io.core["mode"]))

    def advance(self, ticks: int) -> npt.NDArray[Any]:
        """Run so many ticks; returns their telemetry, (ticks,) TELEMETRY."""
        records = np.empty(ticks, TELEMETRY)
        states = np.empty((ticks if self.keep_states else 0, STATES))
        done = 0
        slots = len(self.block.ring)
        while done < ticks:
            count = min(ticks - done, self._feed(slots))
            first = self.tick
            place = states[done:].ctypes.data if self.keep_states else 0
            run_ticks(*self.io.addresses, first, count, self.app_beats, place)
            slot = first % slots
            until_end = min(count, slots - slot)
            records[done : done + until_end] = self.block.ring[slot : slot + until_end]
            records[done + until_end : done + count] = self.block.ring[: count - until_end]
            done += count
        self.states = states
        return records

    def command(
        self, opcode: Opcode, argument: int = 0, value: float = 0.0, lease: int | None = None
    ) -> Reply:
        """Post a command and run until it is answered. Without a lease it bears the one in force."""
        now_ns = self.tick * int(self.block.fields["period_ns"])
        epoch = int(self.block.fields["lease"]) if lease is None else lease
        sequence = post(self.block, opcode, argument, value=value, lease=epoch, now_ns=now_ns)
        while (answer := acknowledgement(self.block, sequence)) is None:
            self.advance(1)
        return Reply(answer[0])

    def load_program(self, program: Program | Any) -> Reply:
        """Fill the idle bank with a program (or a PROGRAM record) and have the loop adopt it."""
        given = program if isinstance(program, Program) else resident(program)
        bank = 1 - int(self.block.fields["active_program"])
        writer = ProgramWriter(self.block.fields["programs"][bank], given)
        reply = self.command(Opcode.ADOPT_PROGRAM, bank)
        if reply == Reply.ACCEPTED:
            self._writer = writer
        return reply

    def set_down(self, force: Any, motion: Any) -> None:
        """Put a run that has just begun within the first segments of its program: a START record each."""
        program = self.block.fields["programs"][int(self.block.fields["active_program"])]
        core_address = self.io.addresses[1]
        for name, at in (("force", force), ("motion", motion)):
            begun = np.array([at], START)
            table = int(program[name]["segments"].ctypes.data) - offset_of(TABLE, "segments")
            generator = core_address + offset_of(CORE, name)
            set_down(generator, table, address_of(begun), self.period_s)

    def _feed(self, ticks: int) -> int:
        """Give the loop more of a streamed program; returns for how many ticks that is enough."""
        writer = self._writer
        if writer is None or not writer.streaming:
            return ticks
        playing = read_playing(self.block)
        if playing is not None:
            writer.fill(playing)
        return min(ticks, FEED_TICKS)

    def bring_to_ready(self, within_s: float = 20.0) -> None:
        """Reset, pressurise, and wait. Raises RuntimeError where the rig does not become ready."""
        for opcode in (Opcode.RESET, Opcode.PRESSURISE):
            reply = self.command(opcode)
            if reply != Reply.ACCEPTED:
                raise RuntimeError(f"{opcode.name.lower()} was refused: {reply.name.lower()}")
        was_ready = False
        for _ in range(round(within_s / 0.1)):
            self.advance(round(0.1 / self.period_s))
            if (
                was_ready and self.mode == Mode.READY
            ):  # and stays so: no detector has anything against it
                return
            was_ready = self.mode == Mode.READY
        raise RuntimeError(f"not ready within {within_s:g} s but {self.mode.name.lower()}")

    def run(self, argument: int = 1, at_most_s: float = 3600.0) -> npt.NDArray[Any]:
        """Start what is loaded and run it to its end; returns the ticks that belong to the run.

        Raises RuntimeError where the start is refused.
        """
        reply = self.command(Opcode.START, argument)
        if reply != Reply.ACCEPTED:
            raise RuntimeError(f"start was refused: {reply.name.lower()}")
        first = self.block.ring[(self.tick - 1) % len(self.block.ring)].copy()
        parts = [np.array([first])]
        step = round(0.5 / self.period_s)
        while parts[-1][-1]["run"] == argument and len(parts) * 0.5 < at_most_s:
            parts.append(self.advance(step))
        records: npt.NDArray[Any] = np.concatenate(parts)
        return records[records["run"] == argument]

    def events(self) -> npt.NDArray[Any]:
        """Events since the last call, (n,) EVENT."""
        return self._events.read().records
