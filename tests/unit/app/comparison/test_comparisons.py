"""Runs beside one another, against plain array arithmetic on the very records; and what is refused."""

from collections.abc import Iterator
from datetime import UTC, datetime, timedelta
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from app.analysis.overlay import Tolerance
from app.comparison.measured import Measured, measurement_rows
from app.comparison.order import Asked
from app.comparison.schemas import Align, RunComparison
from app.comparison.service import Comparisons
from app.db import Database
from app.errors import Code, Refusal
from app.prediction.schemas import Computing
from app.recording.files import remove_samples
from app.runs.verdicts import WHOLE_RUN
from rtcore.rig.parameters import rig_from
from tests.recorded_runs import SINE, enter, forget_samples, played, with_force

HELD = [{"kind": "hold", "force_n": 1500.0, "duration_s": 0.3}, SINE]


@pytest.fixture
def database(tmp_path: Path) -> Database:
    database = Database(f"sqlite:///{tmp_path / 'forcerig.sqlite'}")
    database.upgrade()
    return database


@pytest.fixture
def comparisons(database: Database, tmp_path: Path) -> Iterator[Comparisons]:
    comparisons = Comparisons(database, tmp_path / "runs")
    yield comparisons
    comparisons.close()


def compare(comparisons: Comparisons, *ids: int, **how: Any) -> RunComparison:
    found = comparisons.of(Asked(ids, **how), wait_s=60)
    assert isinstance(found, RunComparison), found
    return found


def refused(comparisons: Comparisons, *ids: int, **how: Any) -> Refusal:
    found = comparisons.of(Asked(ids, **how), wait_s=60)
    assert isinstance(found, Refusal), found
    return found


def test_bins_lose_no_peak_and_no_difference(
    database: Database, comparisons: Comparisons, tmp_path: Path
) -> None:
    runs = tmp_path / "runs"
    records = played([SINE], 1.0)
    other = with_force(records, records["force_n"])
    other["force_n"][1001] += 900.0  # one tick
    a, b = enter(database, runs, records, [SINE]), enter(database, runs, other, [SINE])
    found = compare(comparisons, a, b, points=200, tolerance_abs=500.0)
    (channel,) = found.overlay.channels
    assert found.overlay.decimated
    assert max(v for v in channel.series[1].max if v is not None) == other["force_n"].max()
    assert min(v for v in channel.series[0].min if v is not None) == records["force_n"].min()
    (difference,) = channel.differences
    assert difference.peak == pytest.approx(900, abs=1e-3)
    assert difference.peak_at == pytest.approx(1001 * 250e-6)
    assert difference.rms == pytest.approx(900 / np.sqrt(len(records)), rel=1e-4)
    (exceeded,) = difference.exceeded
    assert exceeded.first == exceeded.last == pytest.approx(1001 * 250e-6)
    assert difference.exceeded_share == pytest.approx(1 / len(records))


def test_of_few_ticks_each_is_told(
    database: Database, comparisons: Comparisons, tmp_path: Path
) -> None:
    runs = tmp_path / "runs"
    records = played([SINE], 1.0)
    a = enter(database, runs, records, [SINE])
    b = enter(database, runs, with_force(records, records["force_n"] * 1.1), [SINE])
    found = compare(comparisons, a, b, from_s=0.1, to_s=0.15, tolerance_abs=1.0, tolerance_rel=0.05)
    overlay = found.overlay
    ticks = slice(400, 601)
    assert not overlay.decimated
    assert overlay.x == pytest.approx(np.arange(400, 601) * 250e-6)
    series = overlay.channels[0].series[0]
    assert series.min == series.max == pytest.approx(records["force_n"][ticks])
    (difference,) = overlay.channels[0].differences
    expected = np.maximum(1.0, 0.05 * np.abs(records["force_n"][ticks].astype(float)))
    assert difference.tolerance == pytest.approx(expected)
    outside = np.abs(0.1 * records["force_n"][ticks]) > expected
    assert difference.exceeded_share == pytest.approx(np.mean(outside), abs=0.01)


def test_a_window_is_what_was_recorded_however_much_more_is_asked_for(
    database: Database, comparisons: Comparisons, tmp_path: Path
) -> None:
    runs, records = tmp_path / "runs", played([SINE], 1.0)
    ids = [enter(database, runs, records, [SINE]) for _ in range(2)]
    overlay = compare(comparisons, *ids, points=5000).overlay
    wider = compare(comparisons, *ids, points=5000, from_s=-1e9, to_s=1e9).overlay
    assert wider.x == overlay.x
    assert wider.channels == overlay.channels
    assert "begins at 0 s" in refused(comparisons, *ids, from_s=-1e9, to_s=-1.0).detail


