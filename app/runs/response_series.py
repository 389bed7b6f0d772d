"""Points of a frequency response as they are told: in series, with their extremes."""

import cmath
import math
from collections.abc import Iterable, Sequence
from typing import cast

from app.analysis.response.extremes import Extreme, find_extremes
from app.analysis.response.point import ResponsePoint
from app.analysis.response.transfers import EVERY
from app.conducting.found import Found
from app.definitions.responses import FrequencyResponse
from app.runs.response_schemas import (
    BandOut,
    ExtremesOut,
    PeakOut,
    ResponseFrame,
    ResponsePointOut,
    ResponseSeries,
    TransferName,
)

NO_UNIT = "1"


def point_out(found: Found) -> ResponsePointOut:
    """A point as it is told."""
    point = found.point
    low, high = point.gain_95
    has_db = _has_no_unit(point.transfer) and point.gain > 0
    return ResponsePointOut(
        frequency_hz=point.frequency_hz,
        amplitude_n=point.amplitude_n,
        asked_n=_asked_n(point),
        amplitude_m=found.amplitude_m,
        mean_n=point.mean_n,
        gain=point.gain,
        gain_db=20 * math.log10(point.gain) if has_db else None,
        phase_deg=point.phase_deg,
        gain_low=low if math.isfinite(low) else 0.0,
        gain_high=high if math.isfinite(high) else None,
        phase_low_deg=point.phase_95_deg.low,
        phase_high_deg=point.phase_95_deg.high,
        coherence=point.coherence,
        distortion_percent=point.distortion_percent,
        noise_std=found.noise_std,
        nonlinear_std=found.nonlinear_std,
        cycles=point.cycles,
        settled=point.settled,
    )


def frame_of(run_id: int, found: Found) -> ResponseFrame:
    """A point on its way to the browsers."""
    point = found.point
    transfer = cast(TransferName, point.transfer)
    return ResponseFrame(run=run_id, block=point.block, transfer=transfer, point=point_out(found))


def series_of(points: Iterable[Found], transfer: str) -> list[ResponseSeries]:
    """The points of a transfer by block, amplitude and mean, each in the order of frequency.

    A point that was backed off belongs to the amplitude that was asked for.
    """
    groups: dict[tuple[int, str, float, float], list[Found]] = {}
    for found in points:
        point = found.point
        if point.transfer == transfer and math.isfinite(point.gain):
            key = point.block, found.method, _asked_n(point), point.mean_n
            groups.setdefault(key, []).append(found)
    return [_series(key, group) for key, group in groups.items()]


def bands_of(asked: Iterable[FrequencyResponse]) -> list[BandOut]:
    """What the test requires."""
    return [BandOut(**band.model_dump()) for one in asked for band in one.bands]


def _series(key: tuple[int, str, float, float], group: Sequence[Found]) -> ResponseSeries:
    block, _, amplitude_n, mean_n = key
    ordered = sorted(group, key=lambda found: found.point.frequency_hz)
    return ResponseSeries(
        block=block,
        method=ordered[0].method,
        amplitude_n=amplitude_n,
        amplitude_m=ordered[0].amplitude_m,
        mean_n=mean_n,
        points=[point_out(found) for found in ordered],
        extremes=_extremes(ordered),
    )


def _extremes(ordered: Sequence[Found]) -> ExtremesOut:
    points = [found.point for found in ordered]
    if not _has_no_unit(points[0].transfer):
        return ExtremesOut()
    response = [cmath.rect(p.gain, math.radians(p.phase_deg)) for p in points]
    found = find_extremes([p.frequency_hz for p in points], response)
    return ExtremesOut(
        peak=_peak(found.peak),
        dip=_peak(found.dip),
        minus_3_db_hz=found.minus_3_db_hz,
        minus_90_deg_hz=found.minus_90_deg_hz,
    )


def _asked_n(point: ResponsePoint) -> float:
    return point.amplitude_n if point.asked_n is None else point.asked_n


def _has_no_unit(transfer: str) -> bool:
    return EVERY[transfer].unit == NO_UNIT


def _peak(extreme: Extreme | None) -> PeakOut | None:
    if extreme is None:
        return None
    return PeakOut(frequency_hz=extreme.frequency_hz, gain_db=extreme.gain_db)
