"""Test definitions from text, files and plain data, and back.

`histories` is where the files of time histories are looked up; without it they are refused.
"""

from pathlib import Path
from typing import Any

from app.definitions.courses import HISTORIES
from app.definitions.definition import Definition
from app.documents.reading import read_data, read_file, read_text
from app.errors import Code, Refusal
from app.histories.history import Histories
from app.histories.store import Beside


def load_definition(path: Path) -> Definition | Refusal:
    """The definition in a file: JSON where its name ends in .json, YAML otherwise.

    Time histories are looked up beside it.
    """
    context = {HISTORIES: Beside(path.parent)}
    return read_file(Definition, path, Code.INVALID_TEST, context=context)


def parse_definition(
    text: str, source: str = "text", *, json: bool = False, histories: Histories | None = None
) -> Definition | Refusal:
    """The definition in a text. `source` names it in the refusal."""
    context = {HISTORIES: histories}
    return read_text(Definition, text, Code.INVALID_TEST, source, json=json, context=context)


def definition_from(
    data: Any, source: str = "test", *, histories: Histories | None = None
) -> Definition | Refusal:
    """The definition in plain data, as from a JSON request."""
    return read_data(Definition, data, Code.INVALID_TEST, source, context={HISTORIES: histories})
