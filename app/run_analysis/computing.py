"""Computes the analysis of a run that is over: passes over its recording, in memory that does not grow."""

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import pyarrow.parquet as pq

from app.analysis.predicted import Predicted
from app.analysis.rainflow_counting import CountedCycles, count_cycles
from app.analysis.time_domain import NEEDED, TimeReader
from app.analysis.uncertainty import Known
from app.analysis.walk import Columns
from app.definitions.windows import stretches
from app.histories.history import Histories
from app.prediction.series_file import NAME as PREDICTED
from app.recording.samples import Samples, open_samples
from app.recording.whole_file import whole_file
from app.rig_configuration.configuration import FULL_SCALE_V
from app.rig_configuration.record import configuration_of, model_of
from app.run_analysis.schemas import VERSION, RunAnalysis
from app.run_analysis.told import told
from app.runs.measuring import read_definition

NAME = "analysis.json"
_READING, _COUNTING = 0.6, 0.2  # shares of the work: the first pass, and each of the two after it

Progress = Callable[[float], None]


@dataclass(frozen=True)
class Subject:
    """What has to be known of a run to analyse it; can be sent to another process."""

    folder: Path
    definition: Mapping[str, Any]
    rig: Mapping[str, Any]
    period_s: float
    first_tick: int | None
    histories: Histories | None = None


def analyse_run(report: Progress, subject: Subject) -> None:
    """Analyse a run and keep that in its folder. Raises `ValueError` where it cannot be, and `OSError`."""
    found = analysis_of(subject, report)
    with whole_file(subject.folder / NAME) as file:
        file.write(found.model_dump_json().encode())


def kept(folder: Path, version: int = VERSION) -> RunAnalysis | None:
    """The analysis in a run's folder, None where there is none of this version."""
    try:
        found = RunAnalysis.model_validate_json((folder / NAME).read_bytes())
    except (FileNotFoundError, ValueError):
        return None
    return found if found.version == version else None


def analysis_of(subject: Subject, report: Progress) -> RunAnalysis:
    """The analysis of a run with samples. Raises `ValueError` where it cannot be read, and `OSError`."""
    samples = open_samples(subject.folder)
    if samples is None:
        raise ValueError("there are no samples of the run")
    definition = read_definition(subject.definition, subject.histories)
    rig = model_of(subject.rig)
    first_tick = samples.first_tick if subject.first_tick is None else subject.first_tick
    reader = TimeReader(
        stretches(definition),
        subject.period_s,
        rig,
        predicted=_predicted(subject.folder),
        first_tick=first_tick,
        known=known_of(subject.rig),
    )
    for chunk in _chunks(samples, NEEDED, report, 0.0, _READING):
        reader.take(chunk)
    applied = _counted(samples, "force_n", report, _READING)
    asked = _counted(samples, "force_command_n", report, _READING + _COUNTING)
    return told(reader.result(), asked, applied, subject.period_s)


def known_of(rig: Mapping[str, Any]) -> Known | None:
    """What the configuration that a run was made with says of the load cell; None where it says nothing."""
    configuration = configuration_of(rig)
    if configuration is None:
        return None
    cell = configuration.calibrations.load_cell
    class_percent = cell.class_percent
    if class_percent is None:
        return None
    full_n = abs(cell.gain) * FULL_SCALE_V
    said = f"its calibration: {class_percent:g} % of {full_n / 1000:.3g} kN"
    return Known(load_cell_n=0.01 * class_percent * full_n, load_cell_from=said)


def _counted(samples: Samples, channel: str, report: Progress, done: float) -> CountedCycles:
    chunks = _chunks(samples, (channel,), report, done, _COUNTING)
    return count_cycles(np.asarray(chunk[channel]) for chunk in chunks)


def _chunks(
    samples: Samples, names: tuple[str, ...], report: Progress, done: float, share: float
) -> Iterator[Columns]:
    """The recording, chunk by chunk; what is done with one is over when the next is asked for."""
    ticks = max(1, samples.last_tick - samples.first_tick + 1)
    for chunk in samples.chunks(names, samples.first_tick, samples.last_tick):
        yield chunk
        if len(chunk["tick"]):
            report(done + share * (int(chunk["tick"][-1]) - samples.first_tick + 1) / ticks)


def _predicted(folder: Path) -> Predicted | None:
    path = folder / PREDICTED
    return Predicted(_predicted_chunks(path)) if path.exists() else None


def _predicted_chunks(path: Path) -> Iterator[Columns]:
    names = ["program_tick", "force_n"]
    with pq.ParquetFile(path) as file:
        for batch in file.iter_batches(columns=names):
            yield {name: batch.column(name).to_numpy() for name in names}
