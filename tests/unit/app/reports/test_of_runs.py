"""Reports of runs as they come: passed, tripped, interrupted, without samples, with values that are none."""

import hashlib
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from app.db import Database
from app.definitions.definition import Definition
from app.errors import Code, Refusal
from app.jobs.apart import run_apart
from app.jobs.jobs import Job
from app.recording.files import parquet_path, remove_samples
from app.reports import service
from app.reports.branding import Branding, branding
from app.reports.collect import collect
from app.reports.of_run import subject_of_run
from app.reports.orders import Extent, Format, Order, Sources, carry_out
from app.reports.rendering import render_html, render_pdf
from app.reports.service import Ready, Reports, Wanted
from app.runs import repository
from bench.filed_run import file_run
from tests.unit.app.reports.test_rendering import WICKED, pages

pytestmark = [pytest.mark.process, pytest.mark.slow]
HOLD = {"kind": "hold", "force_n": 0, "duration_s": 0.2}
STEP = {"kind": "step", "to_n": 2000, "hold_s": 0.4}
SINE = {"kind": "harmonic", "amplitude_n": 2000, "frequency_hz": 50, "cycles": 10}


@pytest.fixture(scope="module")
def sources(tmp_path_factory: pytest.TempPathFactory) -> Sources:
    folder = tmp_path_factory.mktemp("reports")
    url = f"sqlite:///{folder / 'forcerig.sqlite'}"
    return Sources(url, folder / "runs", folder / "histories")


@pytest.fixture(scope="module")
def database(sources: Sources) -> Iterator[Database]:
    found = Database(sources.database_url)
    found.upgrade()
    yield found
    found.close()


@pytest.fixture(scope="module")
def run_id(database: Database, sources: Sources) -> int:
    """One that went well."""
    noted: dict[str, Any] = {
        "operator": "Ada",
        "notes": WICKED[0],
        "tags": ("seal",),
        "test_name": "Seal <b>test</b>",
    }
    return file_run(database, sources.runs_dir, [HOLD, STEP, SINE], **noted)


@pytest.fixture
def look() -> Branding:
    found = branding(None, None)
    assert isinstance(found, Branding)
    return found


def text_of(
    database: Database, sources: Sources, run_id: int, extent: Extent = Extent.FULL
) -> list[str]:
    look = branding(None, None)
    subject = subject_of_run(run_id, database, sources.runs_dir)
    assert isinstance(look, Branding)
    assert not isinstance(subject, Refusal), subject
    report = collect(subject, extent)
    assert b"<html" in render_html(report, look)
    return pages(render_pdf(report, look))


def change(database: Database, run_id: int, **values: Any) -> None:
    with database.writing() as session:
        run = repository.to_change(session, run_id)
        assert run is not None
        for name, value in values.items():
            setattr(run, name, value)


def test_the_facts_are_in_it(database: Database, sources: Sources, run_id: int) -> None:
    first, *others = text_of(database, sources, run_id)
    for fact in ("NO VERDICT", "Completed", "Ada", "Seal <b>test</b>", f"Run {run_id}", "seal"):
        assert fact in first
    assert "2026-03-02 09:30:00 UTC" in first
    rest = " ".join(others)
    path = parquet_path(sources.runs_dir / str(run_id))
    assert hashlib.sha256(path.read_bytes()).hexdigest() in rest.replace("\u200b", "").replace(
        " ", ""
    )
    for fact in (
        "No detector tripped",
        "Step",
        "Error budget",
        "RLIMIT_MEMLOCK",
        "Deadlines missed",
    ):
        assert fact in " ".join([first, rest]), fact
    for heading in ("Over time", "X-Y", "Uncertainty", "Real-time quality", "Settings", "Data"):
        assert heading in rest, heading


def test_it_has_every_transfer_the_margins_and_the_units_stiffness(
    database: Database, sources: Sources
) -> None:
    stepped = {"kind": "frequency_response", "amplitudes_n": [3000], "frequencies_hz": [20, 40, 60]}
    slow = {"kind": "harmonic", "amplitude_n": 10_000, "frequency_hz": 2, "cycles": 5}
    run_id = file_run(database, sources.runs_dir, [stepped, slow])
    told = " ".join(" ".join(text_of(database, sources, run_id)).split())
    for fact in (
        "Dynamic stiffness of the unit",
        "Admittance of the unit",
        "Margins from the measured loop",
        "The unit under test, from slow cycles",
        "Static stiffness",
    ):
        assert fact in told, fact


def test_the_brief_one_has_two_pages_at_most(
    database: Database, sources: Sources, run_id: int
) -> None:
    assert len(text_of(database, sources, run_id, Extent.BRIEF)) <= 2


def test_it_has_the_same_bytes_from_two_processes(
    sources: Sources, run_id: int, tmp_path: Path
) -> None:
    order = Order(run_id, Extent.FULL, Format.PDF, tmp_path / "apart")
    assert run_apart(carry_out, sources, order, report=lambda _: None) is None
    assert carry_out(lambda _: None, sources, replace(order, path=tmp_path / "here")) is None
    assert (tmp_path / "apart").read_bytes() == (tmp_path / "here").read_bytes()


def test_a_run_that_tripped_says_by_what(database: Database, sources: Sources) -> None:
    """A step of 40 kN is beyond what the force's error is allowed."""
    over = {"kind": "step", "to_n": 45_000, "hold_s": 0.3}
    number = file_run(database, sources.runs_dir, [HOLD, over, over | {"to_n": -45_000}])
    first, *others = text_of(database, sources, number)
    assert "Tripped" in first
    assert "Trips" in " ".join(others)
    assert "No detector tripped" not in " ".join(others)


