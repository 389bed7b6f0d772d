"""Whether the calibrations hold, in words."""

from datetime import date
from enum import StrEnum

from pydantic import BaseModel

from app.rig_configuration.configuration import Calibration, Calibrations

SOON_DAYS = 30


class CalibrationWord(StrEnum):
    """What is to be said of a calibration."""

    NONE = "none"  # was never entered
    VALID = "valid"
    DUE_SOON = "due_soon"
    OVERDUE = "overdue"


class CalibrationState(BaseModel):
    """A sensor's calibration on a day: `overdue since 2026-01-31`."""

    sensor: str
    word: CalibrationWord
    text: str


def calibration_states(calibrations: Calibrations, on: date) -> list[CalibrationState]:
    """Of every sensor, in the order of the document."""
    names = type(calibrations).model_fields
    return [_state(name, getattr(calibrations, name), on) for name in names]


def _state(sensor: str, calibration: Calibration, on: date) -> CalibrationState:
    word, text = _said(calibration, on)
    return CalibrationState(sensor=sensor, word=word, text=text)


def _said(calibration: Calibration, on: date) -> tuple[CalibrationWord, str]:
    made, due = calibration.calibrated_on, calibration.due_on
    if made is None:
        return CalibrationWord.NONE, "no calibration entered"
    if due is None:
        return CalibrationWord.VALID, f"calibrated on {made}, never due again"
    if due < on:
        return CalibrationWord.OVERDUE, f"overdue since {due}"
    if (due - on).days <= SOON_DAYS:
        return CalibrationWord.DUE_SOON, f"due on {due}"
    return CalibrationWord.VALID, f"valid until {due}"
