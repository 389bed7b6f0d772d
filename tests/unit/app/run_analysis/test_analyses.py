"""The analysis of a recorded run: what it tells of a run on the virtual rig, and that it is computed once."""

from collections.abc import Iterator
from datetime import UTC, datetime
from pathlib import Path

import numpy as np
import pytest

from app.db import Database
from app.errors import Code, Refusal
from app.prediction.schemas import Computing
from app.recording.files import remove_samples
from app.run_analysis.computing import NAME, Subject, analysis_of
from app.run_analysis.schemas import BEFORE, VERSION, RunAnalysis
from app.run_analysis.service import Analyses
from app.runs.models import RunEvent
from tests.recorded_runs import PERIOD_S, SINE, enter, forget_samples, played

BLOCKS = [SINE, {"kind": "step", "to_n": 3000.0, "hold_s": 0.4}]


@pytest.fixture
def database(tmp_path: Path) -> Database:
    database = Database(f"sqlite:///{tmp_path / 'forcerig.sqlite'}")
    database.upgrade()
    return database


@pytest.fixture
def analyses(database: Database, tmp_path: Path) -> Iterator[Analyses]:
    analyses = Analyses(database, tmp_path / "runs")
    yield analyses
    analyses.close()


def test_a_run_on_the_virtual_rig_is_analysed_once_and_kept(
    database: Database, analyses: Analyses, tmp_path: Path
) -> None:
    run_id = enter(database, tmp_path / "runs", played(BLOCKS, 2.0), BLOCKS)
    found = analyses.of(run_id, wait_s=120)
    assert isinstance(found, RunAnalysis)
    (layer,) = found.layers
    assert layer.asked is not None
    assert (layer.asked.frequency_hz, layer.cycles, layer.range_n.count) == (50, 20, 20)
    assert layer.range_n.mean == pytest.approx(2 * (layer.amplitude_n or 0), rel=0.05)
    (step,) = found.steps
    assert (step.begin_n, step.end_n) == (0, 3000)
    assert step.dead_time_s is not None
    assert 0 < step.dead_time_s < (step.rise_s or 0) < 0.01
    assert abs(step.steady_error_n or 0) < 30
    path = tmp_path / "runs" / str(run_id) / NAME
    path.write_text(path.read_text().replace('"layers_in_all":1', '"layers_in_all":77'))
    again = analyses.of(run_id)
    assert isinstance(again, RunAnalysis)
    assert again.layers_in_all == 77


def test_what_is_kept_outlives_the_samples_and_what_is_not_is_refused(
    database: Database, analyses: Analyses, tmp_path: Path
) -> None:
    run_id = enter(database, tmp_path / "runs", played([SINE], 1.0), [SINE])
    folder = tmp_path / "runs" / str(run_id)
    assert isinstance(analyses.of(run_id), Computing)
    assert isinstance(analyses.of(run_id, wait_s=120), RunAnalysis)
    remove_samples(folder)
    forget_samples(database, run_id, datetime(2026, 3, 1, tzinfo=UTC))
    assert isinstance(analyses.of(run_id), RunAnalysis)
    (folder / NAME).unlink()
    refusal = analyses.of(run_id)
    assert isinstance(refusal, Refusal)
    assert refusal.code is Code.NO_DATA
    assert "retention on 2026-03-01" in refusal.detail


@pytest.mark.parametrize("skipped", [False, True])
def test_of_the_version_before_what_is_right_outlives_the_samples_too(
    database: Database, analyses: Analyses, tmp_path: Path, skipped: bool
) -> None:
    run_id = enter(database, tmp_path / "runs", played([SINE], 1.0), [SINE])
    assert isinstance(analyses.of(run_id, wait_s=120), RunAnalysis)
    folder = tmp_path / "runs" / str(run_id)
    path = folder / NAME
    path.write_text(path.read_text().replace(f'"version":{VERSION}', f'"version":{BEFORE}'))
    remove_samples(folder)
    forget_samples(database, run_id, datetime(2026, 3, 1, tzinfo=UTC))
    if skipped:
        with database.writing() as session:
            event = {"sequence": 1, "tick": 5, "kind": "skipped", "code": "2", "text": "Went on"}
            session.add(RunEvent(run_id=run_id, **event))
    assert isinstance(analyses.of(run_id), Refusal if skipped else RunAnalysis)


