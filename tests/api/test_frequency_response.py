"""Frequency responses of live runs: points on the stream and over REST, adapted live as on the virtual rig."""

import math
from typing import Any

import numpy as np
import pytest

from app.definitions.reading import definition_from
from app.errors import Refusal
from tests.api.test_live import listening, messages
from tests.console_process import ConsoleProcess, wait_for
from tests.unit.app.conducting.responses import play

pytestmark = [pytest.mark.process, pytest.mark.slow]
ADAPTIVE: dict[str, Any] = {
    "kind": "frequency_response",
    "amplitudes_n": [2000],
    "frequencies_hz": [20, 40, 80],
    "measure_cycles": 60,
    "confidence": {"gain_db": 0.1, "phase_deg": 1.0},
    "bands": [{"from_hz": 10, "to_hz": 100, "low_db": -6, "high_db": 6}],
}


def _definition(block: dict[str, Any]) -> dict[str, Any]:
    return {"schema": 1, "name": "Live response", "blocks": [block]}


def _saved(console: ConsoleProcess, block: dict[str, Any]) -> str:
    answer = console.http.post("/tests", json={"definition": _definition(block)})
    assert answer.status_code == 201, answer.text
    return str(answer.json()["id"])


def _response(console: ConsoleProcess, run_id: int, transfer: str = "force") -> Any:
    path = f"/runs/{run_id}/frequency-response"
    answer = console.http.get(path, params={"transfer": transfer, "wait_s": 20})
    assert answer.status_code == 200, answer.text
    return answer.json()


def test_an_adaptive_test_run_live_gives_what_the_virtual_rig_gives(ready: ConsoleProcess) -> None:
    test_id = _saved(ready, ADAPTIVE)
    with listening(ready) as stream:
        run_id = ready.start_run(test_id)
        told = messages(stream, "response")
        first = next(told)
        assert first["run"] == run_id
        assert first["point"]["frequency_hz"] == 20
        while (point := next(told))["point"]["frequency_hz"] != 80:
            assert point["block"] == 0
        so_far = _response(ready, run_id)
        assert so_far["progress"] is None or so_far["progress"]["of"] == 3
    assert ready.ended_run(run_id)["outcome"] == "completed"
    found = _response(ready, run_id)
    (series,) = found["series"]
    definition = definition_from(_definition(ADAPTIVE))
    assert not isinstance(definition, Refusal)
    expected = play(definition).by_frequency()
    assert [point["frequency_hz"] for point in series["points"]] == [20, 40, 80]
    for point in series["points"]:
        other = expected[point["frequency_hz"]]
        wide = point["gain_high"] - point["gain_low"] + other.gain_95.high - other.gain_95.low
        assert abs(point["gain"] - other.gain) <= max(wide, 0.01)
        assert point["gain_db"] == pytest.approx(20 * math.log10(point["gain"]))
        assert point["cycles"] < 60
    events = ready.http.get(f"/runs/{run_id}/events").json()["events"]
    assert sum(event["kind"] == "skipped" for event in events) == 3


def test_it_has_the_models_curve_bands_extremes_and_other_transfers(ready: ConsoleProcess) -> None:
    run_id = ready.start_run(_saved(ready, ADAPTIVE | {"measure_cycles": 6}))
    ready.ended_run(run_id)
    found = _response(ready, run_id)
    assert found["unit"] == "1"
    assert found["bands"][0]["high_db"] == 6
    assert found["progress"] is None
    (series,) = found["series"]
    assert series["method"] == "stepped_sine"
    assert series["extremes"]["peak"]["frequency_hz"] == pytest.approx(35, abs=10)
    assert {"force", "plant", "stiffness"} <= set(found["available"])
    model = wait_for(lambda: _response(ready, run_id)["model"], "the model's curve")[0]
    at = min(range(len(model["gain"])), key=lambda i: abs(model["frequencies_hz"][i] - 20))
    assert 20 * math.log10(model["gain"][at]) == pytest.approx(
        series["points"][0]["gain_db"], abs=1
    )
    assert _response(ready, run_id, "stiffness")["unit"] == "N/m"
    loop = _response(ready, run_id, "loop")
    assert "loop" in found["available"]
    assert loop["margins"][0]["crossover_hz"] == pytest.approx(48, abs=10)
    assert loop["model"] or wait_for(lambda: _response(ready, run_id, "loop")["model"], "a model")
    assert found["margins"] == []
    plant = _response(ready, run_id, "plant")
    assert plant["unit"] == "N"
    assert plant["series"][0]["points"][0]["gain_db"] is None
    assert plant["bands"] == plant["model"] == []


