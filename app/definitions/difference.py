"""What changed from one definition to another: blocks are matched, so that one inserted is one change."""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from difflib import SequenceMatcher, unified_diff
from enum import StrEnum
from json import dumps
from typing import Any

from app.definitions.definition import Definition
from app.documents.locate import written
from app.documents.tree import Path
from app.documents.writing import to_data

_UNMATCHED = 0.6  # what an entry that goes or comes costs, where two that share nothing cost 1
_MOST_PAIRS = 40_000


class ChangeKind(StrEnum):
    """What became of a value."""

    ADDED = "added"
    REMOVED = "removed"
    CHANGED = "changed"


@dataclass(frozen=True)
class Change:
    """One change. `keys` lead to the value: in the definition before where it was removed, in the one
    after otherwise. What was not there is None."""

    kind: ChangeKind
    keys: Path
    before: Any
    after: Any

    @property
    def path(self) -> str:
        """`blocks[1].frequency_hz`."""
        return written(self.keys)


def differences(before: Definition, after: Definition) -> list[Change]:
    """Every change from one definition to another, in the order of their keys."""
    return data_differences(to_data(before), to_data(after))


def data_differences(before: Any, after: Any) -> list[Change]:
    """As `differences`, of plain data."""
    return list(_between(before, after, (), ()))


def applied(changes: Sequence[Change], before: Any) -> Any:
    """Plain data with changes made to them: those that led from there to other data give those."""
    data = _copied(before)
    # What goes is named as it was, so the last goes first; what comes is named as it will be.
    for change in reversed([c for c in changes if c.kind is ChangeKind.REMOVED]):
        del _holder(data, change.keys)[change.keys[-1]]
    for change in (c for c in changes if c.kind is ChangeKind.ADDED):
        holder = _holder(data, change.keys)
        if isinstance(holder, list):
            holder.insert(int(change.keys[-1]), _copied(change.after))
        else:
            holder[change.keys[-1]] = _copied(change.after)
    for change in (c for c in changes if c.kind is ChangeKind.CHANGED):
        _holder(data, change.keys)[change.keys[-1]] = _copied(change.after)
    return data


def text_difference(before: str, after: str, names: tuple[str, str] = ("before", "after")) -> str:
    """A unified difference of two texts, empty where they are the same."""
    found = unified_diff(before.splitlines(), after.splitlines(), *names, lineterm="")
    return "".join(f"{line}\n" for line in found)


def _between(before: Any, after: Any, was: Path, now: Path) -> Iterator[Change]:
    if _same(before, after):
        return
    if isinstance(before, dict) and isinstance(after, dict):
        yield from _of_mapping(before, after, was, now)
    elif _has_entries(before) and _has_entries(after):
        yield from _of_list(before, after, was, now)
    else:
        yield Change(ChangeKind.CHANGED, now, before, after)


def _of_mapping(
    before: dict[str, Any], after: dict[str, Any], was: Path, now: Path
) -> Iterator[Change]:
    for key in [*before, *(key for key in after if key not in before)]:
        if key not in after:
            yield Change(ChangeKind.REMOVED, (*was, key), before[key], None)
        elif key not in before:
            yield Change(ChangeKind.ADDED, (*now, key), None, after[key])
        else:
            yield from _between(before[key], after[key], (*was, key), (*now, key))


def _of_list(before: list[Any], after: list[Any], was: Path, now: Path) -> Iterator[Change]:
    for i, j in _matched(before, after):
        if j is None and i is not None:
            yield Change(ChangeKind.REMOVED, (*was, i), before[i], None)
        elif i is None and j is not None:
            yield Change(ChangeKind.ADDED, (*now, j), None, after[j])
        elif i is not None and j is not None:
            yield from _between(before[i], after[j], (*was, i), (*now, j))


_Pairs = Iterator[tuple[int | None, int | None]]


def _matched(before: list[Any], after: list[Any]) -> _Pairs:
    """Which entry became which, in order; None where one has no other."""
    was, now = ([dumps(entry, sort_keys=True) for entry in part] for part in (before, after))
    matcher = SequenceMatcher(a=was, b=now, autojunk=False)
    for tag, i, i_end, j, j_end in matcher.get_opcodes():
        if tag == "equal":
            yield from zip(range(i, i_end), range(j, j_end), strict=True)
        else:
            yield from _likened(before, after, range(i, i_end), range(j, j_end))


def _likened(before: list[Any], after: list[Any], these: range, those: range) -> _Pairs:
    """Pairs of entries that are most alike, none of them equal: the cheapest alignment."""
    if len(these) * len(those) > _MOST_PAIRS:
        yield from ((i, None) for i in these)
        yield from ((None, j) for j in those)
        return
    costs = [[_UNMATCHED * (a + b) for b in range(len(those) + 1)] for a in range(len(these) + 1)]
    for a, i in enumerate(these, 1):
        for b, j in enumerate(those, 1):
            alone = min(costs[a - 1][b], costs[a][b - 1]) + _UNMATCHED
            costs[a][b] = min(alone, costs[a - 1][b - 1] + _unlike(before[i], after[j]))
    yield from reversed(_traced(costs, these, those, lambda i, j: _unlike(before[i], after[j])))


def _traced(
    costs: list[list[float]], these: range, those: range, unlike: Callable[[int, int], float]
) -> list[tuple[int | None, int | None]]:
    """The way through a table of costs, from its end."""
    a, b = len(these), len(those)
    pairs: list[tuple[int | None, int | None]] = []
    while a or b:
        i, j = these[a - 1] if a else None, those[b - 1] if b else None
        paired = (
            i is not None and j is not None and costs[a][b] == costs[a - 1][b - 1] + unlike(i, j)
        )
        if paired:
            a, b = a - 1, b - 1
            pairs.append((i, j))
        elif b and costs[a][b] == costs[a][b - 1] + _UNMATCHED:
            b -= 1
            pairs.append((None, j))
        else:
            a -= 1
            pairs.append((i, None))
    return pairs


def _unlike(before: Any, after: Any) -> float:
    """0 … 1, and more than going and coming together where one cannot have become the other."""
    if not isinstance(before, dict) or not isinstance(after, dict):
        return 3 * _UNMATCHED
    if before.get("kind") != after.get("kind"):
        return 3 * _UNMATCHED
    keys = before.keys() | after.keys()
    missing = object()
    other = sum(not _same(before.get(key, missing), after.get(key, missing)) for key in keys)
    return other / max(len(keys), 1)


def _same(before: Any, after: Any) -> bool:
    """Equal, and true is not 1."""
    return type(before) is type(after) and bool(before == after)


def _has_entries(value: Any) -> bool:
    """Whether a list holds things with keys, as blocks are; numbers change as a whole list."""
    return isinstance(value, list) and all(isinstance(entry, dict) for entry in value)


def _holder(data: Any, keys: Path) -> Any:
    for key in keys[:-1]:
        data = data[key]
    return data


def _copied(value: Any) -> Any:
    if isinstance(value, dict):
        return {key: _copied(inner) for key, inner in value.items()}
    return [_copied(inner) for inner in value] if isinstance(value, list) else value
