"""The response of a sweep once it is over: by the local polynomial method, from the whole of it at once."""

import math
from collections.abc import Iterator

import numpy as np
import numpy.typing as npt

from app.analysis.evidence import Kind
from app.analysis.response.curve import Curve
from app.analysis.response.point import Interval, ResponsePoint
from app.analysis.response.stepped import REFERENCE, channels_of
from app.analysis.response.swept import swept_response
from app.analysis.response.transfers import TRANSFERS, Transfer
from app.analysis.walk import Columns, Part
from app.conducting.found import Found
from app.definitions.blocks import Sweep
from app.definitions.limits import RIG
from rtcore.compiled import Array

MOST_TICKS = 1_200_000  # five minutes, 34 MB: a longer one is not kept
POINTS_AN_OCTAVE = 12
REST_S = 0.1  # in which the force comes to rest, before a sweep and after it
REST_TICKS = round(REST_S / RIG.period_s)
SETTLED_S = 0.15  # after it began from rest: its first cycles, with their friction, are not yet the response
_CHANNELS = channels_of(TRANSFERS.values())
Column = npt.NDArray[np.float32]


class Stillness:
    """For how long the setpoint has stood still, chunk after chunk; as a run begins, for ever."""

    def __init__(self) -> None:
        self._ticks = REST_TICKS
        self._level: float | None = None

    def before(self, chunk: Columns, tick: int) -> int:
        """Ticks before this one of the chunk that comes next."""
        return self._until(chunk, int(np.searchsorted(chunk["tick"], tick)))

    def take(self, chunk: Columns) -> None:
        """The next ticks of the run."""
        if len(chunk["tick"]):
            self._ticks = self._until(chunk, len(chunk["tick"]))
            self._level = float(chunk[REFERENCE][-1])

    def _until(self, chunk: Columns, end: int) -> int:
        if end == 0:
            return self._ticks
        setpoint = chunk[REFERENCE][:end]
        moved = np.flatnonzero(setpoint != setpoint[-1])
        if len(moved):
            return end - 1 - int(moved[-1])
        goes_on = self._level is None or self._level == float(setpoint[-1])
        return end + (self._ticks if goes_on else 0)