def test_a_multisine_has_its_lines_after_each_period(ready: ConsoleProcess) -> None:
    block = {
        "kind": "frequency_response",
        "method": "multisine",
        "amplitudes_n": [2000],
        "frequencies_hz": [10, 20, 30, 40, 50],
        "settle_cycles": 2,
        "measure_cycles": 8,
    }
    with listening(ready) as stream:
        run_id = ready.start_run(_saved(ready, block))
        assert next(messages(stream, "response"))["run"] == run_id
    ready.ended_run(run_id)
    (series,) = _response(ready, run_id)["series"]
    assert series["method"] == "multisine"
    assert [point["frequency_hz"] for point in series["points"]] == [10, 20, 30, 40, 50]
    assert all(point["noise_std"] < 0.1 for point in series["points"])


def test_a_multisine_of_the_motion_has_the_units_position_response(ready: ConsoleProcess) -> None:
    hold = {"kind": "hold", "force_n": 3000, "duration_s": 4.5}
    lines = [4.0, 8.0, 12.0, 16.0, 24.0]
    motion = {"kind": "multisine", "amplitude_m": 0.0008, "frequencies_hz": lines}
    definition = _definition(hold) | {"motion": [motion | {"realisations": 3}]}
    answer = ready.http.post("/tests", json={"definition": definition})
    assert answer.status_code == 201, answer.text
    with listening(ready) as stream:
        run_id = ready.start_run(str(answer.json()["id"]))
        told = next(messages(stream, "response"))
        assert (told["transfer"], told["point"]["amplitude_m"]) == ("position", 0.0008)
        assert told["point"]["mean_n"] == 3000
    assert ready.ended_run(run_id)["outcome"] == "completed"
    found = _response(ready, run_id, "position")
    assert found["available"] == ["position"]
    assert (found["unit"], found["bands"]) == ("1", [])
    (series,) = found["series"]
    assert (series["method"], series["amplitude_m"], series["mean_n"]) == (
        "multisine",
        0.0008,
        3000,
    )
    assert [point["frequency_hz"] for point in series["points"]] == lines
    assert all(0 <= point["nonlinear_std"] < 1e-3 for point in series["points"])
    assert series["extremes"]["minus_90_deg_hz"] == pytest.approx(12, rel=0.01)
    (model,) = found["model"]
    for point in series["points"]:
        gain = np.interp(point["frequency_hz"], model["frequencies_hz"], model["gain"])
        assert point["gain"] == pytest.approx(gain, rel=0.005)
        assert point["gain_low"] < point["gain"] < point["gain_high"]


def test_a_run_without_a_frequency_response_has_none(ready: ConsoleProcess) -> None:
    hold = {"kind": "hold", "duration_s": 0.1}
    run_id = ready.start_run(_saved(ready, hold))
    ready.ended_run(run_id)
    found = _response(ready, run_id)
    assert (found["series"], found["model"], found["bands"]) == ([], [], [])


def test_what_is_not_there_is_refused(console: ConsoleProcess) -> None:
    answer = console.http.get("/runs/99999/frequency-response")
    assert (answer.status_code, answer.json()["code"]) == (404, "unknown_run")
    answer = console.http.get("/runs/1/frequency-response", params={"transfer": "guess"})
    assert answer.status_code == 422
