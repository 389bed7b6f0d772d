"""The example tests that ship with forcerig, the paper's among them."""

from functools import cache
from importlib.resources import files

from app.definitions.definition import Definition
from app.definitions.reading import parse_definition
from app.errors import Refusal

_SUFFIX = ".yaml"


@cache
def library() -> dict[str, Definition]:
    """Every example by its id, in the order of their ids. An example that is refused is a bug."""
    folder = files("app.library")
    names = [entry.name for entry in folder.iterdir() if entry.name.endswith(_SUFFIX)]
    ids = sorted(name.removesuffix(_SUFFIX) for name in names)
    return {test_id: _read(test_id + _SUFFIX) for test_id in ids}


def library_text(test_id: str) -> str:
    """The YAML of an example, with its comments. Raises KeyError where there is no such example."""
    if test_id not in library():
        raise KeyError(test_id)
    return files("app.library").joinpath(test_id + _SUFFIX).read_text(encoding="utf-8")


def _read(name: str) -> Definition:
    text = files("app.library").joinpath(name).read_text(encoding="utf-8")
    definition = parse_definition(text, name)
    if isinstance(definition, Refusal):
        raise ValueError(definition.detail)
    return definition
