"""A database with many runs, as a lab has them after years: for measuring how they are found."""

import random
from collections.abc import Iterator
from datetime import UTC, datetime, timedelta
from typing import Any

from sqlalchemy import insert, text
from sqlalchemy.orm import Session

from app.db import Database
from app.runs import repository
from app.runs.models import Run, RunTag, words_of_run

COMMON, RARE, ABSENT = "harmonic", "Kolbendichtung", "nowhere"
MORNING, EVENING = "morning", "evening"  # common both, and never together
PORTION = 5000
FIRST = datetime(2021, 1, 1, tzinfo=UTC)
EVERY = timedelta(minutes=23)
_FROZEN = ("definition", "plan", "controller", "interlocks", "rig", "conditions")
_KINDS = (COMMON, COMMON, COMMON, "layers", "hold", "sweep", "step")
_OPERATORS = tuple(f"{first} {last}" for first in ("Anna", "Otto", "Ida") for last in "BKMRS")
_TAGS = (*(f"customer-{n}" for n in range(40)), "acceptance", "endurance", "check", "paper")
_WORDS = tuple(f"{a}{b}" for a in ("seal", "valve", "spring", "oil") for b in range(500))
_OUTCOMES = ("completed",) * 90 + ("stopped",) * 6 + ("tripped",) * 3 + ("interrupted",)
_ENDS = {"tripped": "Force error 7.2 kN, allowed 6 kN", "stopped": "Stopped by the operator"}


def fill(database: Database, runs: int) -> None:
    """Enter so many runs with tags, notes, operators and reasons; the same ones each time."""
    chance = random.Random(1)
    with database.writing() as session:
        documents = [_documents(session, number) for number in range(200)]
    for first in range(1, runs + 1, PORTION):
        numbers = range(first, min(first + PORTION, runs + 1))
        made = [_run(chance, number, chance.choice(documents), runs) for number in numbers]
        with database.writing() as session:
            session.execute(insert(Run), [row for row, _ in made])
            tags = [{"run_id": row["id"], "tag": tag} for row, found in made for tag in found]
            session.execute(insert(RunTag), tags)
    with database.engine.begin() as connection:
        connection.execute(text("ANALYZE"))


def _documents(session: Session, number: int) -> dict[str, int]:
    """Definitions differ from test to test, settings hardly."""
    own = {"definition": number, "plan": number, "controller": number % 7}
    bodies = {name: {"about": name, "own": own.get(name, 0)} for name in _FROZEN}
    return {f"{name}_id": repository.freeze(session, body) for name, body in bodies.items()}


def _run(
    chance: random.Random, number: int, documents: dict[str, int], runs: int
) -> tuple[dict[str, Any], list[str]]:
    kind, force_kn = chance.choice(_KINDS), chance.randint(1, 60)
    outcome = chance.choice(_OUTCOMES)
    row = {
        "id": number,
        "test_id": f"{kind}-{force_kn}-kn",
        "test_name": f"{kind.capitalize()} {force_kn} kN",
        "revision": chance.randint(1, 9),
        "software_version": "0.1.0",
        "loop_life": "1-1",
        "period_ns": 250_000,
        "started_at": FIRST + number * EVERY,
        "ended_at": FIRST + number * EVERY + timedelta(minutes=5),
        "ticks": 1_200_000,
        "duration_s": 300.0,
        "outcome": outcome,
        "verdict": chance.choice(("pass", "pass", "fail", "unset")),
        "reason": _ENDS.get(outcome),
        "operator": chance.choice(_OPERATORS),
        "notes": " ".join(_notes(chance, number, runs)),
        **documents,
    }
    tags = chance.sample(_TAGS, chance.randint(0, 3))
    rows = [RunTag(tag=tag) for tag in tags]
    return {**row, "words": words_of_run(Run(**row, tag_rows=rows))}, tags


def _notes(chance: random.Random, number: int, runs: int) -> Iterator[str]:
    yield chance.choice((MORNING, EVENING))
    yield from chance.choices(_WORDS, k=chance.randint(0, 12))
    if number == runs // 3:
        yield RARE
