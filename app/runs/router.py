"""`/api/v1/runs`."""

from typing import Annotated, Literal

from fastapi import APIRouter, Query

from app.access.dependencies import Operator, Viewer
from app.access.principal import Role, lacking
from app.dependencies import RunsService, StarterService
from app.parameters import Before, Limit, Number
from app.problems import PROBLEMS, granted
from app.recording.outcome import Outcome
from app.runs.finding import Sought
from app.runs.schemas import (
    Moment,
    RunAnnotation,
    RunDetail,
    RunEvents,
    RunPage,
    RunStart,
    RunSummary,
)

router = APIRouter(prefix="/api/v1/runs", tags=["runs"], responses=PROBLEMS)


@router.post("", status_code=201, operation_id="startRun")
def start_run(who: Operator, body: RunStart, starter: StarterService) -> RunSummary:
    """Start a test. Answers once the loop has begun it. To override a prediction takes an engineer."""
    if body.override_reason is not None:
        granted(lacking(who, Role.ENGINEER))
    return RunSummary.of(granted(starter.start(body, who)))


@router.get("", operation_id="listRuns")
def list_runs(
    who: Viewer,
    runs: RunsService,
    search: Annotated[str, Query(max_length=200, description="beginnings of words")] = "",
    test_id: Annotated[str | None, Query(max_length=100)] = None,
    tag: Annotated[str | None, Query(max_length=50)] = None,
    outcome: Outcome | Literal["under_way"] | None = None,
    verdict: Literal["pass", "fail", "unset"] | None = None,
    operator: Annotated[str | None, Query(max_length=100)] = None,
    since: Moment | None = None,
    until: Annotated[Moment | None, Query(description="and not then")] = None,
    limit: Limit = 50,
    before: Before = None,
) -> RunPage:
    """The newest runs first; `next` of a page is `before` of the page after it.

    Every word of `search` is the beginning of a word in test, notes, tags, operator or reason, or
    of the run's number.
    """
    sought = Sought(search, test_id, tag, outcome, verdict, operator, since, until)
    return runs.page(sought, limit, before)


@router.get("/tags", operation_id="listRunTags")
def list_run_tags(who: Viewer, runs: RunsService) -> list[str]:
    """Every tag that a run has, in order."""
    return runs.tags()


@router.get("/operators", operation_id="listRunOperators")
def list_run_operators(who: Viewer, runs: RunsService) -> list[str]:
    """Everybody who is noted as the operator of a run, in order."""
    return runs.operators()


@router.get("/{run_id}", operation_id="getRun")
def get_run(who: Viewer, run_id: Number, runs: RunsService) -> RunDetail:
    """A run with everything that it was made with."""
    return granted(runs.detail(run_id))


@router.patch("/{run_id}", operation_id="annotateRun")
def annotate_run(
    who: Operator, run_id: Number, body: RunAnnotation, runs: RunsService
) -> RunDetail:
    """Change notes, tags or operator; refused where somebody else did in the meantime."""
    return granted(runs.annotate(run_id, body))


@router.get("/{run_id}/events", operation_id="listRunEvents")
def list_run_events(who: Viewer, run_id: Number, runs: RunsService) -> RunEvents:
    """What the loop reported during the run, in order."""
    return granted(runs.events(run_id))
