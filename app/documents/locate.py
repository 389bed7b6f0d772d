"""Where in a document, and in which model, a validation error of Pydantic's belongs."""

from dataclasses import dataclass
from types import UnionType
from typing import Annotated, Any, Literal, Union, get_args, get_origin

from pydantic import BaseModel, Tag

from app.documents.tree import Path


@dataclass(frozen=True)
class Place:
    """A path as people write it, the model that holds its last key, and what is expected there."""

    path: Path
    holder: type[BaseModel] | None
    expected: Any

    @property
    def text(self) -> str:
        """`blocks[1].frequency_hz`."""
        return written(self.path)

    @property
    def known_names(self) -> list[str]:
        """The keys that may stand beside the last one."""
        return names_of(self.holder) if self.holder else []

    @property
    def kinds(self) -> list[str]:
        """The values of `kind` among which a block at this place chooses."""
        return [kind for model in models_in(self.expected) for kind in kinds_of(model)]


def written(path: Path) -> str:
    """A path in the way people write it."""
    text = "".join(f"[{key}]" if isinstance(key, int) else f".{key}" for key in path)
    return text.removeprefix(".")


def locate(model: type[BaseModel], location: tuple[int | str, ...]) -> Place:
    """The place of an error; the tags that Pydantic puts after a union's index are left out."""
    path: list[int | str] = []
    holder: type[BaseModel] | None = None
    expected: Any = model
    for key in location:
        models = models_in(expected)
        chosen = [model for model in models if key in kinds_of(model)]
        if chosen and len(models) > 1:
            expected = chosen[0]
            continue
        tagged = _tagged(expected, key)
        if tagged is not None:
            expected = tagged
            continue
        path.append(key)
        if isinstance(key, str) and models:
            holder = models[0]
            expected = _field(holder, key)
        else:
            expected = _item(expected)
    return Place(tuple(path), holder, expected)


def models_in(annotation: Any) -> list[type[BaseModel]]:
    """The models that an annotation lets through: its members where it is a union."""
    if get_origin(annotation) is Annotated:
        return models_in(get_args(annotation)[0])
    if get_origin(annotation) in (Union, UnionType):
        return [model for member in get_args(annotation) for model in models_in(member)]
    return (
        [annotation] if isinstance(annotation, type) and issubclass(annotation, BaseModel) else []
    )


def kinds_of(model: type[BaseModel]) -> tuple[Any, ...]:
    """The values of a model's `kind`, none where it has no such field."""
    field = model.model_fields.get("kind")
    return get_args(field.annotation) if field and get_origin(field.annotation) is Literal else ()


def names_of(model: type[BaseModel]) -> list[str]:
    """The keys of a model as they are written in a document."""
    return [field.alias or name for name, field in model.model_fields.items()]


def _tagged(annotation: Any, key: int | str) -> Any:
    """The member of a union that bears a tag of this name, or None."""
    if get_origin(annotation) is Annotated:
        return _tagged(get_args(annotation)[0], key)
    for member in get_args(annotation):
        if any(isinstance(m, Tag) and m.tag == key for m in getattr(member, "__metadata__", ())):
            return member
    return None


def _field(model: type[BaseModel], key: str) -> Any:
    for name, field in model.model_fields.items():
        if key in (name, field.alias):
            return field.annotation
    return None


def _item(annotation: Any) -> Any:
    if get_origin(annotation) is Annotated:
        return _item(get_args(annotation)[0])
    arguments = get_args(annotation)
    return arguments[0] if get_origin(annotation) in (tuple, list) and arguments else None
