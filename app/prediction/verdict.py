"""From what was predicted to a verdict: a table of rules, each with its limits and a sentence to act on."""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass

from app.interlocks.table import Detector, Interlocks
from app.link.words import NAMED, QUANTITIES, Judging
from app.prediction.schemas import (
    BlockPrediction,
    CriterionOut,
    Margin,
    Peaks,
    PredictionVerdict,
    Reason,
    Severity,
    Valve,
)
from app.prediction.watch import SENSORS
from app.recording.outcome import Ending, Outcome
from rtcore.interlocks import Action, Quantity

# Of the threshold. A load of 50 kN is what the rig is made for, and its trip at 55 kN is no more than 10 % above.
LEAST_MARGIN_SHARE = {Quantity.FORCE_N: 0.05}
LEAST_MARGIN_SHARE_ELSE = 0.10
SATURATED_REFUSED_S, SATURATED_CAUTION_S = 0.05, 0.005  # in one stretch
SATURATED_REFUSED_SHARE, SATURATED_CAUTION_SHARE = 0.10, 0.01  # of a block …
SATURATED_REFUSED_IN_ALL_S, SATURATED_CAUTION_IN_ALL_S = (
    0.02,
    0.005,
)  # … and in all of it: a step is none
AMPLITUDE_ERROR_SHARE = 0.20
DROOP_SHARE = 0.15  # of the pump's pressure


@dataclass(frozen=True)
class Worst:
    """The longest stretch of a saturated valve: how long, in which block, when it ended."""

    duration_s: float
    block: int | None
    time_s: float


@dataclass(frozen=True)
class Findings:
    """Everything that the rules look at."""

    ending: Ending
    margins: Sequence[Margin]
    interlocks: Interlocks
    valve: Valve
    saturated: Worst
    peaks: Peaks
    supply_pa: float
    blocks: Sequence[BlockPrediction]
    amplitude_errors: Sequence[tuple[int, float]]  # block, and share of what was asked for
    criteria: Sequence[CriterionOut]
    apart: Sequence[tuple[int, int]]


Rule = Callable[[Findings], Iterator[Reason]]


def _trips(found: Findings) -> Iterator[Reason]:
    detectors = {d.name: d for d in found.interlocks.detectors}
    for margin in found.margins:
        if margin.margin is None or margin.margin >= 0:
            continue
        detector = detectors[margin.detector]
        where = _where(margin.block, margin.time_s)
        text = (
            f"{_reached(detector, margin, where)}: the interlock {detector.name}"
            f" {_DOES[detector.action]}. {_REMEDY.get(detector.quantity, '')}"
        ).rstrip()
        severity: Severity = "refused" if detector.action >= Action.HOLD else "caution"
        yield _reason("detector_trips", text, severity, margin.block, margin.time_s)


def _reached(detector: Detector, margin: Margin, where: str) -> str:
    """`Force would reach 56,000 N in block 2 at 1.20 s, limit 55,000 N`."""
    judging = Judging.of_detector(detector)
    reached = "not a number" if margin.extreme is None else judging.write(margin.extreme)
    if detector.quantity in NAMED:
        return f"{judging.name()} would be {reached}{where}"
    lasting = f" for {detector.persistence_s * 1e3:g} ms" if detector.persistence_s else ""
    return f"{judging.name()} would reach {reached}{lasting}{where}, {judging.limit()}"


_DOES = {
    Action.INDICATE: "would come up",
    Action.HOLD: "would hold the test",
    Action.STOP: "would stop the test",
    Action.SHUTDOWN: "would shut the rig down",
}
_GENTLER = "Ask for less load there, or for a slower change"
_COMPENSATE = "Turn on compensation of amplitude, or ask for a lower frequency"
_REMEDY = {
    **dict.fromkeys(
        (Quantity.FORCE_N, Quantity.FORCE_ERROR_N, Quantity.VALVE_SATURATION), _GENTLER
    ),
    **dict.fromkeys((Quantity.FORCE_ERROR_RELATIVE, Quantity.UNDERPEAK), _COMPENSATE),
    Quantity.DISPLACEMENT_M: "Ask for less motion there",
    Quantity.DISPLACEMENT_ERROR_M: "Ask for a slower motion there",
    Quantity.VELOCITY_M_S: "Ask for a slower motion there, or for less load at a high frequency",
    Quantity.SUPPLY_PRESSURE_PA: "Ask for less at a time, or raise the supply pressure",
    **dict.fromkeys(SENSORS, _GENTLER),
}


def _does_not_complete(found: Findings) -> Iterator[Reason]:
    explained = any(reason.severity == "refused" for reason in _trips(found))
    if not (_completes(found) or explained):
        why = found.ending.reason or "the loop does not say why"
        yield _reason("does_not_complete", f"The test would not run to its end: {why}", "refused")


def _completes(found: Findings) -> bool:
    return found.ending.outcome is Outcome.COMPLETED


def _saturates(found: Findings) -> Iterator[Reason]:
    worst = found.saturated
    if worst.duration_s >= SATURATED_CAUTION_S:
        severity: Severity = "refused" if worst.duration_s >= SATURATED_REFUSED_S else "caution"
        text = (
            f"The valve would be at its limit for {worst.duration_s * 1e3:.0f} ms"
            f"{_where(worst.block, worst.time_s)}: nothing controls the force meanwhile. {_GENTLER}"
        )
        yield _reason("valve_saturates", text, severity, worst.block, worst.time_s)


