"""A document, from text or a file, as a frozen model or a refusal that lists every problem."""

from collections.abc import Callable, Mapping
from pathlib import Path as FilePath
from typing import Any, TypeVar

from pydantic import BaseModel, ValidationError

from app.documents.locate import locate, written
from app.documents.messages import Details, bound_of, message_for
from app.documents.refusal import Problem, plain, refuse
from app.documents.tree import MAX_BYTES, Malformed, Path, Tree, parse_json, parse_yaml
from app.documents.units import unit_of
from app.errors import Code, Refusal

M = TypeVar("M", bound=BaseModel)

JSON_SUFFIX = ".json"


def read_file(
    model: type[M],
    path: FilePath,
    code: Code,
    *,
    build: Callable[[Mapping[str, Any]], M] | None = None,
    context: Mapping[str, Any] | None = None,
) -> M | Refusal:
    """The document in a file: JSON where its name ends in .json, YAML otherwise."""
    text = _text_of(path)
    if isinstance(text, Problem):
        return refuse(code, str(path), [text])
    json = path.suffix.lower() == JSON_SUFFIX
    return read_text(model, text, code, str(path), json=json, build=build, context=context)


def read_text(
    model: type[M],
    text: str,
    code: Code,
    source: str = "text",
    *,
    json: bool = False,
    build: Callable[[Mapping[str, Any]], M] | None = None,
    context: Mapping[str, Any] | None = None,
) -> M | Refusal:
    """The document in a text. `source` names it in the refusal."""
    try:
        if len(text) > MAX_BYTES:
            raise Malformed(f"{len(text):,} characters, the limit is {MAX_BYTES:,}")
        tree = parse_json(text) if json else parse_yaml(text)
    except Malformed as error:
        return refuse(code, source, [_whole(str(error), error.path, error.line)])
    return read_data(model, tree.data, code, source, tree.lines, build=build, context=context)


def read_data(
    model: type[M],
    data: Any,
    code: Code,
    source: str = "data",
    lines: dict[Path, int] | None = None,
    *,
    build: Callable[[Mapping[str, Any]], M] | None = None,
    context: Mapping[str, Any] | None = None,
) -> M | Refusal:
    """The document in plain data (as from JSON).

    `build` makes the model where data alone do not: it may raise the model's ValidationError.
    `context` is what the model's validators may look things up in.
    """
    if data is None:
        return refuse(code, source, [_whole("the document is empty")])
    if not isinstance(data, dict):
        message = f"the document must be a mapping of keys to values, is {plain(data)}"
        return refuse(code, source, [_whole(message)])
    try:
        return build(data) if build else model.model_validate(data, context=context)
    except ValidationError as error:
        found = [dict(details) for details in error.errors(include_url=False)]
        tree = Tree(data, lines or {})
        problems = [_problem(model, d, tree) for d in found if not _echo(d)]
        return refuse(code, source, sorted(problems, key=lambda problem: problem.line or 0))


def _text_of(path: FilePath) -> str | Problem:
    try:
        if path.stat().st_size > MAX_BYTES:
            return _whole(f"the file is larger than the limit of {MAX_BYTES:,} bytes")
        return path.read_text(encoding="utf-8-sig")
    except FileNotFoundError:
        return _whole("no such file")
    except UnicodeDecodeError:
        return _whole("the file is not text in UTF-8")
    except OSError as error:
        return _whole(f"cannot be read: {error.strerror}")


def _whole(message: str, path: Path = (), line: int | None = None) -> Problem:
    return Problem(written(path), None, message, line=line)


def _echo(details: Details) -> bool:
    """Whether a list counts as too short only because its entries were refused, each by itself."""
    if details["type"] != "too_short":
        return False
    return bool(len(details["input"]) >= details["ctx"]["min_length"])


def _problem(model: type[BaseModel], details: Details, tree: Tree) -> Problem:
    place = locate(model, details["loc"])
    context = details.get("ctx", {})
    path = place.path + _key_below(details)
    name = next((key for key in reversed(path) if isinstance(key, str)), "")
    return Problem(
        written(path),
        plain(_value(details)),
        message_for(details, place),
        limit=bound_of(details),
        unit=context.get("unit") or unit_of(name),
        line=_line(tree, path),
    )


def _value(details: Details) -> object:
    """What stood there: nothing where a key is missing, what a check across keys computed."""
    if details["type"] in ("missing", "union_tag_not_found"):
        return None
    context = details.get("ctx", {})
    return context.get("value", context.get("tag", details["input"]))


def _key_below(details: Details) -> Path:
    """The key of a block that an error of the whole block is about."""
    if details["type"].startswith("union_tag"):
        return ("kind",)
    field = details.get("ctx", {}).get("field")
    return (field,) if field else ()


def _line(tree: Tree, path: Path) -> int | None:
    """The line of a path, or of the nearest thing around it that exists."""
    parents = (path[:length] for length in range(len(path), -1, -1))
    return next((tree.lines[parent] for parent in parents if parent in tree.lines), None)
