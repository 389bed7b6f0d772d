"""Runs of the virtual rig, recorded as a live one is and finalised by the clerk: measured and judged."""

import math
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt
import pyarrow as pa
import pyarrow.parquet as pq
import pytest

from app.controller.record import to_record as gains_record
from app.controller.settings import ControllerSettings
from app.db import Database
from app.definitions.definition import Definition
from app.definitions.expansion import expand
from app.definitions.limits import RIG
from app.definitions.outline import outline
from app.definitions.reading import definition_from
from app.errors import Refusal
from app.interlocks.defaults import default_interlocks
from app.interlocks.record import to_record as interlocks_record
from app.recording.clerk import Clerk
from app.recording.outcome import Ending, Outcome
from app.recording.parts import PartWriter
from app.recording.recovery import close_orphans
from app.recording.run_file import Recorded
from app.runs import repository
from app.runs.acquisition_files import acquisition_path
from app.runs.ledger import Ledger
from app.runs.measuring import Measurer, measure
from app.runs.models import Run
from app.runs.results import Results
from app.runs.results_schemas import AcquisitionRows, RunMeasurements
from rtcore.codes import Opcode, Reply
from rtcore.virtual import Virtual

COMPLETED = Ending(Outcome.COMPLETED, None)
TRIPPED = Ending(Outcome.TRIPPED, "Force beyond its limit")
BLOCKS = [
    {"kind": "step", "to_n": 1000, "hold_s": 0.3},
    {"kind": "harmonic", "amplitude_n": 2000, "mean_n": 500, "frequency_hz": 20, "cycles": 30},
    {"kind": "ramp", "to_n": 0, "rate_n_s": 5000},
]
ALSO: list[dict[str, Any]] = [
    {"kind": "timed", "rate_hz": 100},
    {"kind": "peak_valley"},
    {"kind": "max_min", "every_s": 0.5},
    {"kind": "logarithmic_cycles"},
]


def _data(*acceptance: dict[str, Any]) -> dict[str, Any]:
    data = {"schema": 1, "name": "judged", "blocks": BLOCKS, "record": {"also": ALSO}}
    return data | {"acceptance": list(acceptance)}


@pytest.fixture(scope="module")
def records() -> npt.NDArray[Any]:
    """Every tick of the run."""
    definition = definition_from(_data())
    assert isinstance(definition, Definition), definition.detail
    interlocks = interlocks_record(default_interlocks(), RIG.period_s)
    virtual = Virtual(gains_record(ControllerSettings()), interlocks)
    virtual.bring_to_ready()
    assert virtual.load_program(expand(definition)) == Reply.ACCEPTED
    assert virtual.command(Opcode.START, 1) == Reply.ACCEPTED
    first = virtual.block.ring[[(virtual.tick - 1) % len(virtual.block.ring)]].copy()
    rest = virtual.advance(round(outline(definition).duration_s / RIG.period_s) + 4000)
    found = np.concatenate([first, rest])
    of_the_run: npt.NDArray[Any] = found[found["run"] == 1]
    return of_the_run


