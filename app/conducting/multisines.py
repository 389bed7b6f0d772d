"""The response of multisine blocks while they are played: a best linear approximation after each period."""

import math
from collections.abc import Callable, Mapping, Sequence
from typing import NamedTuple

import numpy as np

from app.analysis.evidence import Kind
from app.analysis.response.bla import BestLinear, fast, robust
from app.analysis.response.periods import Periods, Realisation
from app.analysis.response.point import Interval, ResponsePoint
from app.analysis.response.stepped import channels_of
from app.analysis.response.transfers import TRANSFERS, Transfer
from app.analysis.walk import Part
from app.conducting.found import Found
from app.definitions.limits import RIG
from app.definitions.multisine import Grid
from app.definitions.responses import FrequencyResponse


class Played(NamedTuple):
    """What is played of a multisine: mean and amplitude (N) of each realisation in turn, led in to and settled."""

    grid: Grid
    loads: Sequence[tuple[float, float]]
    settle_cycles: int
    left_out: tuple[int, ...] = ()  # odd lines that show distortion because they are not played


class Multisine:
    """One block: means, amplitudes and realisations follow one another."""

    def __init__(
        self,
        block: int,
        played: Played,
        transfers: Mapping[str, Transfer] = TRANSFERS,
        corrected: Callable[[Realisation], Realisation] = lambda realisation: realisation,
    ) -> None:
        """`corrected` makes of a realisation what the transfers are read from."""
        self._block = block
        self._grid, self._loads, self._settle, self._left_out = played
        self._transfers = tuple(transfers.values())
        self._corrected = corrected
        self._channels = channels_of(self._transfers)
        self._number = -1
        self._leads = False
        self._periods: Periods | None = None
        self._realisations: dict[tuple[float, float], list[Realisation]] = {}
        self._told: tuple[int, list[Found]] = 0, []  # of so many periods

    def take(self, part: Part) -> None:
        """The next part of the block."""
        if part.stretch.kind is Kind.LEAD:
            self._leads = True
            return
        if self._leads:
            self._leads = False
            self._next()
        if self._periods is not None:
            self._periods.take(part.positions, part.columns)

    def points(self) -> list[Found]:
        """What there is so far, of every transfer."""
        periods = self._periods_so_far()
        if self._told[0] != periods:
            self._told = periods, self._found()
        return self._told[1]

    def _periods_so_far(self) -> int:
        going_on = None if self._periods is None else self._periods.realisation()
        done = [r for realisations in self._realisations.values() for r in realisations]
        return sum(r.periods for r in [*done, *([going_on] if going_on else [])])

    def _found(self) -> list[Found]:
        found: list[Found] = []
        loads = dict.fromkeys([*self._realisations, *self._loads[: self._number + 1]])
        for mean_n, amplitude_n in loads:
            realisations = self._of((mean_n, amplitude_n))
            with np.errstate(divide="ignore", invalid="ignore"):  # of what stands still: no point
                for transfer in self._transfers if realisations else ():
                    found += self._read(transfer, realisations, mean_n, amplitude_n)
        return found

    def _next(self) -> None:
        self._file()
        self._number = (self._number + 1) % len(self._loads)
        lines = sorted({*self._grid.lines, *self._left_out})
        self._periods = Periods(self._channels, self._grid.period_ticks, lines, self._settle)

    def _file(self) -> None:
        done = None if self._periods is None else self._periods.realisation()
        if done is not None:
            self._realisations.setdefault(self._loads[self._number], []).append(done)

    def _of(self, load: tuple[float, float]) -> list[Realisation]:
        found = list(self._realisations.get(load, ()))
        going_on = None if self._periods is None else self._periods.realisation()
        if going_on is not None and self._loads[self._number] == load:
            found.append(going_on)
        return [self._corrected(realisation) for realisation in found]

    def _read(
        self,
        transfer: Transfer,
        realisations: Sequence[Realisation],
        mean_n: float,
        amplitude_n: float,
    ) -> list[Found]:
        period_s = self._grid.period_ticks * RIG.period_s
        excited = np.array(self._grid.lines, np.int64)
        channels = transfer.input, transfer.output
        if len(self._left_out) and len(realisations) == 1:
            left_out = np.array(self._left_out, np.int64)
            best = fast(realisations, *channels, excited, left_out, period_s)
        else:
            best = robust(realisations, *channels, excited, period_s)
        periods = sum(r.periods for r in realisations)
        return [
            self._point(transfer, best, i, periods * line, mean_n, amplitude_n)
            for i, line in enumerate(self._grid.lines)
            if np.isfinite(best.gain[i])
        ]

    def _point(
        self,
        transfer: Transfer,
        best: BestLinear,
        i: int,
        cycles: int,
        mean_n: float,
        amplitude_n: float,
    ) -> Found:
        gain = complex(best.gain[i])
        point = ResponsePoint(
            transfer=transfer.name,
            block=self._block,
            frequency_hz=float(best.frequencies_hz[i]),
            amplitude_n=amplitude_n,
            mean_n=mean_n,
            gain=abs(gain),
            phase_deg=math.degrees(math.atan2(gain.imag, gain.real)),
            gain_95=Interval(*map(float, best.gain_95[i])),
            phase_95_deg=Interval(*map(float, best.phase_95_deg[i])),
            coherence=_known(best.coherence[i]),
            distortion_percent=None,
            cycles=cycles,
            settled=True,
        )
        noise, nonlinear = best.noise_variance[i], best.nonlinear_variance[i]
        return Found("multisine", point, _deviation(noise), _deviation(nonlinear))


def _deviation(variance: float) -> float | None:
    return math.sqrt(variance) if math.isfinite(variance) and variance >= 0 else None


def _known(value: float) -> float | None:
    return float(value) if math.isfinite(value) else None


def played_of(asked: FrequencyResponse) -> Played:
    """What a block plays."""
    loads = [(mean, amplitude) for mean in asked.means() for amplitude in asked.amplitudes_n]
    each = [load for load in loads for _ in range(asked.realisations)]
    return Played(asked.grid(), each, asked.settle_cycles, _left_out(asked))


def _left_out(asked: FrequencyResponse) -> tuple[int, ...]:
    if asked.lines != "odd_random":
        return ()
    odd = asked.model_copy(update={"lines": "odd"}).grid().lines
    return tuple(sorted(set(odd) - set(asked.grid().lines)))
