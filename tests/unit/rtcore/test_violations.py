"""From a violation to safe outputs: in the very tick, for every detector, in whatever situation."""

from collections import Counter
from typing import Any, cast

import numpy as np
import pytest
from hypothesis import settings
from hypothesis import strategies as st
from hypothesis.stateful import RuleBasedStateMachine, initialize, invariant, rule

from rtcore.codes import Opcode, Reply
from rtcore.interlocks import Action, Comparison, Form, Quantity
from rtcore.io import SUPPLY_OFF
from rtcore.memory.commands import post
from rtcore.memory.stopping import ask_stop
from rtcore.modes import Mode, is_run
from rtcore.rig.faults import Fault
from rtcore.virtual import Virtual
from tests.detector_oracle import Oracle
from tests.unit.rtcore.programs import Row, gains, harmonic, interlocks, program

PLAYING = program(harmonic(4000.0, 50.0, 500), harmonic(0.004, 4.0, 40))
STARTS = (Mode.OFF, Mode.READY, Mode.RUNNING, Mode.HOLDING, Mode.STOPPING)
QUIET = {"quantity": Quantity.FORCE_N, "threshold": 1e9}
FAULTS = [fault for fault in Fault if fault is not Fault.LATE_TICKS]  # that one is the clock's


def brought_to(mode: Mode) -> Virtual:
    """A rig with its twin in this state; nothing has tripped it."""
    rig = Virtual(gains(), interlocks(), twin=True)
    if mode is Mode.OFF:
        rig.command(Opcode.RESET)
        return rig
    rig.bring_to_ready()
    if mode is Mode.READY:
        return rig
    rig.load_program(PLAYING)
    rig.command(Opcode.START, 1)
    rig.advance(2000)
    if mode is not Mode.RUNNING:
        rig.command(Opcode.HOLD if mode is Mode.HOLDING else Opcode.STOP)
        rig.advance(100)
    assert rig.mode == mode
    return rig


class Situations:
    """Rigs in every state, made once and put back as often as one likes."""

    def __init__(self) -> None:
        self._made: dict[Mode, tuple[Virtual, list[np.ndarray[Any, Any]]]] = {}

    def rig(self, mode: Mode) -> Virtual:
        if mode not in self._made:
            rig = brought_to(mode)
            self._made[mode] = rig, [part.copy() for part in self._parts(rig)]
        rig, kept = self._made[mode]
        for part, before in zip(self._parts(rig), kept, strict=True):
            part[...] = before
        rig.app_beats = True
        return rig

    @staticmethod
    def _parts(rig: Virtual) -> list[Any]:
        return [rig.block._raw, rig.io.cores, rig.io.worlds, rig.io._twins]


SITUATIONS = Situations()


def put_in_force(rig: Virtual, rows: list[Row]) -> Oracle:
    """Another table, as if it had been adopted between two ticks."""
    core = rig.io.core
    rig.block.fields["interlocks"][int(rig.block.fields["active_interlocks"])] = interlocks(*rows)
    core["violated_ticks"], core["trips"], core["blocking"] = 0, 0, 0
    core["trends"]["last"], core["trends"]["rate_1_s"] = np.nan, 0.0
    rig.block.fields["first_out"] = -1
    return Oracle(rows)


def is_safe(rig: Virtual, record: Any, before: int, action: int) -> bool:
    """Whether the outputs of a tick are what the strongest action demands, begun in the state `before`."""
    core = rig.io.core
    mode = int(record["mode"])
    if action == Action.SHUTDOWN or (action == Action.STOP and not is_run(before)):
        null = core["outputs"]["valve_command"] == 0.0 and record["valve_command"] == 0.0
        return mode == Mode.TRIPPED and bool(null) and core["outputs"]["supply"] == SUPPLY_OFF
    if action == Action.STOP:
        fading = core["trip_after_stop"] == 1 and core["force"]["stop_ticks"] > 0
        return mode == Mode.TRIPPED or (mode == Mode.STOPPING and bool(fading))
    if action == Action.HOLD:
        return mode != Mode.RUNNING
    return True


