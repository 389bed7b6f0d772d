"""Text to plain data: YAML with the core schema of YAML 1.2, or JSON, each key's line remembered.

YAML 1.1, which PyYAML reads by itself, turns `off` into false, `1:30` into 90 and `2e4` into text.
"""

import json
import re
from dataclasses import dataclass, field
from typing import Any

import yaml

MAX_BYTES = 500_000
MAX_DEPTH = 64
MAX_NODES = 200_000  # aliases expanded, so that a few lines cannot become a million blocks

Path = tuple[str | int, ...]


@dataclass(frozen=True)
class Tree:
    """Plain data, and the line (from 1) where each path stands."""

    data: Any
    lines: dict[Path, int] = field(default_factory=dict)


class Malformed(Exception):
    """The text is no document; `line` counts from 1 where it is known."""

    def __init__(self, message: str, path: Path = (), line: int | None = None) -> None:
        super().__init__(message)
        self.path = path
        self.line = line


CORE_FLOAT = re.compile(
    r"^(?:[-+]?(?:\.[0-9]+|[0-9]+(?:\.[0-9]*)?)(?:[eE][-+]?[0-9]+)?"
    r"|[-+]?\.(?:inf|Inf|INF)|\.(?:nan|NaN|NAN))$"
)
_CORE: tuple[tuple[str, re.Pattern[str], list[str]], ...] = (
    ("null", re.compile(r"^(?:~|null|Null|NULL|)$"), ["~", "n", "N", ""]),
    ("bool", re.compile(r"^(?:true|True|TRUE|false|False|FALSE)$"), list("tTfF")),
    ("int", re.compile(r"^(?:[-+]?[0-9]+|0o[0-7]+|0x[0-9a-fA-F]+)$"), list("-+0123456789")),
    ("float", CORE_FLOAT, list("-+0123456789.")),
)


class _CoreLoader(yaml.SafeLoader):
    yaml_implicit_resolvers: dict[str, Any] = {}  # noqa: RUF012  # PyYAML's own way of declaring


for _name, _pattern, _first in _CORE:
    _CoreLoader.add_implicit_resolver(f"tag:yaml.org,2002:{_name}", _pattern, _first)


def parse_yaml(text: str) -> Tree:
    """Raises `Malformed`."""
    try:
        root = yaml.compose(text, Loader=_CoreLoader)
    except yaml.MarkedYAMLError as error:
        mark = error.problem_mark or error.context_mark
        line = mark.line + 1 if mark else None
        raise Malformed(f"this is not YAML: {error.problem}", line=line) from None
    except yaml.YAMLError as error:
        raise Malformed(f"this is not YAML: {error}") from None
    except RecursionError:
        raise Malformed(f"nested deeper than {MAX_DEPTH} levels") from None
    builder = _Builder()
    return Tree(builder.build(root, ()) if root else None, builder.lines)


class _Builder:
    """Plain data from YAML nodes, within limits."""

    def __init__(self) -> None:
        self.lines: dict[Path, int] = {}
        self.nodes = 0

    def build(self, node: yaml.Node, path: Path) -> Any:
        line = node.start_mark.line + 1
        self.lines.setdefault(path, line)
        self.nodes += 1
        if self.nodes > MAX_NODES or len(path) > MAX_DEPTH:
            limits = f"{MAX_NODES:,} values, {MAX_DEPTH} levels deep"
            raise Malformed(f"larger than the limit of {limits}", line=line)
        if isinstance(node, yaml.MappingNode):
            return self._mapping(node, path)
        if isinstance(node, yaml.SequenceNode):
            return [self.build(child, (*path, i)) for i, child in enumerate(node.value)]
        return self._scalar(node, path, line)

    def _mapping(self, node: yaml.MappingNode, path: Path) -> dict[str, Any]:
        mapping: dict[str, Any] = {}
        for key_node, value_node in node.value:
            line = key_node.start_mark.line + 1
            if not isinstance(key_node, yaml.ScalarNode):
                raise Malformed("a key must be a name", path, line)
            key = str(key_node.value)
            if key in mapping:
                first = self.lines[(*path, key)]
                raise Malformed(f"{key} is given twice, first on line {first}", (*path, key), line)
            self.lines[(*path, key)] = line
            mapping[key] = self.build(value_node, (*path, key))
        return mapping

    def _scalar(self, node: yaml.Node, path: Path, line: int) -> Any:
        kind, text = node.tag.rpartition(":")[2], str(node.value)
        try:
            return _SCALARS[kind](text)
        except KeyError:
            raise Malformed(f"the tag {node.tag} means nothing here", path, line) from None
        except ValueError as error:
            raise Malformed(str(error), path, line) from None


def _integer(text: str) -> int:
    """`010` is ten, as in YAML 1.2, and not eight."""
    base = {"0o": 8, "0x": 16}.get(text[:2], 10)
    return int(text, base)


_SCALARS: dict[str, Any] = {
    "null": lambda text: None,
    "bool": lambda text: text.lower() == "true",
    "int": _integer,
    "float": lambda text: float(text.lower().replace(".inf", "inf").replace(".nan", "nan")),
    "str": str,
}


def parse_json(text: str) -> Tree:
    """Raises `Malformed`. NaN and Infinity pass, for the model to refuse with their path."""
    try:
        return Tree(json.loads(text, object_pairs_hook=_without_duplicates))
    except json.JSONDecodeError as error:
        raise Malformed(f"this is not JSON: {error.msg}", line=error.lineno) from None
    except RecursionError:
        raise Malformed(f"nested deeper than {MAX_DEPTH} levels") from None
    except ValueError as error:  # a number of thousands of digits
        raise Malformed(f"this is not JSON: {error}") from None


def _without_duplicates(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    mapping: dict[str, Any] = {}
    for key, value in pairs:
        if key in mapping:
            raise Malformed(f"{key} is given twice")
        mapping[key] = value
    return mapping