class SweptSine:
    """One block, kept until it is over and at rest. One that is held, has gaps or is too long has no response."""

    def __init__(self, block: int, asked: Sweep, still_ticks: int) -> None:
        """`still_ticks` is for how long the setpoint stood still before it."""
        self._block, self._asked = block, asked
        self._from_rest = still_ticks >= REST_TICKS
        self._kept: dict[str, list[Column]] = {name: [] for name in _CHANNELS}
        self._next_tick: int | None = None
        self._ticks = 0
        self._broken = False
        self._rest: int | None = None  # ticks of it, once the block is over
        self._points: list[Found] | None = None

    def take(self, part: Part) -> None:
        """The next part of the block, tapers too."""
        if self._rest is not None:
            return  # it is repeated: the first time counts
        ticks = part.columns["tick"]
        self._ticks += len(ticks)
        if self._broken or not self._follows(ticks) or self._ticks > MOST_TICKS:
            self._broken = True
            self._kept.clear()
            return
        self._keep(part.columns, slice(None))
        if self._is_over(part):
            self._rest = 0

    def follow(self, chunk: Columns) -> None:
        """The next ticks of the run, whatever they are of: those after the block are kept while it rests."""
        if self._rest is None or self._points is not None:
            return
        first = int(np.searchsorted(chunk["tick"], self._next_tick or 0))
        after = slice(first, first + REST_TICKS - self._rest)
        ticks, setpoint = chunk["tick"][after], chunk[REFERENCE][after]
        if len(ticks) == 0:
            return
        level = self._kept[REFERENCE][-1][-1] if self._rest else setpoint[0]
        expected = ticks[0] if self._next_tick is None else self._next_tick
        rests = (setpoint == level) & (ticks == expected + np.arange(len(ticks)))
        still = len(ticks) if rests.all() else int(np.argmin(rests))
        if still > 0:
            self._keep(chunk, slice(first, first + still))
            self._rest += still
        if still < len(ticks) or self._rest == REST_TICKS:
            self._end()

    def points(self) -> list[Found]:
        """All of them once it is over, and the rest after it, if there is one."""
        return self._points or []

    def _end(self) -> None:
        self._points = list(self._read())
        self._kept.clear()

    def _follows(self, ticks: npt.NDArray[np.int64]) -> bool:
        """Whether nothing is missing before and among ticks."""
        follows = self._next_tick is None or int(ticks[0]) == self._next_tick
        return follows and int(ticks[-1]) - int(ticks[0]) + 1 == len(ticks)

    def _keep(self, columns: Columns, where: slice) -> None:
        self._next_tick = int(columns["tick"][where][-1]) + 1
        for name, kept in self._kept.items():
            kept.append(np.array(columns[name][where], np.float32))

    def _is_over(self, part: Part) -> bool:
        ends = int(part.positions[-1]) + 1 == part.stretch.last
        if self._asked.taper_cycles == 0:
            return ends and part.stretch.kind in (Kind.SWEEP, Kind.CYCLES)
        return ends and part.stretch.kind is Kind.LEAD and part.stretch.continues

    def _read(self) -> Iterator[Found]:
        columns = {name: np.concatenate(kept) for name, kept in self._kept.items()}
        low, high = sorted((self._asked.from_hz, self._asked.to_hz))
        points = max(2, round(POINTS_AN_OCTAVE * math.log2(high / low)))
        frequencies_hz = np.geomspace(low, high, points)
        frequencies_hz = frequencies_hz[self._reached_s(frequencies_hz) >= SETTLED_S]
        if len(frequencies_hz) == 0:
            return
        for transfer in TRANSFERS.values():
            input, output = columns[transfer.input], columns[transfer.output]
            reference = None if transfer.input == REFERENCE else columns[REFERENCE]
            if not min(np.ptp(input), np.ptp(output)) > 0.0:  # what stands still has no response
                continue
            try:
                with np.errstate(divide="ignore", invalid="ignore"):
                    curve = swept_response(
                        *(input, output, RIG.period_s, frequencies_hz),
                        reference=reference,
                        at_rest=self._from_rest and self._rest == REST_TICKS,
                    )
            except ValueError:  # too short for its lines
                return
            yield from self._told(transfer, curve)

    def _reached_s(self, frequencies_hz: Array) -> Array:
        """(n,) how long after the block began the sweep was at these frequencies."""
        asked = self._asked
        ends_hz = np.array([asked.from_hz, asked.to_hz])
        if asked.law == "log":
            frequencies_hz, ends_hz = np.log(frequencies_hz), np.log(ends_hz)
        share = (frequencies_hz - ends_hz[0]) / (ends_hz[1] - ends_hz[0])
        return np.asarray(asked.taper_cycles / asked.from_hz + share * asked.lasts_s)

    def _told(self, transfer: Transfer, curve: Curve) -> Iterator[Found]:
        for i, hz in enumerate(curve.frequencies_hz):
            gain = complex(curve.gain[i])
            if not (math.isfinite(abs(gain)) and math.isfinite(curve.coherence[i])):
                continue
            point = ResponsePoint(
                transfer=transfer.name,
                block=self._block,
                frequency_hz=float(hz),
                amplitude_n=self._asked.amplitude_n,
                mean_n=self._asked.mean_n,
                gain=abs(gain),
                phase_deg=math.degrees(math.atan2(gain.imag, gain.real)),
                gain_95=Interval(*map(float, curve.gain_95[i])),
                phase_95_deg=Interval(*map(float, curve.phase_95_deg[i])),
                coherence=float(curve.coherence[i]),
                distortion_percent=None,
                cycles=0,
                settled=True,
            )
            yield Found("sweep", point, math.sqrt(float(curve.variance[i])))
