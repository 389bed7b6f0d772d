"""What the requests about the system give."""

from datetime import datetime

from pydantic import BaseModel

from app.rigs.schemas import Condition


class Histogram(BaseModel):
    """Counts of ticks since the loop's start: bin `i` begins at `i` times `bin_s`, the last has no end.

    Times are null where there is no count, or where they lie in the last bin.
    """

    bin_s: float
    counts: list[int]
    p50_s: float | None
    p99_s: float | None
    p999_s: float | None
    longest_s: float | None


class LoopTiming(BaseModel):
    """How the loop keeps time, over its whole life; the loop alone resets it, by starting anew.

    What happened since an earlier answer is the difference of the counts, as long as `life` is the same.
    """

    life: str
    pid: int
    alive: bool
    period_s: float
    ticks: int
    late_ticks: int
    deadlines_missed: int
    wakeup: Histogram
    tick_time: Histogram
    realtime: bool
    conditions: list[Condition]


class FindingOut(BaseModel):
    """One thing that was looked at; `grade` is good, unknown, limited or unfit."""

    name: str
    seen: str
    grade: str
    advice: str


class Diagnosis(BaseModel):
    """Whether this machine is fit for real time. `measured` says what wake-ups it is judged by."""

    verdict: str
    sentence: str
    findings: list[FindingOut]
    measured: str


class About(BaseModel):
    """The console. Memory is what each process holds in RAM, null where that cannot be seen."""

    version: str
    database: str
    started_at: datetime
    uptime_s: float
    data_bytes: int
    clients: int
    console_memory_bytes: int | None
    loop_memory_bytes: int | None
