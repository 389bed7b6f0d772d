"""Analysis, comparison and trend over the interface, of runs of the real loop."""

from typing import Any

import pytest

from tests.browser.session import HARMONIC, predict
from tests.console_process import ConsoleProcess, wait_for

pytestmark = [pytest.mark.process, pytest.mark.slow]


@pytest.fixture(scope="module")
def runs(console: ConsoleProcess) -> tuple[int, int]:
    """Two runs of the 50 Hz example."""
    predict(console, HARMONIC)
    console.make_ready()
    found = []
    for _ in range(2):
        found.append(console.start_run(HARMONIC))
        assert console.ended_run(found[-1])["outcome"] == "completed"
    return found[0], found[1]


def problem(console: ConsoleProcess, path: str) -> tuple[int, str]:
    answer = console.http.get(path)
    return answer.status_code, answer.json()["code"]


def test_an_analysis_is_computed_and_kept(console: ConsoleProcess, runs: tuple[int, int]) -> None:
    def found() -> dict[str, Any] | None:
        answer = console.http.get(f"/runs/{runs[0]}/analysis?wait_s=5")
        assert answer.status_code in (200, 202), answer.text
        return dict(answer.json()) if answer.status_code == 200 else None

    analysis = wait_for(found, "the analysis")
    (layer,) = analysis["layers"]
    assert layer["asked"] == {"frequency_hz": 50.0, "amplitude_n": 2000.0, "mean_n": 0.0}
    assert layer["range_n"]["count"] == layer["cycles"] > 0
    uncertainty = analysis["uncertainty"]
    squares = sum(part["standard_n"] ** 2 for part in uncertainty["contributions"])
    assert uncertainty["unit_expanded_n"] == pytest.approx(2 * squares**0.5)
    assert console.http.get(f"/runs/{runs[0]}/analysis?wait_s=0").status_code == 200
    assert problem(console, "/runs/999999/analysis") == (404, "unknown_run")


def test_two_runs_of_a_test_are_compared(console: ConsoleProcess, runs: tuple[int, int]) -> None:
    ids = f"{runs[0]},{runs[1]}"
    answer = console.http.get(f"/runs/compare?ids={ids}&tolerance_abs=1e6&points=500&wait_s=30")
    assert answer.status_code == 200, answer.text
    found = answer.json()
    assert [run["id"] for run in found["runs"]] == list(runs)
    assert found["settings"] == []
    (channel,) = found["overlay"]["channels"]
    assert len(found["overlay"]["x"]) <= 500
    (difference,) = channel["differences"]
    assert difference["exceeded_in_all"] == 0
    assert 0 < difference["rms"] < 100  # noise of two load cells, and of the loop

    assert problem(console, f"/runs/compare?ids={runs[0]}") == (422, "invalid_request")
    assert problem(console, "/runs/compare?ids=one,two") == (422, "invalid_request")
    assert problem(console, f"/runs/compare?ids={ids}&channels=x") == (422, "unknown_channel")
    assert problem(console, f"/runs/compare?ids={ids}&from_s=1e6") == (404, "no_data")


def test_a_trend_tells_of_every_run(console: ConsoleProcess, runs: tuple[int, int]) -> None:
    answer = console.http.get(f"/runs/trend?measurement=amplitude_n&test_id={HARMONIC}")
    assert answer.status_code == 200, answer.text
    found = answer.json()
    assert set(runs) <= {point["run_id"] for point in found["points"]}
    assert found["unit"] == "N"
    path = f"/runs/trend?measurement=beauty&test_id={HARMONIC}"
    assert problem(console, path) == (422, "invalid_request")