def test_a_run_under_way_and_one_that_is_not_there_are_refused(
    database: Database, analyses: Analyses, tmp_path: Path
) -> None:
    run_id = enter(database, tmp_path / "runs", played([SINE], 1.0), [SINE], outcome=None)
    codes = [found.code for n in (run_id, 99) if isinstance(found := analyses.of(n), Refusal)]
    assert codes == [Code.RUN_UNDER_WAY, Code.UNKNOWN_RUN]


def test_rainflow_of_the_setpoint_is_what_the_test_asks_for(tmp_path: Path) -> None:
    from app.documents.writing import to_data
    from bench.recorded import make_test
    from rtcore.rig.parameters import rig_from
    from tests.recorded_runs import recorded

    layers = [
        {"mean_n": 0.0, "amplitude_n": 4000.0, "frequency_hz": 50.0, "cycles": 30},
        {"mean_n": 0.0, "amplitude_n": 1000.0, "frequency_hz": 50.0, "cycles": 60},
    ]
    blocks = [{"kind": "layers", "layers": layers, "repeats": 1, "transition_s": 0.1}]
    records = played(blocks, 4.0)
    folder = recorded(tmp_path, 1, records)
    subject = Subject(
        folder, to_data(make_test(blocks)), rig_from({}).model_dump(mode="json"), PERIOD_S, None
    )
    shares: list[float] = []
    found = analysis_of(subject, shares.append)
    assert shares == sorted(shares)
    assert shares[-1] == pytest.approx(1.0)
    asked = {c.from_n: c.asked for c in found.rainflow.spectrum if c.asked > 5}
    assert sum(asked.values()) == pytest.approx(90, abs=8)  # and tapers
    assert max(asked) in (7500, 8000)
    ratio = (np.array([c.range_n.mean for c in found.layers]) / (8000, 2000)) ** 5
    damage = next(d for d in found.damage if d.exponent == 5)
    assert damage.ratio == pytest.approx(ratio[0], rel=0.25)  # of the large cycles, all but wholly


def test_slow_cycles_tell_the_stiffness_of_the_unit(tmp_path: Path) -> None:
    from app.documents.writing import to_data
    from bench.recorded import make_test
    from rtcore.rig.parameters import load_rig, rig_from
    from tests.recorded_runs import recorded

    slow = {"kind": "harmonic", "amplitude_n": 10_000.0, "frequency_hz": 2.0, "cycles": 5}
    blocks = [slow, SINE]
    folder = recorded(tmp_path, 1, played(blocks, 3.5))
    subject = Subject(
        folder, to_data(make_test(blocks)), rig_from({}).model_dump(mode="json"), PERIOD_S, None
    )
    (unit,) = analysis_of(subject, lambda share: None).unit
    assert (unit.block, unit.asked.frequency_hz, unit.cycles) == (0, 2.0, 5)
    assert unit.stiffness_n_m == pytest.approx(load_rig().unit.k_tra, rel=0.02)
    assert unit.backlash_m is not None
    assert unit.hysteresis_j is not None


def test_of_a_response_that_ends_early_each_frequency_is_a_layer(tmp_path: Path) -> None:
    from app.documents.writing import to_data
    from rtcore.rig.parameters import rig_from
    from tests.recorded_runs import recorded
    from tests.unit.app.conducting.responses import play, response_test

    frequencies_hz = [20.0, 40.0, 80.0]
    test = response_test(
        frequencies_hz=frequencies_hz, measure_cycles=40, confidence={"gain_db": 0.05}
    )
    run = play(test)
    assert run.skips > 0
    folder = recorded(tmp_path, 1, run.records)
    subject = Subject(folder, to_data(test), rig_from({}).model_dump(mode="json"), PERIOD_S, None)
    layers = analysis_of(subject, lambda share: None).layers
    assert [layer.asked.frequency_hz for layer in layers if layer.asked] == frequencies_hz
    gains = [(layer.amplitude_n or 0) / 2000 for layer in layers]
    assert gains == pytest.approx([point.gain for point in run.points], rel=0.02)
