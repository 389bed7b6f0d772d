"""The settings in which runs differ: every path with its value in each of them."""

import json
from collections.abc import Sequence
from typing import Any, Literal, get_args

from app.comparison.schemas import SettingRow
from app.definitions.difference import ChangeKind, data_differences

MOST_ROWS = 300  # that are told
LONGEST_VALUE = 300  # as JSON
Part = Literal["definition", "controller", "interlocks", "rig"]


def differing(runs: Sequence[dict[str, Any]]) -> list[SettingRow]:
    """The settings that are not the same in all runs, each by its parts; the first is the baseline."""
    return [row for part in get_args(Part) for row in _of_part(part, [run[part] for run in runs])]


def _of_part(part: Part, trees: Sequence[Any]) -> list[SettingRow]:
    """Rows in the order in which the baseline's keys come."""
    baseline, *others = trees
    rows: dict[str, list[Any]] = {}
    for place, other in enumerate(others, start=1):
        for change in data_differences(baseline, other):
            before = None if change.kind is ChangeKind.ADDED else change.before
            row = rows.setdefault(change.path, [_shown(before)] * len(trees))
            row[place] = _shown(change.after)
    return [SettingRow(part=part, path=path, values=values) for path, values in rows.items()]


def _shown(value: Any) -> Any:
    """A value, but not pages of it."""
    text = json.dumps(value, ensure_ascii=False)
    return value if len(text) <= LONGEST_VALUE else f"{text[:LONGEST_VALUE]}…"
