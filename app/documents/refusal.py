"""What is wrong with a document: a refusal whose faults know the limit, its unit and the line."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from app.errors import Code, Fault, Refusal


@dataclass(frozen=True)
class Problem(Fault):
    """One thing wrong with a document.

    `path` leads to the key (`blocks[1].frequency_hz`, empty for the whole document), `expected`
    says what would be right; `limit` and `unit` are given where a limit was exceeded; `line`
    counts from 1 where the text is known.
    """

    limit: float | None = None
    unit: str | None = None
    line: int | None = None

    @property
    def sentence(self) -> str:
        """`line 7, blocks[1].frequency_hz: 3,000 Hz must be below 2,000 Hz`."""
        place = [f"line {self.line}"] if self.line else []
        place += [self.path] if self.path else []
        return f"{', '.join(place)}: {self.expected}" if place else self.expected

    def as_data(self) -> dict[str, Any]:
        """The problem in types that JSON knows."""
        return {
            "path": self.path,
            "value": self.value,
            "message": self.expected,
            "limit": self.limit,
            "unit": self.unit,
            "line": self.line,
        }


def refuse(code: Code, source: str, problems: Sequence[Problem]) -> Refusal:
    """A document refused for all its problems; `source` is its file or what else it is known by."""
    detail = "\n".join(f"{source}: {problem.sentence}" for problem in problems)
    return Refusal(code, detail, tuple(problems))


def plain(value: object) -> Any:
    """A value as JSON can carry it: NaN and infinity as words, long text and lists cut short."""
    if isinstance(value, float) and not math.isfinite(value):
        return str(value)
    if value is None or isinstance(value, bool | float):
        return value
    if isinstance(value, int):
        return value if abs(value) < 1 << 63 else "a number too large"
    if isinstance(value, dict):
        return f"a mapping with {len(value)} keys"
    if isinstance(value, list | tuple):
        return f"a list of {len(value)}"
    return str(value)[:200]
