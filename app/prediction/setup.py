"""What a prediction or simulation is made with."""

from dataclasses import dataclass

from app.controller.settings import ControllerSettings
from app.definitions.definition import Definition
from app.interlocks.table import Interlocks
from rtcore.rig.parameters import RigParameters


@dataclass(frozen=True)
class Setup:
    """Everything that decides what a run on the virtual rig gives, to the bit."""

    definition: Definition
    rig: RigParameters
    controller: ControllerSettings
    interlocks: Interlocks
    seed: int = 1
