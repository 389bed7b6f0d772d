"""Everything that a prediction remembers of a run: a few numbers, and a bounded stretch of force and displacement."""

from typing import Any

import numpy as np
import numpy.typing as npt

from app.prediction.watching import TALLY, WATCH, make_extremes, watch_ticks
from rtcore.interlocks import Quantity
from rtcore.modes import Mode

# Only a live rig knows these: its console, its processor, its disk, its chain, and how it differs from its twin.
NOT_PREDICTED = (
    Quantity.APP_SILENCE_S,
    Quantity.DEADLINES_MISSED,
    Quantity.TWIN_RESIDUAL_N,
    Quantity.TWIN_GOODNESS,
    Quantity.TWIN_SPOOL,
    Quantity.UNRECORDED_S,
    Quantity.CHAIN_OPEN,
)
SENSORS = (Quantity.LOAD_CELL, Quantity.LVT, Quantity.LVDT, Quantity.PRESSURE_SENSOR)
_MODES = (Mode.READY, Mode.RUNNING, Mode.HOLDING, Mode.STOPPING, Mode.TRIPPED)  # that a run meets
TAIL_S = 2.0  # that a run may last beyond its program


class Watch:
    """What is seen of one run of so many ticks; `kept_ticks` of its force and displacement are kept.

    `interlocks` is the INTERLOCKS record that the loop has.
    """

    def __init__(
        self,
        interlocks: Any,
        valve_limit: float,
        blocks: int,
        program_ticks: int,
        kept_ticks: int,
        period_s: float,
    ) -> None:
        self.detectors = interlocks["detectors"][: int(interlocks["count"])].copy()
        self._longest = program_ticks + round(TAIL_S / period_s)
        self.tallies = np.zeros(blocks, TALLY)
        kept = min(program_ticks, kept_ticks)
        self.force_n = np.zeros(kept, np.float32)
        self.displacement_m = np.zeros(kept, np.float32)
        self._watch = np.zeros(1, WATCH)
        self._watch["detectors"] = len(self.detectors)
        self._watch["valve_limit"] = valve_limit
        self._watch["least_supply_pa"] = np.inf
        self._watch["longest_block"] = -1

    def begin(self, run: int, violated_ticks: npt.NDArray[np.int64]) -> None:
        """Look at this run; the loop has found its detectors violated for so many ticks already."""
        self._watch["run"] = run
        modes = sum(1 << mode for mode in _MODES)
        self.extremes = make_extremes(self.detectors, violated_ticks, modes, self._longest)
        room = max(1, int(self.extremes["room"].sum()))
        self._lows, self._ends = np.zeros(room), np.zeros(room, np.int64)

    def run_ticks(
        self, addresses: tuple[int, int, int, int], first: int, ticks: int, beats: bool, states: int
    ) -> None:
        """As `rtcore.virtual.run_ticks`."""
        watch_ticks(
            *addresses,
            first,
            ticks,
            beats,
            states,
            self._watch,
            self.detectors,
            self.extremes,
            self._lows,
            self._ends,
            self.tallies,
            self.force_n,
            self.displacement_m,
        )

    def end(self) -> None:
        """Let go of what only the looking took."""
        kept = int(self.seen["kept"])
        self.force_n = self.force_n[:kept].copy()
        self.displacement_m = self.displacement_m[:kept].copy()
        self._lows, self._ends = np.zeros(1), np.zeros(1, np.int64)

    @property
    def seen(self) -> Any:
        """The WATCH record."""
        return self._watch[0]