def _saturates_often(found: Findings) -> Iterator[Reason]:
    for block in found.blocks if _completes(found) else ():
        share, in_all_s = block.saturation_share or 0.0, block.saturated_s or 0.0
        if share < SATURATED_CAUTION_SHARE or in_all_s < SATURATED_CAUTION_IN_ALL_S:
            continue
        often = share >= SATURATED_REFUSED_SHARE and in_all_s >= SATURATED_REFUSED_IN_ALL_S
        text = (
            f"The valve would be at its limit for {100 * share:.0f} % of block {block.index + 1}:"
            f" its load would not be what is asked for. {_GENTLER}"
        )
        yield _reason("valve_saturates_often", text, "refused" if often else "caution", block.index)


def _little_margin(found: Findings) -> Iterator[Reason]:
    """Of what acts: an indication that comes up does no harm."""
    detectors = {d.name: d for d in found.interlocks.detectors if d.action > Action.INDICATE}
    for margin in found.margins:
        share, detector = margin.margin_share, detectors.get(margin.detector)
        if detector is None or share is None or margin.extreme is None:
            continue
        if not 0 <= share < LEAST_MARGIN_SHARE.get(detector.quantity, LEAST_MARGIN_SHARE_ELSE):
            continue
        judging = Judging.of_detector(detector)
        text = (
            f"{judging.name()} would reach {judging.write(margin.extreme)}"
            f"{_where(margin.block, margin.time_s)}: {100 * share:.0f} % from the limit {judging.allowed()}"
            f" of the interlock {margin.detector}"
        )
        yield _reason("little_margin", text, "caution", margin.block, margin.time_s)


def _amplitude(found: Findings) -> Iterator[Reason]:
    for block, error in found.amplitude_errors if _completes(found) else ():
        if abs(error) > AMPLITUDE_ERROR_SHARE:
            more = "more" if error > 0 else "less"
            text = (
                f"The amplitude of block {block + 1} would be {100 * abs(error):.0f} % {more} than"
                " what is asked for"
            )
            yield _reason("amplitude_error", text, "caution", block)


def _droop(found: Findings) -> Iterator[Reason]:
    droop_pa = found.peaks.pressure_droop_pa
    if droop_pa is not None and droop_pa > DROOP_SHARE * found.supply_pa:
        write = QUANTITIES[Quantity.SUPPLY_PRESSURE_PA].write
        text = (
            f"The supply pressure would droop by {write(droop_pa)} of {write(found.supply_pa)}:"
            " the pump does not keep up"
        )
        yield _reason("pressure_droop", text, "caution")


def _criteria(found: Findings) -> Iterator[Reason]:
    for c in found.criteria if _completes(found) else ():
        if c.outcome == "fail":
            value = "not a number" if c.value is None else f"{c.value:,.4g} {c.unit}"
            limits = [f"at least {c.at_least:,g}"] if c.at_least is not None else []
            limits += [f"at most {c.at_most:,g}"] if c.at_most is not None else []
            where = "" if c.block is None else f" of block {c.block + 1}"
            text = (
                f"The test would not pass: {c.measurement}{where} would be {value},"
                f" asked for is {' and '.join(limits)}"
            )
            yield _reason("criterion_fails", text, "caution", c.block)


def _apart(found: Findings) -> Iterator[Reason]:
    for block, motion in found.apart:
        text = (
            f"Block {block + 1} under motion {motion + 1} is not predicted as it will run: the test is too"
            " long for all of it, and in what was predicted they do not meet at every phase, or not as long"
        )
        yield _reason("not_predicted", text, "caution", block)


RULES: tuple[Rule, ...] = (
    _trips,
    _does_not_complete,
    _saturates,
    _saturates_often,
    _little_margin,
    _amplitude,
    _droop,
    _criteria,
    _apart,
)


def reasons_of(found: Findings) -> list[Reason]:
    """Everything that stands against a test; what refuses it first."""
    reasons = [reason for rule in RULES for reason in rule(found)]
    return sorted(reasons, key=lambda reason: reason.severity != "refused")


def verdict_of(reasons: Sequence[Reason]) -> PredictionVerdict:
    """As bad as the worst reason."""
    severities = {reason.severity for reason in reasons}
    for verdict in (PredictionVerdict.REFUSED, PredictionVerdict.CAUTION):
        if verdict.value in severities:
            return verdict
    return PredictionVerdict.CLEAR


def _reason(
    code: str,
    text: str,
    severity: Severity,
    block: int | None = None,
    time_s: float | None = None,
) -> Reason:
    sentence = text.strip().removesuffix(".")
    return Reason(code=code, text=sentence, severity=severity, block=block, time_s=time_s)


def _where(block: int | None, time_s: float | None) -> str:
    """` in block 3 at 1.25 s`."""
    place = "" if block is None or block < 0 else f" in block {block + 1}"
    return place if time_s is None else f"{place} at {time_s:,.2f} s"
