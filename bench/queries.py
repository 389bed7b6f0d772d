"""Finding runs among 100,000: list, filters and search as the service does them.

Beside each measurement, in turns, runs a page of bare keys: what the database needs at the least.
`FORCERIG_BENCH_DATABASE_URL` names another database to fill, which must be empty;
`FORCERIG_BENCH_RUNS` another number of runs.
"""

import os
import statistics
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path

from sqlalchemy import text

from app.db import Database
from app.runs.finding import Sought
from app.runs.service import Runs
from bench.book_of_runs import (
    ABSENT,
    COMMON,
    EVENING,
    EVERY,
    FIRST,
    MORNING,
    RARE,
    fill,
)
from bench.report import Figure, progress, show

RUNS = 100_000
ROUNDS = 40
PAGE = 50
AT_MOST_S = 50e-3
_BARE = text("SELECT id FROM runs WHERE id < :before ORDER BY id DESC LIMIT 51")


def main(as_json: bool = False) -> int:
    """Measure and show. Returns 1 where a target is missed."""
    runs = int(os.environ.get("FORCERIG_BENCH_RUNS", RUNS))
    with tempfile.TemporaryDirectory() as folder:
        url = os.environ.get("FORCERIG_BENCH_DATABASE_URL")
        database = Database(url or f"sqlite:///{Path(folder) / 'bench.sqlite'}")
        database.upgrade()
        progress(f"Writing {runs:,} runs")
        fill(database, runs)
        figures = measure(database, runs)
        kind = database.engine.dialect.name
        database.close()
    notes = [
        f"{runs:,} runs on {kind}, medians and 95th percentiles of {ROUNDS} pages of {PAGE}",
        "ratios are to a page of bare keys on the same connection, measured in turns",
    ]
    show("queries", figures, notes, as_json)
    return int(any(figure.met is False for figure in figures))


def asked(runs: int) -> dict[str, tuple[str, Sought, int | None]]:
    """What is asked for, by the name of its figure."""
    middle = FIRST + runs // 2 * EVERY
    some = Sought(outcome="tripped", tag="acceptance", verdict="fail")
    return {
        "newest": ("the newest runs", Sought(), None),
        "deep": ("a page deep in the past", Sought(), runs // 20),
        "filtered": ("tripped, tagged and failed", some, None),
        "deep_filtered": ("such a page deep in the past", some, runs // 20),
        "test": ("the runs of a test", Sought(test_id=f"{COMMON}-9-kn"), None),
        "operator": ("the runs of an operator", Sought(operator="Anna B"), None),
        "times": ("a week in the past", Sought(since=middle, until=middle + 438 * EVERY), None),
        "until": ("all before the middle", Sought(until=middle), None),
        "common": ("a word that most runs have", Sought(COMMON), None),
        "begun": ("one letter", Sought("h"), None),
        "typed": ("a common word, half typed", Sought(COMMON[:5]), None),
        "rare": ("a word that one run has", Sought(RARE), None),
        "absent": ("a word that no run has", Sought(ABSENT), None),
        "apart": ("two common words, never together", Sought(f"{MORNING} {EVENING}"), None),
        "many": ("words and filters", Sought("harm 9 anna", outcome="tripped"), None),
        "word_and_times": ("a word before the middle", Sought(COMMON, until=middle), None),
    }


def measure(database: Database, runs: int) -> list[Figure]:
    """Each question in turns with the bare page."""
    service = Runs(database, Path())
    bare: list[float] = []
    figures = []
    for name, (what, sought, before) in asked(runs).items():
        took: list[float] = []
        beside: list[float] = []
        for _ in range(ROUNDS):
            took.append(_seconds(lambda: service.page(sought, PAGE, before)))  # noqa: B023
            beside.append(_seconds(lambda: _bare_page(database, before or runs)))  # noqa: B023
        bare += beside
        figures += _figures(name, what, took, statistics.median(beside))
    figures += _lists(service)
    middle = statistics.median(bare)
    return [*figures, Figure("bare_page_median_s", "a page of bare keys", middle, "s")]


def _lists(service: Runs) -> list[Figure]:
    """What filters are offered."""
    asks = {"tags": service.tags, "operators": service.operators}
    return [
        Figure(f"{name}_s", f"all {name}", _seconds(ask), "s", at_most=AT_MOST_S)
        for name, ask in asks.items()
    ]


def _figures(name: str, what: str, took: list[float], bare: float) -> list[Figure]:
    middle, late = statistics.median(took), statistics.quantiles(took, n=20)[-1]
    return [
        Figure(f"{name}_median_s", what, middle, "s", at_most=AT_MOST_S),
        Figure(f"{name}_p95_s", f"{what}, 95 %", late, "s", at_most=AT_MOST_S),
        Figure(f"{name}_ratio", f"{what}, to bare keys", middle / bare, "×"),
    ]


def _bare_page(database: Database, before: int) -> None:
    with database.reading() as session:
        session.execute(_BARE, {"before": before}).all()


def _seconds(work: Callable[[], object]) -> float:
    begun = time.perf_counter()
    work()
    return time.perf_counter() - begun


if __name__ == "__main__":
    sys.exit(main())
