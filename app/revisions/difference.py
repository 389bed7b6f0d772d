"""What two documents differ in, value by value."""

from collections.abc import Iterator, Mapping
from typing import Any

from pydantic import BaseModel

from app.documents.locate import written
from app.documents.tree import Path
from app.documents.units import unit_of
from app.documents.writing import to_data
from app.revisions.schemas import SettingsChange, SettingsDifference, Value


def difference(
    before: BaseModel, after: BaseModel, numbers: tuple[int | None, int | None]
) -> SettingsDifference:
    """From one document to another, in the order of the latter; what is gone comes last."""
    was, now = dict(_leaves(to_data(before))), dict(_leaves(to_data(after)))
    paths = [*now, *(path for path in was if path not in now)]
    changes = [_change(p, was.get(p), now.get(p)) for p in paths if was.get(p) != now.get(p)]
    return SettingsDifference(before=numbers[0], to=numbers[1], changes=changes)


def _change(path: Path, before: Value, after: Value) -> SettingsChange:
    return SettingsChange(
        path=written(path), unit=unit_of(str(path[-1])), before=before, after=after
    )


def _leaves(value: Any, path: Path = ()) -> Iterator[tuple[Path, Value]]:
    if isinstance(value, Mapping):
        for key, inner in value.items():
            yield from _leaves(inner, (*path, key))
    elif isinstance(value, list):
        for i, inner in enumerate(value):
            yield from _leaves(inner, (*path, i))
    else:
        yield path, value
