"""The banks: what the loop takes over whole or not at all, between two ticks; long programs are streamed."""

from threading import Lock
from typing import Any

from app.errors import Refusal
from app.link.commander import Commander
from app.link.feeder import Feeder
from app.link.life import Life
from app.link.refusals import as_refusal
from rtcore.codes import Opcode
from rtcore.program.stream import Program, ProgramWriter

_BANKS = {
    Opcode.ADOPT_GAINS: ("gains", "active_gains"),
    Opcode.ADOPT_INTERLOCKS: ("interlocks", "active_interlocks"),
    Opcode.ADOPT_MODEL: ("models", "active_model"),
}
_filling = Lock()


def adopt(
    life: Life, commander: Commander, opcode: Opcode, record: Any, lease: int | None = None
) -> Refusal | None:
    """Fill the idle bank with `record`, a scalar of the bank's dtype, and have the loop adopt it.

    Returns None where it did.
    """
    bank, active = _BANKS[opcode]
    with _filling:
        fields = life.block.fields
        idle = 1 - int(fields[active])
        fields[bank][idle] = record
        return as_refusal(opcode, commander.ask(opcode, idle, lease=lease))


def load(
    life: Life, commander: Commander, program: Program, lease: int | None = None
) -> Feeder | Refusal:
    """Fill the idle bank with a program and have the loop adopt it; the feeder gives what did not fit."""
    with _filling:
        fields = life.block.fields
        idle = 1 - int(fields["active_program"])
        writer = ProgramWriter(fields["programs"][idle], program)
        answer = commander.ask(Opcode.ADOPT_PROGRAM, idle, lease=lease)
        return as_refusal(Opcode.ADOPT_PROGRAM, answer) or Feeder(life, writer)
