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
from app.analysis.walk import Part
from app.conducting.found import Found
from app.definitions.blocks import Sweep
from app.definitions.limits import RIG
from rtcore.compiled import Array

MOST_TICKS = 1_200_000  # five minutes, 34 MB: a longer one is not kept
POINTS_AN_OCTAVE = 12
SETTLED_S = 0.15  # after it began from rest: its first cycles, with their friction, are not yet the response
_CHANNELS = channels_of(TRANSFERS.values())
Column = npt.NDArray[np.float32]


class SweptSine:
    """One block, kept until it is over. One that is held, has gaps or is too long has no response."""

    def __init__(self, block: int, asked: Sweep) -> None:
        self._block, self._asked = block, asked
        self._kept: dict[str, list[Column]] = {name: [] for name in _CHANNELS}
        self._next_tick: int | None = None
        self._ticks = 0
        self._broken = False
        self._points: list[Found] = []

    def take(self, part: Part) -> None:
        """The next part of the block, tapers too."""
        ticks = part.columns["tick"]
        follows = self._next_tick is None or int(ticks[0]) == self._next_tick
        whole = int(ticks[-1]) - int(ticks[0]) + 1 == len(ticks)
        self._ticks += len(ticks)
        if self._broken or not follows or not whole or self._ticks > MOST_TICKS:
            self._broken = True
            self._kept.clear()
            return
        self._next_tick = int(ticks[-1]) + 1
        for name, kept in self._kept.items():
            kept.append(part.columns[name].copy())
        if self._is_over(part):
            self._points = list(self._read())
            self._broken = True  # and if it is repeated: the first time counts
            self._kept.clear()

    def points(self) -> list[Found]:
        """All of them once it is over."""
        return self._points

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
                        at_rest=self._asked.taper_cycles > 0,
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
