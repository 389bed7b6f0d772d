"""What a run is made with besides the test: rig, controller and interlocks, from files or shipped."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from typing import TypeVar

import yaml

from app.controller.record import load_controller
from app.controller.settings import ControllerSettings
from app.errors import Code, Refusal
from app.interlocks.defaults import default_interlocks
from app.interlocks.record import load_interlocks
from app.interlocks.safeguards import adoptable
from app.interlocks.table import Interlocks
from app.rig_configuration.configuration import RigConfiguration
from app.rig_configuration.record import load_configuration
from app.settings import Settings
from rtcore.rig.parameters import RigParameters, load_rig

T = TypeVar("T")


@dataclass(frozen=True)
class Presets:
    """The settings that the loop is given when it starts."""

    controller: ControllerSettings
    interlocks: Interlocks
    rig: RigParameters
    configuration: RigConfiguration


def load_presets(settings: Settings) -> Presets | Refusal:
    """The presets of these settings, or what is wrong with one of their files."""
    controller = _from(settings.controller_file, load_controller, ControllerSettings)
    if isinstance(controller, Refusal):
        return controller
    interlocks = _from(settings.interlocks_file, _guarded, default_interlocks)
    if isinstance(interlocks, Refusal):
        return interlocks
    try:
        rig = load_rig(settings.rig_file)
        of_rig = partial(RigConfiguration, model=rig)
        configuration = _from(settings.rig_configuration_file, load_configuration, of_rig)
        if isinstance(configuration, Refusal):
            return configuration
        return Presets(controller, interlocks, rig, configuration)
    except (OSError, ValueError, yaml.YAMLError) as error:
        return Refusal(Code.INVALID_REQUEST, f"{settings.rig_file}: {' '.join(str(error).split())}")


def _guarded(path: Path) -> Interlocks | Refusal:
    """The interlocks of a file, which protect as the shipped ones do or say that they do not."""
    table = load_interlocks(path)
    if isinstance(table, Refusal):
        return table
    found = adoptable(table)
    if isinstance(found, Refusal):
        return replace(found, detail=f"{path}: {found.detail}")
    return found


def _from(
    path: Path | None, load: Callable[[Path], T | Refusal], shipped: Callable[[], T]
) -> T | Refusal:
    return shipped() if path is None else load(path)
