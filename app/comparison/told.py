"""Runs on one axis as they are told."""

import math
from collections.abc import Sequence

import numpy as np

from app.analysis.overlay import Difference, Floats
from app.comparison.order import Laid, Order
from app.comparison.schemas import (
    Align,
    ComparedChannel,
    ComparedDifference,
    ComparedSeries,
    ExceededOut,
    Numbers,
    OverlayOut,
)
from rtcore.channels import CHANNEL


def told(
    order: Order,
    found: dict[str, Laid],
    x: Floats,
    place: float,
    decimated: bool,
    offsets_s: Sequence[float | None],
) -> OverlayOut:
    start = float(x[0])
    return OverlayOut(
        align=order.align,
        block=order.block,
        x_unit="°" if order.align is Align.PHASE else "s",
        x=x.round(9).tolist(),
        decimated=decimated,
        offsets_s=list(offsets_s),
        channels=[_channel(order, name, one, start, place) for name, one in found.items()],
    )


def _channel(order: Order, name: str, found: Laid, start: float, place: float) -> ComparedChannel:
    ids = [side.run_id for side in order.sides]
    return ComparedChannel(
        channel=name,
        unit=CHANNEL[name].unit,
        series=[
            ComparedSeries(run_id=run_id, min=_numbers(band.low), max=_numbers(band.high))
            for run_id, band in zip(ids, found.series, strict=True)
        ],
        differences=[
            _difference(run_id, difference, order, start, place)
            for run_id, difference in zip(ids[1:], found.differences, strict=True)
        ],
    )


def _difference(
    run_id: int, found: Difference, order: Order, start: float, place: float
) -> ComparedDifference:
    found.close()
    asked = order.tolerance is not None
    exceeding = found.exceeding

    def at(index: int) -> float:
        return round(start + index * place, 9)

    return ComparedDifference(
        run_id=run_id,
        min=_numbers(found.band.low),
        max=_numbers(found.band.high),
        tolerance=_numbers(found.tolerances) if asked else None,
        rms=found.rms,
        peak=found.peak,
        peak_at=None if found.peak_at is None else at(found.peak_at),
        compared=found.count,
        one_sided=found.one_sided,
        exceeded_share=found.exceeded_share,
        exceeded=[
            ExceededOut(first=at(one.first), last=at(one.last), peak=_number(one.peak))
            for one in exceeding.intervals
        ],
        exceeded_in_all=exceeding.count,
    )


def _number(value: float) -> float | None:
    return value if math.isfinite(value) else None


def _numbers(values: Floats) -> Numbers:
    numbers: Numbers = values.tolist()
    for index in np.flatnonzero(~np.isfinite(values)).tolist():
        numbers[index] = None
    return numbers
