"""The unit's own position response while its motion is played: displacement to command, without the loop's delay."""

from functools import partial

import numpy as np

from app.analysis.evidence import Kind
from app.analysis.response.stepped import REFERENCE, channels_of
from app.analysis.response.transfers import MOTION_TRANSFERS
from app.analysis.response.unit_under_test import command_as_it_acts
from app.analysis.walk import Columns, Part, Walk
from app.conducting.found import Found
from app.conducting.multisines import Multisine, Played
from app.definitions.definition import Definition
from app.definitions.limits import RIG
from app.definitions.motions import MotionMultisine
from app.definitions.windows import motion_stretches

CHANNELS = channels_of(MOTION_TRANSFERS.values())


def multisines_in(definition: Definition) -> dict[int, MotionMultisine]:
    """Those of the motion, by number."""
    return {i: m for i, m in enumerate(definition.motion) if isinstance(m, MotionMultisine)}


class PositionResponses:
    """Takes a run chunk by chunk beside the force; gives the points of every multisine of its motion.

    A hold stops the motion as it stops the force; a skip of the force's program leaves it alone.
    """

    def __init__(
        self, definition: Definition, period_s: float, first_tick: int | None = None
    ) -> None:
        self._multisines = {i: _Moved(i, m) for i, m in multisines_in(definition).items()}
        program = motion_stretches(definition)
        self._walk = Walk(program, period_s, first_tick, also=CHANNELS, counts=True)

    def take(self, chunk: Columns) -> None:
        """The next ticks of the run."""
        for part in self._walk.take(chunk) if self._multisines else ():
            if part.stretch.block in self._multisines:
                self._multisines[part.stretch.block].take(part)

    def points(self) -> list[Found]:
        """All that there are so far."""
        return [found for one in self._multisines.values() for found in one.points()]


class _Moved:
    """One multisine of the motion, and the force that was commanded in its first period that counts."""

    def __init__(self, number: int, asked: MotionMultisine) -> None:
        grid = asked.grid()
        self._amplitude_m = asked.amplitude_m
        self._settle_ticks = asked.settle_cycles * grid.period_ticks
        self._period_ticks = grid.period_ticks
        self._first: int | None = None
        self._sum_n, self._ticks = 0.0, 0
        self._multisine = Multisine(
            number,
            Played(grid, [(0.0, 0.0)] * asked.realisations, asked.settle_cycles),
            MOTION_TRANSFERS,
            partial(command_as_it_acts, tick_hz=RIG.loop_rate_hz, period_ticks=grid.period_ticks),
        )

    def take(self, part: Part) -> None:
        if part.stretch.kind is not Kind.LEAD:
            self._note_force(part)
        self._multisine.take(part)

    def points(self) -> list[Found]:
        mean_n = self._sum_n / max(1, self._ticks)
        return [
            found._replace(point=found.point._replace(mean_n=mean_n), amplitude_m=self._amplitude_m)
            for found in self._multisine.points()
        ]

    def _note_force(self, part: Part) -> None:
        if self._first is None:
            self._first = int(part.positions[0]) + self._settle_ticks
        at = part.positions - self._first
        counted = part.columns[REFERENCE][(at >= 0) & (at < self._period_ticks)]
        self._sum_n += float(counted.sum(dtype=np.float64))
        self._ticks += len(counted)
