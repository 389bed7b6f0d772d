"""A campaign of kills: kill -9 of the console, its loop or both at random moments, then an account.

    python -m tests.process.kills --kills 200 --seed 1

What must hold of each run is told by the ring in shared memory, which no kill touches: which of its
ticks were published, and how it ended. Prints one line at the end; ends with 1 where anything is wrong.
"""

import argparse
import contextlib
import os
import random
import signal
import sqlite3
import subprocess
import sys
import tempfile
import time
from collections import Counter
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from threading import Thread
from typing import Any

import httpx2
import numpy as np
import pyarrow.parquet as pq
from alembic import command
from alembic.config import Config

from app.db import Database, migrations_folder
from rtcore.memory.rings import telemetry_reader
from rtcore.memory.segment import BlockError, attach_block, loop_is_running
from rtcore.modes import Mode
from tests.console_process import SERVE, ConsoleProcess, wait_for

RUN_S = 1.5
STARTING_S = 4.0
FILING_S = 2.5  # from the end of the test to its file: taking the load off is in it
BEFORE = "0002"  # the revision to which the database is put back before some starts
MOMENTS = ("starting a run", "running", "filing", "starting up")
VICTIMS = ("app", "loop", "both")
TEST: dict[str, Any] = {
    "schema": 1,
    "name": "Short",
    "blocks": [
        {
            "kind": "harmonic",
            "mean_n": 0,
            "amplitude_n": 500,
            "frequency_hz": 5,
            "duration_s": RUN_S,
        }
    ],
}


@dataclass
class Truth:
    """What the ring told of a run."""

    accepted: bool = False  # the console said that it began
    first_tick: int | None = None
    last_tick: int = -1
    tripped: bool = False
    followed: bool = False  # ticks that are not of it any more came after it

    def outcomes(self) -> set[str | None]:
        """What the book may say of it."""
        if self.first_tick is None:
            return {"failed", "interrupted"}
        if self.tripped:
            return {"tripped"}
        return {"completed"} if self.followed else {"interrupted"}


@dataclass
class Account:
    """What a campaign came to."""

    kills: Counter[str] = field(default_factory=Counter)
    outcomes: Counter[str] = field(default_factory=Counter)
    ticks: int = 0
    wrong: list[str] = field(default_factory=list)


class Victim(ConsoleProcess):
    """A console that can be killed before it has said anything."""

    def launch(self) -> None:
        """Start it, and wait for nothing."""
        with self._log.open("ab") as log:
            self._process = subprocess.Popen(
                [sys.executable, "-c", SERVE], env=self._environment, stdout=log, stderr=log
            )

    def kill_now(self) -> None:
        """kill -9 of the app, whatever it is at."""
        if self._process is not None and self._process.poll() is None:
            self._process.send_signal(signal.SIGKILL)
            self._process.wait(60)
        if hasattr(self, "http"):
            self.http.close()

    @property
    def runs(self) -> bool:
        return self._process is not None and self._process.poll() is None

    def kill_loop(self) -> None:
        """kill -9 of the loop, where there is one: of one that is getting ready too."""
        for pid in loops_on(self.block):
            with contextlib.suppress(ProcessLookupError):
                os.kill(pid, signal.SIGKILL)
        wait_for(lambda: not loop_is_running(self.block), "the end of the loop")

    def clean_up(self) -> None:
        self.kill_now()
        self.kill_loop()
        super().clean_up()


def loops_on(block: Path) -> list[int]:
    """The process ids of the loops on a block, whether it is there yet or not."""
    found = []
    for folder in Path("/proc").glob("[0-9]*"):
        with contextlib.suppress(OSError):
            words = (folder / "cmdline").read_bytes().split(b"\0")
            if str(block).encode() in words and b"rtcore" in words:
                found.append(int(folder.name))
    return found


