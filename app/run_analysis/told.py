"""An analysis as it is told and kept."""

from app.analysis.damage import class_width_n, damages, matrix, spectrum
from app.analysis.rainflow_counting import GATE_N, CountedCycles
from app.analysis.slow_reader import SlowSine
from app.analysis.time_domain import Layer, Step, TimeDomain
from app.analysis.uncertainty import COVERAGE
from app.run_analysis.schemas import (
    ControlOut,
    DamageOut,
    HarmonicOut,
    LayerOut,
    LikenessOut,
    MatrixCellOut,
    RainflowOut,
    RangeClassOut,
    RunAnalysis,
    SineOut,
    SpreadOut,
    StepOut,
    UncertaintyOut,
    UnitOut,
)


def told(
    time: TimeDomain, asked: CountedCycles, applied: CountedCycles, period_s: float
) -> RunAnalysis:
    """What was found of a run, in the words of the interface."""
    return RunAnalysis(
        layers=[_layer(layer) for layer in time.layers],
        layers_in_all=time.layers_in_all,
        steps=[_step(step, period_s) for step in time.steps],
        steps_in_all=time.steps_in_all,
        unit=[unit_out(one) for one in time.slow],
        goodness=None if time.likeness is None else LikenessOut.model_validate(time.likeness),
        rainflow=_rainflow(asked, applied),
        damage=[DamageOut.model_validate(one) for one in damages(asked, applied)],
        uncertainty=UncertaintyOut.model_validate(
            {"coverage": COVERAGE, **time.measured._asdict()}
        ),
        control=ControlOut.model_validate(time.controlled),
    )


def _layer(layer: Layer) -> LayerOut:
    found, cycles = layer.found, layer.cycles
    names = ("amplitude_n", "mean_n", "phase_deg", "amplitude_error_percent", "distortion_percent")
    spreads = {
        "peak_n": cycles.peak_n,
        "valley_n": cycles.valley_n,
        "cycle_mean_n": cycles.mean_n,
        "range_n": cycles.range_n,
    }
    return LayerOut.model_validate(
        {
            "block": layer.block,
            "asked": None if layer.sine is None else SineOut.model_validate(layer.sine),
            "cycles": cycles.count,
            **{name: None if found is None else getattr(found, name) for name in names},
            "mean_error_n": layer.mean_error_n,
            **{name: SpreadOut.model_validate(spread) for name, spread in spreads.items()},
            "harmonics": [HarmonicOut.model_validate(one) for one in layer.harmonics],
        }
    )


def _step(step: Step, period_s: float) -> StepOut:
    response = step.response
    return StepOut(
        block=step.block,
        time_s=round(step.program_tick * period_s, 9),
        begin_n=step.begin_n,
        end_n=step.end_n,
        dead_time_s=response.dead_time_s,
        rise_s=response.rise_s,
        overshoot_percent=response.overshoot_percent,
        settling_s=response.settling_s,
        steady_error_n=response.steady_error,
    )


def unit_out(slow: SlowSine) -> UnitOut:
    """The unit as slow cycles show it, as it is told."""
    asked = SineOut.model_validate(slow.sine)
    return UnitOut.model_validate({"block": slow.block, "asked": asked, **slow.unit._asdict()})


def _rainflow(asked: CountedCycles, applied: CountedCycles) -> RainflowOut:
    class_n = class_width_n(asked, applied)
    return RainflowOut(
        gate_n=GATE_N,
        class_n=class_n,
        asked_cycles=asked.cycles,
        applied_cycles=applied.cycles,
        asked_largest_range_n=asked.largest_range_n,
        applied_largest_range_n=applied.largest_range_n,
        spectrum=[RangeClassOut.model_validate(one) for one in spectrum(asked, applied)],
        matrix=[MatrixCellOut.model_validate(one) for one in matrix(applied, class_n)],
    )
