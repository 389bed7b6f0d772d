"""A virtual rig as a life of the loop, with a ring as long as that of a real one: for keepers to follow."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any
from unittest.mock import patch

from app.controller.record import to_record as gains_record
from app.controller.settings import ControllerSettings
from app.db import Database
from app.definitions.definition import Definition
from app.definitions.expansion import expand
from app.definitions.reading import definition_from
from app.first_outs.account import Account
from app.first_outs.files import BoxSamples, samples_of
from app.interlocks.defaults import default_interlocks
from app.interlocks.record import to_record as interlocks_record
from app.link.life import Life
from rtcore.codes import Opcode, Reply
from rtcore.rig.faults import Fault
from rtcore.rig.parameters import load_rig
from rtcore.virtual import Virtual
from tests.unit.app.first_outs.watched import Watched

PERIOD_S = 250e-6
SECOND = 4000
HARMONIC: Mapping[str, Any] = {
    "schema": 1,
    "name": "Harmonic",
    "blocks": [
        {
            "kind": "harmonic",
            "mean_n": 500,
            "amplitude_n": 2000,
            "frequency_hz": 10,
            "duration_s": 600,
        }
    ],
}


def definition(data: Mapping[str, Any] = HARMONIC) -> Definition:
    """A test that is sound."""
    found = definition_from(dict(data))
    assert isinstance(found, Definition), found
    return found


class Lived(Virtual):
    """The rig as shipped, and what a keeper keeps of it."""

    def __init__(self, database: Database, folder: Path) -> None:
        table = interlocks_record(default_interlocks(), PERIOD_S)
        with patch("rtcore.virtual.RING_SECONDS", 60.0):
            super().__init__(gains_record(ControllerSettings()), table, load_rig(), seed=0)
        self.watched = Watched(Life(self.block), database, folder)
        self._folder = folder

    def start(self, run: int = 1, data: Mapping[str, Any] = HARMONIC) -> None:
        """Begin a test; its first tick is the latest."""
        self.bring_to_ready()
        self.advance(SECOND)
        assert self.load_program(expand(definition(data))) == Reply.ACCEPTED
        assert self.command(Opcode.START, run) == Reply.ACCEPTED

    def inject(self, fault: Fault, amount: float = 1.0) -> None:
        """Break something, or mend it with 0."""
        assert self.command(Opcode.INJECT_FAULT, fault, amount) == Reply.ACCEPTED

    def kept(self) -> tuple[Account, BoxSamples]:
        """The last first-out, once its box is full."""
        self.advance(4 * SECOND)  # some take a while to trip
        self.watched.look()
        row = self.watched.kept[-1]
        samples = samples_of(self._folder, row.id)
        assert samples is not None
        return Account.model_validate(row.account), samples
