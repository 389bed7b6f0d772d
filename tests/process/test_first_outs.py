"""First-outs of a real console: what is kept where it, or its loop, is killed around one."""

import os
import signal
from typing import Any

import numpy as np
import pyarrow.parquet as pq
import pytest

from app.access.principal import Role
from rtcore.memory.segment import attach_block
from tests.console_process import ConsoleProcess, wait_for

pytestmark = [pytest.mark.process, pytest.mark.slow, pytest.mark.timeout(600)]
AROUND_TICKS = 8000


def first_outs(console: ConsoleProcess) -> list[dict[str, Any]]:
    """All that are kept, the newest first."""
    answer = console.http.get("/first-outs")
    assert answer.status_code == 200, answer.text
    return list(answer.json()["first_outs"])


def kept(console: ConsoleProcess, count: int = 1) -> dict[str, Any]:
    """The newest, once there are so many."""
    wait_for(lambda: len(first_outs(console)) >= count, f"first-out {count}")
    return first_outs(console)[0]


def ticks_of(console: ConsoleProcess, number: int) -> Any:
    """The ticks in its file."""
    path = console.data / "first-outs" / str(number) / "box.parquet"
    return pq.read_table(path)["tick"].to_numpy()


def has_tripped(console: ConsoleProcess) -> bool:
    return int(attach_block(console.block).fields["first_out"]) >= 0


def test_the_console_is_killed_before_it_could_keep_anything(console: ConsoleProcess) -> None:
    console.start().make_ready()
    console.kill()
    wait_for(lambda: has_tripped(console), "a trip: nobody is there")
    console.start()
    row = kept(console)
    assert (row["detector"], row["mode_before"], row["run_id"]) == ("app_silence", "ready", None)
    ticks = ticks_of(console, row["id"])
    around = np.arange(row["tick"] - AROUND_TICKS, row["tick"] + AROUND_TICKS + 1)
    assert np.array_equal(ticks, around)

    detail = console.http.get(f"/first-outs/{row['id']}").json()
    assert detail["trips"][0]["detector"] == "app_silence"
    assert (detail["first_s"], detail["last_s"]) == (-2.0, 2.0)
    asked: dict[str, str | float] = {"channels": "force_n,mode", "from_s": -0.01, "to_s": 0.01}
    window = console.http.get(f"/first-outs/{row['id']}/samples", params=asked).json()
    assert not window["decimated"]
    assert (window["time_s"][0], window["time_s"][-1], len(window["time_s"])) == (-0.01, 0.01, 81)
    whole = console.http.get(f"/first-outs/{row['id']}/data.parquet")
    assert whole.content[:4] == b"PAR1"
    replayed = console.http.post(f"/first-outs/{row['id']}/replay").json()
    assert replayed["reproduces"]
    assert "app_silence" in [left["detector"] for left in replayed["not_replayed"]]

    viewer = console.as_role(Role.VIEWER)
    operator = console.as_role(Role.OPERATOR)
    path = f"/first-outs/{row['id']}"
    assert viewer.patch(path, json={"note": "x"}).status_code == 403
    noted = operator.patch(path, json={"note": "The console was killed", "cause": "test"})
    assert (noted.json()["note"], noted.json()["cause"]) == ("The console was killed", "test")
    assert operator.delete(path).status_code == 403

    assert console.stop() == 0
    console.start()
    assert [one["note"] for one in first_outs(console)] == ["The console was killed"]
    assert console.http.delete(path).status_code == 204
    assert console.http.get(path).json()["code"] == "unknown_first_out"
    assert not (console.data / "first-outs" / str(row["id"])).exists()


def test_the_loop_is_killed_just_after_it_tripped(console: ConsoleProcess) -> None:
    console.start().make_ready()
    console.signal(signal.SIGSTOP)
    wait_for(lambda: has_tripped(console), "a trip: nobody is there")
    os.kill(console.loop_pid, signal.SIGKILL)
    console.signal(signal.SIGCONT)
    row = kept(console)
    ticks = ticks_of(console, row["id"])
    assert row["detector"] == "app_silence"
    assert ticks[0] == row["tick"] - AROUND_TICKS
    assert row["tick"] <= ticks[-1] < row["tick"] + AROUND_TICKS
    assert row["ticks"] == len(ticks)


def test_both_are_killed_and_the_next_console_finds_it(console: ConsoleProcess) -> None:
    console.start().make_ready()
    console.kill()
    wait_for(lambda: has_tripped(console), "a trip: nobody is there")
    os.kill(console.loop_pid, signal.SIGKILL)
    console.start()
    row = kept(console)
    assert row["tick"] in ticks_of(console, row["id"])
    wait_for(lambda: console.status()["loop"]["alive"], "a new loop")
    console.make_ready()
    console.signal(signal.SIGSTOP)
    wait_for(lambda: has_tripped(console), "another trip, of the new loop")
    console.signal(signal.SIGCONT)
    assert kept(console, 2)["id"] != row["id"]
