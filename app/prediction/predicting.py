"""A prediction: the test run on the virtual rig as the console has it, told as margins, peaks and a verdict."""

import math
import time
from dataclasses import dataclass, replace
from typing import Any, Literal

from app.analysis.measurements import MEASUREMENTS
from app.definitions.definition import Definition
from app.definitions.limits import RIG
from app.definitions.outline import outline
from app.errors import Refusal
from app.interlocks.table import Interlocks
from app.prediction.agreement import same_ticks
from app.prediction.judgement import Judged, Judgement
from app.prediction.key import key_of
from app.prediction.margins import margins_of
from app.prediction.play import Progress, ignore
from app.prediction.schemas import (
    BlockPrediction,
    CriterionOut,
    CutOut,
    MeasurementOut,
    Peaks,
    Prediction,
    PredictionVerdict,
    Reason,
    Valve,
)
from app.prediction.setup import Setup
from app.prediction.shortening import Shortened, shorten
from app.prediction.through import Through, run_through
from app.prediction.verdict import Findings, Worst, reasons_of, verdict_of
from app.prediction.watch import Watch
from rtcore.modes import Mode

_OF_BLOCK = (
    *("force_error_rms_n", "force_error_peak_n", "peak_force_n"),
    *("saturation_share", "saturated_s", "longest_saturation_s"),
)
LEAST_SWING_N = 1.0  # rms: of less, an amplitude error means nothing


@dataclass(frozen=True)
class Predicted:
    """A prediction, and the run on the virtual rig that it is of; none where the rig cannot have it."""

    prediction: Prediction
    through: Through | None
    same_ticks: int  # of the program, over which prediction and test are one and the same

    @property
    def nbytes(self) -> int:
        """What it takes in memory, nearly."""
        return 100_000 + (0 if self.through is None else self.through.series.nbytes)


def predict(setup: Setup, progress: Progress = ignore) -> Predicted:
    """Predict a test, one of whatever repeats in it where it is long."""
    began = time.perf_counter()
    shortened = shorten(setup.definition, _longest_wait_s(setup.interlocks))
    through = run_through(replace(setup, definition=shortened.definition), progress)
    took_s = time.perf_counter() - began
    if isinstance(through, Refusal):
        return Predicted(_impossible(setup, through, took_s), None, 0)
    prediction = prediction_of(setup, shortened, through, took_s)
    kept = len(through.series.force_n)
    return Predicted(prediction, through, same_ticks(setup.definition, shortened.definition, kept))


def _longest_wait_s(interlocks: Interlocks) -> float:
    """For how long a detector of a running test wants to see what it trips at."""
    waits = (d.persistence_s for d in interlocks.detectors if d.enabled and Mode.RUNNING in d.armed)
    return max(waits, default=0.0)


def prediction_of(
    setup: Setup, shortened: Shortened, through: Through, took_s: float
) -> Prediction:
    """The prediction that a run on the virtual rig amounts to; `setup` is of the whole test."""
    watch = through.watch
    definition = shortened.definition
    left_out = outline(setup.definition).cycles - outline(definition).cycles
    margins = margins_of(setup.interlocks, watch, left_out)
    valve, peaks = _valve(watch), _peaks(watch, setup.rig.supply.high_pa)
    blocks = _blocks(definition, watch, through.judged)
    criteria = _criteria(through.judged, whole=not shortened.cuts)
    reasons = reasons_of(
        Findings(
            ending=through.ending,
            margins=margins,
            interlocks=setup.interlocks,
            valve=valve,
            saturated=_worst(watch),
            peaks=peaks,
            supply_pa=setup.rig.supply.high_pa,
            blocks=blocks,
            amplitude_errors=_amplitude_errors(watch),
            criteria=criteria,
            apart=shortened.apart,
        )
    )
    predicted_s = through.ticks * RIG.period_s
    return Prediction(
        verdict=verdict_of(reasons),
        reasons=reasons,
        duration_s=outline(setup.definition).duration_s,
        predicted_s=predicted_s,
        shortened=[CutOut(path=cut.path, text=cut.text) for cut in shortened.cuts],
        margins=margins,
        valve=valve,
        peaks=peaks,
        blocks=blocks,
        criteria=criteria,
        outcome=through.ending.outcome.value,
        reason=through.ending.reason,
        computed_in_s=took_s,
        speed=predicted_s / took_s,
        seed=setup.seed,
        key=key_of(setup),
    )


