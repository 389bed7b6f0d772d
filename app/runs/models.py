"""The tables of the runs."""

from datetime import datetime
from typing import Any

from sqlalchemy import JSON, Connection, Double, ForeignKey, Index, String, Text, event
from sqlalchemy.ext.associationproxy import AssociationProxy, association_proxy
from sqlalchemy.orm import Mapped, Mapper, mapped_column, relationship

from app.db import Base, BigInt, UtcDateTime, key_text
from app.runs.words import facet, words_of


class Document(Base):
    """A frozen JSON document, kept once however many runs were made with it."""

    __tablename__ = "documents"

    id: Mapped[int] = mapped_column(BigInt, primary_key=True)
    hash: Mapped[str] = mapped_column(String(64), unique=True)  # SHA-256 of its canonical JSON
    body: Mapped[Any] = mapped_column(JSON)


class RunTag(Base):
    """A tag of a run."""

    __tablename__ = "run_tags"
    __table_args__ = (Index("run_tags_by_tag", "tag", "run_id"),)

    run_id: Mapped[int] = mapped_column(
        BigInt, ForeignKey("runs.id", ondelete="CASCADE"), primary_key=True
    )
    tag: Mapped[str] = mapped_column(key_text(50), primary_key=True)


def _frozen() -> Mapped[int]:
    return mapped_column(BigInt, ForeignKey("documents.id"))


def _document(column: str) -> Mapped[Document]:
    return relationship(foreign_keys=f"Run.{column}", viewonly=True)


class Run(Base):
    """A run and everything it was made with; none of that changes afterwards.

    What people note of it (operator, notes, tags) may: `annotation` counts those changes.
    """

    __tablename__ = "runs"
    # The loop and the files know a run by its number: a number is never given twice.
    __table_args__ = (
        Index("runs_open", "outcome", sqlite_where="outcome IS NULL"),
        Index("runs_of_test", "test_id", "started_at"),
        Index("runs_started", "started_at"),
        Index("runs_operator", "operator"),
        Index("runs_samples_removed", "samples_removed_at"),
        {"sqlite_autoincrement": True},
    )

    id: Mapped[int] = mapped_column(BigInt, primary_key=True)
    test_id: Mapped[str] = mapped_column(String(100))
    test_name: Mapped[str] = mapped_column(String(200))
    revision: Mapped[int | None]  # of the test; None before tests had revisions
    definition_id: Mapped[int] = _frozen()
    plan_id: Mapped[int] = _frozen()  # blocks, cycles and durations expected
    controller_id: Mapped[int] = _frozen()
    interlocks_id: Mapped[int] = _frozen()
    rig_id: Mapped[int] = _frozen()
    conditions_id: Mapped[int] = _frozen()  # real-time ones, had or not
    prediction_id: Mapped[int | None] = mapped_column(BigInt, ForeignKey("documents.id"))
    prediction_verdict: Mapped[str | None] = mapped_column(String(10))
    override_reason: Mapped[str | None] = mapped_column(String(500))
    software_version: Mapped[str] = mapped_column(String(50))
    loop_life: Mapped[str] = mapped_column(String(50))
    period_ns: Mapped[int] = mapped_column(BigInt)
    started_at: Mapped[datetime] = mapped_column(UtcDateTime)
    ended_at: Mapped[datetime | None] = mapped_column(UtcDateTime)
    first_tick: Mapped[int | None] = mapped_column(BigInt)
    last_tick: Mapped[int | None] = mapped_column(BigInt)
    ticks: Mapped[int] = mapped_column(BigInt, default=0)
    missing_ticks: Mapped[int] = mapped_column(BigInt, default=0)
    duration_s: Mapped[float | None] = mapped_column(Double)  # recorded
    outcome: Mapped[str | None] = mapped_column(String(20))  # None while it is under way
    verdict: Mapped[str] = mapped_column(String(10), default="unset")
    reason: Mapped[str | None] = mapped_column(String(500))
    operator: Mapped[str] = mapped_column(key_text(100), default="")
    notes: Mapped[str] = mapped_column(Text, default="")
    annotation: Mapped[int] = mapped_column(default=0)
    samples_removed_at: Mapped[datetime | None] = mapped_column(UtcDateTime)  # by retention
    words: Mapped[str] = mapped_column(Text, default="", deferred=True)  # what it is found by

    definition_document: Mapped[Document] = _document("definition_id")
    plan_document: Mapped[Document] = _document("plan_id")
    controller_document: Mapped[Document] = _document("controller_id")
    interlocks_document: Mapped[Document] = _document("interlocks_id")
    rig_document: Mapped[Document] = _document("rig_id")
    conditions_document: Mapped[Document] = _document("conditions_id")
    prediction_document: Mapped[Document | None] = relationship(
        foreign_keys="Run.prediction_id", viewonly=True
    )
    tag_rows: Mapped[list[RunTag]] = relationship(
        cascade="all, delete-orphan", passive_deletes=True, lazy="selectin", order_by=RunTag.tag
    )
    tags: AssociationProxy[list[str]] = association_proxy(
        "tag_rows", "tag", creator=lambda tag: RunTag(tag=tag)
    )

    definition: AssociationProxy[dict[str, Any]] = association_proxy("definition_document", "body")
    plan: AssociationProxy[dict[str, Any]] = association_proxy("plan_document", "body")
    controller: AssociationProxy[dict[str, Any]] = association_proxy("controller_document", "body")
    interlocks: AssociationProxy[dict[str, Any]] = association_proxy("interlocks_document", "body")
    rig: AssociationProxy[dict[str, Any]] = association_proxy("rig_document", "body")
    conditions: AssociationProxy[list[dict[str, Any]]] = association_proxy(
        "conditions_document", "body"
    )
    prediction: AssociationProxy[dict[str, Any] | None] = association_proxy(
        "prediction_document", "body"
    )


