"""The report of several runs: what differs is in it."""

from datetime import UTC, datetime
from typing import Any

import pytest

from app.comparison.schemas import (
    Align,
    ComparedChannel,
    ComparedDifference,
    ComparedRun,
    ComparedSeries,
    ComparedValue,
    MeasurementRow,
    OverlayOut,
    RunComparison,
    SettingRow,
)
from app.recording.outcome import Outcome
from app.reports.branding import Branding, branding
from app.reports.comparison import collect_comparison
from app.reports.rendering import render_html, render_pdf
from tests.unit.app.reports.test_rendering import pages


def a_run(number: int, **values: Any) -> ComparedRun:
    told: dict[str, Any] = {
        "test_id": "step",
        "test_name": "#eval(1) <b>",
        "revision": 1,
        "started_at": datetime(2026, 3, number, tzinfo=UTC),
        "operator": "Ada",
        "outcome": Outcome.COMPLETED,
        "verdict": "pass",
        "duration_s": 2.0,
        "software_version": "0.1.0",
        "offset_s": 0.0,
    }
    return ComparedRun(id=number, **(told | values))


@pytest.fixture
def compared() -> RunComparison:
    x = [0.0, 0.5, 1.0]
    force: list[float | None] = [0.0, None, 2000.0]
    series = [ComparedSeries(run_id=n, min=force, max=force) for n in (1, 2)]
    difference = ComparedDifference(
        run_id=2,
        min=[0.0, None, 40.0],
        max=[0.0, None, 60.0],
        tolerance=None,
        rms=12.0,
        peak=-60.0,
        peak_at=1.0,
        compared=2,
        one_sided=0,
        exceeded_share=None,
        exceeded=[],
        exceeded_in_all=0,
    )
    channel = ComparedChannel(channel="force_n", unit="N", series=series, differences=[difference])
    overlay = OverlayOut(
        align=Align.TIME,
        block=None,
        x_unit="s",
        x=x,
        decimated=True,
        offsets_s=[0.0, 0.0],
        channels=[channel],
    )
    values = [
        ComparedValue(run_id=1, value=1000.0, difference=None, within=None),
        ComparedValue(run_id=2, value=1500.0, difference=500.0, within=False),
    ]
    return RunComparison.model_construct(
        baseline_id=1,
        runs=[a_run(1), a_run(2, operator="Otto", verdict="fail")],
        overlay=overlay,
        measurements=[MeasurementRow(block=None, name="peak_force_n", unit="N", values=values)],
        settings=[SettingRow(part="controller", path="k_p", values=[1.19e-5, "#raw"])],
        settings_in_all=1,
    )


@pytest.fixture
def look() -> Branding:
    found = branding(None, None)
    assert isinstance(found, Branding)
    return found


def test_what_differs_is_told(compared: RunComparison, look: Branding) -> None:
    text = " ".join(pages(render_pdf(collect_comparison(compared), look)))
    facts = ("Runs 1, 2", "Ada", "Otto", "differ: 1;", "tolerance: 1.")
    for fact in (*facts, "controller: k_p", "#raw", "−0.06 kN", "1.5 kN", "#eval(1) <b>"):
        assert fact in text, fact
    assert b"<b>" not in render_html(collect_comparison(compared), look)


def test_the_same_comparison_has_the_same_bytes(compared: RunComparison, look: Branding) -> None:
    made = [render_pdf(collect_comparison(compared), look) for _ in range(2)]
    assert made[0] == made[1]
