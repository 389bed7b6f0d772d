"""The base of every document's model, and how checks across keys say what is wrong."""

from collections.abc import Sequence
from typing import Any

from pydantic import BaseModel, ConfigDict, ValidationError
from pydantic_core import InitErrorDetails, PydanticCustomError

from app.documents.tree import Path


class Document(BaseModel):
    """Frozen, finite, and without room for unknown keys."""

    model_config = ConfigDict(frozen=True, extra="forbid", allow_inf_nan=False)


def wrong(
    field: str,
    message: str,
    *,
    value: Any = None,
    limit: float | None = None,
    unit: str | None = None,
) -> PydanticCustomError:
    """An error to raise in a validator of a whole block; `field` is the key that it is about."""
    context = {"field": field, "value": value, "limit": limit, "unit": unit, "message": message}
    return PydanticCustomError("wrong", "{message}", context)


def all_wrong(title: str, errors: Sequence[tuple[Path, PydanticCustomError]]) -> ValidationError:
    """Several errors, each at the path of its block, to raise in a validator of a document."""
    details = [InitErrorDetails(type=error, loc=path, input=None) for path, error in errors]
    return ValidationError.from_exception_data(title, details)
