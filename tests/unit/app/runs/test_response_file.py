"""The points of a run as they are kept, and told."""

import math
from pathlib import Path

import pytest

from app.analysis.response.point import Interval, ResponsePoint
from app.conducting.found import Found
from app.definitions.responses import FrequencyResponse
from app.runs.response_file import NAME, VERSION, read_points, write_points
from app.runs.response_series import bands_of, point_out, series_of


def found(hz: float, gain: float, phase_deg: float, amplitude_n: float = 1000.0) -> Found:
    """A point of the closed loop."""
    gain_95 = Interval(gain - 0.1, math.inf)
    phase_95 = Interval(phase_deg - 180.0, phase_deg + 180.0)
    point = ResponsePoint(
        "force", 0, hz, amplitude_n, 0.0, gain, phase_deg, gain_95, phase_95, 0.9, 1.5, 3, True
    )
    return Found("stepped_sine", point, None, 0.25)


POINTS = [
    found(10.0, 1.0, -10.0),
    found(40.0, 1.5, -60.0),
    found(20.0, 1.2, -30.0),
    found(80.0, 0.5, -120.0),
]


def test_points_are_read_as_they_were_written(tmp_path: Path) -> None:
    write_points(tmp_path, POINTS)
    assert read_points(tmp_path) == POINTS


@pytest.mark.parametrize(
    "content", [b"", b"[]", b'{"version": 99, "points": []}', b'{"version": 3, "points": [{}]}']
)
def test_what_is_no_such_file_counts_as_not_there(tmp_path: Path, content: bytes) -> None:
    assert read_points(tmp_path) is None
    (tmp_path / NAME).write_bytes(content)
    assert read_points(tmp_path) is None


def test_a_point_without_bounds_is_told_with_nulls() -> None:
    told = point_out(POINTS[1])
    assert told.gain_high is None
    assert told.gain_db == pytest.approx(20 * math.log10(1.5))
    assert (told.noise_std, told.nonlinear_std) == (None, 0.25)


def test_a_coherence_of_which_nothing_is_known_stays_unknown(tmp_path: Path) -> None:
    unknown = POINTS[0]._replace(point=POINTS[0].point._replace(coherence=None))
    write_points(tmp_path, [unknown])
    assert read_points(tmp_path) == [unknown]
    assert point_out(unknown).coherence is None


def test_a_series_is_in_the_order_of_frequency_with_its_extremes() -> None:
    (series,) = series_of(POINTS, "force")
    assert [point.frequency_hz for point in series.points] == [10.0, 20.0, 40.0, 80.0]
    assert series.extremes.peak is not None
    assert 30.0 < series.extremes.peak.frequency_hz < 45.0
    assert series.extremes.minus_90_deg_hz == pytest.approx(57, abs=2)
    assert series_of(POINTS, "plant") == []


def test_a_point_that_was_backed_off_belongs_to_what_was_asked_for() -> None:
    backed_off = found(20.0, 1.2, -30.0, amplitude_n=250.0)
    backed_off = backed_off._replace(point=backed_off.point._replace(asked_n=1000.0))
    points = [POINTS[0], backed_off, found(20.0, 1.2, -30.0, amplitude_n=250.0)]
    series, as_small = series_of(points, "force")
    assert (series.amplitude_n, as_small.amplitude_n) == (1000.0, 250.0)
    assert [point.amplitude_n for point in series.points] == [1000.0, 250.0]
    assert len(as_small.points) == 1


def test_bands_are_those_of_the_test() -> None:
    band = {"from_hz": 5.0, "to_hz": 50.0, "high_db": 3.0}
    asked = FrequencyResponse.model_validate(
        {"amplitudes_n": [1000.0], "frequencies_hz": [10.0], "bands": [band]}
    )
    (told,) = bands_of([asked])
    assert (told.from_hz, told.to_hz, told.low_db, told.high_db) == (5.0, 50.0, None, 3.0)


def test_of_the_version_before_all_but_sweeps_is_right(tmp_path: Path) -> None:
    def aged(points: list[Found]) -> list[Found] | None:
        write_points(tmp_path, points)
        path = tmp_path / NAME
        path.write_text(
            path.read_text().replace(f'"version": {VERSION}', f'"version": {VERSION - 1}')
        )
        return read_points(tmp_path)

    stepped = [found for found in POINTS if found.method != "sweep"]
    assert aged(stepped) == stepped
    assert aged([*stepped, stepped[0]._replace(method="sweep")]) is None
