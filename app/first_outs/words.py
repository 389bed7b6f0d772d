"""What a replay or a re-run came to, in words."""

from collections.abc import Iterable, Sequence

from app.documents.units import say, unit_of
from app.first_outs.account import PeakKept, TripKept
from app.first_outs.changes import Changed
from rtcore.interlocks import Action

_STRENGTH = {action.name.lower(): int(action) for action in Action}
_NAMES = {"force_n": "Peak force", "displacement_m": "peak displacement"}
_SAME_SHARE = 0.01


def first_out_among(trips: Iterable[TripKept], order: Sequence[str]) -> TripKept | None:
    """The first that takes the load off; of several in a tick the strongest, then the table's order."""
    places = {name: i for i, name in enumerate(order)}
    ending = [t for t in trips if _STRENGTH[t.action] >= Action.STOP]
    return min(
        ending,
        key=lambda t: (t.tick, -_STRENGTH[t.action], places.get(t.detector, len(places))),
        default=None,
    )


def made_text(made: Sequence[Changed]) -> str:
    """`With interlocks.force_error.threshold at 20,000 instead of 15,000`."""
    parts = [
        f"{one.path} at {_value(one, one.value)} instead of {_value(one, one.before)}"
        for one in made
    ]
    return "With " + " and ".join(parts)


def _value(one: Changed, value: object) -> str:
    if isinstance(value, float) and 0 < abs(value) < 1e-3:
        return f"{value:.4g}"
    return say(value, unit_of(one.path) if isinstance(value, int | float) else None)


def replayed_text(
    recorded: TripKept, found: TripKept | None, made: Sequence[Changed], *, reproduces: bool
) -> str:
    """What would have happened over the recorded ticks."""
    doubt = "" if reproduces else " As it was, the replay does not trip exactly as the loop did."
    if not made:
        told = "exactly as the loop did" if reproduces else "not exactly as the loop did"
        return f"Over the recorded ticks the detectors trip {told}."
    what = made_text(made)
    if found is None or found.time_s > 0:
        later = (
            ""
            if found is None
            else f" ({found.detector} trips {_after(found.time_s)}, but of a rig that was being stopped)"
        )
        return (
            f"{what} nothing would have taken the load off when {recorded.detector} did{later}."
            f" What the rig would have done from there on, a re-run tells.{doubt}"
        )
    if found.detector == recorded.detector and found.time_s == 0:
        return f"{what} {found.detector} would have tripped in the very same tick.{doubt}"
    when = "in the same tick" if found.time_s == 0 else f"{_lasting(found.time_s)} earlier"
    return f"{what} {found.detector} would have tripped {when}: {found.text}.{doubt}"


def rerun_text(
    made: Changed,
    recorded: TripKept,
    unchanged: tuple[TripKept | None, Sequence[PeakKept]],
    changed: tuple[TripKept | None, Sequence[PeakKept]],
) -> list[str]:
    """What the change did on the virtual rig, sentence by sentence."""
    was, now = unchanged[0], changed[0]
    told = [_unchanged_text(recorded, was), f"{made_text([made])} {_then(was, now)}."]
    told += [
        text for text in (_peak_text(name, unchanged[1], changed[1]) for name in _NAMES) if text
    ]
    return told


def _unchanged_text(recorded: TripKept, was: TripKept | None) -> str:
    if was is None:
        return (
            "Unchanged, nothing trips on the virtual rig: what tripped the rig is not in the model,"
            " in the test or in the injected faults."
        )
    if was.detector != recorded.detector:
        instead = f"{was.detector} trips first on the virtual rig, not {recorded.detector}"
        return f"Unchanged, {instead}, {_after(was.time_s)}."
    return f"Unchanged, {was.detector} trips on the virtual rig too, {_after(was.time_s)}."


def _then(was: TripKept | None, now: TripKept | None) -> str:
    if now is None:
        return "nothing trips until two seconds after" if was else "nothing trips either"
    if was is None:
        return f"{now.detector} trips {_after(now.time_s)}: {now.text}"
    apart_s = now.time_s - was.time_s
    if now.detector == was.detector:
        if apart_s == 0:
            return f"{now.detector} trips in the very same tick"
        return f"{now.detector} trips {_lasting(apart_s)} {'later' if apart_s > 0 else 'earlier'}"
    return f"{now.detector} trips in place of {was.detector}, {_after(now.time_s)}: {now.text}"


def _peak_text(name: str, before: Sequence[PeakKept], after: Sequence[PeakKept]) -> str:
    was, now = (_greatest(name, peaks) for peaks in (before, after))
    if was is None or now is None:
        return ""
    shown = _peak(name, now)
    if abs(now - was) <= _SAME_SHARE * max(abs(was), 1e-12):
        return f"{_NAMES[name].capitalize()} stays at {shown}."
    return f"{_NAMES[name].capitalize()} is {shown} instead of {_peak(name, was)}."


def _greatest(name: str, peaks: Sequence[PeakKept]) -> float | None:
    values = [
        abs(v) for p in peaks if p.channel == name for v in (p.before, p.after) if v is not None
    ]
    return max(values, default=None)


def _peak(name: str, value: float) -> str:
    return f"{value:,.0f} N" if name == "force_n" else f"{value * 1e3:,.2f} mm"


def _after(time_s: float) -> str:
    if time_s == 0:
        return "at the same program time"
    return f"{_lasting(time_s)} {'after' if time_s > 0 else 'before'} the recorded first-out"


def _lasting(time_s: float) -> str:
    return f"{abs(time_s) * 1e3:,.4g} ms" if abs(time_s) < 1 else f"{abs(time_s):,.3g} s"