def test_a_bin_wider_than_what_is_read_at_once_loses_nothing(
    database: Database, comparisons: Comparisons, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    runs, records = tmp_path / "runs", played([SINE], 1.0)
    ids = [enter(database, runs, records, [SINE]) for _ in range(2)]
    whole = compare(comparisons, *ids, points=200).overlay
    monkeypatch.setattr("app.comparison.computing.WINDOW_TICKS", 7)
    again = Comparisons(database, runs)
    assert compare(again, *ids, points=200).overlay == whole
    again.close()


def test_runs_of_unlike_length_end_each_on_its_own(
    database: Database, comparisons: Comparisons, tmp_path: Path
) -> None:
    runs = tmp_path / "runs"
    records = played([SINE], 1.0)
    a = enter(database, runs, records[:1000], [SINE])
    b = enter(database, runs, records, [SINE])
    (channel,) = compare(comparisons, a, b, points=5000).overlay.channels
    assert [v is None for v in channel.series[0].min] == [k >= 1000 for k in range(len(records))]
    assert channel.differences[0].peak == 0
    assert [v is None for v in channel.differences[0].min] == [
        v is None for v in channel.series[0].min
    ]


def test_aligned_by_block_what_came_before_does_not_matter(
    database: Database, comparisons: Comparisons, tmp_path: Path
) -> None:
    runs = tmp_path / "runs"
    longer = [{"kind": "hold", "force_n": 1500.0, "duration_s": 0.5}, SINE]
    a = enter(database, runs, played(HELD, 2.0), HELD)
    b = enter(database, runs, played(longer, 2.0), longer)
    found = compare(comparisons, a, b, channels=("force_command_n",), align=Align.BLOCK, block=1)
    (channel,) = found.overlay.channels
    assert channel.differences[0].peak == pytest.approx(0, abs=1.0)
    offsets = [run.offset_s for run in found.runs]
    assert offsets[1] is not None
    assert offsets[0] is not None
    assert offsets[1] - offsets[0] == pytest.approx(0.2, abs=0.01)
    assert refused(comparisons, a, b, align=Align.BLOCK, block=7).code is Code.NO_DATA
    assert "which block" in refused(comparisons, a, b, align=Align.BLOCK).detail


def test_in_phase_the_mean_cycles_of_two_frequencies_lie_on_each_other(
    database: Database, comparisons: Comparisons, tmp_path: Path
) -> None:
    runs = tmp_path / "runs"
    slower = [SINE | {"frequency_hz": 37.0, "cycles": 15, "phase_deg": 70.0}]
    a = enter(database, runs, played([SINE], 1.0), [SINE])
    b = enter(database, runs, played(slower, 1.5), slower)
    how = {"channels": ("force_command_n", "force_n"), "align": Align.PHASE}
    command, force = compare(comparisons, a, b, **how).overlay.channels
    degrees = np.radians(np.arange(361))
    for series in command.series:
        assert series.min == pytest.approx(2000 * np.cos(degrees), abs=5)
    assert force.differences[0].peak != 0  # the loop answers the two differently
    held = [{"kind": "hold", "force_n": 100.0, "duration_s": 0.2}]
    c = enter(database, runs, played(held, 0.5), held)
    assert "align in time instead" in refused(comparisons, a, c, align=Align.PHASE).detail


def test_in_phase_what_is_no_number_leaves_a_hole_and_no_more(
    database: Database, comparisons: Comparisons, tmp_path: Path
) -> None:
    runs, records = tmp_path / "runs", played([SINE], 1.0)
    other = records.copy()
    other["force_n"][::100] = np.nan
    other["force_command_n"][7::100] = np.nan
    other["displacement_m"] = np.nan
    a, b = enter(database, runs, records, [SINE]), enter(database, runs, other, [SINE])
    names = ("force_n", "displacement_m")
    force, displacement = compare(
        comparisons, a, b, channels=names, align=Align.PHASE
    ).overlay.channels
    assert force.differences[0].compared > 300
    assert abs(force.differences[0].peak or 0) < 20.0
    assert displacement.differences[0].compared == 0
    assert displacement.differences[0].one_sided == 361


def test_what_is_a_number_in_one_run_alone_exceeds_any_tolerance(
    database: Database, comparisons: Comparisons, tmp_path: Path
) -> None:
    runs, records = tmp_path / "runs", played([SINE], 1.0)
    half, none, short = records.copy(), records.copy(), records[:1000]
    half["force_n"][1000:1400] = np.nan
    none["force_n"] = np.nan
    ids = [enter(database, runs, each, [SINE]) for each in (records, half, none, short)]
    (channel,) = compare(comparisons, *ids, points=5000, tolerance_abs=1.0).overlay.channels
    partly, never, shorter = channel.differences
    count = len(records)
    assert (partly.compared, partly.one_sided, partly.peak) == (count - 400, 400, 0.0)
    (exceeded,) = partly.exceeded
    assert (exceeded.first, exceeded.last, exceeded.peak) == (0.25, 1399 * 250e-6, None)
    assert partly.exceeded_share == pytest.approx(400 / count)
    assert (never.compared, never.one_sided, never.exceeded_share) == (0, count, 1.0)
    assert (never.rms, never.peak, never.peak_at) == (None, None, None)
    assert (shorter.compared, shorter.one_sided, shorter.exceeded_in_all) == (1000, 0, 0)


def test_long_runs_are_compared_apart(
    database: Database, comparisons: Comparisons, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("app.comparison.overlays.AT_ONCE_TICKS", 10)
    records = played([SINE], 1.0)
    ids = [enter(database, tmp_path / "runs", records, [SINE]) for _ in range(2)]
    assert isinstance(comparisons.of(Asked(tuple(ids))), Computing)
    assert compare(comparisons, *ids).overlay.channels[0].differences[0].peak == 0


def test_measurements_and_settings_stand_beside_one_another(
    database: Database, comparisons: Comparisons, tmp_path: Path
) -> None:
    runs, records = tmp_path / "runs", played([SINE], 1.0)
    louder = [SINE | {"amplitude_n": 2500.0}]
    a = enter(database, runs, records, [SINE])
    b = enter(database, runs, with_force(records, records["force_n"] * 1.2), louder)
    stiffer = rig_from({"structure": {"k_pl": 2e8}})
    c = enter(database, runs, records, [SINE], rig=stiffer)
    found = compare(comparisons, a, b, c, tolerance_rel=0.1)
    rows = {(row.block, row.name): row for row in found.measurements}
    row = rows[None, "amplitude_n"]
    values = [one.value for one in row.values]
    assert values[1] == pytest.approx(1.2 * (values[0] or 0), rel=1e-4)
    assert [one.within for one in row.values] == [True, False, True]
    settings = {(row.part, row.path): row.values for row in found.settings}
    assert settings["definition", "blocks[0].amplitude_n"] == [2000.0, 2500.0, 2000.0]
    assert settings["rig", "structure.k_pl"] == [1.5e8, 1.5e8, 2e8]
    assert len(settings) == found.settings_in_all == 2


def test_a_measurement_is_tolerated_up_to_the_larger_of_both() -> None:
    values = {"peak_force_n": 0.0, "force_error_rms_n": 10.0, "cycles": 0.0}
    other = {"peak_force_n": 3.0, "force_error_rms_n": 16.0, "cycles": 0.5}
    runs = [
        Measured(i, {(WHOLE_RUN, k): v for k, v in each.items()})
        for i, each in enumerate((values, other))
    ]

    def within(absolute: float, relative: float) -> list[bool | None]:
        rows = measurement_rows(runs, Tolerance(absolute, relative), {"N"})
        found = {row.name: row.values[1].within for row in rows}
        return [found[name] for name in values]

    assert within(5.0, 0.1) == [True, False, False]
    assert within(5.0, 0.7) == [True, True, False]
    assert within(2.0, 0.0) == [False, False, None]  # no newtons for what is none


def test_what_cannot_be_compared_is_refused_with_what_to_do(
    database: Database, comparisons: Comparisons, tmp_path: Path
) -> None:
    runs, records = tmp_path / "runs", played([SINE], 1.0)
    a = enter(database, runs, records, [SINE])
    under_way = enter(database, runs, records, [SINE], outcome=None)
    slow = enter(database, runs, records, [SINE], period_ns=500_000)
    gone = enter(database, runs, records, [SINE])
    remove_samples(runs / str(gone))
    forget_samples(database, gone, datetime(2026, 3, 1, tzinfo=UTC))
    for ids in ((a,), (a, a), tuple(range(1, 10))):
        assert "2 to 8 different runs" in refused(comparisons, *ids).detail
    assert refused(comparisons, a, 999).code is Code.UNKNOWN_RUN
    assert refused(comparisons, a, under_way).code is Code.RUN_UNDER_WAY
    assert "align them in phase" in refused(comparisons, a, slow).detail
    assert "leave it out" in refused(comparisons, a, gone).detail
    unknown = refused(comparisons, a, slow, channels=("force",))
    assert unknown.code is Code.UNKNOWN_CHANNEL
    assert (
        "ends at"
        in refused(comparisons, a, enter(database, runs, records, [SINE]), from_s=9.0).detail
    )


def test_a_measurement_that_drifts_is_told_from_one_that_scatters(
    database: Database, comparisons: Comparisons, tmp_path: Path
) -> None:
    records = played([SINE], 1.0)
    start = datetime(2026, 1, 1, tzinfo=UTC)
    random = np.random.default_rng(3)
    for day in range(12):
        for test_id, drift in (("ages", 0.01), ("stays", 0.0)):
            scale = 1 + drift * day + 0.002 * random.standard_normal()
            other = with_force(records, records["force_n"] * scale)
            at = start + timedelta(days=day)
            enter(database, tmp_path / "runs", other, [SINE], test_id=test_id, started_at=at)
    ages, stays = (comparisons.trend("amplitude_n", name) for name in ("ages", "stays"))
    assert not isinstance(ages, Refusal)
    assert not isinstance(stays, Refusal)
    assert ages.line is not None
    assert stays.line is not None
    first = ages.points[0].value
    assert ages.line.leans
    assert ages.line.slope_low < 0.01 * first < ages.line.slope_high
    assert not stays.line.leans
    assert [point.run_id for point in ages.points] == sorted(p.run_id for p in ages.points)
    newest = comparisons.trend("amplitude_n", "ages", limit=2)
    assert not isinstance(newest, Refusal)
    assert (len(newest.points), newest.runs_in_all, newest.line) == (2, 12, None)
    assert isinstance(comparisons.trend("amplitude", "ages"), Refusal)
