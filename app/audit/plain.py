"""Data as the audit keeps it: JSON that comes back from either database as it went in, no secrets."""

import math
import re
from collections.abc import Iterable, Mapping
from dataclasses import asdict, is_dataclass
from datetime import datetime
from enum import Enum
from typing import Any

from pydantic import BaseModel

REDACTED = "(redacted)"
_SECRET = {"password", "passphrase", "secret", "token", "cookie", "authorization", "credentials"}
_SECRET |= {f"{word}s" for word in _SECRET}
_ABOUT = {"id", "name", "kind", "at", "role"}  # `token_id` names a token, and is none
_WORD = re.compile(r"[A-Z]?[a-z]+|[A-Z]+(?![a-z])")


def plain(data: Any) -> Any:
    """Data as JSON. What hides behind a field named like a secret is redacted."""
    if isinstance(data, BaseModel):
        return plain(data.model_dump(mode="json"))
    if is_dataclass(data) and not isinstance(data, type):
        return plain(asdict(data))
    if isinstance(data, Enum):
        return plain(data.name.lower() if isinstance(data.value, int) else data.value)
    if isinstance(data, Mapping):
        return {clean(str(key)): _field(str(key), value) for key, value in data.items()}
    if isinstance(data, Iterable) and not isinstance(data, str | bytes):
        return [plain(value) for value in data]
    return _scalar(data)


def clean(text: str) -> str:
    """Text that every database keeps: no NUL, nothing that UTF-8 cannot say."""
    return text.replace("\x00", "\N{SYMBOL FOR NULL}").encode("utf-8", "replace").decode()


def is_secret(name: str) -> bool:
    """Whether a field of this name holds a secret."""
    words = [word.lower() for word in _WORD.findall(name)]
    return not _SECRET.isdisjoint(words) and words[-1] not in _ABOUT


def _field(name: str, value: Any) -> Any:
    if value is not None and not isinstance(value, bool) and is_secret(name):
        return REDACTED
    return plain(value)


def _scalar(value: Any) -> Any:
    if value is None or isinstance(value, bool | int):
        return value
    if isinstance(value, float):
        return value if math.isfinite(value) else str(value)  # JSON has neither NaN nor infinity
    if isinstance(value, datetime):
        return value.isoformat()
    return clean(str(value))
