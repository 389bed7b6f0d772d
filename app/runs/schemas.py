"""What the requests about runs take and give."""

from datetime import datetime
from typing import Annotated, Any, Literal

from pydantic import AfterValidator, AwareDatetime, BaseModel, ConfigDict, Field, StringConstraints

from app.authority.schemas import Epoch
from app.db import NO_NUL
from app.recording.outcome import Outcome
from app.runs.models import Run, RunEvent

LONGEST_NOTES = 20_000
SHOWN_NOTES = 200  # in a list

Tag = Annotated[
    str, StringConstraints(pattern=NO_NUL, strip_whitespace=True, min_length=1, max_length=50)
]
Operator = Annotated[str, StringConstraints(pattern=NO_NUL, strip_whitespace=True, max_length=100)]
Notes = Annotated[str, Field(pattern=NO_NUL, max_length=LONGEST_NOTES)]


def _of_our_time(moment: datetime) -> datetime:
    if not 1970 <= moment.year < 9999:  # in UTC it is a year that can be counted
        raise ValueError("must be a time between 1970 and 9998")
    return moment


Moment = Annotated[AwareDatetime, AfterValidator(_of_our_time)]


def _each_once(tags: tuple[str, ...]) -> tuple[str, ...]:
    return tuple(sorted(set(tags)))


Tags = Annotated[tuple[Tag, ...], Field(max_length=50), AfterValidator(_each_once)]


class RunStart(BaseModel):
    """Which test to run, and what to note of the run; without a revision, the newest.

    Without `lease` it bears the epoch that the caller holds.
    """

    model_config = ConfigDict(extra="forbid")

    test_id: Annotated[str, Field(min_length=1, max_length=100)]
    revision: Annotated[int, Field(ge=1, le=2**31 - 1)] | None = None
    override_reason: Annotated[str, Field(pattern=NO_NUL, min_length=1, max_length=500)] | None = (
        None
    )
    operator: Operator = ""
    notes: Notes = ""
    tags: Tags = ()
    lease: Epoch | None = None


class RunAnnotation(BaseModel):
    """What to note of a run, on top of `annotation` and nothing newer; what is null stays."""

    model_config = ConfigDict(extra="forbid")

    annotation: Annotated[int, Field(ge=0, le=2**31 - 1)]
    notes: Notes | None = None
    tags: Tags | None = None
    operator: Operator | None = None


class RunSummary(BaseModel):
    """A run in the list; `outcome` is null while it is under way, `notes` begin here."""

    id: int
    test_id: str
    test_name: str
    revision: int | None
    started_at: datetime
    ended_at: datetime | None
    outcome: Outcome | None
    verdict: Literal["pass", "fail", "unset"]
    ticks: int
    missing_ticks: int
    duration_s: float | None
    reason: str | None
    prediction_verdict: Literal["clear", "caution", "refused"] | None
    override_reason: str | None
    operator: str
    tags: list[str]
    notes: str
    annotation: int

    @staticmethod
    def fields_of(run: Run) -> dict[str, Any]:
        """The fields of a summary from its row; of the notes only the beginning."""
        names = RunSummary.model_fields.keys() - {"tags", "notes"}
        fields = {name: getattr(run, name) for name in names}
        return fields | {"tags": list(run.tags), "notes": run.notes[:SHOWN_NOTES]}

    @staticmethod
    def of(run: Run) -> "RunSummary":
        return RunSummary.model_validate(RunSummary.fields_of(run))


class RunDetail(RunSummary):
    """A run with everything that it was made with."""

    first_tick: int | None
    last_tick: int | None
    period_s: float
    definition: dict[str, Any]
    controller: dict[str, Any]
    interlocks: dict[str, Any]
    rig: dict[str, Any]
    conditions: list[dict[str, Any]]
    software_version: str
    samples_removed_at: datetime | None  # by retention: the rest stays

    @staticmethod
    def of(run: Run) -> "RunDetail":
        more = RunDetail.model_fields.keys() - RunSummary.model_fields.keys() - {"period_s"}
        fields = RunSummary.fields_of(run) | {name: getattr(run, name) for name in more}
        whole = {"period_s": run.period_ns * 1e-9, "notes": run.notes}
        return RunDetail.model_validate(fields | whole)


class RunPage(BaseModel):
    """A page of runs, newest first; `next` is the number to ask for those before."""

    runs: list[RunSummary]
    next: int | None


class RunEventOut(BaseModel):
    """What the loop reported during a run; `time_s` counts from the run's first tick."""

    tick: int
    time_s: float
    kind: str
    code: str
    text: str
    value: float | None
    limit: float | None

    @staticmethod
    def of(event: RunEvent, run: Run) -> "RunEventOut":
        since = event.tick - (run.first_tick or 0)
        return RunEventOut(
            tick=event.tick,
            time_s=round(since * run.period_ns * 1e-9, 9),
            kind=event.kind,
            code=event.code,
            text=event.text,
            value=event.value,
            limit=event.limit,
        )


class RunEvents(BaseModel):
    """The events of a run, in order."""

    events: list[RunEventOut]


class Band(BaseModel):
    """Least and greatest value at each time; null where the channel was not a number."""

    min: list[float | None]
    max: list[float | None]


class RunSamples(BaseModel):
    """Channels over time; `time_s` counts from the run's first tick, or from the tick of a first-out."""

    from_s: float
    to_s: float
    decimated: bool
    time_s: list[float]
    channels: dict[str, Band]
