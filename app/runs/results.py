"""What can be asked about a run's measurements and acquisitions."""

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt
import pyarrow as pa
from pyarrow import csv

from app.analysis.acquisition.table import Column, Rows
from app.db import Database
from app.errors import Code, Refusal
from app.histories.history import Histories
from app.runs import repository
from app.runs.acquiring import Asked, asked
from app.runs.acquisition_files import acquisition_path, count_rows, read_rows
from app.runs.live_acquisitions import LiveAcquisitions, Snapshot
from app.runs.measuring import Subject, read_definition
from app.runs.models import Run, RunMeasurement
from app.runs.results_schemas import (
    AcquisitionColumn,
    AcquisitionRows,
    AcquisitionSummary,
    BlockMeasurements,
    JudgedCriterion,
    MeasuredValue,
    RunMeasurements,
)
from app.runs.verdicts import WHOLE_RUN


@dataclass(frozen=True)
class _Table:
    """A table of a run, wherever its rows are; `from_row` is the first that is still there."""

    asked: Asked
    columns: Sequence[Column]
    rows: int
    read: Callable[[], Iterator[Rows]]
    from_row: int = 0


class Results:
    """The measurements and acquisitions of the runs of this data directory."""

    def __init__(self, database: Database, runs_dir: Path, histories: Histories | None) -> None:
        self._database = database
        self._runs_dir = runs_dir
        self._histories = histories
        self._live = LiveAcquisitions(histories)

    def measurements(self, run_id: int) -> RunMeasurements | Refusal:
        """What was measured of a run, and how it was judged."""
        with self._database.reading() as session:
            run = repository.get(session, run_id)
            if run is None:
                return _unknown(run_id)
            rows = repository.measurements(session, run_id)
            criteria = repository.criteria(session, run_id)
            blocks = sorted({row.block for row in rows} - {WHOLE_RUN})
            told = {
                "verdict": run.verdict,
                "criteria": [JudgedCriterion.model_validate(c) for c in criteria],
                "blocks": [_of_block(block, run, rows) for block in blocks],
                "run": _values(rows, WHOLE_RUN),
            }
            return RunMeasurements.model_validate(told)

    def acquisitions(self, run_id: int) -> list[AcquisitionSummary] | Refusal:
        """The tables that a run has beside its record."""
        tables = self._tables(run_id)
        if isinstance(tables, Refusal):
            return tables
        return [_summary(index, table) for index, table in enumerate(tables)]

    def rows(self, run_id: int, index: int, from_row: int, limit: int) -> AcquisitionRows | Refusal:
        """Some rows of a table."""
        table = self._table(run_id, index)
        if isinstance(table, Refusal):
            return table
        first = max(from_row, table.from_row)
        columns = _cut(table, first - table.from_row, limit)
        return AcquisitionRows(from_row=first, rows=table.rows, columns=columns)

    def as_csv(self, run_id: int, index: int) -> Iterator[bytes] | Refusal:
        """A whole table as text, with the units in its first line."""
        table = self._table(run_id, index)
        return table if isinstance(table, Refusal) else _csv(table)

    def _table(self, run_id: int, index: int) -> _Table | Refusal:
        tables = self._tables(run_id)
        if isinstance(tables, Refusal):
            return tables
        if index < len(tables):
            return tables[index]
        detail = f"Run {run_id} has no acquisition {index}: its test asks for {len(tables)}"
        return Refusal(Code.NOT_FOUND, detail)

    def _tables(self, run_id: int) -> list[_Table] | Refusal:
        with self._database.reading() as session:
            run = repository.get(session, run_id)
            if run is None:
                return _unknown(run_id)
            under_way = run.outcome is None
            subject = Subject(
                folder=self._runs_dir / str(run_id),
                definition=run.definition,
                controller=run.controller,
                period_s=run.period_ns * 1e-9,
                first_tick=run.first_tick,
                completed=False,
            )
        try:
            return self._going_on(run_id, subject) if under_way else self._finished(subject)
        except (ValueError, OSError) as error:
            return Refusal(
                Code.NO_DATA, f"The acquisitions of run {run_id} cannot be read: {error}"
            )

    def _going_on(self, run_id: int, subject: Subject) -> list[_Table]:
        return [
            _Table(now.asked, now.columns, now.rows, _keeper(now), now.forgotten)
            for now in self._live.tables(run_id, subject)
        ]

    def _finished(self, subject: Subject) -> list[_Table]:
        tables = []
        for index, one in enumerate(asked(read_definition(subject.definition, self._histories))):
            path = acquisition_path(subject.folder, index)
            columns = one.begin(subject.period_s, 0).columns
            if path.exists():
                read = _reader(path)
                tables.append(_Table(one, columns, count_rows(path), read))
            else:
                tables.append(_Table(one, columns, 0, lambda: iter(())))
        return tables


def _keeper(now: Snapshot) -> Callable[[], Iterator[Rows]]:
    return lambda: iter([now.content()])


def _reader(path: Path) -> Callable[[], Iterator[Rows]]:
    return lambda: read_rows(path)


def _summary(index: int, table: _Table) -> AcquisitionSummary:
    columns = [AcquisitionColumn(name=c.name, unit=c.unit) for c in table.columns]
    kind, title = table.asked.kind, table.asked.title
    return AcquisitionSummary(index=index, kind=kind, title=title, rows=table.rows, columns=columns)


def _cut(table: _Table, first: int, limit: int) -> dict[str, list[float | None]]:
    """Rows from `first` on, at most `limit`."""
    found: dict[str, list[float | None]] = {column.name: [] for column in table.columns}
    at = 0
    for rows in table.read():
        count = len(rows[table.columns[0].name])
        low, high = max(0, first - at), min(count, first + limit - at)
        for name, values in rows.items():
            found[name] += _numbers(values[low:high]) if low < high else []
        at += count
        if at >= first + limit:
            break
    return found


def _numbers(values: npt.NDArray[Any]) -> list[float | None]:
    if values.dtype.kind != "f":
        return list(values.tolist())
    return [value if np.isfinite(value) else None for value in values.tolist()]


def _csv(table: _Table) -> Iterator[bytes]:
    yield (",".join(f"{c.name} [{c.unit}]" for c in table.columns) + "\n").encode()
    for rows in table.read():
        arrays = [pa.array(rows[c.name], from_pandas=True) for c in table.columns]
        batch = pa.record_batch(arrays, names=[c.name for c in table.columns])
        sink = pa.BufferOutputStream()
        csv.write_csv(batch, sink, csv.WriteOptions(include_header=False))
        yield sink.getvalue().to_pybytes()


def _of_block(block: int, run: Run, rows: Iterable[RunMeasurement]) -> BlockMeasurements:
    kind = str(run.definition["blocks"][block]["kind"])
    return BlockMeasurements(block=block, kind=kind, measurements=_values(rows, block))


def _values(rows: Iterable[RunMeasurement], block: int) -> list[MeasuredValue]:
    return [
        MeasuredValue(name=row.name, unit=row.unit, value=row.value)
        for row in rows
        if row.block == block
    ]


def _unknown(run_id: int) -> Refusal:
    return Refusal(Code.UNKNOWN_RUN, f"There is no run {run_id}")