def row_of(quantity: Quantity, action: Action, value: float, **other: Any) -> Row:
    """A detector that a quantity of this value violates at once."""
    return {
        "quantity": quantity,
        "form": Form.VALUE,
        "comparison": Comparison.ABOVE,
        "action": action,
        "enabled": 1,
        "latching": 1,
        "armed_modes": 0x7F,
        "persistence_ticks": 1,
        "threshold": value - max(1.0, 0.5 * abs(value)),
        "low": -1e9,
        "horizon_s": 0.0,
        "smoothing_s": 0.0,
    } | other


@pytest.mark.parametrize("persistence", [1, 4])
@pytest.mark.parametrize("action", Action)
@pytest.mark.parametrize("mode", STARTS)
def test_every_quantity_acts_in_the_tick_in_which_it_has_been_violated_long_enough(
    mode: Mode, action: Action, persistence: int
) -> None:
    for quantity in Quantity:
        rig = SITUATIONS.rig(mode)
        seen = float(rig.io.core["observed"]["quantities"][quantity])
        row = row_of(quantity, action, seen, persistence_ticks=persistence, threshold=-1e9)
        put_in_force(rig, [row])
        for tick in range(persistence):
            before = rig.mode
            record = rig.advance(1)[-1]
            assert (record["trips"] == 1) == (tick == persistence - 1), quantity.name
        assert is_safe(rig, record, before, action), quantity.name
        if action >= Action.STOP:
            assert rig.block.fields["first_out"] == 0
            assert rig.block.fields["first_out_tick"] == record["tick"]


SEEN: Counter[tuple[str, str]] = Counter()  # violations by quantity and action, over all examples


