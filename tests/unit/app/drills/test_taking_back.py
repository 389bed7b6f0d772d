"""Faults are taken back whatever the loop says at first: it may be stalled, or command changing hands."""

from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest

from app.db import Database
from app.drills import service
from app.drills.scoring import Limits
from app.drills.service import Drills
from app.errors import Code, Refusal
from rtcore.codes import Opcode
from rtcore.rig.faults import Fault
from rtcore.rig.parameters import load_rig

STALE = Refusal(Code.STALE_LEASE, "Command has changed hands since")
SILENT = Refusal(Code.LOOP_SILENT, "The loop process did not answer")


class Loop:
    """A loop with a fault, and what it answers in turn; the last answer stands."""

    def __init__(self, *answers: object) -> None:
        self.answers = list(answers)
        self.asked: list[Opcode] = []
        self.life = SimpleNamespace(
            alive=True, ended=False, injected=lambda: {Fault.PUMP_LOSS: 1.0}
        )

    def ask(self, opcode: Opcode, *_: object, **__: object) -> object:
        self.asked.append(opcode)
        return self.answers.pop(0) if len(self.answers) > 1 else self.answers[0]


def opened(database: Database, folder: Path, loop: Any) -> None:
    """A console that starts on this loop."""
    limits = Limits.of(load_rig())
    Drills(database, folder, loop, lambda who, epoch: 1, list, limits).open()


@pytest.fixture(autouse=True)
def at_once(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(service, "_AGAIN_S", 0.0)


def test_it_is_tried_again_until_the_loop_has_done_it(database: Database, tmp_path: Path) -> None:
    loop = Loop(STALE, SILENT, "done")
    opened(database, tmp_path, loop)
    assert loop.asked == [Opcode.CLEAR_FAULTS] * 3


def test_a_loop_that_has_ended_has_no_faults_any_more(database: Database, tmp_path: Path) -> None:
    loop = Loop(SILENT)
    loop.life.ended = True
    opened(database, tmp_path, loop)
    assert len(loop.asked) == 1


def test_it_is_said_where_it_is_in_vain(
    database: Database, tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    loop = Loop(SILENT)
    opened(database, tmp_path, loop)
    assert len(loop.asked) == service._ATTEMPTS
    assert caplog.text.count(SILENT.detail) == service._ATTEMPTS
