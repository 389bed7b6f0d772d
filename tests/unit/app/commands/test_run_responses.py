"""`forcerig analyse frequency-response`: every transfer of a run's file, the loop's margins, and what is refused."""

import json
from pathlib import Path
from typing import Any

import pytest
from typer.testing import CliRunner, Result

from app.cli import cli
from app.commands.output import Exit
from bench.recorded import make_test
from rtcore.rig.parameters import load_rig
from tests.unit.app.commands.recorded_file import recorded_file

STEPPED = {
    "kind": "frequency_response",
    "amplitudes_n": [3000.0],
    "frequencies_hz": [20.0, 40.0, 60.0],
    "settle_cycles": 3,
    "measure_cycles": 6,
}
MOTION = {"kind": "multisine", "amplitude_m": 0.0008, "frequencies_hz": [8.0, 12.0, 16.0]}


@pytest.fixture(scope="module")
def of_force(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return recorded_file(tmp_path_factory.mktemp("force") / "run.parquet", make_test([STEPPED]))


@pytest.fixture(scope="module")
def of_motion(tmp_path_factory: pytest.TempPathFactory) -> Path:
    hold = {"kind": "hold", "force_n": 0, "duration_s": 2.0}
    test = make_test([hold], [MOTION])
    return recorded_file(tmp_path_factory.mktemp("motion") / "run.parquet", test)


def run(*arguments: object) -> Result:
    command = ["analyse", "frequency-response", *map(str, arguments)]
    return CliRunner().invoke(cli, command)


def told(*arguments: object) -> Any:
    result = run(*arguments, "--json")
    assert result.exit_code == Exit.PASSED, result.output
    return json.loads(result.stdout)


def test_the_units_stiffness_and_admittance_are_told_from_the_file_alone(of_force: Path) -> None:
    unit = load_rig().unit
    stiffness = told(of_force, "--transfer", "stiffness")
    assert stiffness["unit"] == "N/m"
    assert [p["frequency_hz"] for p in stiffness["points"]] == [20.0, 40.0, 60.0]
    for point in stiffness["points"]:
        assert point["gain"] == pytest.approx(unit.k_tra, rel=0.03)
    assert len(told(of_force, "--transfer", "admittance")["points"]) == 3


def test_the_open_loop_is_told_with_its_margins(of_force: Path) -> None:
    loop = told(of_force, "--transfer", "loop")
    (margins,) = loop["margins"]
    assert 40 < margins["crossover_hz"] < 60
    assert 45 < margins["phase_margin_deg"] < 70
    assert "phase margin" in run(of_force, "--transfer", "loop").stdout
    loaded = told(of_force, "--transfer", "loop", "--load-hz", 50)
    assert loaded["margins"][0]["phase_margin_deg"] != margins["phase_margin_deg"]


def test_without_a_name_it_is_the_force_or_what_there_is(of_force: Path, of_motion: Path) -> None:
    assert told(of_force)["transfer"] == "force"
    found = told(of_motion)
    assert found["transfer"] == "position"
    assert [p["frequency_hz"] for p in found["points"]] == [8.0, 12.0, 16.0]


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["--transfer", "stifness"], "did you mean stiffness"),
        (["--transfer", "position"], "has no point of the transfer 'position': it has force"),
        (["--load-hz", "50"], "needs --transfer loop"),
        (["--json", "--csv"], "leave one of them out"),
    ],
)
def test_what_cannot_be_told_is_refused(of_force: Path, arguments: list[str], said: str) -> None:
    result = run(of_force, *arguments)
    assert result.exit_code == Exit.BAD_INPUT
    assert said in " ".join(result.stderr.split())


def test_the_units_static_stiffness_comes_from_slow_cycles(of_force: Path, tmp_path: Path) -> None:
    slow = {"kind": "harmonic", "amplitude_n": 10_000.0, "frequency_hz": 2.0, "cycles": 5}
    path = recorded_file(tmp_path / "run.parquet", make_test([slow]))
    result = CliRunner().invoke(cli, ["analyse", "unit", str(path), "--json"])
    (unit,) = json.loads(result.stdout)["unit"]
    assert unit["stiffness_n_m"] == pytest.approx(load_rig().unit.k_tra, rel=0.02)
    assert "kN/mm" in CliRunner().invoke(cli, ["analyse", "unit", str(path)]).stdout
    refused = CliRunner().invoke(cli, ["analyse", "unit", str(of_force)])
    assert refused.exit_code == Exit.BAD_INPUT
    assert "has no slow cycles" in refused.stderr


@pytest.fixture(scope="module")
def of_layers(tmp_path_factory: pytest.TempPathFactory) -> Path:
    sines = [
        {"mean_n": 0, "amplitude_n": 3000, "frequency_hz": hz, "cycles": 4 * hz} for hz in (20, 40)
    ]
    test = make_test([{"kind": "layers", "layers": sines, "repeats": 1, "transition_s": 0.1}])
    return recorded_file(tmp_path_factory.mktemp("layers") / "run.parquet", test)


@pytest.mark.parametrize("estimator", ["h1", "h2", "hv"])
def test_layers_have_a_response_by_averaged_spectra(
    of_force: Path, of_layers: Path, estimator: str
) -> None:
    stepped = {p["frequency_hz"]: p["gain"] for p in told(of_force)["points"]}
    found = told(of_layers, "--estimator", estimator)
    assert found["estimator"] == estimator
    points = {p["frequency_hz"]: p for p in found["points"]}
    assert max(points) == 200
    for hz in (20.0, 40.0):
        assert points[hz]["gain"] == pytest.approx(stepped[hz], rel=0.02)
        assert points[hz]["coherence"] > 0.99
        assert points[hz]["gain_low"] <= points[hz]["gain"] <= points[hz]["gain_high"]
    assert points[170.0]["coherence"] < 0.99  # nothing is played there: there the choice matters
    finer = told(of_layers, "--estimator", estimator, "--segment-s", 2)
    assert finer["points"][0]["frequency_hz"] == 0.5


def test_the_plant_by_averaged_spectra_is_taken_against_the_setpoint(
    of_force: Path, of_layers: Path
) -> None:
    stepped = {p["frequency_hz"]: p for p in told(of_force, "--transfer", "plant")["points"]}
    found = told(of_layers, "--transfer", "plant", "--estimator", "reference")
    for point in found["points"]:
        if point["frequency_hz"] in (20.0, 40.0):
            of = stepped[point["frequency_hz"]]
            assert point["gain"] == pytest.approx(of["gain"], rel=0.02)
            assert point["phase_deg"] == pytest.approx(of["phase_deg"], abs=2)


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["--estimator", "h3"], "no estimator 'h3'"),
        (["--estimator", "h1", "--transfer", "stiffness"], "no transfer by averaged spectra"),
        (["--estimator", "reference"], "--estimator h1 is the same"),
        (["--estimator", "h1", "--transfer", "position"], "stands still"),
        (["--estimator", "h1", "--segment-s", "100"], "choose a shorter --segment-s"),
    ],
)
def test_what_has_no_averaged_spectra_is_refused(
    of_layers: Path, arguments: list[str], said: str
) -> None:
    result = run(of_layers, *arguments)
    assert result.exit_code == Exit.BAD_INPUT
    assert said in " ".join(result.stderr.split())
