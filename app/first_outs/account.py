"""Everything that is kept of a first-out besides its samples: in the black box itself, and in the database."""

from datetime import datetime
from typing import Any

from pydantic import BaseModel


class TripKept(BaseModel):
    """A detector that tripped in the black box's time, in the order of tripping; `limit` is its threshold."""

    order: int
    tick: int
    time_s: float  # from the first-out
    detector: str
    quantity: str
    action: str
    text: str
    value: float | None
    limit: float | None


class EventKept(BaseModel):
    """What the loop reported in the black box's time."""

    tick: int
    time_s: float
    kind: str
    code: str
    text: str
    value: float | None
    limit: float | None


class PeakKept(BaseModel):
    """The greatest magnitude of a channel before the first-out and from it on; null where nothing was kept."""

    channel: str
    unit: str
    before: float | None
    after: float | None
    after_s: float | None  # when, from the first-out


class Step(BaseModel):
    """A command or fault before the first-out that a re-run gives again at the same tick."""

    tick: int
    opcode: str
    argument: int = 0
    value: float = 0.0


class Settings(BaseModel):
    """What was in force; `interlocks` is null where the loop had a table that nobody knows any more."""

    controller: dict[str, Any]
    interlocks: dict[str, Any] | None
    rig: dict[str, Any]
    seed: int


class Account(BaseModel):
    """A first-out as it was noticed."""

    loop_life: str
    tick: int
    period_ns: int
    tripped_at: datetime
    mode_before: str | None
    run_id: int | None
    run_tick: int | None  # ticks of the run before the first-out
    first: TripKept
    trips: list[TripKept]
    events: list[EventKept]
    peaks: list[PeakKept]
    settings: Settings
    injected: dict[str, float]  # faults of the simulated rig and their amounts
    lease: dict[str, Any] | None
    steps: list[Step]  # since the start of the run, or of the last seconds
    began: str  # mode in which `steps` begin
    remembered: dict[str, Any]  # by the loop's check, as the black box begins
    first_tick: int
    last_tick: int
    ticks: int
    missing_ticks: int