class Campaign:
    """Kills, restarts, and keeps an account."""

    def __init__(self, folder: Path, seed: int, say: Callable[[str], None] = print) -> None:
        self.console = Victim(folder)
        self.truth: dict[int, Truth] = {}
        self.account = Account()
        self._random = random.Random(seed)
        self._say = say

    def run(self, kills: int) -> Account:
        """So many kills, then the account."""
        for number in range(kills):
            moment = self._random.choice(MOMENTS)
            # A loop that is starting has no console yet that could lose it.
            victim = self._random.choice(("app", "both") if moment == MOMENTS[-1] else VICTIMS)
            self._say(f"{number + 1}/{kills}: {victim} while {moment}")
            self._kill(moment, victim)
            self.account.kills[victim] += 1
        self._back()
        self._settle()
        self._check_runs()
        self.console.stop()
        self._check_database()
        return self.account

    def _kill(self, moment: str, victim: str) -> None:
        if moment == "starting up":
            self._kill_starting(victim)
            return
        self._back()
        self._ready()
        post = Thread(target=self._start_run, daemon=True)
        post.start()
        if moment == "starting a run":
            time.sleep(self._random.uniform(0.0, 0.5))
        else:
            post.join()
            share = self._random.uniform(0.0, 1.0)
            time.sleep(share * RUN_S if moment == "running" else RUN_S + share * FILING_S)
        self._strike(victim)
        post.join()

    def _kill_starting(self, victim: str) -> None:
        """While it starts; every other time with a database to migrate."""
        if self.console.runs:
            self._settle()
            self.console.kill_now()
        if self._random.random() < 0.5:
            self._downgrade()
        self.console.launch()
        time.sleep(self._random.uniform(0.0, STARTING_S))
        self._strike(victim)

    def _strike(self, victim: str) -> None:
        self._observe()
        if victim in ("loop", "both"):
            self.console.kill_loop()
        if victim in ("app", "both"):
            self.console.kill_now()
        self._observe()

    def _back(self) -> None:
        """Have a console with a living loop again, after a while."""
        if not self.console.runs:
            time.sleep(self._random.uniform(0.0, 1.5))
            self._observe()
            self.console.start()
        wait_for(lambda: self.console.status()["loop"]["alive"], "a living loop")

    def _ready(self) -> None:
        """Whatever state it is in: every run ended, reset, pressure."""
        self._settle()

        def ready() -> bool:
            self.console.take_command()
            mode = self.console.mode()
            if mode == "tripped":
                self.console.command("reset")
                time.sleep(0.3)  # or it counts as held down
            elif mode == "off":
                self.console.command("pressurise")
            return mode == "ready" and self.console.status()["commands"]["start"] is None

        wait_for(ready, "pressure")

    def _start_run(self) -> None:
        """The answer may never come: the console dies meanwhile, or the loop does."""
        with contextlib.suppress(httpx2.HTTPError, RuntimeError):
            asked = {"test_id": self._test(), "override_reason": "Kill test"}
            answer = self.console.http.post("/runs", json=asked)
            if answer.status_code == 201:
                self.truth.setdefault(int(answer.json()["id"]), Truth()).accepted = True

    def _test(self) -> str:
        known = self.console.http.get("/tests", params={"search": TEST["name"]}).json()
        for test in known:
            if test["name"] == TEST["name"]:
                return str(test["id"])
        answer = self.console.http.post("/tests", json={"definition": TEST})
        return str(answer.json()["id"])

    def _settle(self) -> None:
        """Until no run is open."""

        def settled() -> bool:
            self._observe()
            runs = self.console.http.get("/runs", params={"limit": 200}).json()["runs"]
            return all(run["outcome"] is not None for run in runs)

        if self.console.runs and self.console.url:
            wait_for(settled, "the end of every run")
            self._observe()

    def _observe(self) -> None:
        """What the ring has now."""
        try:
            records = telemetry_reader(attach_block(self.console.block)).read(1 << 20).records
        except (BlockError, OSError, ValueError):
            return
        for run_id in (int(number) for number in np.unique(records["run"]) if number):
            of_run = records[records["run"] == run_id]
            truth = self.truth.setdefault(run_id, Truth())
            first, last = int(of_run["tick"][0]), int(of_run["tick"][-1])
            truth.first_tick = first if truth.first_tick is None else truth.first_tick
            truth.last_tick = max(truth.last_tick, last)
            truth.tripped |= bool(np.any(of_run["mode"] == Mode.TRIPPED))
            truth.followed |= int(records["tick"][-1]) > last

    def _downgrade(self) -> None:
        """An older database, as before an update of the console."""
        path = self.console.data / "forcerig.sqlite"
        if not path.exists() or _revision(path) is None:
            return
        config = Config()
        config.set_main_option("script_location", str(migrations_folder()))
        database = Database(f"sqlite:///{path}")
        with database.engine.execution_options(writes=True).begin() as connection:
            config.attributes["connection"] = connection
            if (_revision(path) or "") > BEFORE:
                command.downgrade(config, BEFORE)
                self.console.token = ""  # that console knew neither users nor tokens
        database.close()

    # ---- the account ----

    def _check_runs(self) -> None:
        listed = self._listed()
        for run_id, truth in sorted(self.truth.items()):
            if run_id not in listed and (truth.accepted or truth.first_tick is not None):
                self._wrong(run_id, "is not listed")
        for run_id, run in listed.items():
            self.account.outcomes[str(run["outcome"])] += 1
            self._check_run(run_id, run, self.truth.get(run_id, Truth()))

    def _listed(self) -> dict[int, dict[str, Any]]:
        found: dict[int, dict[str, Any]] = {}
        query: dict[str, Any] = {"limit": 200}
        while True:
            page = self.console.http.get("/runs", params=query).json()
            found |= {run["id"]: run for run in page["runs"]}
            if page["next"] is None:
                return found
            query["before"] = page["next"]

    def _check_run(self, run_id: int, run: dict[str, Any], truth: Truth) -> None:
        if run["outcome"] not in truth.outcomes():
            self._wrong(run_id, f"is {run['outcome']}, the ring says {truth.outcomes()}")
        if truth.first_tick is None:
            return
        detail = self.console.run(run_id)
        if detail["missing_ticks"]:
            self._wrong(run_id, f"{detail['missing_ticks']} ticks are missing")
        path = self.console.data / "runs" / str(run_id) / "run.parquet"
        try:
            ticks = pq.read_table(path, columns=["tick"])["tick"].to_numpy()
        except OSError as error:
            self._wrong(run_id, f"cannot be read: {error}")
            return
        self.account.ticks += len(ticks)
        if not np.array_equal(ticks, np.arange(detail["first_tick"], detail["last_tick"] + 1)):
            self._wrong(run_id, "has gaps in its file")
        if ticks[0] > truth.first_tick or ticks[-1] < truth.last_tick:
            told = f"{truth.first_tick}…{truth.last_tick}"
            self._wrong(run_id, f"has {ticks[0]}…{ticks[-1]}, the ring had {told}")
        query = "samples?channels=force_n&points=50"
        if not self.console.http.get(f"/runs/{run_id}/{query}").is_success:
            self._wrong(run_id, "shows no samples")

    def _check_database(self) -> None:
        path = self.console.data / "forcerig.sqlite"
        with contextlib.closing(sqlite3.connect(path)) as connection:
            (found,) = connection.execute("PRAGMA integrity_check").fetchone()
            broken = connection.execute("PRAGMA foreign_key_check").fetchall()
        if found != "ok" or broken:
            self.account.wrong.append(f"the database: {found} {broken}")
        for path in self.console.data.glob("runs/*/*"):
            if path.name.startswith((".", "part-")):
                self.account.wrong.append(f"{path.parent.name}/{path.name} was left behind")

    def _wrong(self, run_id: int, what: str) -> None:
        self.account.wrong.append(f"run {run_id} {what}")


