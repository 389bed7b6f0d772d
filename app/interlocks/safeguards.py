"""The detectors that no table goes without unless it says so: what stands between a fault and a person."""

from collections.abc import Iterator
from dataclasses import dataclass

from app.documents.messages import nearest
from app.errors import Code, Fault, Refusal
from app.interlocks.defaults import default_interlocks
from app.interlocks.detector import Detector
from app.interlocks.table import Interlocks
from app.link.words import Judging
from rtcore.interlocks import Comparison

GUARDED = ("force", "load_cell", "app_silence", "deadlines_missed", "hard_wired_chain")


@dataclass(frozen=True)
class Shortfall:
    """A guarded detector that a table falls short of: `its limit is 58,000 N, as shipped 55,000 N`."""

    detector: str
    text: str


def shortfalls(interlocks: Interlocks) -> tuple[Shortfall, ...]:
    """By which guarded detectors a table is weaker than the shipped one, whatever its own are called."""
    shipped = {d.name: d for d in default_interlocks().detectors}
    found = ((name, _weakness(interlocks, shipped[name])) for name in GUARDED)
    return tuple(Shortfall(name, text) for name, text in found if text)


def adoptable(interlocks: Interlocks) -> Interlocks | Refusal:
    """The table with no more words given than are needed, or why it cannot be adopted."""
    unknown = _unknown(interlocks)
    if unknown:
        detail = "; ".join(f"{fault.path}: {fault.expected}" for fault in unknown)
        return Refusal(Code.INVALID_REQUEST, detail, unknown)
    short = shortfalls(interlocks)
    unsaid = [s for s in short if s.detector not in interlocks.knowingly_weaker]
    if unsaid:
        return _weakened(unsaid)
    needed = tuple(s.detector for s in short)
    return interlocks.model_copy(update={"knowingly_weaker": needed})


def _weakness(interlocks: Interlocks, guarded: Detector) -> str:
    """How the strongest of those that watch the same falls short; empty where one does not."""
    same = [d for d in interlocks.detectors if _watches(d) == _watches(guarded)]
    if not same:
        return "there is none"
    texts = [", ".join(_weaker(d, guarded)) for d in same]
    return min(texts, key=len)


def _watches(d: Detector) -> tuple[object, ...]:
    return d.quantity, d.form, d.comparison


def _weaker(d: Detector, guarded: Detector) -> Iterator[str]:
    if not d.enabled:
        yield "it is switched off"
        return
    below = d.comparison is Comparison.BELOW
    if d.threshold < guarded.threshold if below else d.threshold > guarded.threshold:
        judging = Judging.of_detector(guarded)
        limits = (judging.write(d.threshold), judging.write(guarded.threshold))
        yield f"its limit is {limits[0]}, as shipped {limits[1]}"
    if d.persistence_s > guarded.persistence_s:
        yield f"it waits {d.persistence_s:g} s, as shipped {guarded.persistence_s:g} s"
    if d.action < guarded.action:
        words = (d.action.name.lower(), guarded.action.name.lower())
        yield f"its action is {words[0]}, as shipped {words[1]}"
    missing = [mode.name.lower() for mode in guarded.armed if mode not in d.armed]
    if missing:
        yield f"it is not armed when {', '.join(missing)}"


def _weakened(unsaid: list[Shortfall]) -> Refusal:
    told = "; ".join(f"{s.detector}: {s.text}" for s in unsaid)
    names = ", ".join(s.detector for s in unsaid)
    detail = (
        f"Weaker than shipped where it protects people ({told}). To adopt it all the same, name it in"
        f" knowingly_weaker: {names}"
    )
    shown = [{"detector": s.detector, "text": s.text} for s in unsaid]
    return Refusal(Code.INTERLOCKS_WEAKENED, detail, about={"weakened": shown})


def _unknown(interlocks: Interlocks) -> tuple[Fault, ...]:
    def known(name: str) -> str:
        return f"no guarded detector{nearest(name, GUARDED) or '; there are ' + ', '.join(GUARDED)}"

    return tuple(
        Fault(f"knowingly_weaker[{i}]", name, known(name))
        for i, name in enumerate(interlocks.knowingly_weaker)
        if name not in GUARDED
    )