def _impossible(setup: Setup, refusal: Refusal, took_s: float) -> Prediction:
    """Of a test that this rig cannot even begin."""
    reason = Reason(code=refusal.code.value, text=refusal.detail, severity="refused")
    return Prediction(
        verdict=PredictionVerdict.REFUSED,
        reasons=[reason],
        duration_s=outline(setup.definition).duration_s,
        predicted_s=0.0,
        shortened=[],
        margins=[],
        valve=Valve(peak=0.0, saturation_share=0.0, longest_saturation_s=0.0),
        peaks=Peaks(**dict.fromkeys(Peaks.model_fields)),
        blocks=[],
        criteria=[],
        outcome="failed",
        reason=refusal.detail,
        computed_in_s=took_s,
        speed=0.0,
        seed=setup.seed,
        key=key_of(setup),
    )


def _valve(watch: Watch) -> Valve:
    seen = watch.seen
    return Valve(
        peak=float(seen["valve"]),
        saturation_share=int(seen["saturated"]) / max(1, int(seen["loaded"])),
        longest_saturation_s=int(seen["longest_saturated"]) * RIG.period_s,
    )


def _worst(watch: Watch) -> Worst:
    seen = watch.seen
    block = int(seen["longest_block"])
    return Worst(
        int(seen["longest_saturated"]) * RIG.period_s,
        block if block >= 0 else None,
        int(seen["longest_ended"]) * RIG.period_s,
    )


def _peaks(watch: Watch, supply_pa: float) -> Peaks:
    seen = watch.seen
    names = ("force_n", "displacement_m", "velocity_m_s", "supply_flow_m3_s", "force_error_n")
    droop_pa = supply_pa - float(seen["least_supply_pa"])
    return Peaks(
        **{name: float(seen[name]) for name in names},
        pressure_droop_pa=droop_pa if math.isfinite(droop_pa) else 0.0,
    )


def _blocks(definition: Definition, watch: Watch, judged: Judged) -> list[BlockPrediction]:
    pairs = zip(definition.blocks, watch.tallies, strict=True)
    return [
        BlockPrediction(
            index=i, kind=block.kind, measurements=_measured(judged, i), **_of_block(tally)
        )
        for i, (block, tally) in enumerate(pairs)
    ]


def _of_block(tally: Any) -> dict[str, float | None]:
    """What a TALLY comes to; nothing where the block was not reached."""
    ticks = int(tally["ticks"])
    if ticks == 0:
        return dict.fromkeys(_OF_BLOCK)
    values = (
        math.sqrt(float(tally["error_squares"]) / ticks),
        float(tally["error_peak_n"]),
        float(tally["peak_force_n"]),
        int(tally["saturated"]) / ticks,
        int(tally["saturated"]) * RIG.period_s,
        int(tally["longest_saturated"]) * RIG.period_s,
    )
    return dict(zip(_OF_BLOCK, values, strict=True))


def _measured(judged: Judged, block: int) -> list[MeasurementOut]:
    values = judged.measured.blocks.get(block, {})
    return [
        MeasurementOut(name=name, unit=MEASUREMENTS[name].unit, value=value)
        for name, value in values.items()
        if value is not None and math.isfinite(value)
    ]


def _amplitude_errors(watch: Watch) -> list[tuple[int, float]]:
    """Of each block that swings, by how much more or less than it is asked to."""
    found = []
    for i, tally in enumerate(watch.tallies):
        asked = float(tally["swing_asked"])
        if asked > LEAST_SWING_N**2 * int(tally["ticks"]):
            found.append((i, math.sqrt(float(tally["swing_had"]) / asked) - 1.0))
    return found


def _criteria(judged: Judged, *, whole: bool) -> list[CriterionOut]:
    """The criteria as judged; what grows with every cycle cannot be, where cycles were left out."""

    def outcome(c: Judgement) -> Literal["pass", "fail", "unset"]:
        unknown = MEASUREMENTS[c.measurement].grows and not whole
        return "unset" if unknown else c.outcome.value

    return [
        CriterionOut(
            measurement=c.measurement,
            unit=c.unit,
            block=c.block,
            value=c.value if c.value is not None and math.isfinite(c.value) else None,
            at_least=c.at_least,
            at_most=c.at_most,
            outcome=outcome(c),
        )
        for c in judged.criteria
    ]