class _Lab:
    """A data directory with one run in it, as a recorder leaves it for the clerk."""

    def __init__(self, folder: Path, data: dict[str, Any], measurer: Measurer = measure) -> None:
        self.runs_dir = folder / "runs"
        self.database = Database(f"sqlite:///{folder / 'book.db'}")
        self.database.upgrade()
        self.over: list[tuple[int, int]] = []
        ended = lambda run_id, ticks: self.over.append((run_id, ticks))  # noqa: E731
        ledger = Ledger(self.database, self.runs_dir, measurer, lambda: None, ended)
        self._clerk = Clerk(self.runs_dir, ledger)
        self.results = Results(self.database, self.runs_dir, None)
        self.run_id = self._enter(data)

    def record(self, records: npt.NDArray[Any]) -> Recorded:
        """Write the parts of the run."""
        part = PartWriter(self.runs_dir / str(self.run_id))
        for piece in np.array_split(records, 7):
            part.append(piece)
        part.close()
        first, last = int(records["tick"][0]), int(records["tick"][-1])
        return Recorded(first, last, len(records), last - first + 1 - len(records))

    def finalise(self, records: npt.NDArray[Any], ending: Ending = COMPLETED) -> RunMeasurements:
        """Record the run and let the clerk end it; what was measured then."""
        self._clerk.ended(self.run_id, self.record(records), ending)
        self._clerk.work_off()
        found = self.results.measurements(self.run_id)
        assert isinstance(found, RunMeasurements)
        return found

    def run(self) -> Run:
        """Its row."""
        with self.database.reading() as session:
            run = repository.get(session, self.run_id)
            assert run is not None
            session.expunge(run)
            return run

    def _enter(self, data: dict[str, Any]) -> int:
        documents = {
            "definition_id": data,
            "plan_id": {},
            "controller_id": ControllerSettings().model_dump(mode="json"),
            "interlocks_id": {},
            "rig_id": {},
            "conditions_id": [],
        }
        with self.database.writing() as session:
            frozen = {name: repository.freeze(session, body) for name, body in documents.items()}
            run = Run(
                test_id="judged",
                test_name="judged",
                software_version="0",
                loop_life="1-1",
                period_ns=round(RIG.period_s * 1e9),
                started_at=datetime.now(UTC),
                **frozen,
            )
            session.add(run)
            session.flush()
            return int(run.id)


def _run_values(found: RunMeasurements) -> dict[str, float | None]:
    return {value.name: value.value for value in found.run}


def test_a_run_that_keeps_its_limits_passes(tmp_path: Path, records: npt.NDArray[Any]) -> None:
    lab = _Lab(
        tmp_path,
        _data(
            {"measurement": "cycles", "at_least": 30, "at_most": 30},
            {"measurement": "amplitude_error_percent", "block": 1, "at_least": -20, "at_most": 20},
            {"measurement": "step_overshoot_percent", "block": 0, "at_most": 60},
            {"measurement": "peak_force_n", "at_most": 5000},
        ),
    )
    found = lab.finalise(records)
    assert found.verdict == "pass"
    assert [c.outcome for c in found.criteria] == ["pass"] * 4
    assert [c.block for c in found.criteria] == [None, 1, 0, None]
    assert lab.run().verdict == "pass"
    assert lab.run().outcome == "completed"
    assert [(b.block, b.kind) for b in found.blocks] == [(0, "step"), (1, "harmonic"), (2, "ramp")]


def test_what_is_measured_is_what_numpy_has_of_the_record(
    tmp_path: Path, records: npt.NDArray[Any]
) -> None:
    found = _Lab(tmp_path, _data()).finalise(records)
    assert found.verdict == "unset"  # nothing was asked
    values = _run_values(found)
    in_block = records[(records["block"] == 1) & (records["mode"] == 4)]
    counted = in_block[400:-400]  # two cycles of tapers at 20 Hz on either side
    assert len(counted) == 6000
    force_n = counted["force_n"].astype(np.float64)
    phase = 2 * np.pi * 20 * RIG.period_s * np.arange(6000)
    bins = [np.mean(force_n * np.exp(-1j * k * phase)) * 2 for k in range(11)]
    setpoint = np.mean(counted["force_command_n"] * np.exp(-1j * phase)) * 2
    assert values["amplitude_n"] == pytest.approx(abs(bins[1]), rel=1e-6)
    assert values["mean_n"] == pytest.approx(np.mean(force_n), rel=1e-6)
    lag_deg = math.degrees(np.angle(bins[1] / setpoint))
    assert values["phase_deg"] == pytest.approx(lag_deg, abs=1e-4)
    distortion = 100 * np.linalg.norm(bins[2:]) / abs(bins[1])
    assert values["total_harmonic_distortion_percent"] == pytest.approx(distortion, rel=1e-4)
    peaks = force_n.reshape(30, 200).max(axis=1)
    assert values["mean_peak_n"] == pytest.approx(np.mean(peaks), rel=1e-6)
    error_n = counted["force_error_n"].astype(np.float64)
    assert values["force_error_rms_n"] == pytest.approx(np.sqrt(np.mean(error_n**2)), rel=1e-6)


