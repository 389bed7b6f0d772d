"""The system's figures against independent counts."""

import json
import os
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from app.errors import Code, Refusal
from app.link.life import Life
from app.system.diagnosis import diagnose
from app.system.processes import folder_bytes, memory_bytes
from app.system.service import System
from app.system.timing import timing
from rtcore.memory.segment import private_block

CONDITIONS = [
    {"name": "sched_fifo", "had": False, "reason": "not permitted"},
    {"name": "mlockall", "had": True, "reason": "locked"},
]


@pytest.fixture
def life() -> Life:
    """A loop that has counted 100 wake-ups of 3.5 µs, one of 12.5, and one beyond the bins."""
    block = private_block(250_000, seconds=0.01)
    fields = block.fields
    fields["wakeup_histogram"][[3, 12, -1]] = 100, 1, 1
    fields["tick_time_histogram"][[20]] = 102
    fields["late_ticks"] = 2
    fields["snapshot"]["deadlines_missed"] = 5
    fields["conditions"] = json.dumps(CONDITIONS).encode()
    return Life(block)


def test_the_histograms_are_those_of_the_loop(life: Life) -> None:
    found = timing(life)
    assert found.wakeup.counts == life.block.fields["wakeup_histogram"].tolist()
    assert (found.ticks, found.late_ticks, found.deadlines_missed) == (102, 2, 5)
    assert found.wakeup.bin_s == 1e-6
    assert found.wakeup.p50_s == pytest.approx(3.51e-6)  # the 51st of 100 counts in [3, 4) µs
    assert found.wakeup.longest_s is None  # beyond the bins: nobody knows how long
    assert found.tick_time.longest_s == pytest.approx(21e-6)
    assert (found.period_s, found.realtime) == (250e-6, False)
    assert [condition.model_dump() for condition in found.conditions] == CONDITIONS


def test_looking_changes_nothing_in_the_loop(life: Life) -> None:
    before = np.array(life.block.fields["wakeup_histogram"])
    timing(life)
    diagnose(life)
    assert np.array_equal(before, life.block.fields["wakeup_histogram"])


def test_the_doctor_judges_by_the_running_loop_and_starts_no_other(
    life: Life, monkeypatch: pytest.MonkeyPatch
) -> None:
    def probe(*_: Any) -> None:
        raise AssertionError("a probe was started")

    monkeypatch.setattr("rtcore.doctor.LoopProbe", probe)
    found = diagnose(life)
    graded = {finding.name: finding.grade for finding in found.findings}
    assert graded["sched_fifo"] == "limited"
    assert graded["wakeups_of_the_loop"] == "unfit"  # 5 of 107 deadlines
    assert (found.verdict, "No probe" in found.measured) == ("not fit", True)
    assert "wakeups_of_the_loop" not in {finding.name for finding in diagnose(None).findings}


def test_a_system_without_a_loop_says_so(tmp_path: Path) -> None:
    system = System(_NO_DATABASE, tmp_path, lambda: None, lambda: 0)
    refusal = system.loop()
    assert isinstance(refusal, Refusal)
    assert refusal.code is Code.LOOP_LOST


def test_folders_and_processes_take_up_what_they_hold(tmp_path: Path) -> None:
    (tmp_path / "runs" / "1").mkdir(parents=True)
    (tmp_path / "runs" / "1" / "run.parquet").write_bytes(bytes(700))
    (tmp_path / "forcerig.sqlite").write_bytes(bytes(30))
    (tmp_path / "lost").symlink_to(tmp_path / "nowhere")
    assert folder_bytes(tmp_path) == 730 + len(str(tmp_path / "nowhere"))
    assert folder_bytes(tmp_path / "nowhere") == 0
    held = memory_bytes(os.getpid())
    assert held is not None
    assert held > 1_000_000
    assert memory_bytes(2**22 + 1) is None


_NO_DATABASE: Any = None
