"""A rig file for the virtual rig: what it leaves out is as in the rig that ships with forcerig."""

from pathlib import Path

from app.documents.reading import read_file
from app.errors import Code, Refusal
from rtcore.rig.parameters import RigParameters, rig_from


def load_rig_file(path: Path) -> RigParameters | Refusal:
    """The rig of a file: JSON where its name ends in .json, YAML otherwise."""
    return read_file(RigParameters, path, Code.INVALID_REQUEST, build=rig_from)
