"""Stop for whoever asks on the path of its own: the block, and a note for the audit that never waits."""

from collections.abc import Callable

from app.access.principal import Principal
from app.audit.actor import Actor, acting
from app.audit.record import Entry, note
from app.errors import Refusal
from app.link.life import Life
from app.link.stopping import NO_LOOP, Stopped, stop
from app.rigs.schemas import ModeWord
from app.stopping.schemas import StopState


class Stops:
    """Stops the rig by the word of the block of the loop's present life."""

    def __init__(self, life: Callable[[], Life | None]) -> None:
        self._life = life

    def stop(self, who: Principal) -> StopState | Refusal:
        """Have the loop take the load off. Where there is none, that is done."""
        answer = stop(self._life())
        with acting(Actor(who.name, who.role.word, who.id)):
            note(_entry(answer))
        return answer if isinstance(answer, Refusal) else _state(answer)

    def state(self) -> StopState | Refusal:
        """How the rig is now."""
        life = self._life()
        record = None if life is None or not life.alive else life.snapshot()
        return NO_LOOP if record is None else _state(Stopped.of(record))


def _state(stopped: Stopped) -> StopState:
    return StopState(mode=ModeWord.of(stopped.mode), tick=stopped.tick)


def _entry(answer: Stopped | Refusal) -> Entry:
    if isinstance(answer, Refusal):
        return Entry("rig.stop", "rig", why=answer.detail, refused=answer.code)
    return Entry("rig.stop", "rig", after={"tick": answer.tick, "path": "its own"})
