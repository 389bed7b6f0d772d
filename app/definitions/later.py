"""Kinds of blocks that the format knows and this version cannot run yet."""

from typing import Any

from pydantic import BeforeValidator

from app.documents.fields import wrong

LATER_BLOCKS = ("sweep", "frequency_response", "time_history")
LATER_MOTIONS = ("time_history",)


def refuse_later(kinds: tuple[str, ...], what: str) -> BeforeValidator:
    """A validator that says of these kinds that they are not available yet."""

    def refuse(value: Any) -> Any:
        kind = value.get("kind") if isinstance(value, dict) else None
        if kind in kinds:
            message = f"{what} of kind {kind} is not available yet in this version of forcerig"
            raise wrong("kind", message, value=kind)
        return value

    return BeforeValidator(refuse)