class AnySituation(RuleBasedStateMachine):
    """Detectors, commands, faults, silence and missed deadlines in any order, each tick against the oracle."""

    @initialize(mode=st.sampled_from(STARTS))
    def begin(self, mode: Mode) -> None:
        self.rig = SITUATIONS.rig(mode)
        self.oracle = put_in_force(self.rig, [row_of(Quantity.FORCE_N, Action.SHUTDOWN, 1e9)])
        self.missed = 0
        self.tick()

    def tick(self) -> None:
        """One tick, and what the oracle says of it."""
        rig, before = self.rig, int(self.rig.io.core["mode"])
        if self.missed:
            now_ns = rig.tick * 250_000
            if rig.app_beats:
                rig.block.fields["app_heartbeat_ns"] = now_ns
            rig.block.fields["recorded"] = rig.block.fields["telemetry_published"]
            rig.io.cycle(now_ns, self.missed * 250_000, 0, self.missed)
            record = rig.block.ring[(rig.tick - 1) % len(rig.block.ring)]
            self.missed = 0
        else:
            record = rig.advance(1)[-1]
        quantities = [float(q) for q in rig.io.core["observed"]["quantities"]]
        action = self.oracle.see(quantities, before)
        for i, row in enumerate(self.oracle.rows):
            if self.oracle.counts[i] >= row["persistence_ticks"]:
                SEEN[Quantity(row["quantity"]).name, Action(row["action"]).name] += 1
        assert is_safe(rig, record, before, action), (Mode(before).name, action)
        if rig.io.core["last_reply"] == Reply.ACCEPTED and record["trips"] == 0:
            self.oracle.reset() if rig.io.core["last_reset_tick"] == record["tick"] else None
        assert int(record["trips"]) == self.oracle.trips
        assert int(rig.block.fields["first_out"]) == self.oracle.first_out
        assert int(rig.io.core["violated"]) == sum(
            1 << i
            for i, row in enumerate(self.oracle.rows)
            if self.oracle.counts[i] >= row["persistence_ticks"]
        )

    @rule(
        chosen=st.lists(
            st.fixed_dictionaries(
                {
                    "quantity": st.sampled_from(Quantity),
                    "form": st.sampled_from(Form),
                    "comparison": st.sampled_from(Comparison),
                    "action": st.sampled_from(Action),
                    "enabled": st.sampled_from([1, 1, 1, 0]),
                    "latching": st.integers(0, 1),
                    "armed_modes": st.sampled_from([0x7F, 0x7F, 0b1111100, 0b0010000]),
                    "persistence_ticks": st.integers(1, 4),
                    "horizon_s": st.sampled_from([0.0, 1e-3, 0.05]),
                    "smoothing_s": st.sampled_from([0.0, 1e-3]),
                    "share": st.floats(-0.4, 0.4),
                }
            ),
            min_size=1,
            max_size=6,
        ),
        ticks=st.integers(1, 10),
    )
    def another_table(self, chosen: list[dict[str, Any]], ticks: int) -> None:
        """Detectors with thresholds about what their quantities are now: some violated, some soon, some not."""
        rows = []
        for drawn in chosen:
            row = dict(drawn)
            share = row.pop("share")
            now = float(self.rig.io.core["observed"]["quantities"][row["quantity"]])
            scale = max(1.0, abs(now)) if np.isfinite(now) else 1.0
            threshold = (now if np.isfinite(now) else 0.0) + share * scale
            rows.append(row | {"threshold": threshold, "low": threshold - scale})
        self.oracle = put_in_force(self.rig, rows)
        self.advance(ticks)

    @rule(ticks=st.integers(1, 12))
    def advance(self, ticks: int) -> None:
        for _ in range(ticks):
            self.tick()

    @rule(
        command=st.sampled_from([o for o in Opcode if o <= Opcode.SHUTDOWN and o != Opcode.RESET])
    )
    def command(self, command: Opcode) -> None:
        self._post(command)

    @rule()
    def reset(self) -> None:
        self._post(Opcode.RESET)

    @rule(fault=st.sampled_from(FAULTS), ticks=st.integers(1, 8))
    def inject(self, fault: Fault, ticks: int) -> None:
        self._post(Opcode.INJECT_FAULT, int(fault), 1.0)
        self.advance(ticks)

    @rule()
    def mend(self) -> None:
        self._post(Opcode.CLEAR_FAULTS)

    @rule(missed=st.integers(1, 2000))
    def late(self, missed: int) -> None:
        self.missed = missed
        self.tick()

    @rule(beats=st.booleans())
    def app(self, beats: bool) -> None:
        self.rig.app_beats = beats

    @rule()
    def stop_word(self) -> None:
        ask_stop(self.rig.block)
        self.tick()

    def _post(self, opcode: Opcode, argument: int = 0, value: float = 0.0) -> None:
        now_ns = self.rig.tick * 250_000
        lease = int(self.rig.block.fields["lease"])
        post(self.rig.block, opcode, argument, value=value, lease=lease, now_ns=now_ns)
        self.tick()

    @invariant()
    def the_valve_is_at_null_without_pressure(self) -> None:
        if hasattr(self, "rig") and self.rig.mode in (Mode.TRIPPED, Mode.OFF):
            assert self.rig.io.core["outputs"]["valve_command"] == 0.0
            assert self.rig.io.core["outputs"]["supply"] == SUPPLY_OFF


@pytest.mark.slow
@pytest.mark.timeout(600)
def test_in_any_situation_the_outputs_are_safe_in_the_tick_of_the_violation() -> None:
    SEEN.clear()
    machine = cast(Any, AnySituation)
    machine.TestCase.settings = settings(
        max_examples=2000, stateful_step_count=20, deadline=None, derandomize=True
    )
    machine.TestCase().runTest()
    violations = sum(SEEN.values())
    print(f"{violations} violated detectors, {len(SEEN)} pairs of quantity and action")
    assert violations > 20_000
    assert {quantity for quantity, _ in SEEN} == {quantity.name for quantity in Quantity}
