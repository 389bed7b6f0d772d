"""Previews of controllers that nobody has put in force: made in a process apart, a few kept."""

from app.catalogue.service import Catalogue
from app.controller.preview_schemas import ControllerPreview, Previewed
from app.controller.previewing import Side, preview
from app.controller.service import ControllerSettingsBook
from app.controller.settings import ControllerSettings
from app.definitions.outline import outline
from app.documents.units import say
from app.errors import Code, Refusal
from app.interlocks.service import InterlockTables
from app.jobs.jobs import Job, Jobs, JobState
from app.prediction.setup import Setup
from app.rig_configuration.service import RigConfigurations

LONGEST_S = 60.0


class Previews:
    """Tries drafts on the virtual rig, with the model and the interlocks in force."""

    def __init__(
        self,
        catalogue: Catalogue,
        controllers: ControllerSettingsBook,
        interlocks: InterlockTables,
        configurations: RigConfigurations,
    ) -> None:
        self._catalogue = catalogue
        self._controllers = controllers
        self._interlocks = interlocks
        self._configurations = configurations
        self._jobs: Jobs[Previewed | Refusal] = Jobs("previews")

    def close(self) -> None:
        """Give up what is being tried."""
        self._jobs.close()

    def ask(
        self, draft: ControllerSettings, test_id: str, beside: int | None
    ) -> ControllerPreview | Refusal:
        """Begin to try a draft with a test, beside a revision or what is in force."""
        now = self._controllers.in_force
        other = now if beside is None else self._controllers.revision(beside)
        if isinstance(other, Refusal):
            return other
        stored = self._catalogue.definition_of(test_id, None)
        if isinstance(stored, Refusal):
            return stored
        lasts_s = outline(stored.definition).duration_s
        if lasts_s > LONGEST_S:
            detail = f"{stored.name} lasts {say(lasts_s, 's')}: choose a test of at most {say(LONGEST_S, 's')}"
            return Refusal(Code.INVALID_TEST, detail)
        rig = self._configurations.in_force.document.model
        table = self._interlocks.in_force.document
        sides = (
            Side(Setup(stored.definition, rig, draft, table), None),
            Side(Setup(stored.definition, rig, other.document, table), other.number),
        )
        return _told(self._jobs.start(f"Preview: {stored.name}", preview, test_id, *sides))

    def of(self, preview_id: str) -> ControllerPreview | Refusal:
        """How far one is, or what came of it."""
        return _told(self._jobs.get(preview_id))

    def give_up(self, preview_id: str) -> ControllerPreview | Refusal:
        """Nobody wants it any more."""
        return _told(self._jobs.cancel(preview_id))


def _told(job: Job[Previewed | Refusal] | Refusal) -> ControllerPreview | Refusal:
    if isinstance(job, Refusal):
        return job
    if isinstance(job.result, Refusal):
        return job.result
    told = {name: getattr(job, name) for name in ControllerPreview.model_fields}
    return ControllerPreview.model_validate(
        told | {"result": job.result if _is_done(job) else None}
    )


def _is_done(job: Job[Previewed | Refusal]) -> bool:
    return job.state is JobState.DONE
