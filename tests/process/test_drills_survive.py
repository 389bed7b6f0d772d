"""kill -9 of the console in the middle of a drill: the next one mends the rig, and says what happened."""

import pytest

from tests.console_process import ConsoleProcess, wait_for

pytestmark = [pytest.mark.process, pytest.mark.slow, pytest.mark.timeout(300)]


def test_a_drill_that_its_console_did_not_live_to_see_is_taken_back(
    console: ConsoleProcess,
) -> None:
    console.start().make_ready()
    answer = console.http.post("/drills", json={"fault": "load_cell_drift", "amount": 100.0})
    assert answer.status_code == 201, answer.text
    console.kill()
    console.start()
    wait_for(lambda: console.status()["injected"] == [], "a rig without faults")
    record = console.http.get(f"/drills/records/{answer.json()['id']}").json()
    assert record["state"] == "interrupted"
    assert record["why"] == "The console ended in the middle of it"
