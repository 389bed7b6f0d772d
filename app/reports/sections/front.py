"""The first page: what was tested, by whom, on what, with what, and what it came to."""

from datetime import date, datetime

from app.documents.units import say
from app.reports.numbers import NOTHING, duration, moment, quantity, spoken
from app.reports.report import Column, Facts, Item, Row, Table, Tone, Verdict, Words
from app.reports.subject import Document, Subject
from app.rig_configuration.configuration import Calibration, Calibrations, TypePlate
from app.rig_configuration.due import CalibrationWord, calibration_states
from app.rig_configuration.record import KEY, configuration_of
from app.runs.results_schemas import JudgedCriterion

TONES = {"pass": Tone.GOOD, "fail": Tone.BAD, "unset": Tone.QUIET}
WORDS = {"pass": "PASSED", "fail": "FAILED", "unset": "NO VERDICT"}


def verdict_of(subject: Subject) -> Verdict:
    """Its verdict in a word, and how it ended in a sentence."""
    judged = subject.measured.verdict
    met = sum(c.outcome == "pass" for c in subject.measured.criteria)
    asked = len(subject.measured.criteria)
    criteria = f"{met} of {asked} criteria met" if asked else "The test asks for nothing"
    ended = f"{subject.outcome.capitalize()} after {duration(subject.ticks * subject.period_s)}"
    because = f": {subject.reason}" if subject.reason else ""
    return Verdict(WORDS[judged], f"{criteria}. {ended}{because}", TONES[judged])


def about(subject: Subject) -> tuple[Item, ...]:
    """Everything on the first page below the verdict."""
    items: list[Item] = [Facts(tuple(_facts(subject)))]
    description = str(subject.frozen.definition.get("description") or "")
    if description:
        items.append(Words(description, Tone.QUIET))
    if subject.noted.notes:
        items.append(Words(subject.noted.notes))
    if subject.measured.criteria:
        items.append(_criteria(subject))
    return tuple(items)


def _facts(subject: Subject) -> list[tuple[str, str]]:
    frozen, noted = subject.frozen, subject.noted
    revision = "" if subject.revision is None else f", revision {subject.revision}"
    clock = (
        f"virtual rig and clock, seed {subject.virtual_seed}" if subject.virtual else "real time"
    )
    facts = [
        ("Test", f"{subject.test_name}{revision}"),
        ("Test id", subject.test_id),
        ("Run", f"{subject.label} ({clock})"),
        ("Operator", noted.operator or "not noted"),
        ("Started", moment(subject.started_at)),
        ("Ended", moment(subject.ended_at)),
        *_rig(frozen.rig, subject.started_at),
        ("Controller", _controller(subject)),
        ("Software", f"forcerig {subject.software}"),
        ("Prediction", "" if subject.prediction is None else subject.prediction.verdict.value),
        ("Overridden because", noted.override_reason or ""),
        ("Tags", ", ".join(noted.tags)),
    ]
    return [(name, value) for name, value in facts if value and value != NOTHING]


def _rig(kept: Document, at: datetime | None) -> list[tuple[str, str]]:
    """What it was tested on, with revision and serial numbers where the run keeps a configuration."""
    sensors = kept.get("sensors", {})
    span = sensors.get("force_range_n")
    cell = "" if span is None else f"range ±{quantity(span, 'N')}"
    configuration = configuration_of(kept)
    if configuration is None:
        return [("Rig", str(kept.get("name", ""))), ("Load cell", cell)]
    calibrated = configuration.calibrations.load_cell
    told = [("certificate", calibrated.certificate), ("calibrated", calibrated.calibrated_on)]
    told += [("due", calibrated.due_on)]
    known = ", ".join(f"{name} {value}" for name, value in told if value)
    return [
        ("Lab", configuration.lab),
        ("Unit under test", _plate(configuration.unit_under_test)),
        ("Rig", _plate(configuration.rig)),
        ("Rig configuration", f"revision {kept[KEY].get('revision', NOTHING)}"),
        ("Load cell", ", ".join(filter(None, [_plate(calibrated), cell, known]))),
        ("Overdue", "" if at is None else _overdue(configuration.calibrations, at.date())),
    ]


def _overdue(calibrations: Calibrations, on: date) -> str:
    """The sensors whose certificates no longer held on the day of the run."""
    states = calibration_states(calibrations, on)
    late = [s for s in states if s.word is CalibrationWord.OVERDUE]
    return ", ".join(f"calibration of {s.sensor.replace('_', ' ')} {s.text}" for s in late)


def _plate(of: TypePlate | Calibration) -> str:
    name = getattr(of, "name", "")
    serial = f"serial {of.serial_number}" if of.serial_number else ""
    return ", ".join(filter(None, [name, of.maker, of.part_number, serial]))


def _controller(subject: Subject) -> str:
    asked = subject.frozen.definition.get("controller", {})
    mode = f"compensation {asked.get('compensation', 'auto')}"
    gains = subject.frozen.controller
    told = [f"{name} {say(gains[name])}" for name in ("k_p", "k_i", "k_d") if name in gains]
    return ", ".join([mode, *told])


def _criteria(subject: Subject) -> Table:
    columns = (
        Column("Criterion"),
        Column("At least", number=True),
        Column("Measured", number=True),
        Column("At most", number=True),
        Column("Outcome"),
    )
    rows = tuple(_criterion(c) for c in subject.measured.criteria)
    return Table("Acceptance", columns, rows)


def _criterion(c: JudgedCriterion) -> Row:
    place = "" if c.block is None else f", block {c.block + 1}"
    numbers = (quantity(value, c.unit) for value in (c.at_least, c.value, c.at_most))
    at_least, value, at_most = numbers
    cells = (f"{spoken(c.measurement)}{place}", at_least, value, at_most, c.outcome)
    return Row(cells, TONES[c.outcome])
