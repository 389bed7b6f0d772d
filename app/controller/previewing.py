"""A test on the virtual rig under a draft of the controller and under the one that it is laid beside."""

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass

import numpy as np

from app.controller.preview_schemas import BlockMeasured, Previewed, PreviewSide, Stretches
from app.definitions.limits import RIG
from app.definitions.outline import outline
from app.errors import Refusal
from app.prediction.play import Records
from app.prediction.schemas import Prediction
from app.prediction.setup import Setup
from app.prediction.simulation import begin_simulation

POINTS = 1200  # of each curve
SHOWN = ("force_n", "force_command_n")


@dataclass(frozen=True)
class Side:
    """One of the two controllers, in everything that decides what the virtual rig does."""

    setup: Setup
    revision: int | None


def preview(
    report: Callable[[float], None], test_id: str, draft: Side, beside: Side
) -> Previewed | Refusal:
    """Both on the virtual rig, one after the other; what one of them cannot have is refused."""
    first = _side(draft, lambda share: report(0.5 * share))
    if isinstance(first, Refusal):
        return first
    second = _side(beside, lambda share: report(0.5 + 0.5 * share))
    if isinstance(second, Refusal):
        return second
    name = draft.setup.definition.name
    return Previewed(test_id=test_id, test_name=name, draft=first, beside=second)


def _side(side: Side, report: Callable[[float], None]) -> PreviewSide | Refusal:
    simulating = begin_simulation(side.setup, report)
    if isinstance(simulating, Refusal):
        return simulating
    curves = _Curves(outline(side.setup.definition).duration_s)
    for records in simulating.chunks():
        curves.take(records)
    prediction, through = simulating.prediction(), simulating.through
    nearest = _nearest(prediction)
    rms_n = _root_of_mean(prediction)
    return PreviewSide(
        revision=side.revision,
        outcome=through.ending.outcome.value,
        reason=through.ending.reason,
        error_rms_n=rms_n,
        error_peak_n=prediction.peaks.force_error_n,
        saturation_share=prediction.valve.saturation_share,
        nearest=None if nearest is None else nearest[0],
        nearest_share=None if nearest is None else nearest[1],
        measurements=list(_measured(prediction)),
        time_s=curves.time_s,
        force_n=curves.band("force_n"),
        force_command_n=curves.band("force_command_n"),
    )


def _measured(prediction: Prediction) -> Iterator[BlockMeasured]:
    for block in prediction.blocks:
        for found in block.measurements:
            yield BlockMeasured(block=block.index, kind=block.kind, **found.model_dump())


def _root_of_mean(prediction: Prediction) -> float | None:
    """The rms over the block in which it is worst: holds before and after it would hide it."""
    found = [b.force_error_rms_n for b in prediction.blocks if b.force_error_rms_n is not None]
    return max(found, default=None)


def _nearest(prediction: Prediction) -> tuple[str, float] | None:
    shares = [
        (m.margin_share, m.detector) for m in prediction.margins if m.margin_share is not None
    ]
    return None if not shares else (min(shares)[1], min(shares)[0])


class _Curves:
    """Least and greatest values over even stretches of a test: of the last, unfinished one none."""

    def __init__(self, duration_s: float) -> None:
        self._stride = max(1, math.ceil(duration_s / RIG.period_s / POINTS))
        self._left: Records | None = None
        self._bands = {channel: Stretches(min=[], max=[]) for channel in SHOWN}
        self.time_s: list[float] = []

    def take(self, records: Records) -> None:
        """The next ticks of the run."""
        both = records if self._left is None else np.concatenate([self._left, records])
        whole = len(both) // self._stride * self._stride
        self._left = both[whole:].copy()
        stretches = both[:whole].reshape(-1, self._stride)
        for channel, band in self._bands.items():
            band.min += map(float, stretches[channel].min(axis=1))
            band.max += map(float, stretches[channel].max(axis=1))
        begun, width_s = len(self.time_s), self._stride * RIG.period_s
        self.time_s += [round((begun + i) * width_s, 9) for i in range(len(stretches))]

    def band(self, channel: str) -> Stretches:
        """A channel over all stretches."""
        return self._bands[channel]
