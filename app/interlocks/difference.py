"""What two tables differ in, detector by detector, in words."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass

from app.definitions.difference import ChangeKind
from app.interlocks.detector import Detector
from app.interlocks.table import Interlocks
from app.link.words import Judging
from rtcore.modes import Mode

_ALWAYS = "always"


@dataclass(frozen=True)
class DetectorChange:
    """What became of a detector: `threshold 55,000 N, was 50,000 N`, a line each."""

    detector: str
    kind: ChangeKind
    lines: tuple[str, ...]


@dataclass(frozen=True)
class TableDifference:
    """All that differs. `reordered` is whether detectors that are in both change places."""

    detectors: tuple[DetectorChange, ...]
    reordered: bool


def difference(before: Interlocks, after: Interlocks) -> TableDifference:
    """From one table to another, in the order of the latter; what is gone comes last."""
    was = {d.name: d for d in before.detectors}
    now = {d.name: d for d in after.detectors}
    changes = [*_changed(was, now), *_removed(was, now)]
    kept_before = [name for name in was if name in now]
    return TableDifference(tuple(changes), kept_before != [name for name in now if name in was])


def in_a_line(detector: Detector) -> str:
    """All of a detector: `Force, limit 55,000 N, at once: shutdown; armed when ready, running`."""
    judging = Judging.of_detector(detector)
    watched = ", ".join(part for part in (judging.name(), judging.limit()) if part)
    action = f"{_persistence(detector)}: {detector.action.name.lower()}"
    armed = _armed(detector)
    when = armed if armed == _ALWAYS else f"when {armed}"
    return f"{watched}, {action}; armed {when}{'' if detector.enabled else '; switched off'}"


def _changed(was: dict[str, Detector], now: dict[str, Detector]) -> Iterator[DetectorChange]:
    for name, detector in now.items():
        if name not in was:
            yield DetectorChange(name, ChangeKind.ADDED, (in_a_line(detector),))
        elif detector != was[name]:
            yield DetectorChange(name, ChangeKind.CHANGED, tuple(_lines(was[name], detector)))


def _removed(was: dict[str, Detector], now: dict[str, Detector]) -> Iterator[DetectorChange]:
    for name, detector in was.items():
        if name not in now:
            yield DetectorChange(name, ChangeKind.REMOVED, (in_a_line(detector),))


def _lines(before: Detector, after: Detector) -> Iterator[str]:
    for field, tell in _TOLD.items():
        old, new = tell(before), tell(after)
        if old != new:
            yield f"{field}: {new or 'none'}, was {old or 'none'}"


def _watches(d: Detector) -> str:
    return Judging.of_detector(d).name()


def _limit(d: Detector) -> str:
    judging = Judging.of_detector(d)
    return judging.limit() or f"above {d.threshold:g}"


def _persistence(d: Detector) -> str:
    return f"after {1e3 * d.persistence_s:g} ms" if d.persistence_s else "at once"


def _armed(d: Detector) -> str:
    return _ALWAYS if set(d.armed) == set(Mode) else ", ".join(m.name.lower() for m in d.armed)


_TOLD: dict[str, Callable[[Detector], str]] = {
    "watches": _watches,
    "compares": lambda d: d.comparison.name.lower().replace("_", " "),
    "limit": _limit,
    "smoothed over": lambda d: f"{1e3 * d.smoothing_s:g} ms" if d.smoothing_s else "",
    "persistence": _persistence,
    "action": lambda d: d.action.name.lower(),
    "armed": _armed,
    "latches": lambda d: "yes" if d.latching else "no",
    "switched": lambda d: "on" if d.enabled else "off",
    "text": lambda d: d.text,
}
