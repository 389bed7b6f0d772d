"""A database with runs that are over, each with files of a size."""

from datetime import UTC, datetime, timedelta
from pathlib import Path

import pytest

from app.db import Database
from app.runs import repository
from app.runs.models import Run, RunTag

NOW = datetime(2026, 3, 1, 12, tzinfo=UTC)
DOCUMENTS = ("definition", "plan", "controller", "interlocks", "rig", "conditions")
FILES = {"run.parquet": 700, "overview-0.bin": 200, "predicted.parquet": 100}
REDUCED = {"acquisition-0.parquet": 10}


@pytest.fixture
def database(tmp_path: Path) -> Database:
    """A fresh one."""
    database = Database(f"sqlite:///{tmp_path / 'forcerig.sqlite'}")
    database.upgrade()
    return database


def enter(
    database: Database, runs_dir: Path, age_days: float, *tags: str, ticks: int = 100_000
) -> int:
    """A run that ended so many days ago, with its files; returns its number."""
    ended_at = NOW - timedelta(days=age_days)
    with database.writing() as session:
        frozen = repository.freeze(session, {})
        run = Run(
            test_id="step",
            test_name="Step",
            **{f"{name}_id": frozen for name in DOCUMENTS},
            software_version="0",
            loop_life="1-42",
            period_ns=250_000,
            started_at=ended_at,
            ended_at=ended_at,
            outcome="completed",
            ticks=ticks,
            first_tick=0,
            last_tick=ticks - 1,
            tag_rows=[RunTag(tag=tag) for tag in tags],
        )
        session.add(run)
    folder = runs_dir / str(run.id)
    folder.mkdir(parents=True)
    for name, size in (FILES | REDUCED).items():
        (folder / name).write_bytes(bytes(size))
    return run.id


def files(runs_dir: Path, run_id: int) -> set[str]:
    """What is in a run's folder."""
    return {path.name for path in (runs_dir / str(run_id)).iterdir()}
