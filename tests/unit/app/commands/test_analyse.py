"""`forcerig analyse`: the sheets as JSON, CSV and text, and what it says of wrong input."""

import csv
import io
import json
from pathlib import Path

import pytest

from app.commands.analyse import Subject, compensator, linear, static
from app.commands.output import Exit


def test_the_margins_as_json_are_those_of_the_data_sheet(
    capsys: pytest.CaptureFixture[str],
) -> None:
    assert linear(Subject(as_json=True), {"amplitude_n": [2000.0]}, bode=False) == Exit.PASSED
    loop = json.loads(capsys.readouterr().out)["loops"][0]
    assert loop["margins"]["crossover_hz"] == pytest.approx(45.6, abs=0.15)
    assert loop["k_1_n"] == pytest.approx(193e3, rel=4e-3)


def test_csv_has_its_units_in_the_header(capsys: pytest.CaptureFixture[str]) -> None:
    given = {"orifice_diameter_m": [0.5e-3, 0.85e-3], "points": 5}
    assert static(Subject(as_csv=True), given) == Exit.PASSED
    rows = list(csv.DictReader(io.StringIO(capsys.readouterr().out)))
    assert len(rows) == 10
    assert float(rows[2]["force_n"]) == 0.0
    assert {"load_pressure_pa", "force_gain_n", "bypass_flow_m3_s"} < set(rows[0])


def test_the_text_tells_branch_and_tuning(capsys: pytest.CaptureFixture[str]) -> None:
    given = {"load_hz": 50.0, "tune_hz": 4.0, "points": 5}
    assert compensator(Subject(), given) == Exit.PASSED
    text = capsys.readouterr().out
    assert "exact_ff_v" in text
    assert "1.96068" in text


@pytest.mark.parametrize(
    ("given", "said"),
    [
        ({"from_hz": 5.0, "to_hz": 5.0}, "to_hz: must be above from_hz"),
        ({"amplitude_n": [1e9]}, "amplitude_n[0]"),
        ({"mean_n": 49.9e3, "amplitude_n": [1e3]}, ""),
    ],
)
def test_wrong_input_is_told_by_its_name(
    capsys: pytest.CaptureFixture[str], given: dict[str, object], said: str
) -> None:
    found = linear(Subject(as_json=True), given, bode=False)
    assert found == (Exit.BAD_INPUT if said else Exit.PASSED)
    assert said in capsys.readouterr().err


def test_a_rig_file_that_cannot_be_read_and_two_forms_are_refused(
    capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    assert static(Subject(rig=tmp_path / "none.yaml"), {}) == Exit.BAD_INPUT
    assert "no such file" in capsys.readouterr().err
    assert static(Subject(as_json=True, as_csv=True), {}) == Exit.BAD_INPUT
