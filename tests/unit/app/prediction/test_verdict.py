"""Each rule of the verdict, at its limit and beside it."""

from dataclasses import replace
from typing import Any

import pytest

from app.interlocks.defaults import default_interlocks
from app.prediction.schemas import (
    BlockPrediction,
    CriterionOut,
    Margin,
    Peaks,
    PredictionVerdict,
    Valve,
)
from app.prediction.verdict import Findings, Worst, reasons_of, verdict_of
from app.recording.outcome import Ending, Outcome

CLEAR, CAUTION, REFUSED = PredictionVerdict


def _margin(detector: str, share: float, **more: Any) -> Margin:
    found = next(d for d in default_interlocks().detectors if d.name == detector)
    values: dict[str, Any] = {
        "detector": detector,
        "quantity": found.quantity.name.lower(),
        "unit": found.unit,
        "threshold": found.threshold,
        "extreme": found.threshold * (1 - share),
        "margin": found.threshold * share,
        "margin_share": share,
        "tick": 4000,
        "time_s": 1.0,
        "block": 1,
        "action": found.action.name.lower(),
        "predicted": True,
    }
    return Margin(**values | more)


def _block(share: float, saturated_s: float) -> BlockPrediction:
    return BlockPrediction(
        index=0,
        kind="harmonic",
        force_error_rms_n=1.0,
        force_error_peak_n=1.0,
        peak_force_n=1.0,
        saturation_share=share,
        saturated_s=saturated_s,
        longest_saturation_s=0.001,
    )


def _peaks(droop_pa: float) -> Peaks:
    return Peaks(**dict.fromkeys(Peaks.model_fields, 0.0) | {"pressure_droop_pa": droop_pa})


def _criterion(outcome: str) -> CriterionOut:
    return CriterionOut.model_validate(
        {
            "measurement": "peak_force_n",
            "unit": "N",
            "block": None,
            "value": 3.0,
            "at_least": None,
            "at_most": 2.0,
            "outcome": outcome,
        }
    )


FINE = Findings(
    ending=Ending(Outcome.COMPLETED, None),
    margins=[_margin("force", 0.5), _margin("supply_pressure", 0.3)],
    interlocks=default_interlocks(),
    valve=Valve(peak=0.5, saturation_share=0.0, longest_saturation_s=0.0),
    saturated=Worst(0.0, None, 0.0),
    peaks=_peaks(1e6),
    supply_pa=21e6,
    blocks=[_block(0.0, 0.0)],
    amplitude_errors=[(0, 0.05)],
    criteria=[_criterion("pass")],
    apart=[],
)


@pytest.mark.parametrize(
    ("change", "code", "verdict"),
    [
        ({}, None, CLEAR),
        ({"margins": [_margin("force", -0.01)]}, "detector_trips", REFUSED),
        ({"margins": [_margin("force", 0.04)]}, "little_margin", CAUTION),
        ({"margins": [_margin("force", 0.06)]}, None, CLEAR),
        ({"margins": [_margin("velocity", 0.09)]}, "little_margin", CAUTION),
        ({"margins": [_margin("velocity", 0.11)]}, None, CLEAR),
        ({"margins": [_margin("app_silence", 0.0, extreme=None, margin=None, margin_share=None)]}, None, CLEAR),
        ({"saturated": Worst(0.0049, 0, 1.0)}, None, CLEAR),
        ({"saturated": Worst(0.005, 0, 1.0)}, "valve_saturates", CAUTION),
        ({"saturated": Worst(0.05, 0, 1.0)}, "valve_saturates", REFUSED),
        ({"blocks": [_block(0.009, 1.0)]}, None, CLEAR),
        ({"blocks": [_block(0.5, 0.004)]}, None, CLEAR),
        ({"blocks": [_block(0.02, 0.01)]}, "valve_saturates_often", CAUTION),
        ({"blocks": [_block(0.2, 0.01)]}, "valve_saturates_often", CAUTION),
        ({"blocks": [_block(0.2, 0.03)]}, "valve_saturates_often", REFUSED),
        ({"amplitude_errors": [(0, 0.21)]}, "amplitude_error", CAUTION),
        ({"amplitude_errors": [(0, -0.21)]}, "amplitude_error", CAUTION),
        ({"peaks": _peaks(3.2e6)}, "pressure_droop", CAUTION),
        ({"peaks": _peaks(3.1e6)}, None, CLEAR),
        ({"criteria": [_criterion("fail")]}, "criterion_fails", CAUTION),
        ({"criteria": [_criterion("unset")]}, None, CLEAR),
        ({"apart": [(2, 1)]}, "not_predicted", CAUTION),
        ({"ending": Ending(Outcome.TRIPPED, "Something tripped")}, "does_not_complete", REFUSED),
    ],
)  # fmt: skip
def test_each_rule_speaks_from_its_limit_on(
    change: dict[str, Any], code: str | None, verdict: PredictionVerdict
) -> None:
    reasons = reasons_of(replace(FINE, **change))
    assert [reason.code for reason in reasons] == ([] if code is None else [code])
    assert verdict_of(reasons) is verdict


def test_what_refuses_comes_first_and_a_trip_explains_the_end() -> None:
    found = replace(
        FINE,
        margins=[_margin("velocity", 0.05), _margin("force", -0.1)],
        ending=Ending(Outcome.TRIPPED, "Force 60,500 N, limit 55,000 N"),
        criteria=[_criterion("fail")],
    )
    reasons = reasons_of(found)
    assert [reason.code for reason in reasons] == ["detector_trips", "little_margin"]
    assert (
        reasons[0].text == "Force would reach 60,500 N in block 2 at 1.00 s, limit 55,000 N: "
        "the interlock force would shut the rig down. Ask for less load there, or for a slower change"
    )
    assert (reasons[0].block, reasons[0].time_s) == (1, 1.0)
