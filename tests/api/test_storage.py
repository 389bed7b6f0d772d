"""The disk and the rule of retention over HTTP."""

import pytest

from tests.console_process import ConsoleProcess

pytestmark = [pytest.mark.process, pytest.mark.slow]
RULE = {"keep_days": 30.0, "keep_bytes": None, "keep_tags": ["paper"]}


def test_room_is_told_in_numbers(console: ConsoleProcess) -> None:
    told = console.http.get("/storage").json()
    assert 0 < told["free_bytes"] < told["total_bytes"]
    assert told["used_by_runs_bytes"] >= 0
    assert 100 * 4000 < told["bytes_per_s"] < 250 * 4000
    assert told["retention"]["keep_days"] is None
    shown = console.status()["storage"]
    assert shown["state"] == told["state"]


def test_a_rule_is_previewed_saved_and_not_overwritten(console: ConsoleProcess) -> None:
    based_on = console.http.get("/storage").json()["retention"]["revision"]
    preview = console.http.get("/storage/retention/preview", params={"keep_days": 30})
    assert preview.json() == {"runs": [], "bytes": 0}
    saved = console.http.put("/storage/retention", json=RULE | {"based_on": based_on})
    assert saved.json()["revision"] == based_on + 1
    assert saved.json()["keep_tags"] == ["paper"]
    stale = console.http.put("/storage/retention", json=RULE | {"based_on": based_on})
    assert (stale.status_code, stale.json()["code"]) == (409, "edit_conflict")


def test_a_rule_that_makes_no_sense_is_refused(console: ConsoleProcess) -> None:
    for wrong in ({"keep_days": 0}, {"keep_bytes": -1}, {"keep_tags": [""]}, {"keep": 1}):
        answer = console.http.put("/storage/retention", json=RULE | {"based_on": 0} | wrong)
        assert (answer.status_code, answer.json()["code"]) == (422, "invalid_request")
