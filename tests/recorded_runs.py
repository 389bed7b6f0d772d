"""Runs of the virtual rig, recorded as a console would, in its book and on its disk."""

from collections.abc import Mapping, Sequence
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from app.db import Database
from app.documents.writing import to_data
from app.prediction.judgement import judge_run
from app.recording.files import convert
from app.recording.outcome import Ending, Outcome
from app.recording.run_file import Recorded, RunFile
from app.runs import repository
from app.runs.models import Run
from app.runs.verdicts import measurement_rows
from bench.recorded import begin, make_test, ready_rig
from rtcore.rig.parameters import RigParameters, rig_from
from tests.a_run import a_run

PERIOD_S = 250e-6
Records = npt.NDArray[Any]
SINE = {"kind": "harmonic", "amplitude_n": 2000.0, "frequency_hz": 50.0, "cycles": 20}


@cache
def _played(blocks: str, seed: int, ticks: int) -> Records:
    import json

    virtual = ready_rig(rig_from({}), seed=seed)
    begin(virtual, make_test(json.loads(blocks)))
    records = virtual.advance(ticks)
    found: Records = records[records["run"] == 1]
    return found


def played(blocks: Sequence[Mapping[str, Any]], seconds: float, seed: int = 1) -> Records:
    """(n,) TELEMETRY of blocks on the shipped rig, so many seconds at most."""
    import json

    return _played(json.dumps(list(blocks)), seed, round(seconds / PERIOD_S))


def recorded(runs_dir: Path, run_id: int, records: Records) -> Path:
    """The folder of a run with these ticks, its recording over."""
    file = RunFile.open(run_id, runs_dir, int(records["tick"][0]))
    file.append(records)
    file.abandon_part()
    there = Recorded(file.began_at, file.next_tick - 1, file.extent.ticks, file.missing_ticks)
    convert(file.folder, {"run_id": run_id}, there, Ending(Outcome.COMPLETED, None))
    return file.folder


def enter(
    database: Database,
    runs_dir: Path,
    records: Records,
    blocks: Sequence[Mapping[str, Any]],
    rig: RigParameters | None = None,
    **values: Any,
) -> int:
    """A run that is over, in the book with its measurements and on the disk; returns its number."""
    definition = make_test(blocks)
    with database.writing() as session:
        run = a_run(session, **values)
        run.definition_id = repository.freeze(session, to_data(definition))
        run.rig_id = repository.freeze(session, (rig or rig_from({})).model_dump(mode="json"))
        run.first_tick, run.last_tick = int(records["tick"][0]), int(records["tick"][-1])
        run.outcome, run.ticks = values.get("outcome", "completed"), len(records)
        session.add(run)
        session.flush()
        judged = judge_run(definition, records, PERIOD_S)
        repository.set_measured(session, run.id, measurement_rows(run.id, judged), [])
    recorded(runs_dir, run.id, records)
    return run.id


def forget_samples(database: Database, run_id: int, when: Any) -> None:
    """As retention does."""
    with database.writing() as session:
        run = session.get(Run, run_id)
        assert run is not None
        run.samples_removed_at = when


def with_force(records: Records, force_n: npt.ArrayLike) -> Records:
    """The same run with another force."""
    other = records.copy()
    other["force_n"] = np.asarray(force_n, np.float32)
    return other
