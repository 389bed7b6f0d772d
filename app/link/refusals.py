"""What the loop's replies mean, as refusals."""

from app.errors import Code, Refusal
from app.link.commander import Answer
from rtcore.codes import Opcode, Reply

_TEXT = {
    Reply.WRONG_MODE: (Code.WRONG_MODE, "the rig is not in a state for that"),
    Reply.STALE_LEASE: (
        Code.STALE_LEASE,
        "command has changed hands; look at the rig, then give it again",
    ),
    Reply.EXPIRED: (Code.EXPIRED, "the command reached the loop too late; give it again"),
    Reply.REPLAYED: (Code.REPLAYED, "the command had been given already"),
    Reply.UNKNOWN: (Code.UNKNOWN_COMMAND, "the loop does not know this command"),
    Reply.CAUSE_PRESENT: (Code.CAUSE_PRESENT, "what tripped the rig is still there"),
    Reply.INVALID_BANK: (Code.INVALID_BANK, "the loop found the values invalid"),
    Reply.NO_PROGRAM: (Code.NO_PROGRAM, "the loop has no test to run"),
    Reply.NOT_CONFIGURED: (Code.BUSY, "gains and interlocks are still on their way; try again"),
    Reply.NOT_AN_EDGE: (Code.BUSY, "it is held down: let go, and press once"),
    Reply.NOT_SIMULATED: (Code.UNKNOWN_COMMAND, "only a simulated rig takes faults"),
    Reply.BUSY: (Code.BUSY, "the loop is still checking what it was sent; try again"),
}

_NOT_TO_BE_TARED = (
    "the load cell must be unloaded and at rest: pressure off for two seconds, "
    "and an offset below 2 % of its range"
)

_SPOKEN = {
    Opcode.ADOPT_GAINS: "take over the gains",
    Opcode.ADOPT_INTERLOCKS: "take over the interlocks",
    Opcode.ADOPT_MODEL: "take over the model of the rig",
    Opcode.ADOPT_PROGRAM: "load the test",
    Opcode.SHUTDOWN: "shut down",
    Opcode.TAKE_LEASE: "give you command",
}


def as_refusal(opcode: Opcode, answer: Answer | Refusal) -> Refusal | None:
    """The refusal in an answer, or None where the loop did as it was asked."""
    if isinstance(answer, Refusal):
        return answer
    if answer.reply is Reply.ACCEPTED:
        return None
    code, reason = _TEXT[answer.reply]
    if opcode is Opcode.TARE and answer.reply is Reply.CAUSE_PRESENT:
        reason = _NOT_TO_BE_TARED
    return Refusal(code, f"Cannot {_SPOKEN.get(opcode, opcode.name.lower())}: {reason}")
