"""The row of a run that is about to start, with everything that it is made with."""

from collections.abc import Mapping
from dataclasses import dataclass
from datetime import UTC, datetime
from typing import Any

from app.audit.record import Entry as AuditEntry
from app.audit.record import record
from app.catalogue.service import StoredTest
from app.db import Database
from app.link.life import Life
from app.prediction.schemas import Prediction, PredictionVerdict
from app.runs import repository
from app.runs.models import Run, RunTag
from app.runs.schemas import RunStart
from app.settings import VERSION


@dataclass(frozen=True)
class Frozen:
    """The settings that a run is made with, as JSON."""

    controller: Mapping[str, Any]
    interlocks: Mapping[str, Any]
    rig: Mapping[str, Any]


@dataclass(frozen=True)
class Entry:
    """What was asked for, the test and its prediction; `plan` is its outline as JSON."""

    asked: RunStart
    stored: StoredTest
    prediction: Prediction
    plan: Mapping[str, Any]


def enter(database: Database, life: Life, frozen: Frozen, entry: Entry) -> tuple[Run, list[int]]:
    """Enter a run: its number is how the loop will know it. Also the documents that are new with it."""
    bodies: dict[str, Any] = {
        "definition_id": entry.stored.definition.model_dump(mode="json", by_alias=True),
        "plan_id": dict(entry.plan),
        "controller_id": dict(frozen.controller),
        "interlocks_id": dict(frozen.interlocks),
        "rig_id": dict(frozen.rig),
        "conditions_id": life.conditions(),
        "prediction_id": entry.prediction.model_dump(mode="json"),
    }
    run = _row(life, entry)
    with database.writing() as session:
        newest = repository.newest_document(session)
        ids = {column: repository.freeze(session, body) for column, body in bodies.items()}
        for column, number in ids.items():
            setattr(run, column, number)
        session.add(run)
        session.flush()
        record(session, _told(run, entry.asked))
    return run, [number for number in ids.values() if number > newest]


def _row(life: Life, entry: Entry) -> Run:
    asked, verdict = entry.asked, entry.prediction.verdict
    overrides = verdict is PredictionVerdict.CAUTION
    return Run(
        test_id=entry.stored.test_id,
        test_name=entry.stored.name,
        revision=entry.stored.revision,
        operator=asked.operator,
        notes=asked.notes,
        tag_rows=[RunTag(tag=tag) for tag in asked.tags],
        prediction_verdict=verdict.value,
        override_reason=asked.override_reason if overrides else None,
        software_version=VERSION,
        loop_life=life.name,
        period_ns=life.period_ns,
        started_at=datetime.now(UTC),
        ticks=0,
        missing_ticks=0,
        verdict="unset",
    )


def _told(run: Run, asked: RunStart) -> AuditEntry:
    made = {name: getattr(run, name) for name in ("test_id", "revision", "prediction_verdict")}
    noted = asked.model_dump(mode="json", include={"operator", "notes", "tags"})
    return AuditEntry("runs.start", f"run {run.id}", run.override_reason, after={**made, **noted})
