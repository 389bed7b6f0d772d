"""The detectors that the rig starts with: read from the file that ships with forcerig."""

from functools import cache
from importlib.resources import files

from app.documents.reading import read_text
from app.errors import Code, Refusal
from app.interlocks.table import Interlocks
from rtcore.modes import Mode

IN_A_TEST = (Mode.RUNNING, Mode.HOLDING)
SHIPPED = "shipped.yaml"


@cache
def default_interlocks() -> Interlocks:
    """The table as shipped. One that is refused is a bug."""
    text = files("app.interlocks").joinpath(SHIPPED).read_text(encoding="utf-8")
    table = read_text(Interlocks, text, Code.INVALID_REQUEST, SHIPPED)
    if isinstance(table, Refusal):
        raise ValueError(table.detail)
    return table