def _revision(path: Path) -> str | None:
    with contextlib.closing(sqlite3.connect(path)) as connection:
        try:
            row = connection.execute("SELECT version_num FROM alembic_version").fetchone()
        except sqlite3.OperationalError:
            return None
    return None if row is None else str(row[0])


def campaign(folder: Path, kills: int, seed: int, say: Callable[[str], None] = print) -> Account:
    """Run one, and leave nothing running."""
    of = Campaign(folder, seed, say)
    try:
        return of.run(kills)
    except BaseException:
        say(of.console.said()[-5000:])
        raise
    finally:
        of.console.clean_up()


def main() -> int:
    """From the command line."""
    parser = argparse.ArgumentParser(description="Kill -9 at random moments, then an account.")
    parser.add_argument("--kills", type=int, default=200)
    parser.add_argument("--seed", type=int, default=1)
    asked = parser.parse_args()

    def say(text: str) -> None:
        print(text, file=sys.stderr, flush=True)

    begun = time.monotonic()
    with tempfile.TemporaryDirectory(prefix="forcerig-kills-") as folder:
        account = campaign(Path(folder), asked.kills, asked.seed, say)
    for wrong in account.wrong:
        print(f"WRONG: {wrong}")
    minutes = (time.monotonic() - begun) / 60
    print(
        f"{asked.kills} kills ({dict(account.kills)}) in {minutes:.0f} min, seed {asked.seed}: "
        f"{sum(account.outcomes.values())} runs ({dict(account.outcomes)}), "
        f"{account.ticks:,} ticks, {len(account.wrong)} wrong"
    )
    return 1 if account.wrong else 0


if __name__ == "__main__":
    raise SystemExit(main())
