"""Frequency response of stepped sines, while they are played: IEEE 1057 fits of each point.

The frequency is known exactly and so are the sampling instants, so each channel is fitted with mean,
sine and harmonics by least squares over whatever is there of a point, whole cycles or not. All channels
of a record are of the same instant, so a transfer is the ratio of two fits; the valve command of a
record is applied a tick later (docs/conventions.md).
"""

from collections.abc import Iterable, Mapping

from app.analysis.evidence import Sine
from app.analysis.phasors import Phasors
from app.analysis.response.fit import Estimate, Fit, fit_of
from app.analysis.response.point import ResponsePoint
from app.analysis.response.transfers import TRANSFERS, Transfer
from app.analysis.response.unit_under_test import MEASURED, unit_estimates
from app.analysis.walk import Part
from rtcore.rig.parameters import RigParameters

REFERENCE = "force_command_n"  # whose phase stretches of the same sine are turned to

Key = tuple[int, Sine]


def channels_of(transfers: Iterable[Transfer]) -> tuple[str, ...]:
    """Every channel that the transfers need, once, with that of the setpoint."""
    both = (name for transfer in transfers for name in (transfer.input, transfer.output))
    return tuple(dict.fromkeys([REFERENCE, *both]))


class SteppedSine:
    """Takes a run part after part; gives the points so far.

    The `Walk` that gives the parts needs `also=channels_of(transfers.values())`. Memory grows with the
    points, not with the ticks. A sine that a block plays several times is one point, one for each
    amplitude that it was backed off from. With a `rig`,
    dynamic stiffness and admittance of the unit under test are told too.
    """

    def __init__(
        self,
        period_s: float,
        transfers: Mapping[str, Transfer] = TRANSFERS,
        rig: RigParameters | None = None,
    ) -> None:
        self._period_s = period_s
        self._rig = rig
        self._transfers = tuple(transfers.values())
        self._channels = channels_of([*self._transfers, *([] if rig is None else [MEASURED])])
        self._fits: dict[Key, Fit] = {}
        self._points: dict[Key, list[ResponsePoint]] = {}
        self._now: tuple[Key, Phasors] | None = None

    def take(self, part: Part) -> None:
        """The next part of the run, of whatever kind."""
        if part.begins:
            self._file()
        sine = part.stretch.sine
        if sine is None or len(part.positions) == 0:
            return
        if self._now is None:
            began_at, first = int(part.columns["tick"][0]), int(part.positions[0])
            turned = sine.frequency_hz * self._period_s
            phasors = Phasors(self._channels, turned, began_at, first)
            self._now = (part.stretch.block, sine), phasors
        self._now[1].take(part.positions, part.columns)

    def points(self) -> list[ResponsePoint]:
        """What there is of each point, in the order in which they began; the last may still grow."""
        found = dict(self._points)
        if self._now is not None:
            key, phasors = self._now
            fit = self._with_those_before(key, phasors)
            if fit is not None:
                found[key] = self._read(key, fit)
        return [point for points in found.values() for point in points]

    def latest(self) -> list[ResponsePoint]:
        """The point that is being measured now, of each transfer; empty between two."""
        if self._now is None:
            return []
        key, phasors = self._now
        fit = self._with_those_before(key, phasors)
        return [] if fit is None else self._read(key, fit)

    def _file(self) -> None:
        """Keep what the stretch amounts to."""
        now, self._now = self._now, None
        if now is None:
            return
        key, phasors = now
        fit = self._with_those_before(key, phasors)
        if fit is not None:
            self._fits[key], self._points[key] = fit, self._read(key, fit)

    def _with_those_before(self, key: Key, phasors: Phasors) -> Fit | None:
        fit = fit_of(phasors)
        if fit.whole_cycles < 1:
            return self._fits.get(key)  # not one whole cycle
        before = self._fits.get(key)
        return fit if before is None else before.added(fit, REFERENCE)

    def _read(self, key: Key, fit: Fit) -> list[ResponsePoint]:
        found = {t: fit.estimate(t.input, t.output) for t in self._transfers}
        if self._rig is not None:
            found |= unit_estimates(fit, self._rig, key[1].frequency_hz)
        return [_point(t, key, fit, e) for t, e in found.items() if e is not None]


def _point(transfer: Transfer, key: Key, fit: Fit, estimate: Estimate) -> ResponsePoint:
    block, sine = key
    measured = transfer.output in fit.channels
    return ResponsePoint(
        transfer=transfer.name,
        block=block,
        frequency_hz=sine.frequency_hz,
        amplitude_n=sine.amplitude_n,
        mean_n=sine.mean_n,
        gain=abs(estimate.gain),
        phase_deg=estimate.phase_deg,
        gain_95=estimate.gain_95,
        phase_95_deg=estimate.phase_95_deg,
        coherence=estimate.coherence,
        distortion_percent=fit.distortion_percent(transfer.output) if measured else None,
        cycles=fit.whole_cycles,
        settled=estimate.steady,
        asked_n=sine.asked_n,
    )
