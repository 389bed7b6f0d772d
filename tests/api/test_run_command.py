"""`forcerig run` as a program of its own, against a real console."""

import json
import os
import signal
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from xml.etree import ElementTree as Xml

import pytest

from app.access.principal import Role
from tests.console_process import ConsoleProcess, wait_for

pytestmark = [pytest.mark.process, pytest.mark.slow]
STEP, LONG = "step-2-kn", "flight-spectrum"
PROGRAM = [sys.executable, "-c", "from app.cli import main; main()", "run"]


def begin(console: ConsoleProcess, *words: str) -> "subprocess.Popen[str]":
    """The command, with a token that may operate."""
    environment = os.environ | {
        "FORCERIG_URL": console.url,
        "FORCERIG_TOKEN": console.new_token(Role.OPERATOR),
    }
    pipes = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE}
    return subprocess.Popen([*PROGRAM, *words], env=environment, text=True, **pipes)  # type: ignore[call-overload,no-any-return]


@pytest.fixture
def free(console: ConsoleProcess) -> Iterator[ConsoleProcess]:
    """A console with a rig that is ready, and nobody in command."""
    console.make_ready()
    console.http.delete("/lease")
    yield console
    console.command("stop")


def test_from_command_to_verdict(free: ConsoleProcess, tmp_path: Path) -> None:
    report, xml = tmp_path / "report.pdf", tmp_path / "verdict.xml"
    command = begin(free, STEP, "--report", str(report), "--junit", str(xml), "--json")
    out, err = command.communicate(timeout=120)
    assert command.returncode == 0, err
    told = json.loads(out)
    assert (told["run"]["test_id"], told["run"]["outcome"]) == (STEP, "completed")
    assert told["measurements"]["verdict"] == "pass"
    assert "Prediction: clear" in err
    suite = Xml.fromstring(xml.read_bytes())
    assert suite.get("failures") == "0"
    assert len(suite.findall("testcase")) == 1 + len(told["measurements"]["criteria"])
    assert report.read_bytes().startswith(b"%PDF")
    assert free.http.get("/lease").json() is None


def test_somebody_who_is_in_command_stays_so(free: ConsoleProcess) -> None:
    free.take_command()
    command = begin(free, STEP, "--wait")
    _, err = command.communicate(timeout=60)
    assert command.returncode == 2
    assert "in command" in err
    assert free.mode() == "ready"


def test_ctrl_c_takes_the_load_off(free: ConsoleProcess) -> None:
    command = begin(free, LONG, "--wait")
    wait_for(lambda: free.mode() == "running", "the test to begin")
    run_id = free.status()["run"]["id"]
    command.send_signal(signal.SIGINT)
    _, err = command.communicate(timeout=60)
    assert command.returncode == 3, err
    assert "Stopped" in err
    assert free.mode() == "ready"
    assert free.ended_run(run_id)["outcome"] == "stopped"


def test_what_cannot_be_is_said_before_anything_moves(free: ConsoleProcess) -> None:
    for words, why in (
        (("no-such-test",), "no-such-test"),
        ((STEP, "--report", "/nowhere/r.pdf"), "There is no folder"),
        ((STEP, "--report", "r.docx"), ".pdf or .html"),
        ((STEP, "--url", "http://127.0.0.1:9"), "No console answers"),
    ):
        command = begin(free, *words)
        _, err = command.communicate(timeout=60)
        assert command.returncode == 2, err
        assert why in err
    assert free.http.get("/lease").json() is None
