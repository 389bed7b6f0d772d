"""Finding runs: as a plain look at each of them would, on either database."""

import random
import unicodedata
from datetime import UTC, datetime, timedelta

import pytest

from app.db import Database
from app.runs import finding, repository
from app.runs.finding import UNDER_WAY, Sought
from app.runs.models import Run
from app.runs.words import LONGEST_WORD, facet, words_of
from tests.a_run import a_run

NAMES = (
    "Harmonic 2 kN",
    "Größte Kraft",
    "ÉCOLE d'été",
    "試験 7",
    "hold_50-kn",
    "ﬁne, ﬂow",
    "ZZTOP",
)
TAGS = ("a", "A", "ärmel", "customer 1", "zz", "%", "")
OPERATORS = ("", "Anna", "anna", "Otto K.")
REASONS = (None, "Force error 7.2 kN", "Stopped by the operator")
START = datetime(2026, 1, 1, tzinfo=UTC)


@pytest.fixture
def book(database: Database) -> list[Run]:
    chance = random.Random(3)
    with database.writing() as session:
        runs = [
            a_run(
                session,
                test_id=f"test-{chance.randint(0, 3)}",
                test_name=chance.choice(NAMES),
                operator=chance.choice(OPERATORS),
                reason=chance.choice(REASONS),
                outcome=chance.choice((None, "completed", "tripped")),
                verdict=chance.choice(("pass", "fail", "unset")),
                notes=chance.choice(("", "zest of lime", "12 bar", "x" * 60)),
                tags=tuple(sorted({tag for tag in chance.choices(TAGS, k=2) if tag})),
                # Twice the clock is put back.
                started_at=START
                + timedelta(hours=number - 30 * (number > 60) - 50 * (number > 90)),
            )
            for number in range(120)
        ]
        session.add_all(runs)
    return runs


def folded(text: str) -> list[str]:
    text = unicodedata.normalize("NFKC", text).casefold()
    words = "".join(c if c.isalnum() else " " for c in text).split()
    return [word[:LONGEST_WORD] for word in words]


def fits(run: Run, sought: Sought) -> bool:
    """What is meant, said without an index."""
    texts = [run.test_name, run.test_id, run.notes, run.operator, run.reason or "", *run.tags]
    words = [*(word for text in texts for word in folded(text)), str(run.id)]
    return (
        all(any(w.startswith(begin) for w in words) for begin in folded(sought.search))
        and sought.test_id in (None, run.test_id)
        and sought.verdict in (None, run.verdict)
        and sought.operator in (None, run.operator)
        and (sought.tag is None or sought.tag in run.tags)
        and (sought.outcome is None or sought.outcome == (run.outcome or UNDER_WAY))
        and (sought.since is None or run.started_at >= sought.since)
        and (sought.until is None or run.started_at < sought.until)
    )


SOUGHT = [
    Sought(),
    *(Sought(search) for search in ("harm", "KRAFT grösste", "école", "ete", "試", "50", "7")),
    *(Sought(search) for search in ("fine flow", "z", "zz", "zzt", "zztop", "x", "armonic", "--")),
    *(Sought("x" * length) for length in (39, 40, 41, 100)),
    *(Sought(tag=tag) for tag in ("a", "A", "ärmel", "customer 1", "%", "none")),
    *(Sought(operator=operator) for operator in ("Anna", "anna", "Otto K.", "Otto")),
    *(Sought(outcome=outcome) for outcome in ("completed", "tripped", UNDER_WAY)),
    Sought("kn", test_id="test-1", outcome="tripped", verdict="fail"),
    Sought("a' | b & ! *\" OR NOT", tag="a"),
    Sought(since=START + timedelta(hours=20), until=START + timedelta(hours=40)),
    Sought("anna", since=START + timedelta(hours=10)),
    Sought(outcome="completed", until=START + timedelta(hours=45)),
    Sought("harm", outcome=UNDER_WAY, since=START + timedelta(hours=5)),
    Sought(until=START),
]


def test_what_is_found_is_what_a_look_at_each_run_finds(
    database: Database, book: list[Run]
) -> None:
    for sought in SOUGHT:
        expected = [run.id for run in reversed(book) if fits(run, sought)]
        with database.reading() as session:
            assert list(finding.ids(session, sought, None, 1000)) == expected, sought
            half = expected[len(expected) // 2 - 1] if len(expected) > 1 else 0
            rest = list(finding.ids(session, sought, half, 7))
            assert rest == [number for number in expected if number < half][:7], sought


def test_pages_put_together_are_the_whole(database: Database, book: list[Run]) -> None:
    sought, before = Sought(outcome="completed"), None
    found: list[int] = []
    with database.reading() as session:
        while page := repository.page(session, sought, 7, before):
            found += [run.id for run in page]
            before = found[-1]
    assert found == [run.id for run in reversed(book) if run.outcome == "completed"]


def test_a_change_is_found_and_what_was_before_is_not(database: Database) -> None:
    with database.writing() as session:
        run = a_run(session, notes="before", tags=("old",))
        session.add(run)
    with database.writing() as session:
        changed = repository.to_change(session, run.id)
        assert changed is not None
        changed.notes, changed.outcome = "after", "completed"
        changed.tag_rows = []
    with database.reading() as session:
        for sought in (Sought("before"), Sought("old"), Sought(tag="old")):
            assert not finding.ids(session, sought, None, 9), sought
        for sought in (Sought("after"), Sought(outcome="completed")):
            assert list(finding.ids(session, sought, None, 9)) == [run.id], sought
    with database.writing() as session:
        session.delete(session.merge(run))
    with database.reading() as session:
        assert not finding.ids(session, Sought("after"), None, 9)


def test_each_value_is_told_once_in_order(database: Database, book: list[Run]) -> None:
    with database.reading() as session:
        assert repository.tags(session) == sorted({tag for run in book for tag in run.tags})
        assert repository.operators(session) == ["Anna", "Otto K.", "anna"]


def test_no_text_makes_a_facet() -> None:
    for name in ("test_id", "tag", "outcome", "verdict", "operator"):
        made = facet(name, "anything")
        assert made not in words_of([made])
        assert not any(word.startswith(made[:3]) for word in words_of(["zz", "zzt", "z" * 9, made]))
