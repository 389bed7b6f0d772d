"""Adaptive frequency responses on the virtual rig: no longer, no higher and no finer than is needed."""

import math

import numpy as np
import pytest

from app.analysis.response.point import ResponsePoint
from app.conducting.conductor import is_sure
from app.conducting.found import Found
from app.definitions.adaptive import Confidence
from app.definitions.limits import RIG
from app.definitions.outline import outline
from app.runs.response_series import series_of
from tests.unit.app.conducting.responses import Played, play, played, response_test

SURE = {"confidence": {"gain_db": 0.05, "phase_deg": 0.5}}
FEW = {"frequencies_hz": [20.0, 40.0, 80.0], "settle_cycles": 2, "measure_cycles": 40}


def gain_db(point: ResponsePoint) -> float:
    return 20 * math.log10(point.gain)


def is_smooth(run: Played) -> bool:
    """Whether the setpoint moves no faster anywhere than the fastest sine in it."""
    command_n = run.records["force_command_n"].astype(np.float64)
    fastest_hz = max(point.frequency_hz for point in run.points)
    per_tick = 2 * math.pi * fastest_hz * RIG.period_s
    reach_n = np.abs(command_n).max()
    return bool(np.abs(np.diff(command_n)).max() <= 1.05 * per_tick * reach_n)


def test_it_ends_as_soon_as_every_point_is_sure() -> None:
    plain, adaptive = response_test(**FEW), response_test(**FEW, **SURE)
    found = play(adaptive)
    assert outline(adaptive).duration_s == outline(plain).duration_s  # that is the most
    assert found.duration_s < 0.5 * outline(plain).duration_s
    assert all(is_sure(point, Confidence()) for point in found.points)
    assert found.refusals == 0
    assert is_smooth(found)


def test_it_finds_what_the_full_test_finds() -> None:
    whole, short = (play(response_test(**FEW, **more)).by_frequency() for more in ({}, SURE))
    assert whole.keys() == short.keys()
    for hz, point in short.items():
        assert gain_db(point) == pytest.approx(gain_db(whole[hz]), abs=0.1)
        assert point.phase_deg == pytest.approx(whole[hz].phase_deg, abs=0.5)
        assert point.cycles < whole[hz].cycles == 40


def test_it_is_the_same_each_time() -> None:
    adaptive = response_test(**FEW, **SURE)
    once, again = play(adaptive), played(adaptive)
    assert np.array_equal(once.records, again.records)


def test_several_means_and_amplitudes_are_each_a_response_of_their_own() -> None:
    asked = response_test(
        means_n=[-2000.0, 3000.0],
        amplitudes_n=[1000.0, 2000.0],
        frequencies_hz=[20.0, 40.0],
        measure_cycles=20,
        **SURE,
    )
    found = play(asked)
    loads = [(point.mean_n, point.amplitude_n) for point in found.points]
    means = [(mean, amplitude) for mean in (-2000.0, 3000.0) for amplitude in (1000.0, 2000.0)]
    assert loads == [load for load in means for _ in range(2)]
    assert is_smooth(found)


def test_it_settles_until_the_response_is_steady() -> None:
    asked = {"frequencies_hz": [20.0, 40.0], "settle_cycles": 2, "measure_cycles": 4}
    found = play(response_test(**asked, settle={"at_most_cycles": 100}))
    fixed = play(response_test(**asked | {"settle_cycles": 100}))
    assert found.skips == 2
    assert found.duration_s < 0.3 * fixed.duration_s
    for hz, point in found.by_frequency().items():
        assert gain_db(point) == pytest.approx(gain_db(fixed.by_frequency()[hz]), abs=0.1)


def test_it_looks_closer_only_where_the_response_bends() -> None:
    asked = {"frequencies_hz": {"from_hz": 5.0, "to_hz": 80.0, "points": 7}, "measure_cycles": 10}
    bent = {"points": 1, "bend_db": 1.0, "bend_deg": 8.0}
    found = play(response_test(**asked, auto_resolution=bent, **SURE))
    base = set(np.geomspace(5, 80, 7).round(2))
    between = {hz for hz in found.by_frequency() if hz not in base}
    assert base <= found.by_frequency().keys()
    assert 1 <= len(between) < 6
    peak_hz = max(found.points, key=lambda point: point.gain).frequency_hz
    assert min(abs(math.log2(hz / peak_hz)) for hz in between) < 0.5
    assert not [hz for hz in between if hz < 10.0]  # where it is flat


def test_it_backs_the_level_off_where_the_valve_has_too_much_to_do() -> None:
    asked = {"amplitudes_n": [8000.0], "frequencies_hz": [10.0, 40.0, 90.0], "measure_cycles": 10}
    whole = play(response_test(**asked))
    limit = 0.75 * float(np.abs(whole.records["valve_command"]).max())
    found = play(response_test(**asked, auto_level={"valve_at_most": limit}))
    amplitudes_n = [point.amplitude_n for point in found.points if point.cycles == 10]
    assert min(amplitudes_n) < 8000.0
    assert {8000.0 / amplitude for amplitude in amplitudes_n} <= {1.0, 2.0, 4.0, 8.0}
    assert len(amplitudes_n) == 3
    counted = found.records["program_tick"] >= 0
    measured = np.abs(found.records["valve_command"][counted])
    assert np.quantile(measured, 0.95) <= limit


def test_what_was_backed_off_is_no_part_of_the_series_that_was_meant_to_be_as_small() -> None:
    """At 40 Hz 8 kN come down to 4 kN, which are asked for too: two points, each of its own cycles alone."""
    asked = {"amplitudes_n": [8000.0, 4000.0], "frequencies_hz": [10.0, 40.0], "measure_cycles": 10}
    limit = 0.75 * float(np.abs(play(response_test(**asked)).records["valve_command"]).max())
    found = play(response_test(**asked, auto_level={"valve_at_most": limit}))
    at_40 = [p for p in found.points if p.frequency_hz == 40.0 and p.amplitude_n == 4000.0]
    assert [(p.asked_n, p.cycles) for p in at_40] == [(8000.0, 10), (4000.0, 10)]
    of_40 = [p for p in found.points if p.frequency_hz == 40.0]
    series = series_of([Found("stepped_sine", p) for p in of_40], "force")
    assert [(one.amplitude_n, len(one.points)) for one in series] == [(8000.0, 1), (4000.0, 1)]


def test_an_interval_of_few_cycles_is_not_believed() -> None:
    (point, *_) = play(response_test(**FEW)).points
    assert is_sure(point, Confidence(gain_db=1.0, phase_deg=10.0))
    assert not is_sure(point._replace(cycles=3), Confidence(gain_db=1.0, phase_deg=10.0))
    assert not is_sure(point, Confidence(gain_db=0.001, phase_deg=0.01))