def test_whoever_waits_for_the_end_is_told_once_it_is_written(
    tmp_path: Path, records: npt.NDArray[Any]
) -> None:
    lab = _Lab(tmp_path, _data())
    assert lab.over == []
    lab.finalise(records)
    assert lab.over == [(lab.run_id, len(records))]


def test_one_limit_that_is_not_kept_fails_it(tmp_path: Path, records: npt.NDArray[Any]) -> None:
    lab = _Lab(
        tmp_path,
        _data(
            {"measurement": "cycles", "at_least": 30},
            {"measurement": "total_harmonic_distortion_percent", "at_most": 1e-6},
        ),
    )
    assert [c.outcome for c in lab.finalise(records).criteria] == ["pass", "fail"]
    assert lab.run().verdict == "fail"


def test_a_run_that_tripped_never_passes(tmp_path: Path, records: npt.NDArray[Any]) -> None:
    lab = _Lab(
        tmp_path,
        _data(
            {"measurement": "step_overshoot_percent", "block": 0, "at_most": 60},
            {"measurement": "force_error_rms_n", "block": 1, "at_most": 1e6},
            {"measurement": "force_error_rms_n", "block": 2, "at_most": 1e6},
            {"measurement": "cycles", "at_least": 30},
        ),
    )
    cut = records[: np.flatnonzero(records["block"] == 1)[3010]]
    found = lab.finalise(cut, TRIPPED)
    # the step was played to its end; the sine was cut, the ramp not reached, more cycles might come
    assert [c.outcome for c in found.criteria] == ["pass", "unset", "unset", "unset"]
    assert lab.run().verdict == "unset"
    assert _run_values(found)["cycles"] == 13


def test_what_a_run_that_tripped_had_broken_already_fails_it(
    tmp_path: Path, records: npt.NDArray[Any]
) -> None:
    lab = _Lab(tmp_path, _data({"measurement": "peak_force_n", "at_most": 100}))
    lab.finalise(records[:3000], TRIPPED)
    assert lab.run().verdict == "fail"


def test_a_bug_in_measuring_does_not_lose_the_run(
    tmp_path: Path, records: npt.NDArray[Any], caplog: pytest.LogCaptureFixture
) -> None:
    def broken(subject: object) -> None:
        raise ZeroDivisionError("by zero")

    lab = _Lab(tmp_path, _data({"measurement": "cycles", "at_least": 30}), broken)
    assert lab.finalise(records).verdict == "unset"
    assert lab.run().outcome == "completed"
    assert lab.run().reason == "It could not be measured: by zero"
    assert "could not be measured" in caplog.text
    assert pq.read_metadata(lab.runs_dir / "1" / "run.parquet").num_rows == len(records)


def test_a_run_left_open_by_a_kill_is_measured_at_the_next_start(
    tmp_path: Path, records: npt.NDArray[Any]
) -> None:
    lab = _Lab(tmp_path, _data({"measurement": "cycles", "at_least": 1}))
    lab.record(records[:8000])
    close_orphans(lab.runs_dir, lab._clerk, None)
    lab._clerk.work_off()
    assert (lab.run().outcome, lab.run().verdict) == ("interrupted", "unset")
    found = lab.results.measurements(1)
    assert isinstance(found, RunMeasurements)
    assert _run_values(found)["cycles"] == 30
    assert acquisition_path(lab.runs_dir / "1", 1).exists()


def test_a_run_without_a_tick_has_no_verdict(tmp_path: Path, records: npt.NDArray[Any]) -> None:
    lab = _Lab(tmp_path, _data({"measurement": "cycles", "at_least": 30}))
    lab._clerk.never_began(lab.run_id)
    lab._clerk.work_off()
    assert lab.run().outcome == "failed"
    assert lab.run().verdict == "unset"


