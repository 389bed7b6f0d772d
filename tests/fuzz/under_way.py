"""A run that goes on whatever everybody asks of its console, and what of the console may not change."""

import sqlite3
from collections import Counter
from typing import Any, NamedTuple

from app.access.principal import Role
from rtcore.latency import Counts, figures_of, quantile_s
from rtcore.memory.segment import attach_block
from tests.console_process import ConsoleProcess, bearer

# What asking leaves in the database, whoever asks: when a credential was used last, and entries of
# the audit, which are looked at by themselves.
ASKING = {"tokens": "last_used_at", "sessions": "last_used_at"}
GOES_ON = {"runs", "run_events", "sqlite_stat1"}  # of the run that is under way
Row = tuple[Any, ...]


class Timing(NamedTuple):
    """How the loop has kept time so far."""

    ticks: int
    tick_time: Counts


class UnderWay:
    """The run, who asks, and the state that they may not change."""

    def __init__(self, console: ConsoleProcess, test_id: str, run_id: int) -> None:
        self.console, self.test_id, self.run_id = console, test_id, run_id
        self.tokens = {role: console.new_token(role) for role in Role}  # none is in command
        self.asked: Counter[tuple[Role | None, int]] = Counter()  # by role and what was answered
        self.loop = console.loop_pid
        self.before = self.timing()

    def remember(self) -> None:
        """From now on it is disturbed."""
        self.before = self.timing()

    def headers(self, role: Role | None) -> dict[str, str]:
        """What somebody of this role brings along; None is nobody."""
        return {} if role is None else bearer(self.tokens[role])

    def timing(self) -> Timing:
        """A copy of what the loop has counted."""
        found = figures_of(attach_block(self.console.block), ())
        return Timing(found.ticks, found.tick_time)

    def quantiles_s(self) -> tuple[float | None, float | None]:
        """The 99 % quantile of the time of a tick: before, and since then."""
        before, now = self.before.tick_time, self.timing().tick_time
        return quantile_s(before, 0.99), quantile_s(now - before, 0.99)

    def goes_on(self) -> None:
        """The same loop drives the same run, nothing has tripped, and every sample is written."""
        status = self.console.status()
        assert (status["mode"], status["trips"]) == ("running", [])
        assert (status["run"]["id"], status["loop"]["pid"]) == (self.run_id, self.loop)
        assert status["recorder"]["lost_ticks"] == 0
        assert status["recorder"]["trouble"] is None

    def state(self) -> dict[str, Any]:
        """Everything that a request might change: tables, interlocks of the loop, and the lease."""
        lease = self.console.http.get("/lease").json()
        block = attach_block(self.console.block)
        with sqlite3.connect(self.console.data / "forcerig.sqlite") as database:
            database.row_factory = sqlite3.Row
            tables = {name: _rows(database, name) for name in _tables(database)}
        database.close()
        return tables | {
            "lease": (lease["epoch"], lease["holder_id"], lease["requests"]),
            "detectors": block.fields["interlocks"].tobytes(),
            "injected": block.fields["injected"].tobytes(),
            "histories": sorted(path.name for path in self.console.data.glob("histories/*")),
        }

    def entered(self) -> Counter[str]:
        """How often each action was done, by the audit: what was refused is entered, too."""
        with sqlite3.connect(self.console.data / "forcerig.sqlite") as database:
            done = "SELECT action, count(*) FROM audit WHERE outcome = 'done' GROUP BY action"
            found = database.execute(done)
            counted = Counter(dict(found.fetchall()))
        database.close()
        return counted


def _tables(database: sqlite3.Connection) -> list[str]:
    rows = database.execute("SELECT name, sql FROM sqlite_master WHERE type = 'table'").fetchall()
    words = {row["name"] for row in rows if "VIRTUAL" in row["sql"].upper()}
    names = [row["name"] for row in rows if not any(row["name"].startswith(w) for w in words)]
    return sorted(set(names) - GOES_ON - {"audit"})


def _rows(database: sqlite3.Connection, table: str) -> list[Row]:
    rows = database.execute(f"SELECT * FROM {table}").fetchall()
    names = [name for name in (rows[0].keys() if rows else ()) if name != ASKING.get(table)]
    return sorted((tuple(row[name] for name in names) for row in rows), key=repr)