class RunEvent(Base):
    """What the loop reported during a run. `sequence` is the loop's own, negative for gaps."""

    __tablename__ = "run_events"

    run_id: Mapped[int] = mapped_column(
        BigInt, ForeignKey("runs.id", ondelete="CASCADE"), primary_key=True
    )
    sequence: Mapped[int] = mapped_column(BigInt, primary_key=True)
    tick: Mapped[int] = mapped_column(BigInt)
    kind: Mapped[str] = mapped_column(String(30))
    code: Mapped[str] = mapped_column(String(50))
    text: Mapped[str] = mapped_column(String(500))
    value: Mapped[float | None] = mapped_column(Double)  # None where it was not a number
    limit: Mapped[float | None] = mapped_column(Double)


class RunMeasurement(Base):
    """A value measured of a run or of one of its blocks; of several criteria the tightest limits."""

    __tablename__ = "run_measurements"

    run_id: Mapped[int] = mapped_column(
        BigInt, ForeignKey("runs.id", ondelete="CASCADE"), primary_key=True
    )
    block: Mapped[int] = mapped_column(primary_key=True, autoincrement=False)  # -1: the whole run
    name: Mapped[str] = mapped_column(String(50), primary_key=True)
    unit: Mapped[str] = mapped_column(String(20))
    value: Mapped[float | None] = mapped_column(Double)
    at_least: Mapped[float | None] = mapped_column(Double)
    at_most: Mapped[float | None] = mapped_column(Double)
    outcome: Mapped[str | None] = mapped_column(String(10))  # None: no criterion


class RunCriterion(Base):
    """An acceptance criterion as it was judged, in the order of the definition."""

    __tablename__ = "run_criteria"

    run_id: Mapped[int] = mapped_column(
        BigInt, ForeignKey("runs.id", ondelete="CASCADE"), primary_key=True
    )
    position: Mapped[int] = mapped_column(primary_key=True, autoincrement=False)
    measurement: Mapped[str] = mapped_column(String(50))
    block: Mapped[int | None]
    unit: Mapped[str] = mapped_column(String(20))
    value: Mapped[float | None] = mapped_column(Double)
    at_least: Mapped[float | None] = mapped_column(Double)
    at_most: Mapped[float | None] = mapped_column(Double)
    outcome: Mapped[str] = mapped_column(String(10))


def words_of_run(run: Run) -> str:
    """What a run is found by; the databases' own indices add its number."""
    texts = [run.test_name, run.test_id, run.notes, run.operator, run.reason, *run.tags]
    verdict = run.verdict or "unset"  # a default is not there before the row is
    facets = [("test_id", run.test_id), ("outcome", run.outcome), ("verdict", verdict)]
    facets += [("operator", run.operator), *(("tag", tag) for tag in run.tags)]
    words = words_of(text for text in texts if text)
    return " ".join([*words, *(facet(name, value) for name, value in facets if value)])


@event.listens_for(Run, "before_insert")
@event.listens_for(Run, "before_update")
def _index(mapper: Mapper[Run], connection: Connection, run: Run) -> None:
    """Nobody has to remember it: whatever changes a run also changes what it is found by."""
    run.words = words_of_run(run)
