"""What `forcerig check` and `forcerig simulate` do for people and for scripts."""

import json
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pyarrow.parquet as pq
import pytest
from typer.testing import CliRunner, Result

from app.cli import cli
from app.recording.parquet import read_metadata
from rtcore.channels import CHANNELS

GOOD = """\
schema: 1
name: A short hold
blocks:
  - {kind: hold, force_n: 1000, duration_s: 0.2}
acceptance:
  - {measurement: force_error_rms_n, at_most: 200}
"""
SHAKE = "harmonic, amplitude_n: 49000, frequency_hz: 60, cycles: 20"


def _run(*arguments: object) -> Result:
    return CliRunner().invoke(cli, [str(argument) for argument in arguments])


@pytest.fixture
def test_file(tmp_path: Path) -> Path:
    path = tmp_path / "test.yaml"
    path.write_text(GOOD)
    return path


def _json(result: Result) -> Any:
    """The one document on standard output."""
    return json.loads(result.stdout)


def test_check_prints_what_a_test_comes_to(test_file: Path) -> None:
    result = _run("check", test_file)
    assert result.exit_code == 0
    assert "A short hold" in result.stdout
    assert "0.3 s, 0 cycles, peak 1,000 N" in result.stdout


def test_check_gives_the_same_as_json(test_file: Path) -> None:
    document = _json(_run("check", test_file, "--json"))
    assert document["name"] == "A short hold"
    assert document["duration_s"] == pytest.approx(0.3)
    assert document["blocks"][0]["max_force_n"] == 1000


@pytest.mark.parametrize("command", ["check", "simulate"])
def test_a_bad_test_ends_with_2_and_names_file_line_path_and_limit(
    command: str, test_file: Path
) -> None:
    test_file.write_text(GOOD.replace("force_n: 1000", "force_n: 60000"))
    result = _run(command, test_file)
    assert result.exit_code == 2
    assert result.stdout == ""
    said = "line 4, blocks[0].force_n: 60,000 N must be at most 50,000 N"
    assert f"{test_file}: {said}" in result.stderr
    document = _json(_run(command, test_file, "--json"))
    assert document["code"] == "invalid_test"
    assert document["errors"] == [
        {
            "path": "blocks[0].force_n",
            "value": 60000,
            "message": "60,000 N must be at most 50,000 N",
            "limit": 50000.0,
            "unit": "N",
            "line": 4,
        }
    ]


def test_a_test_that_is_nowhere_ends_with_2() -> None:
    assert "no such file" in _run("check", "missing.yaml").stderr
    result = _run("simulate", "step-2kn")
    assert result.exit_code == 2
    assert "did you mean step-2-kn?" in result.stderr


def test_the_paper_s_step_is_reproduced() -> None:
    result = _run("simulate", "step-2-kn", "--json")
    assert result.exit_code == 0
    document = _json(result)
    assert (document["outcome"], document["verdict"]) == ("completed", "pass")
    measured = {m["name"]: m["value"] for m in document["measurements"]}
    # data sheet, section 5
    assert measured["step_overshoot_percent"] == pytest.approx(22.7, abs=1.5)
    assert measured["step_rise_s"] == pytest.approx(2.25e-3, abs=0.3e-3)
    assert measured["step_settling_s"] == pytest.approx(41e-3, abs=4e-3)


def test_a_criterion_that_is_not_met_ends_with_1(test_file: Path) -> None:
    test_file.write_text(GOOD.replace("at_most: 200", "at_most: 0.001"))
    result = _run("simulate", test_file)
    assert result.exit_code == 1
    assert "Verdict: fail" in result.stdout


def test_a_criterion_that_could_not_be_measured_is_not_passed(test_file: Path) -> None:
    test_file.write_text(GOOD.replace("force_error_rms_n", "step_rise_s"))
    result = _run("simulate", test_file)
    assert result.exit_code == 1
    assert "Verdict: unset" in result.stdout


def test_a_trip_ends_with_3_and_says_why(test_file: Path, tmp_path: Path) -> None:
    controller = tmp_path / "wild.yaml"
    controller.write_text("k_p: 5.0e-4\n")  # forty times the shipped gain: unstable
    result = _run("simulate", test_file, "--controller", controller, "--json")
    assert result.exit_code == 3
    document = _json(result)
    assert document["outcome"] == "tripped"
    assert document["reason"] == "LVT: saturated"


