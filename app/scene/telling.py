"""What the console tells the scene's process, a line of JSON each."""

import json
from collections.abc import Mapping
from dataclasses import asdict, dataclass
from typing import Any

from app.scene.chain import Chain, Reading


@dataclass(frozen=True)
class Moment:
    """A recorded moment, of the rig as it was then."""

    chain: Chain
    reading: Reading


@dataclass(frozen=True)
class View:
    """What one view shows: live where it has no moment; deformation and travel drawn so many times as large."""

    deformation: float = 50.0
    travel: float = 1.0
    moment: Moment | None = None


@dataclass(frozen=True)
class RigTold:
    """The rig in force."""

    chain: Chain


@dataclass(frozen=True)
class LiveTold:
    """The rig now."""

    reading: Reading


@dataclass(frozen=True)
class ViewTold:
    """What a view shows from now on."""

    name: str
    view: View


Told = RigTold | LiveTold | ViewTold


def line(told: Told) -> bytes:
    """As a line."""
    return json.dumps(_document(told), separators=(",", ":")).encode() + b"\n"


def _document(told: Told) -> dict[str, Any]:
    if isinstance(told, RigTold):
        return {"rig": asdict(told.chain)}
    if isinstance(told, LiveTold):
        return {"live": told.reading}
    view, moment = told.view, told.view.moment
    shown = {"deformation": view.deformation, "travel": view.travel}
    if moment is not None:
        shown |= {"chain": asdict(moment.chain), "reading": moment.reading}  # type: ignore[dict-item]
    return {"view": told.name} | shown


def told_in(text: bytes) -> Told:
    """What a line says. Raises ValueError, KeyError or TypeError for what is none."""
    document: Mapping[str, Any] = json.loads(text)
    if "rig" in document:
        return RigTold(Chain(**document["rig"]))
    if "live" in document:
        return LiveTold(Reading(*document["live"]))
    moment = None
    if "reading" in document:
        moment = Moment(Chain(**document["chain"]), Reading(*document["reading"]))
    return ViewTold(document["view"], View(document["deformation"], document["travel"], moment))
