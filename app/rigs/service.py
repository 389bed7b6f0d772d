"""Commands to the rig. They need the shared block and nothing else: no database, no files.

What was asked for is noted in the audit, which never makes a command wait.
"""

from collections.abc import Callable

from app.access.principal import Principal, Role, lacking
from app.audit.record import Entry, note
from app.authority.service import InCommand
from app.errors import Code, Refusal
from app.link.life import Life
from app.link.link import Link
from app.rigs.resuming import preview
from app.rigs.schemas import CommandDone, CommandReasons, CommandRequest, ResumePreview, RigCommand
from rtcore.codes import Opcode

_FOR_ANYBODY = (RigCommand.STOP, RigCommand.SHUTDOWN)  # whoever is in command


class Rig:
    """Gives commands; `reasons` says why one cannot be given now, `in_command` who may give it."""

    def __init__(
        self, link: Link, reasons: Callable[[], CommandReasons], in_command: InCommand
    ) -> None:
        self._link = link
        self._reasons = reasons
        self._in_command = in_command

    def command(self, who: Principal, asked: CommandRequest) -> CommandDone | Refusal:
        """Give a command and wait for the loop's answer. It is in the audit, done or refused."""
        answer = self._lacking(who, asked.command) or self._command(who, asked)
        note(_entry(asked.command, answer))
        return answer

    def _lacking(self, who: Principal, command: RigCommand) -> Refusal | None:
        """Everybody who sees the rig may stop it."""
        return None if command is RigCommand.STOP else lacking(who, Role.OPERATOR)

    def _command(self, who: Principal, asked: CommandRequest) -> CommandDone | Refusal:
        command = asked.command
        lease = None if command in _FOR_ANYBODY else self._in_command(who, asked.lease)
        if isinstance(lease, Refusal):
            return lease
        answer = self._link.ask(Opcode[command.name], lease=lease)
        if not isinstance(answer, Refusal):
            return CommandDone(command=command, tick=answer.tick)
        if command is RigCommand.STOP and answer.code is Code.WRONG_MODE:
            return self._nothing_to_stop(answer)
        return self._in_plain_words(command, answer)

    def resume_preview(self) -> ResumePreview | Refusal:
        """What Resume would do at this moment; refused where nothing is held."""
        return preview(self._link.life)

    def why_not_start(self) -> Refusal | None:
        """Why no run can be started now."""
        reason = self._reasons().start
        return None if reason is None else Refusal(Code.WRONG_MODE, reason)

    def _nothing_to_stop(self, refusal: Refusal) -> CommandDone | Refusal:
        """A Stop with nothing to stop is done already."""
        life: Life | None = self._link.life
        record = None if life is None else life.snapshot()
        return (
            refusal
            if record is None
            else CommandDone(command=RigCommand.STOP, tick=int(record["tick"]))
        )

    def _in_plain_words(self, command: RigCommand, refusal: Refusal) -> Refusal:
        """What the operator can do about it, where the table of reasons knows."""
        if refusal.code not in (Code.WRONG_MODE, Code.CAUSE_PRESENT):
            return refusal
        reason = getattr(self._reasons(), command.value)
        return refusal if reason is None else Refusal(refusal.code, reason)


def _entry(command: RigCommand, answer: CommandDone | Refusal) -> Entry:
    action = f"rig.{command.value}"
    if isinstance(answer, Refusal):
        return Entry(action, "rig", why=answer.detail, refused=answer.code)
    return Entry(action, "rig", after={"tick": answer.tick})
