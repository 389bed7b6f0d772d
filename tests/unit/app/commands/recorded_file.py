"""Files of runs on the virtual rig, as `forcerig simulate --out` writes them."""

from pathlib import Path

from app.controller.settings import ControllerSettings
from app.definitions.definition import Definition
from app.documents.writing import to_data
from app.interlocks.defaults import default_interlocks
from app.prediction.setup import Setup
from app.recording.columns import as_batch
from app.recording.parquet import write_run
from rtcore.rig.parameters import load_rig
from tests.unit.app.conducting.responses import played


def recorded_file(path: Path, definition: Definition) -> Path:
    """The whole of a test, with all that it was made with."""
    setup = Setup(definition, load_rig(), ControllerSettings(), default_interlocks())
    described = {
        "definition": to_data(definition),
        "controller": to_data(setup.controller),
        "rig": setup.rig.model_dump(mode="json"),
        "period_ns": 250_000,
    }
    write_run(path, [as_batch(played(definition).records)], described)
    return path
