"""Measures and judges what was recorded of a run, and acquires what its test asks for, in one pass."""

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import ExitStack
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pyarrow.parquet as pq

from app.analysis.acquisition.table import Acquisition
from app.analysis.predicted import Predicted
from app.analysis.walk import NEEDED, Columns
from app.conducting.responding import NEEDS, Responding, responds
from app.controller.settings import ControllerSettings
from app.definitions.definition import Definition
from app.definitions.reading import definition_from
from app.errors import Refusal
from app.histories.history import Histories
from app.prediction.judgement import Judged, judge_measured, measuring
from app.prediction.series_file import NAME as PREDICTED
from app.recording.samples import Samples, open_samples
from app.rig_configuration.record import model_of
from app.runs.acquiring import asked
from app.runs.acquisition_files import AcquisitionWriter, acquisition_path, writing
from app.runs.response_file import write_points
from rtcore.rig.parameters import RigParameters


@dataclass(frozen=True)
class Subject:
    """What has to be known of a run to measure it."""

    folder: Path
    definition: Mapping[str, Any]
    controller: Mapping[str, Any]
    period_s: float
    first_tick: int | None
    completed: bool
    rig: Mapping[str, Any] | None = None  # its model, for the response of the unit under test


def measure(subject: Subject, histories: Histories | None = None) -> Judged | None:
    """What a run amounts to; None where it has no samples. Writes its acquisitions beside them.

    Raises `ValueError` where its definition cannot be read any more, and `OSError`.
    """
    definition = read_definition(subject.definition, histories)
    samples = open_samples(subject.folder)
    if samples is None:
        return None
    first_tick = samples.first_tick if subject.first_tick is None else subject.first_tick
    valve_limit = ControllerSettings.model_validate(subject.controller).valve_limit
    run = measuring(
        definition, subject.period_s, valve_limit, _predicted(subject.folder), first_tick
    )
    with ExitStack() as stack:
        tables = _tables(stack, subject, definition, first_tick)
        responding = Responding(definition, subject.period_s, first_tick, read_rig(subject.rig))
        has_responses = responds(definition)
        needs = [table.needs for table, _ in tables] + ([NEEDS] if has_responses else [])
        for chunk in _chunks(samples, needs):
            run.take(chunk)
            if has_responses:
                responding.take(chunk)
            for table, file in tables:
                file.append(table.take(chunk))
        for table, file in tables:
            file.append(table.close())
    if has_responses:
        write_points(subject.folder, responding.points())
    return judge_measured(definition, run.result(), completed=subject.completed)


def read_definition(data: Mapping[str, Any], histories: Histories | None) -> Definition:
    """The definition that a run was made with. Raises `ValueError` where it cannot be read."""
    definition = definition_from(data, histories=histories)
    if isinstance(definition, Refusal):
        raise ValueError(f"the definition of the run cannot be read: {definition.detail}")
    return definition


def read_rig(data: Mapping[str, Any] | None) -> RigParameters | None:
    """The model of the rig that a run was made with; None where it cannot be read any more."""
    try:
        return None if data is None else model_of(data)
    except ValueError:
        return None


def _tables(
    stack: ExitStack, subject: Subject, definition: Definition, first_tick: int
) -> list[tuple[Acquisition, AcquisitionWriter]]:
    """The acquisitions of a run, each with the file that it goes to."""
    tables = []
    for index, one in enumerate(asked(definition)):
        table = one.begin(subject.period_s, first_tick)
        path = acquisition_path(subject.folder, index)
        tables.append((table, stack.enter_context(writing(path, table.columns))))
    return tables


def _chunks(samples: Samples, needs: Iterable[Sequence[str]]) -> Iterator[Columns]:
    names = dict.fromkeys([*NEEDED, *(name for one in needs for name in one)])
    return samples.chunks(list(names), samples.first_tick, samples.last_tick)


def _predicted(folder: Path) -> Predicted | None:
    """The force that was predicted for the run; None where nothing was."""
    path = folder / PREDICTED
    return Predicted(_predicted_chunks(path)) if path.exists() else None


def _predicted_chunks(path: Path) -> Iterator[Columns]:
    names = ["program_tick", "force_n"]
    with pq.ParquetFile(path) as file:
        for batch in file.iter_batches(columns=names):
            yield {name: batch.column(name).to_numpy() for name in names}


Measurer = Callable[[Subject], Judged | None]