def test_a_failed_criterion_is_on_the_first_page(database: Database, sources: Sources) -> None:
    wanted = {"measurement": "force_error_rms_n", "at_most": 1e-3}
    asked = {"schema": 1, "name": "x", "blocks": [SINE], "acceptance": [wanted]}
    acceptance = Definition.model_validate(asked).acceptance
    number = file_run(database, sources.runs_dir, [SINE], data={"acceptance": acceptance})
    first = text_of(database, sources, number)[0]
    assert "FAILED 0 of 1 criteria met" in first
    assert "Force error rms" in first


def test_values_that_are_no_numbers_are_no_obstacle(database: Database, sources: Sources) -> None:
    def touch(chunk: np.ndarray) -> None:
        chunk["force_n"][50:90] = np.nan
        chunk["displacement_m"] = np.nan
        chunk["wakeup_latency_s"][:10] = np.nan
        chunk["valve_command"][-5:] = -np.inf

    number = file_run(database, sources.runs_dir, [HOLD, STEP], touch=touch)
    assert "Over time" in " ".join(text_of(database, sources, number))


def test_a_run_without_samples_says_why(database: Database, sources: Sources) -> None:
    number = file_run(database, sources.runs_dir, [HOLD, SINE])
    remove_samples(sources.runs_dir / str(number))
    change(database, number, outcome="interrupted", reason="The loop process ended")
    first, *others = text_of(database, sources, number)
    assert "Interrupted" in first
    assert "The loop process ended" in first
    assert f"Run {number} has no samples" in " ".join([first, *others])


def test_one_under_way_and_one_that_is_not_there_are_refused(
    database: Database, sources: Sources
) -> None:
    number = file_run(database, sources.runs_dir, [HOLD])
    change(database, number, outcome=None)
    reports = Reports(database, sources)
    for run, code in ((number, Code.RUN_UNDER_WAY), (10**6, Code.UNKNOWN_RUN)):
        refused = reports.begin(Wanted(run, Extent.BRIEF, Format.PDF))
        assert isinstance(refused, Refusal)
        assert refused.code is code
    reports.close()
    change(database, number, outcome="completed")


def test_it_is_made_once_and_again_when_somebody_notes_something(
    database: Database, sources: Sources, run_id: int
) -> None:
    reports, wanted = Reports(database, sources), Wanted(run_id, Extent.BRIEF, Format.PDF)
    before = _made(reports, wanted)
    assert _made(reports, wanted) == before
    change(database, run_id, annotation=1, operator="Otto")
    after = _made(reports, wanted)
    assert after != before
    assert not before.exists(), "the one that it takes the place of"
    assert "Otto" in pages(after.read_bytes())[0]
    reports.close()


def test_an_upgrade_makes_it_again(
    database: Database, sources: Sources, run_id: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    reports, wanted = Reports(database, sources), Wanted(run_id, Extent.BRIEF, Format.HTML)
    _made(reports, wanted)
    assert isinstance(reports.begin(wanted), Ready)
    monkeypatch.setattr(service, "VERSION", "99.0")
    assert isinstance(reports.begin(wanted), Job)
    reports.close()


def test_one_that_another_takes_the_place_of_is_still_handed_over(
    database: Database, sources: Sources, run_id: int
) -> None:
    reports, wanted = Reports(database, sources), Wanted(run_id, Extent.BRIEF, Format.PDF)
    path = _made(reports, wanted)
    ready = reports.begin(wanted)
    assert isinstance(ready, Ready)
    path.unlink()
    assert f"Run {run_id}" in pages(ready.content)[0]
    assert isinstance(reports.begin(wanted), Job), "it is not there any more"
    reports.close()


def test_one_that_is_given_up_is_no_report(
    database: Database, sources: Sources, run_id: int
) -> None:
    reports, wanted = Reports(database, sources), Wanted(run_id, Extent.FULL, Format.HTML)
    job = reports.begin(wanted)
    assert isinstance(job, Job)
    assert reports.begin(wanted) is job, "whoever asks for the same waits for the same"
    reports.give_up(wanted)
    assert job.ended.wait(60)
    refused = reports.outcome(wanted, job)
    assert isinstance(refused, Refusal)
    assert refused.code is Code.BUSY
    reports.close()


def test_a_broken_template_is_told_and_leaves_nothing(
    database: Database, sources: Sources, run_id: int, tmp_path: Path
) -> None:
    template = tmp_path / "own.typ"
    template.write_text("#nonsense")
    own = Sources(sources.database_url, sources.runs_dir, sources.histories_dir, template=template)
    reports, wanted = Reports(database, own), Wanted(run_id, Extent.BRIEF, Format.PDF)
    job = reports.begin(wanted)
    assert isinstance(job, Job)
    assert job.ended.wait(60)
    refused = reports.outcome(wanted, job)
    assert isinstance(refused, Refusal)
    assert "nonsense" in refused.detail
    reports.close()


def _made(reports: Reports, wanted: Wanted) -> Path:
    found = reports.begin(wanted)
    if isinstance(found, Job):
        assert found.ended.wait(60)
        found = reports.outcome(wanted, found)
    assert isinstance(found, Ready), found
    return found.path
