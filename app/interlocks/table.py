"""The table of detectors: frozen, bounded, and without contradictions."""

from collections.abc import Iterator
from typing import Any, Self

from pydantic import Field, model_validator

from app.documents.fields import Document, all_wrong, wrong
from app.documents.tree import Path
from app.interlocks.detector import Detector, Name
from app.interlocks.sense import faults_of
from rtcore.interlocks import MAX_DETECTORS

__all__ = ["Detector", "Interlocks"]


class Interlocks(Document):
    """All detectors, in the order in which the loop evaluates them.

    `knowingly_weaker` names the guarded detectors (`app.interlocks.safeguards`) that this table falls
    short of on purpose.
    """

    detectors: tuple[Detector, ...] = Field(min_length=1, max_length=MAX_DETECTORS)
    knowingly_weaker: tuple[Name, ...] = Field(default=(), max_length=MAX_DETECTORS)

    @model_validator(mode="after")
    def _makes_sense(self) -> Self:
        found = [*self._named_twice(), *self._senseless()]
        if found:
            raise all_wrong("Interlocks", found)
        return self

    def _named_twice(self) -> Iterator[tuple[Path, Any]]:
        names = [detector.name for detector in self.detectors]
        for i, name in enumerate(names):
            if name in names[:i]:
                yield ("detectors", i), wrong("name", f"two detectors are named {name}", value=name)

    def _senseless(self) -> Iterator[tuple[Path, Any]]:
        for i, detector in enumerate(self.detectors):
            yield from ((("detectors", i), fault) for fault in faults_of(detector))