def test_the_prediction_is_what_the_force_is_compared_with(
    tmp_path: Path, records: npt.NDArray[Any]
) -> None:
    lab = _Lab(tmp_path, _data({"measurement": "goodness_of_fit", "at_least": 99.9}))

    folder = lab.runs_dir / "1"
    folder.mkdir(parents=True)
    played = records[records["mode"] == 4]
    predicted = {
        "program_tick": np.arange(len(played)),
        "force_n": played["force_n"] + np.float32(25),
        "displacement_m": played["displacement_m"],
    }
    pq.write_table(pa.table(predicted), folder / "predicted.parquet")
    values = _run_values(lab.finalise(records))
    peak_n = np.max(np.abs(played[played["block"] == 1]["force_n"][400:-400]))
    assert values["goodness_of_fit"] == pytest.approx(100 * (1 - 25 / peak_n), rel=1e-5)
    assert lab.run().verdict == "fail"


def test_acquisitions_can_be_read_while_the_run_goes_on_and_afterwards(
    tmp_path: Path, records: npt.NDArray[Any]
) -> None:
    lab = _Lab(tmp_path, _data())
    none_yet = lab.results.acquisitions(1)
    assert isinstance(none_yet, list)
    assert [table.rows for table in none_yet] == [0, 0, 0, 0]
    lab.record(records[:5000])
    under_way = lab.results.rows(1, 0, 0, 100)
    lab.record(records[5000:])
    later = lab.results.rows(1, 0, 0, 10_000)
    lab._clerk.ended(
        1, Recorded(int(records["tick"][0]), int(records["tick"][-1]), len(records), 0), COMPLETED
    )
    lab._clerk.work_off()
    afterwards = lab.results.rows(1, 0, 0, 10_000)
    assert isinstance(under_way, AcquisitionRows)
    assert isinstance(later, AcquisitionRows)
    assert isinstance(afterwards, AcquisitionRows)
    assert under_way.rows == 125
    assert afterwards.rows == len(records) // 40 + 1
    assert later.rows == afterwards.rows - 1  # whether the last instant is over is not known yet
    assert under_way.columns["force_n"] == records["force_n"][:5000:40].tolist()[:100]
    for name, values in later.columns.items():
        assert afterwards.columns[name][:-1] == values, name


def test_the_tables_of_a_run_are_listed_and_served_as_text(
    tmp_path: Path, records: npt.NDArray[Any]
) -> None:
    lab = _Lab(tmp_path, _data())
    lab.finalise(records)
    tables = lab.results.acquisitions(1)
    assert isinstance(tables, list)
    assert [table.kind for table in tables] == [also["kind"] for also in ALSO]
    assert tables[1].rows == 30
    assert tables[3].rows == 5 * 200  # cycles 1, 2, 5, 10 and 20
    text = lab.results.as_csv(1, 1)
    assert not isinstance(text, Refusal)
    lines = b"".join(text).decode().splitlines()
    assert lines[0].startswith(
        "block [1],cycle [1],whole [1],peak_force_n [N],peak_force_time_s [s]"
    )
    assert len(lines) == 31
    in_block = records[(records["block"] == 1) & (records["mode"] == 4)]
    first = in_block[400:600]
    assert float(lines[1].split(",")[3]) == first["force_n"].max()
    unknown = lab.results.rows(1, 4, 0, 1)
    assert isinstance(unknown, Refusal)
    assert unknown.detail == "Run 1 has no acquisition 4: its test asks for 4"
    for index in range(4):
        assert acquisition_path(lab.runs_dir / "1", index).exists()


def test_a_run_that_is_in_the_book_is_not_given_up_afterwards(
    tmp_path: Path, records: npt.NDArray[Any]
) -> None:
    """A start without an answer: the run began, and ended, before the clerk had come to say so."""
    lab = _Lab(tmp_path, _data())
    lab.finalise(records)
    lab._clerk.never_began(lab.run_id)
    lab._clerk.work_off()
    run = lab.run()
    assert (run.outcome, run.ticks, run.reason) == ("completed", len(records), None)
