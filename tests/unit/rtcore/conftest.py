"""Rigs that the tests of the tick begin with."""

import pytest

from rtcore.codes import Opcode, Reply
from rtcore.virtual import Virtual
from tests.unit.rtcore.programs import (
    FORCE_LIMIT,
    SILENCE,
)
from tests.unit.rtcore.virtual_rigs import LONG, make


@pytest.fixture
def virtual() -> Virtual:
    return make()


@pytest.fixture
def running() -> Virtual:
    rig = make(FORCE_LIMIT, SILENCE)
    rig.bring_to_ready()
    assert rig.load_program(LONG) == Reply.ACCEPTED
    assert rig.command(Opcode.START, 7) == Reply.ACCEPTED
    rig.advance(2000)
    return rig
