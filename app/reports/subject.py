"""What a report is of: a run with all that is known of it, from the console or from the command line."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from datetime import datetime
from pathlib import Path
from typing import Any

from app.prediction.schemas import Prediction
from app.recording.samples import Samples
from app.reports.found import Found
from app.runs.results_schemas import RunMeasurements

Document = Mapping[str, Any]


@dataclass(frozen=True)
class Happening:
    """Something that the loop reported; `time_s` counts from the run's first tick."""

    time_s: float
    kind: str
    code: str
    text: str
    value: float | None = None
    limit: float | None = None


@dataclass(frozen=True)
class Frozen:
    """What it was made with, as JSON; none of it changes afterwards."""

    definition: Document
    controller: Document
    interlocks: Document
    rig: Document
    conditions: Sequence[Document]  # of real time; none where it ran on the virtual clock


@dataclass(frozen=True)
class Noted:
    """What people noted of it."""

    operator: str = ""
    notes: str = ""
    tags: tuple[str, ...] = ()
    override_reason: str | None = None


@dataclass(frozen=True)
class Subject:
    """A run that is over. Fields that are None or empty are not known, and a report leaves them out.

    `samples` are its ticks where it has any, `predicted` those of its prediction on the run's own time;
    `data_file` is what a checksum is made of.
    """

    label: str
    test_id: str
    test_name: str
    revision: int | None
    frozen: Frozen
    measured: RunMeasurements
    outcome: str
    reason: str | None
    period_s: float
    ticks: int
    missing_ticks: int
    software: str
    events: tuple[Happening, ...] = ()
    noted: Noted = field(default_factory=Noted)
    started_at: datetime | None = None
    ended_at: datetime | None = None
    first_tick: int | None = None
    prediction: Prediction | None = None
    samples: Samples | None = None
    predicted: Samples | None = None
    data_file: Path | None = None
    without_samples: str = "It has no samples"  # why, where it has none
    virtual_seed: int | None = None  # of a run on the virtual clock
    found: Found | None = None  # in its samples, where its definition can be read

    @property
    def virtual(self) -> bool:
        """Whether it ran on the virtual clock: then there is no real time to report."""
        return self.virtual_seed is not None

    @property
    def origin(self) -> int:
        """The tick that its times count from."""
        if self.first_tick is not None:
            return self.first_tick
        return 0 if self.samples is None else self.samples.first_tick
