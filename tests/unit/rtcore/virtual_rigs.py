"""Virtual rigs for the tests of the whole tick."""

from rtcore.codes import EventKind
from rtcore.virtual import Virtual
from tests.unit.rtcore.programs import (
    Row,
    gains,
    harmonic,
    interlocks,
    program,
)

LONG = program(harmonic(2000.0, 50.0, 500))


def make(*detectors: Row, seed: int = 1) -> Virtual:
    return Virtual(gains(), interlocks(*detectors), seed=seed)


def kinds(rig: Virtual, kind: EventKind) -> list[int]:
    return [int(e["code"]) for e in rig.events() if e["kind"] == kind]


def reply_to(rig: Virtual, sequence: int) -> int:
    return int(rig.block.fields["acknowledgements"][sequence % 64]["reply"])
