"""Rig configurations from files and plain data, and as a run keeps them."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from app.documents.reading import read_data, read_file
from app.documents.writing import to_data
from app.errors import Code, Refusal
from app.revisions.kind import Revision
from app.rig_configuration.configuration import RigConfiguration
from rtcore.rig.parameters import RigParameters, rig_from

KEY = "configuration"  # beside the model's parts


def load_configuration(path: Path) -> RigConfiguration | Refusal:
    """The configuration in a file: JSON where its name ends in .json, YAML otherwise."""
    return read_file(RigConfiguration, path, Code.INVALID_REQUEST)


def configuration_from(data: Any, source: str = "rig configuration") -> RigConfiguration | Refusal:
    """The configuration in plain data, as from a JSON request."""
    return read_data(RigConfiguration, data, Code.INVALID_REQUEST, source)


def frozen(revision: Revision[RigConfiguration]) -> dict[str, Any]:
    """What a run keeps: the model's parts, as `simulate` has them, and the rest of the configuration."""
    document = revision.document
    rest = to_data(document)
    del rest["model"]
    return document.model.model_dump(mode="json") | {KEY: {"revision": revision.number, **rest}}


def model_of(kept: Mapping[str, Any]) -> RigParameters:
    """The model that a run was made with. Raises pydantic's ValidationError."""
    return rig_from({name: value for name, value in kept.items() if name != KEY})


def configuration_of(kept: Mapping[str, Any]) -> RigConfiguration | None:
    """The configuration that a run was made with; None for one before there were any, or that is read no more."""
    rest = {name: value for name, value in kept.get(KEY, {}).items() if name != "revision"}
    if not rest:
        return None
    model = {name: value for name, value in kept.items() if name != KEY}
    found = configuration_from(rest | {"model": model})
    return None if isinstance(found, Refusal) else found
