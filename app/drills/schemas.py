"""What the requests about drills take and give."""

from datetime import datetime
from typing import Annotated

from pydantic import BaseModel, ConfigDict, Field

from app.authority.schemas import Epoch
from app.drills.drills import Drill, Reaction
from app.drills.models import DrillGiven
from app.drills.score import Score
from app.drills.scoring import LEAD_S


class ReactionOut(BaseModel):
    """What must follow; without `first_outs` nothing may take the load off."""

    first_outs: list[str]
    within_s: float
    sees: str

    @staticmethod
    def of(reaction: Reaction | None) -> "ReactionOut | None":
        if reaction is None:
            return None
        return ReactionOut(
            first_outs=list(reaction.first_outs), within_s=reaction.within_s, sees=reaction.sees
        )


class DrillOut(BaseModel):
    """A drill of the catalogue. `why_not` says why it cannot be given now, null where it can.

    `ready` and `test` are what must follow then; null where it cannot be given then.
    """

    fault: str
    name: str
    doc: str
    amount: str  # what it means
    unit: str
    low: float
    high: float
    default: float
    ready: ReactionOut | None
    test: ReactionOut | None
    why_not: str | None

    @staticmethod
    def of(drill: Drill, why_not: str | None) -> "DrillOut":
        kind = drill.kind
        named = {
            name: getattr(kind, name)
            for name in ("name", "doc", "amount", "unit", "low", "high", "default")
        }
        return DrillOut(
            fault=drill.name,
            **named,
            ready=ReactionOut.of(drill.ready),
            test=ReactionOut.of(drill.test),
            why_not=why_not,
        )


class DrillCatalogue(BaseModel):
    """All drills, the one that is under way, and the faults that the rig has now with their amounts."""

    drills: list[DrillOut]
    under_way: int | None
    injected: dict[str, float]


class DrillRequest(BaseModel):
    """Give a fault; without an amount the usual one. Without `lease` it bears the epoch that the caller holds."""

    model_config = ConfigDict(extra="forbid")

    fault: Annotated[str, Field(max_length=40)]
    amount: Annotated[float, Field(allow_inf_nan=False)] | None = None
    lease: Epoch | None = None


class ClearRequest(BaseModel):
    """Take all faults back."""

    model_config = ConfigDict(extra="forbid")

    lease: Epoch | None = None


class DrillSummary(BaseModel):
    """A drill in the list: under_way, passed, failed or interrupted, and then `why`."""

    id: int
    fault: str
    amount: float
    state: str
    mode_before: str
    given_by: str
    given_at: datetime
    ended_at: datetime | None
    run_id: int | None
    first_out: str | None
    reaction_ticks: int | None
    why: str | None

    @staticmethod
    def of(row: DrillGiven) -> "DrillSummary":
        return DrillSummary.model_validate(
            {name: getattr(row, name) for name in DrillSummary.model_fields}
        )


class DrillPage(BaseModel):
    """A page of drills, newest first; `next` is the number to ask for those before."""

    records: list[DrillSummary]
    next: int | None


class DrillDetail(DrillSummary):
    """A drill with its score. Times are seconds from the tick in which the loop took the fault."""

    period_s: float
    tick: int | None
    expected: ReactionOut | None
    score: Score | None
    first_s: float | None  # of its samples; null where there are none
    last_s: float | None

    @staticmethod
    def with_score(row: DrillGiven, expected: Reaction | None) -> "DrillDetail":
        period_s = row.period_ns * 1e-9
        first_s = -LEAD_S if row.ticks else None
        return DrillDetail(
            **DrillSummary.of(row).model_dump(),
            period_s=period_s,
            tick=row.tick,
            expected=ReactionOut.of(expected),
            score=None if row.score is None else Score.model_validate(row.score),
            first_s=first_s,
            last_s=None if first_s is None else round(first_s + (row.ticks - 1) * period_s, 9),
        )
