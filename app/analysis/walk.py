"""Where in its program each tick of a run is: chunk after chunk, with flat memory."""

from collections.abc import Iterable, Iterator, Mapping
from itertools import chain
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from app.analysis.evidence import Kind, Stretch
from rtcore.channels import CHANNEL
from rtcore.compiled import entry
from rtcore.modes import Mode

HOLD_FADE_S = 0.25  # how long the loop takes to fade back in after a hold
POSITION = "program_tick"  # where the loop itself says that it is
_CHANNELS = (
    *("tick", "mode", "cycle", "force_command_n", "force_n", "force_error_n"),
    *("displacement_m", "velocity_m_s", "valve_command"),
)
NEEDED = (POSITION, *_CHANNELS)

Columns = Mapping[str, npt.NDArray[Any]] | npt.NDArray[Any]  # by name, or (n,) TELEMETRY
Ticks = npt.NDArray[np.int64]

_AT = np.dtype(
    [
        ("first", "i8"),  # tick of the run's first record
        ("last", "i8"),  # tick of the record before, and its mode
        ("mode", "i8"),
        ("hold_ticks", "i8"),  # as in the generator: 0 running … held
        ("frozen", "i8"),  # ticks so far in which the program stood still
    ]
)


class Part(NamedTuple):
    """Ticks of a run, (n,) each, that are all of one stretch of its program.

    A stretch comes in several parts where a chunk ends within it; `begins` is true of the first.
    `positions` are the ticks of the program. `in_phase` says of which ticks the setpoint is as the
    program alone has it: after a hold a harmonic's phase has moved on.
    """

    stretch: Stretch
    begins: bool
    positions: Ticks
    columns: dict[str, npt.NDArray[Any]]
    in_phase: npt.NDArray[np.bool_]


class Walk:
    """Follows a run through its program. Ticks in which the program stood still are left out."""

    def __init__(
        self,
        stretches: Iterable[Stretch],
        period_s: float,
        first_tick: int | None = None,
        also: Iterable[str] = (),
        counts: bool = False,
    ) -> None:
        """`first_tick` is that of the run, where it is not that of the first record.

        `also` are channels that the parts have beside those of each. `counts` is for the motion's program, of
        which nothing is ever skipped: `POSITION` is of the force's.
        """
        self._counts = counts
        self._names = tuple(dict.fromkeys([*_CHANNELS, *also]))
        self._stretches = iter(stretches)
        self._stretch: Stretch | None = None
        self._begun = False
        self._fade_ticks = round(HOLD_FADE_S / period_s)
        self._at = np.zeros((), _AT)
        self._first_tick = first_tick
        self._started = False
        self._anchor = 0  # frozen ticks at which the phase was the program's own
        self._turns = False  # whether the stretch before was a harmonic one

    def take(self, chunk: Columns) -> Iterator[Part]:
        """The parts of the next ticks of the run; at least the columns `NEEDED`.

        Positions are counted where the loop does not say its own: of a recording of before there was one.
        """
        ticks = _plain(chunk, "tick")
        if len(ticks) == 0:
            return
        positions = np.empty(len(ticks), np.int64)
        kept = np.empty(len(ticks), np.bool_)
        self._start(int(ticks[0]))
        _follow(
            self._at.reshape(1), ticks, _plain(chunk, "mode"), self._fade_ticks, positions, kept
        )
        if POSITION in _names_of(chunk) and not self._counts:
            told = chunk[POSITION]
            positions = np.where(told >= 0, told, positions)
        columns = {name: _plain(chunk, name) for name in self._names}
        if not kept.all():
            positions = positions[kept]
            columns = {name: values[kept] for name, values in columns.items()}
        yield from self._parts(positions, columns)

    def following(self) -> Stretch | None:
        """The stretch after the present one; None where that is the last."""
        upcoming = next(self._stretches, None)
        if upcoming is not None:
            self._stretches = chain([upcoming], self._stretches)
        return upcoming

    def _start(self, tick: int) -> None:
        if self._started:
            return
        self._started = True
        first = tick if self._first_tick is None else self._first_tick
        self._at["first"], self._at["last"] = first, first - 1
        self._at["mode"] = Mode.RUNNING

    def _parts(self, positions: Ticks, columns: dict[str, npt.NDArray[Any]]) -> Iterator[Part]:
        low = 0
        while low < len(positions):
            stretch = self._go_to(int(positions[low]))
            if stretch is None:
                return
            high = int(np.searchsorted(positions, stretch.last))
            begins, self._begun = not self._begun, True
            inner = {name: values[low:high] for name, values in columns.items()}
            shift = inner["tick"] - positions[low:high]
            in_phase = self._in_phase(stretch, shift, begins)
            yield Part(stretch, begins, positions[low:high], inner, in_phase)
            low = high

    def _go_to(self, position: int) -> Stretch | None:
        """The stretch that a tick of the program is in; None after the last."""
        while self._stretch is None or self._stretch.last <= position:
            if self._begun and self._stretch is not None:
                self._turns = self._stretch.kind not in (Kind.COURSE, Kind.STEP)
            self._stretch = next(self._stretches, None)
            self._begun = False
            if self._stretch is None:
                self._stretches = iter(())
                return None
        return self._stretch

    def _in_phase(self, stretch: Stretch, shift: Ticks, begins: bool) -> npt.NDArray[np.bool_]:
        if stretch.kind in (Kind.COURSE, Kind.STEP):
            return np.ones(len(shift), np.bool_)
        if begins and not (stretch.continues and self._turns):
            self._anchor = int(shift[0])
        return np.asarray(shift == self._anchor)


def _names_of(chunk: Columns) -> Iterable[str]:
    return chunk.dtype.names or () if isinstance(chunk, np.ndarray) else chunk


def _plain(chunk: Columns, name: str) -> npt.NDArray[Any]:
    """A column as the kernels take it: they are compiled once, for whole and writable arrays."""
    return np.require(chunk[name], CHANNEL[name].dtype, ["C", "W"])


@entry
def _follow(
    state: npt.NDArray[Any],
    ticks: Ticks,
    modes: npt.NDArray[np.int8],
    fade_ticks: int,
    positions: Ticks,
    kept: npt.NDArray[np.bool_],
) -> None:
    """The tick of the program for each record, and whether the program went on in it."""
    at = state[0]
    for i in range(len(ticks)):
        missing = ticks[i] - at.last - 1
        if missing > 0:  # as far as one can know, they were like the tick before them
            if at.mode == Mode.HOLDING:
                at.hold_ticks = min(at.hold_ticks + missing, fade_ticks)
                at.frozen += missing
            elif at.mode == Mode.RUNNING:
                at.frozen += min(max(at.hold_ticks - 1, 0), missing)
                at.hold_ticks = max(at.hold_ticks - missing, 0)
        mode = modes[i]
        stands = mode != Mode.RUNNING
        if mode == Mode.HOLDING:
            at.hold_ticks = min(at.hold_ticks + 1, fade_ticks)
        elif mode == Mode.RUNNING and at.hold_ticks > 0:
            at.hold_ticks -= 1
            stands = at.hold_ticks > 0
        if stands:
            at.frozen += 1
        at.last = ticks[i]
        at.mode = mode
        positions[i] = ticks[i] - at.first - at.frozen
        kept[i] = not stands
