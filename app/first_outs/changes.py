"""One value changed by its path: `controller.k_p`, `interlocks.force_error.threshold`, `rig.supply.high_pa`."""

from collections.abc import Mapping
from copy import deepcopy
from dataclasses import dataclass, replace
from typing import Any

from pydantic import BaseModel

from app.controller.record import controller_from
from app.controller.settings import ControllerSettings
from app.documents.messages import nearest
from app.documents.reading import read_data
from app.errors import Code, Fault, Refusal
from app.first_outs.account import Settings
from app.interlocks.record import interlocks_from
from app.interlocks.table import Interlocks
from rtcore.rig.parameters import RigParameters, rig_from

PARTS = ("controller", "interlocks", "rig")
_NO_TABLE = Refusal(
    Code.NO_DATA,
    "The table of detectors that was in force is not known: neither replay nor re-run is possible",
)


@dataclass(frozen=True)
class InForceThen:
    """The settings of a first-out as models, ready to be changed and played."""

    controller: ControllerSettings
    interlocks: Interlocks
    rig: RigParameters
    seed: int


@dataclass(frozen=True)
class Changed:
    """Settings with one value changed, and what it was before."""

    settings: InForceThen
    path: str
    before: Any
    value: Any


def settings_then(kept: Settings) -> InForceThen | Refusal:
    """The settings as they were kept; refused where this version does not know them any more."""
    if kept.interlocks is None:
        return _NO_TABLE
    controller = controller_from(kept.controller)
    interlocks = interlocks_from(kept.interlocks)
    rig = read_data(RigParameters, kept.rig, Code.INVALID_REQUEST, "rig", build=rig_from)
    for found in (controller, interlocks, rig):
        if isinstance(found, Refusal):
            return found
    assert isinstance(controller, ControllerSettings)
    assert isinstance(interlocks, Interlocks)
    assert isinstance(rig, RigParameters)
    return InForceThen(controller, interlocks, rig, kept.seed)


def change(then: InForceThen, path: str, value: Any) -> Changed | Refusal:
    """The settings with the value at a path changed. Refused by path, with the nearest name that is known."""
    part, _, within = path.partition(".")
    if part not in PARTS:
        known = nearest(part, PARTS) or f"; it begins with one of {', '.join(PARTS)}"
        return _refusal(path, value, f"there is no {part or 'empty path'}{known}")
    if part == "interlocks":
        return _changed_detector(then, path, within, value)
    model: BaseModel = getattr(then, part)
    data = model.model_dump(mode="json")
    before = _put(data, within.split("."), value, path)
    if isinstance(before, Refusal):
        return before
    read: Any
    if part == "controller":
        read = controller_from(data)
    else:
        read = read_data(RigParameters, data, Code.INVALID_REQUEST, build=rig_from)
    return _outcome(then, part, read, path, before, value)


def _changed_detector(then: InForceThen, path: str, within: str, value: Any) -> Changed | Refusal:
    name, _, key = within.partition(".")
    names = [d.name for d in then.interlocks.detectors]
    if name not in names:
        known = nearest(name, names) or f"; known: {', '.join(names)}"
        return _refusal(path, value, f"there is no detector {name or 'without a name'}{known}")
    data = then.interlocks.model_dump(mode="json")
    before = _put(data["detectors"][names.index(name)], [key], value, path)
    if isinstance(before, Refusal):
        return before
    return _outcome(then, "interlocks", interlocks_from(data), path, before, value)


def _put(data: dict[str, Any], keys: list[str], value: Any, path: str) -> Any:
    """Put a value into nested data; what was there before, or a refusal."""
    inner: Any = data
    for key in keys[:-1]:
        inner = inner.get(key) if isinstance(inner, dict) else None
    last = keys[-1]
    if not isinstance(inner, dict) or last not in inner:
        return _refusal(path, value, _unknown(data, keys))
    before = deepcopy(inner[last])
    if isinstance(before, dict):
        return _refusal(path, value, f"name one value of it: {', '.join(before)}")
    inner[last] = value
    return before


def _unknown(data: Any, keys: list[str]) -> str:
    """What is wrong with a path, at the first key of it that is not there."""
    for i, key in enumerate(keys):
        if not isinstance(data, dict):
            return f"{'.'.join(keys[:i])} has no parts"
        if key not in data:
            before = "".join(f"{known}." for known in keys[:i])
            guess = nearest(key, data).replace("did you mean ", f"did you mean {before}")
            return f"there is no {before}{key}{guess or '; known here: ' + ', '.join(data)}"
        data = data[key]
    return "there is no such value"


def _outcome(
    then: InForceThen, part: str, read: Any, path: str, before: Any, value: Any
) -> Changed | Refusal:
    if isinstance(read, Refusal):
        faults = tuple(replace(fault, path=path) for fault in read.faults)
        detail = "; ".join(f"{path}: {fault.expected}" for fault in faults)
        return Refusal(Code.INVALID_REQUEST, detail or read.detail, faults)
    return Changed(replace(then, **{part: read}), path, before, value)


def change_detectors(
    then: InForceThen, changes: Mapping[str, Any]
) -> tuple[InForceThen, list[Changed]] | Refusal:
    """Several values of detectors changed, each by `force_error.threshold`."""
    made: list[Changed] = []
    for path, value in changes.items():
        found = change(then, f"interlocks.{path.removeprefix('interlocks.')}", value)
        if isinstance(found, Refusal):
            return found
        then = found.settings
        made.append(found)
    return then, made


def _refusal(path: str, value: Any, expected: str) -> Refusal:
    return Refusal(Code.INVALID_REQUEST, f"{path}: {expected}", (Fault(path, value, expected),))
