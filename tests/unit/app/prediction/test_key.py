"""The same key is the same prediction: everything that it depends on changes it."""

from dataclasses import replace

from app.controller.settings import ControllerSettings
from app.definitions.definition import Definition
from app.definitions.reading import definition_from
from app.interlocks.defaults import default_interlocks
from app.interlocks.table import Interlocks
from app.prediction.key import key_of
from app.prediction.setup import Setup
from rtcore.rig.parameters import load_rig, rig_from


def _setup(duration_s: float = 1.0) -> Setup:
    data = {"schema": 1, "name": "x", "blocks": [{"kind": "hold", "duration_s": duration_s}]}
    definition = definition_from(data)
    assert isinstance(definition, Definition)
    return Setup(definition, load_rig(), ControllerSettings(), default_interlocks())


def test_the_same_content_has_the_same_key() -> None:
    assert key_of(_setup()) == key_of(_setup())


def test_everything_that_it_depends_on_changes_it() -> None:
    setup = _setup()
    fewer = Interlocks(detectors=default_interlocks().detectors[1:])
    others = [
        _setup(2.0),
        replace(setup, seed=2),
        replace(setup, interlocks=fewer),
        replace(setup, controller=ControllerSettings(k_p=1.2e-5)),
        replace(setup, rig=rig_from({"supply": {"high_pa": 20e6}})),
    ]
    keys = {key_of(other) for other in [setup, *others]}
    assert len(keys) == 1 + len(others)
