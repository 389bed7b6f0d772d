"""Starting a run: the test goes to the loop whole, its row into the database, and only then it starts."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from datetime import UTC, datetime
from threading import Lock
from typing import Any

from app.db import Database
from app.definitions.definition import Definition
from app.definitions.expansion import expand
from app.definitions.library import library
from app.definitions.outline import outline
from app.errors import Code, Refusal
from app.link.life import Life
from app.link.link import Link
from app.recording.recorder import Recorder
from app.runs import repository
from app.runs.models import Run, RunTag
from app.runs.plans import Plans
from app.runs.schemas import RunStart
from app.settings import VERSION
from rtcore.codes import Opcode

_CATCHING_UP = Refusal(
    Code.BUSY, "Cannot start: the recorder is still reading what happened before; try again"
)


@dataclass(frozen=True)
class Frozen:
    """The settings that a run is made with, as JSON."""

    controller: Mapping[str, Any]
    interlocks: Mapping[str, Any]
    rig: Mapping[str, Any]


class Starter:
    """Starts runs, one at a time."""

    def __init__(
        self,
        database: Database,
        link: Link,
        recorder: Recorder,
        frozen: Frozen,
        plans: Plans,
        why_not: Callable[[], Refusal | None],
        never_began: Callable[[int], None],
    ) -> None:
        self._database = database
        self._link = link
        self._recorder = recorder
        self._frozen = frozen
        self._plans = plans
        self._why_not = why_not
        self._never_began = never_began
        self._unanswered: set[int] = set()
        self._one_at_a_time = Lock()

    def start(self, asked: RunStart) -> Run | Refusal:
        """Run a test of the library. Returns its row once the loop has begun it."""
        definition = library().get(asked.test_id)
        if definition is None:
            return Refusal(Code.UNKNOWN_TEST, f"There is no test {asked.test_id!r}")
        with self._one_at_a_time:
            return self._start(asked, definition)

    def _start(self, asked: RunStart, definition: Definition) -> Run | Refusal:
        life = self._link.life
        refusal = self._why_not()
        if refusal is not None or life is None:
            return refusal or Refusal(Code.LOOP_LOST, "Cannot start: the loop process does not run")
        if self._recorder.following is not life:
            return _CATCHING_UP
        self._settle()
        refusal = self._link.load_program(expand(definition))
        if refusal is not None:
            return refusal
        plan = outline(definition).model_dump(mode="json")
        run = self._enter(life, asked, definition, plan)
        answer = self._link.ask(Opcode.START, run.id)
        if isinstance(answer, Refusal):
            return self._withdraw(run, answer)
        self._plans.remember(run.id, run.test_name, plan)
        return run

    def _enter(
        self, life: Life, asked: RunStart, definition: Definition, plan: dict[str, Any]
    ) -> Run:
        """The row of a run that is about to start; its number is how the loop will know it."""
        run = Run(
            test_id=asked.test_id,
            test_name=definition.name,
            revision=asked.revision,
            operator=asked.operator,
            notes=asked.notes,
            tag_rows=[RunTag(tag=tag) for tag in asked.tags],
            override_reason=asked.override_reason,
            software_version=VERSION,
            loop_life=life.name,
            period_ns=life.period_ns,
            started_at=datetime.now(UTC),
            ticks=0,
            missing_ticks=0,
            verdict="unset",
        )
        frozen = {
            "definition_id": definition.model_dump(mode="json", by_alias=True),
            "plan_id": plan,
            "controller_id": dict(self._frozen.controller),
            "interlocks_id": dict(self._frozen.interlocks),
            "rig_id": dict(self._frozen.rig),
            "conditions_id": life.conditions(),
        }
        with self._database.writing() as session:
            for column, body in frozen.items():
                setattr(run, column, repository.freeze(session, body))
            session.add(run)
        return run

    def _withdraw(self, run: Run, refusal: Refusal) -> Refusal:
        """The loop did not start it: no run. Where it did not answer, it may have: the row stays."""
        if refusal.code is Code.LOOP_SILENT:
            self._unanswered.add(run.id)
        else:
            with self._database.writing() as session:
                session.delete(session.merge(run))
        return refusal

    def _settle(self) -> None:
        """The loop is ready for a start now: what it did not begin by then, it never will."""
        with self._database.reading() as session:
            for run in repository.without_outcome(session):
                if run.id in self._unanswered and run.first_tick is None:
                    self._never_began(run.id)
        self._unanswered.clear()
