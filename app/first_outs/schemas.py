"""What the requests about first-outs take and give."""

from datetime import datetime
from typing import Annotated, Any

from pydantic import BaseModel, ConfigDict, Field

from app.db import NO_NUL
from app.first_outs.account import Account, EventKept, PeakKept, Settings, TripKept
from app.first_outs.models import FirstOut


class FirstOutSummary(BaseModel):
    """A first-out in the list; `ticks` is 0 where the ring held nothing of it any more."""

    id: int
    tripped_at: datetime
    detector: str
    quantity: str
    action: str
    text: str
    value: float | None
    limit: float | None
    tick: int
    mode_before: str | None
    run_id: int | None
    ticks: int
    note: str
    cause: str

    @staticmethod
    def of(row: FirstOut) -> "FirstOutSummary":
        names = FirstOutSummary.model_fields
        return FirstOutSummary.model_validate({name: getattr(row, name) for name in names})


class FirstOutPage(BaseModel):
    """A page of first-outs, newest first; `next` is the number to ask for those before.

    `trouble` says why one could not be kept yet; it is tried again.
    """

    first_outs: list[FirstOutSummary]
    next: int | None
    trouble: str | None


class FirstOutDetail(FirstOutSummary):
    """A first-out with everything that was kept of it. Times are seconds from its tick."""

    period_s: float
    first_s: float | None  # of its samples
    last_s: float | None
    missing_ticks: int
    trips: list[TripKept]
    events: list[EventKept]
    peaks: list[PeakKept]
    settings: Settings
    injected: dict[str, float]
    lease: dict[str, Any] | None

    @staticmethod
    def of(row: FirstOut) -> "FirstOutDetail":
        kept = Account.model_validate(row.account)
        period_s = kept.period_ns * 1e-9

        def time_s(tick: int) -> float | None:
            return round((tick - kept.tick) * period_s, 9) if kept.ticks else None

        return FirstOutDetail(
            **FirstOutSummary.of(row).model_dump(),
            period_s=period_s,
            first_s=time_s(kept.first_tick),
            last_s=time_s(kept.last_tick),
            missing_ticks=kept.missing_ticks,
            trips=kept.trips,
            events=kept.events,
            peaks=kept.peaks,
            settings=kept.settings,
            injected=kept.injected,
            lease=kept.lease,
        )


class FirstOutNote(BaseModel):
    """What to note of a first-out; what is null stays."""

    model_config = ConfigDict(extra="forbid")

    note: Annotated[str, Field(pattern=NO_NUL, max_length=20_000)] | None = None
    cause: Annotated[str, Field(pattern=NO_NUL, max_length=200)] | None = None
