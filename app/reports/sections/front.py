"""The first page: what was tested, by whom, on what, with what, and what it came to."""

from app.documents.units import say
from app.reports.numbers import NOTHING, duration, moment, quantity, spoken
from app.reports.report import Column, Facts, Item, Row, Table, Tone, Verdict, Words
from app.reports.subject import Subject
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
        ("Unit under test", str(frozen.rig.get("unit_name") or "as in the rig's configuration")),
        ("Rig", str(frozen.rig.get("name", NOTHING))),
        *_identities(subject),
        ("Load cell", _load_cell(subject)),
        ("Controller", _controller(subject)),
        ("Software", f"forcerig {subject.software}"),
        ("Prediction", "" if subject.prediction is None else subject.prediction.verdict.value),
        ("Overridden because", noted.override_reason or ""),
        ("Tags", ", ".join(noted.tags)),
    ]
    return [(name, value) for name, value in facts if value and value != NOTHING]


def _identities(subject: Subject) -> list[tuple[str, str]]:
    """Revision and serial numbers, where the frozen rig has them."""
    rig, found = subject.frozen.rig, []
    if rig.get("revision") is not None:
        found.append(("Rig configuration", f"revision {rig['revision']}"))
    for name, value in sorted(dict(rig.get("serials") or {}).items()):
        found.append((f"Serial, {spoken(str(name)).lower()}", str(value)))
    return found


def _load_cell(subject: Subject) -> str:
    sensors = subject.frozen.rig.get("sensors", {})
    band = sensors.get("confidence_n")
    span = sensors.get("force_range_n")
    told = [] if span is None else [f"range ±{quantity(span, 'N')}"]
    told += [] if band is None else [f"confidence ±{say(band, 'N')}"]
    return ", ".join(told)


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
