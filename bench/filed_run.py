"""A run of the virtual rig in a database and a folder of its own, as a console would have left it."""

from collections.abc import Callable
from datetime import UTC, datetime, timedelta
from pathlib import Path
from typing import Any

import numpy as np

from app.controller.settings import ControllerSettings
from app.db import Database
from app.definitions.outline import outline
from app.errors import Refusal
from app.interlocks.defaults import default_interlocks
from app.prediction.setup import Setup
from app.prediction.simulation import Simulating, begin_simulation
from app.recording.files import convert, remove_parts
from app.recording.run_file import Recorded, RunFile
from app.runs import repository
from app.runs.models import Run, RunTag
from app.runs.verdicts import criterion_rows, measurement_rows
from bench.recorded import Blocks, make_test
from rtcore.rig.parameters import load_rig
from rtcore.virtual import PERIOD_S

STARTED = datetime(2026, 3, 2, 9, 30, tzinfo=UTC)
CONDITIONS = [
    {"name": "sched_fifo", "had": True, "reason": "priority 80"},
    {"name": "mlockall", "had": False, "reason": "not permitted: RLIMIT_MEMLOCK is 8 MB"},
]
Touch = Callable[[np.ndarray], None]  # what is done to each chunk before it is recorded


def file_run(
    database: Database,
    runs_dir: Path,
    blocks: Blocks,
    motion: Blocks = (),
    *,
    data: dict[str, Any] | None = None,
    touch: Touch | None = None,
    **noted: Any,
) -> int:
    """Play a test, record it, measure it, enter it; returns its number.

    `data` replaces parts of the definition, `noted` columns of the row (`operator`, `notes`, `outcome` …).
    """
    definition = make_test(blocks, motion).model_copy(update=data or {})
    setup = Setup(definition, load_rig(), ControllerSettings(), default_interlocks())
    simulating = begin_simulation(setup)
    if isinstance(simulating, Refusal):
        raise ValueError(simulating.detail)
    run_id = _enter(database, setup, noted)
    _record(simulating, RunFile.open(run_id, runs_dir, 0), touch)
    _close(database, run_id, simulating, runs_dir / str(run_id), noted)
    return run_id


def _enter(database: Database, setup: Setup, noted: dict[str, Any]) -> int:
    bodies: dict[str, Any] = {
        "definition": setup.definition.model_dump(mode="json", by_alias=True),
        "plan": outline(setup.definition).model_dump(mode="json"),
        "controller": setup.controller.model_dump(mode="json"),
        "interlocks": setup.interlocks.model_dump(mode="json"),
        "rig": setup.rig.model_dump(mode="json"),
        "conditions": CONDITIONS,
    }
    tags = [RunTag(tag=tag) for tag in noted.pop("tags", ())]
    with database.writing() as session:
        frozen = {f"{name}_id": repository.freeze(session, body) for name, body in bodies.items()}
        run = Run(
            **frozen,
            test_id="benchmark",
            test_name=noted.pop("test_name", setup.definition.name),
            revision=1,
            software_version="0.1.0",
            loop_life="1-1",
            period_ns=round(PERIOD_S * 1e9),
            started_at=STARTED,
            ticks=0,
            missing_ticks=0,
            tag_rows=tags,
        )
        session.add(run)
        session.flush()
        return run.id


def _record(simulating: Simulating, file: RunFile, touch: Touch | None) -> None:
    """Every tick, with wake-ups and tick times as if it were the loop."""
    random = np.random.default_rng(1)
    for i, chunk in enumerate(simulating.chunks()):
        if i == 0:
            file.began_at = int(chunk["tick"][0])
        chunk["wakeup_latency_s"] = random.gamma(2.0, 3e-6, len(chunk))
        chunk["tick_time_s"] = random.gamma(20.0, 3e-7, len(chunk))
        if touch is not None:
            touch(chunk)
        file.append(chunk)
    file.abandon_part()
    found = Recorded(file.began_at, file.next_tick - 1, file.extent.ticks, 0)
    convert(file.folder, {}, found, simulating.through.ending)
    remove_parts(file.folder)


def _close(
    database: Database, run_id: int, simulating: Simulating, folder: Path, noted: dict[str, Any]
) -> None:
    through = simulating.through
    first = through.events[0].tick if through.events else 0
    with database.writing() as session:
        run = repository.to_change(session, run_id)
        assert run is not None
        run.prediction_id = repository.freeze(
            session, simulating.prediction().model_dump(mode="json")
        )
        run.prediction_verdict = "clear"
        run.ended_at = STARTED + timedelta(seconds=through.ticks * PERIOD_S)
        run.outcome, run.reason = through.ending.outcome.value, through.ending.reason
        run.ticks, run.duration_s = through.ticks, through.ticks * PERIOD_S
        run.first_tick = first
        run.verdict = through.judged.verdict.value
        for name, value in noted.items():
            setattr(run, name, value)
        rows = measurement_rows(run_id, through.judged), criterion_rows(run_id, through.judged)
        repository.set_measured(session, run_id, *rows)
        repository.add_events(session, [_event(run_id, event) for event in through.events])


def _event(run_id: int, event: Any) -> dict[str, Any]:
    names = ("sequence", "tick", "kind", "code", "text", "value", "limit")
    told = {name: getattr(event, name) for name in names}
    for name in ("value", "limit"):
        told[name] = told[name] if np.isfinite(told[name]) else None
    return {"run_id": run_id, **told}
