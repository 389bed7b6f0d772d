"""Test definitions from text, files and plain data, and back."""

from pathlib import Path
from typing import Any

from app.definitions.definition import Definition
from app.documents.reading import read_data, read_file, read_text
from app.errors import Code, Refusal


def load_definition(path: Path) -> Definition | Refusal:
    """The definition in a file: JSON where its name ends in .json, YAML otherwise."""
    return read_file(Definition, path, Code.INVALID_TEST)


def parse_definition(
    text: str, source: str = "text", *, json: bool = False
) -> Definition | Refusal:
    """The definition in a text. `source` names it in the refusal."""
    return read_text(Definition, text, Code.INVALID_TEST, source, json=json)


def definition_from(data: Any, source: str = "test") -> Definition | Refusal:
    """The definition in plain data, as from a JSON request."""
    return read_data(Definition, data, Code.INVALID_TEST, source)