def test_goodness_of_fit_is_taken_against_another_seed(test_file: Path) -> None:
    test_file.write_text(
        GOOD.replace("force_error_rms_n, at_most: 200", "goodness_of_fit, at_least: 95")
    )
    document = _json(_run("simulate", test_file, "--json"))
    (criterion,) = document["acceptance"]
    assert criterion["outcome"] == "pass"
    assert 95 < criterion["value"] < 100  # the noise differs


def test_the_file_holds_every_channel_and_all_it_was_made_with(
    test_file: Path, tmp_path: Path
) -> None:
    out = tmp_path / "run.parquet"
    result = _run("simulate", test_file, "--out", out, "--seed", 7, "--json")
    assert result.exit_code == 0
    document = _json(result)
    table = pq.read_table(out)
    assert table.column_names == [channel.name for channel in CHANNELS]
    assert table.num_rows == document["ticks"]
    assert np.all(np.diff(table["tick"].to_numpy()) == 1)
    metadata = read_metadata(out)
    assert metadata["seed"] == 7
    assert metadata["definition"]["blocks"][0]["force_n"] == 1000
    assert metadata["controller"]["k_p"] == 1.19e-5
    assert metadata["interlocks"]["detectors"][0]["name"] == "load_cell"
    assert metadata["rig"]["unit"]["stroke_m"] == 0.03
    assert metadata["software_version"]
    assert metadata["verdict"] == "pass"


def test_the_same_seed_gives_the_same_run_to_the_bit(test_file: Path, tmp_path: Path) -> None:
    forces = []
    for seed in (3, 3, 4):
        out = tmp_path / "run.parquet"
        assert _run("simulate", test_file, "--seed", seed, "--out", out).exit_code == 0
        forces.append(pq.read_table(out)["force_n"].to_numpy())
    assert np.array_equal(forces[0], forces[1])
    assert not np.array_equal(forces[0], forces[2])


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ("suply: {high_pa: 2.1e7}", "suply: unknown key; did you mean supply?"),
        ("supply: {high_pa: 2.1e9}", "supply.high_pa: 2,100,000,000 Pa must be at most"),
        ("supply: {high_pa: 1.0e7}", "does not become ready"),
        ("unit: {stroke_m: 0.001}", "beyond the limits of this rig"),
    ],
)
def test_a_rig_that_cannot_do_it_ends_with_2(tmp_path: Path, text: str, says: str) -> None:
    rig = tmp_path / "rig.yaml"
    rig.write_text(text)
    result = _run("simulate", "harmonic-2-kn-50-hz-moving", "--rig", rig)
    assert result.exit_code == 2
    assert says in result.stderr


@pytest.mark.parametrize(
    ("arguments", "says"),
    [
        (("--report", "r.doc"), "r.doc is none of .pdf or .html"),
        (("--report", "missing/r.pdf"), "there is no folder missing"),
        (("--out", "missing/run.parquet"), "there is no folder missing"),
        (("--controller", "missing.yaml"), "missing.yaml: no such file"),
    ],
)
def test_bad_options_end_with_2_before_anything_runs(
    test_file: Path, arguments: tuple[str, ...], says: str
) -> None:
    result = _run("simulate", test_file, *arguments)
    assert result.exit_code == 2
    assert says in result.stderr
    assert result.stdout == ""


def test_the_margins_and_the_prediction_s_verdict_are_printed(test_file: Path) -> None:
    printed = _run("simulate", test_file).stdout
    assert "supply_pressure" in printed
    assert (
        "Only the live rig can tell: valve_spool, twin_residual, twin_goodness, app_silence"
        in printed
    )
    assert "Prediction: clear" in printed
    prediction = _json(_run("simulate", test_file, "--json"))["prediction"]
    assert prediction["verdict"] == "clear"
    assert prediction["shortened"] == []
    force = next(m for m in prediction["margins"] if m["detector"] == "force")
    assert force["margin"] == pytest.approx(55e3 - force["extreme"])
    assert 1000 < force["extreme"] < 1100


def test_a_test_that_trips_says_which_interlock_and_where(test_file: Path) -> None:
    test_file.write_text(GOOD.replace("hold, force_n: 1000, duration_s: 0.2", SHAKE))
    result = _run("simulate", test_file)
    assert result.exit_code == 3
    assert "Prediction: refused" in result.stdout
    assert "in block 1 at" in result.stdout


def test_help_imports_nothing_that_is_slow() -> None:
    heavy = "{'numba', 'numpy', 'fastapi', 'sqlalchemy', 'pydantic', 'pyarrow'}"
    code = f"import sys, app.cli; print(sorted({heavy} & set(sys.modules)))"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "[]"
