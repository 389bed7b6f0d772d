"""Starting a run: predicted, loaded whole, entered into the database, and only then begun."""

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from threading import Lock

from app.access.principal import Principal
from app.audit.record import Entry as AuditEntry
from app.audit.record import note, record
from app.authority.service import InCommand
from app.catalogue.service import Catalogue, StoredTest
from app.db import Database
from app.definitions.expansion import expand
from app.definitions.outline import Outline, outline
from app.errors import Code, Refusal
from app.link.life import Life
from app.link.link import Link
from app.prediction.gate import gate
from app.prediction.predicting import Predicted
from app.prediction.series_file import remove_series, write_series
from app.prediction.service import Predictions
from app.recording.recorder import Recorder
from app.runs import repository
from app.runs.entering import Entry, Frozen, enter
from app.runs.models import Run
from app.runs.plans import Plans
from app.runs.schemas import RunStart
from app.storage.service import Storage
from rtcore.codes import Opcode

PREDICTED_WITHIN_S = 20.0
_CATCHING_UP = Refusal(
    Code.BUSY, "Cannot start: the recorder is still reading what happened before; try again"
)
_OVERTAKEN = Refusal(
    Code.BUSY, "Cannot start: the settings have changed since the test was predicted; try again"
)
_UNWRITABLE = Refusal(
    Code.NO_SPACE, "Cannot start: nothing can be written to the disk; see the console's log"
)


@dataclass(frozen=True)
class Needs:
    """What starting asks the rest of the console."""

    catalogue: Catalogue
    predictions: Predictions
    storage: Storage
    in_command: InCommand
    why_not: Callable[[], Refusal | None]
    never_began: Callable[[int], None]
    beyond_limits: Callable[[Outline], Refusal | None]


class Starter:
    """Starts runs, one at a time. What is refused leaves nothing behind."""

    def __init__(
        self,
        database: Database,
        runs_dir: Path,
        link: Link,
        recorder: Recorder,
        frozen: Callable[[], Frozen],
        plans: Plans,
        needs: Needs,
        one_at_a_time: Lock,
    ) -> None:
        self._database = database
        self._runs_dir = runs_dir
        self._link = link
        self._recorder = recorder
        self._frozen = frozen
        self._plans = plans
        self._needs = needs
        self._unanswered: set[int] = set()
        self._one_at_a_time = (
            one_at_a_time  # held as well by whoever changes what a run is made with
        )

    def start(self, asked: RunStart, who: Principal) -> Run | Refusal:
        """Run a revision of a test. Returns its row once the loop has begun it.

        Who is in command when they ask must still be when it begins. A refused start is in the audit too.
        """
        run = self._checked(asked, who)
        if isinstance(run, Refusal):
            told = asked.model_dump(mode="json", exclude_none=True)
            note(AuditEntry("runs.start", asked.test_id, run.detail, after=told, refused=run.code))
        return run

    def _checked(self, asked: RunStart, who: Principal) -> Run | Refusal:
        lease = self._needs.in_command(who, asked.lease)
        if isinstance(lease, Refusal):
            return lease
        stored = self._needs.catalogue.definition_of(asked.test_id, asked.revision)
        if isinstance(stored, Refusal):
            return stored
        refusal = self._needs.why_not()
        if refusal is not None:
            return refusal
        found = self._needs.predictions.of(stored.definition, PREDICTED_WITHIN_S)
        predicted = gate(found, asked.override_reason)
        if isinstance(predicted, Refusal):
            return predicted
        with self._one_at_a_time:
            return self._start(asked, stored, predicted, lease)

    def _start(
        self, asked: RunStart, stored: StoredTest, predicted: Predicted, lease: int
    ) -> Run | Refusal:
        life = self._link.life
        plan = outline(stored.definition)
        refusal = (
            self._needs.why_not()
            or self._needs.beyond_limits(plan)
            or self._needs.storage.refusal_for(plan.duration_s)
        )
        if refusal is not None or life is None:
            return refusal or Refusal(Code.LOOP_LOST, "Cannot start: the loop process does not run")
        if self._recorder.following is not life:
            return _CATCHING_UP
        if not self._needs.predictions.stands(stored.definition, predicted):
            return _OVERTAKEN
        self._settle()
        refusal = self._link.load_program(expand(stored.definition), lease)
        if refusal is not None:
            return refusal
        entry = Entry(asked, stored, predicted.prediction, plan.model_dump(mode="json"))
        return self._begin(life, entry, predicted, lease)

    def _begin(self, life: Life, entry: Entry, predicted: Predicted, lease: int) -> Run | Refusal:
        run, fresh = enter(self._database, life, self._frozen(), entry)
        self._unanswered.add(
            run.id
        )  # until it is known what became of it, whatever fails meanwhile
        folder = self._runs_dir / str(run.id)
        try:
            if predicted.through is not None:
                write_series(folder, predicted.through.series, predicted.same_ticks)
        except OSError:
            return self._withdraw(run, fresh, _UNWRITABLE)
        answer = self._link.ask(Opcode.START, run.id, lease=lease)
        if isinstance(answer, Refusal):
            return self._withdraw(run, fresh, answer)
        self._unanswered.discard(run.id)
        self._plans.remember(run.id, run.test_name, dict(entry.plan))
        return run

    def _withdraw(self, run: Run, fresh: list[int], refusal: Refusal) -> Refusal:
        """The loop did not start it: no run. Where it did not answer, it may have: the row stays."""
        if refusal.code is Code.LOOP_SILENT:
            return refusal
        remove_series(self._runs_dir / str(run.id))
        with self._database.writing() as session:
            session.delete(session.merge(run))
            record(session, AuditEntry("runs.withdraw", f"run {run.id}", refusal.detail))
            session.flush()
            repository.forget(session, fresh)
        self._unanswered.discard(run.id)
        return refusal

    def _settle(self) -> None:
        """The loop is ready for a start now: what it did not begin by then, it never will."""
        with self._database.reading() as session:
            for run in repository.without_outcome(session):
                if run.id in self._unanswered and run.first_tick is None:
                    self._needs.never_began(run.id)
        self._unanswered.clear()
