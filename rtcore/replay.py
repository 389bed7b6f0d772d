"""Recorded ticks through the loop's own check: which detector trips when, under this table or another.

What the loop judged in a tick is put together again from the record of that tick and of the one before: setpoints,
valve command and mode are those that the tick before left. What no record tells is listed in `NOT_RECORDED`.
"""

from collections.abc import Iterable
from typing import Any

import numpy as np
import numpy.typing as npt

from rtcore.check import check_detectors
from rtcore.compiled import address_of, carray, entry, pointer
from rtcore.core import CORE
from rtcore.interlocks import Quantity
from rtcore.io.simulated import SimulatedIo
from rtcore.memory.layout import BLOCK
from rtcore.memory.rings import event_reader
from rtcore.memory.segment import private_block
from rtcore.quantities import observe
from rtcore.rig.parameters import RigParameters
from rtcore.sample import take_sample
from rtcore.supervise import clear_trips

Records = npt.NDArray[Any]

NOT_RECORDED = {
    Quantity.APP_SILENCE_S: "how long the console was silent",
    Quantity.UNRECORDED_S: "how much had not been recorded",
    Quantity.TWIN_RESIDUAL_N: "the force of the virtual rig beside the real one",
    Quantity.TWIN_GOODNESS: "the force of the virtual rig beside the real one",
    Quantity.TWIN_SPOOL: "the spool of the virtual rig beside the real one",
    Quantity.CHAIN_OPEN: "the state of the hard-wired chain",
    Quantity.UNDERPEAK: "whether the load was swinging",
    Quantity.CYCLES: "the cycles of the run before",
}
_REMEMBERED = ("observed", "sample", "trends", "violated_ticks")
_TOGETHER = 1024  # ticks between two looks at what tripped: the ring of events holds more


@entry
def _check_recorded(
    block_address: int,
    core_address: int,
    records: Records,
    resets: npt.NDArray[np.int64],
    valve_limit: float,
) -> None:
    """Check each record but the first, which only tells what the second began with."""
    block = carray(pointer(block_address), 1, BLOCK)[0]
    core = carray(pointer(core_address), 1, CORE)[0]
    for k in range(1, len(records)):
        before, now = records[k - 1], records[k]
        core.tick = now.tick
        core.mode = before.mode
        core.run = before.run
        core.force.value = before.force_command_n
        core.force.cycle = before.cycle
        core.force.block = before.block
        core.motion.value = before.displacement_command_m
        core.outputs.valve_command = before.valve_command
        core.inputs.force_n = now.force_n
        core.inputs.displacement_m = now.displacement_m
        core.inputs.velocity_m_s = now.velocity_m_s
        core.inputs.pressure_1_pa = now.pressure_1_pa
        core.inputs.pressure_2_pa = now.pressure_2_pa
        core.inputs.supply_pressure_pa = now.supply_pressure_pa
        core.inputs.chain = 1
        take_sample(core.settings, core.inputs, core.sample)
        missed = now.deadlines_missed - before.deadlines_missed
        observe(core, valve_limit, 0.0, missed, 0.0)
        check_detectors(block.interlocks[0], core, block, block_address)
        if (resets == now.tick).any():
            clear_trips(core, block)


class Replay:
    """The check of a loop, given recorded ticks in order.

    `interlocks` is an INTERLOCKS record; of its detectors, those of what is `NOT_RECORDED` are left out.
    """

    def __init__(
        self, interlocks: Any, rig: RigParameters, valve_limit: float, period_s: float
    ) -> None:
        self._block = private_block(round(period_s * 1e9), 0.01)
        self._cores = SimulatedIo(rig, 0, self._block, twin=False).cores
        self._valve_limit = valve_limit
        self._events = event_reader(self._block)
        self._last: Records | None = None
        table = self._block.fields["interlocks"][:1]
        table[0] = interlocks
        detectors = table["detectors"][0]
        detectors["enabled"][np.isin(detectors["quantity"], list(NOT_RECORDED))] = 0
        self.core["has_interlocks"] = 1

    @property
    def core(self) -> Any:
        """What the check remembers, a CORE record."""
        return self._cores[0]

    def take(self, records: Records, resets: Iterable[int] = ()) -> Records:
        """Check (n,) TELEMETRY after those given before; what tripped or cleared, (m,) EVENT.

        `resets` are the ticks in which what was latched was reset. Of the first record ever given only its
        setpoints and what was latched count.
        """
        if self._last is None and len(records):
            self.core["trips"] = records["trips"][0]
        found = [self._events.read().records]
        at = np.array(sorted(resets), np.int64)
        for first in range(0, len(records), _TOGETHER):
            part = records[first : first + _TOGETHER]
            joined = part.copy() if self._last is None else np.concatenate([self._last, part])
            addresses = self._block.address, address_of(self._cores)
            _check_recorded(*addresses, joined, at, self._valve_limit)
            self._last = joined[-1:].copy()
            found.append(self._events.read().records)
        return np.concatenate(found)

    def remembered(self) -> dict[str, Any]:
        """What the check remembers of the ticks before, as plain data for `recall`."""
        return {name: _plain(self.core[name]) for name in _REMEMBERED}

    def recall(self, remembered: dict[str, Any]) -> None:
        """Go on from what another replay remembered; what is not known here any more is passed over."""
        for name in _REMEMBERED:
            if name in remembered:
                _fill(self._cores, name, remembered[name])

    def forget(self, detector: int) -> None:
        """Let a detector begin anew: it is not the one that is remembered."""
        self.core["violated_ticks"][detector] = 0


def _plain(value: Any) -> Any:
    """A record, an array or a number in types that JSON knows; null where it is no number."""
    if value.dtype.names:
        if value.shape:
            return [_plain(row) for row in value]
        return {name: _plain(value[name]) for name in value.dtype.names}
    if value.shape:
        return [_plain(item) for item in value]
    return value.item() if np.isfinite(value) else None


def _fill(records: Any, name: str, plain: Any) -> None:
    """Put plain data into a field of (1,) records."""
    field = records[name]
    if isinstance(plain, dict):
        for inner in field.dtype.names or ():
            if inner in plain:
                _fill(field, inner, plain[inner])
    elif isinstance(plain, list):
        for i, item in enumerate(plain[: field.shape[1]]):
            _put(field[0], i, item)
    else:
        field[0] = np.nan if plain is None else plain


def _put(row: Any, i: int, item: Any) -> None:
    if isinstance(item, dict):
        for name in row.dtype.names or ():
            if name in item:
                row[name][i] = np.nan if item[name] is None else item[name]
    else:
        row[i] = np.nan if item is None else item
