"""Definitions in files: what is wrong is said with the file, the line and the path."""

from pathlib import Path

import pytest

from app.definitions.definition import Definition
from app.definitions.outline import outline
from app.definitions.reading import load_definition, parse_definition
from app.documents.refusal import Problem
from app.documents.writing import to_yaml
from app.errors import Code, Refusal
from app.histories.store import Beside

GOOD = """\
schema: 1
name: Harmonic load on a moving actuator
controller: {compensation: off}
blocks:
  - {kind: ramp, to_n: 0, rate_n_s: 2e4}
  - {kind: harmonic, mean_n: 0, amplitude_n: 2000, frequency_hz: 50, cycles: 200}
"""


def _problems(result: Definition | Refusal) -> list[Problem]:
    assert isinstance(result, Refusal)
    assert result.code is Code.INVALID_TEST
    return [fault for fault in result.faults if isinstance(fault, Problem)]


def test_a_yaml_file_becomes_a_definition(tmp_path: Path) -> None:
    path = tmp_path / "test.yaml"
    path.write_text(GOOD)
    definition = load_definition(path)
    assert isinstance(definition, Definition)
    assert definition.controller.compensation == "off"
    assert definition.blocks[0].model_dump() == {
        "kind": "ramp",
        "to_n": 0,
        "rate_n_s": 20_000.0,
        "duration_s": None,
    }


def test_a_json_file_becomes_the_same(tmp_path: Path) -> None:
    path = tmp_path / "test.json"
    path.write_text(
        '{"schema": 1, "name": "Tabs are fine in JSON",\n\t"blocks":'
        ' [{"kind": "hold", "duration_s": 1e0}]}'
    )
    assert isinstance(load_definition(path), Definition)


def test_a_problem_names_file_line_and_path(tmp_path: Path) -> None:
    path = tmp_path / "test.yaml"
    path.write_text(GOOD.replace("frequency_hz: 50", "frequency_hz: 3000"))
    result = load_definition(path)
    (problem,) = _problems(result)
    assert problem.line == 6
    assert isinstance(result, Refusal)
    assert result.detail == (
        f"{path}: line 6, blocks[1].frequency_hz: 3,000 Hz must be below 2,000 Hz"
    )


def test_a_missing_key_is_placed_at_the_line_of_its_block() -> None:
    (problem,) = _problems(parse_definition(GOOD.replace("amplitude_n: 2000, ", "")))
    assert (problem.path, problem.line) == ("blocks[1].amplitude_n", 6)


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ("", "the document is empty"),
        ("# nothing\n", "the document is empty"),
        ("- 1\n- 2\n", "must be a mapping of keys to values, is a list of 2"),
        ("hello", "must be a mapping of keys to values, is hello"),
        ("name: a\nname: b\n", "name is given twice, first on line 1"),
        ("a: [", "this is not YAML"),
    ],
)
def test_what_is_no_definition_at_all_is_said(tmp_path: Path, text: str, says: str) -> None:
    path = tmp_path / "test.yaml"
    path.write_text(text)
    (problem,) = _problems(load_definition(path))
    assert says in problem.expected


def test_what_is_no_text_file_is_said(tmp_path: Path) -> None:
    (missing,) = _problems(load_definition(tmp_path / "missing.yaml"))
    assert missing.expected == "no such file"
    (folder,) = _problems(load_definition(tmp_path))
    assert folder.expected == "cannot be read: Is a directory"
    binary = tmp_path / "binary.yaml"
    binary.write_bytes(b"\xff\xfe\x00")
    (not_text,) = _problems(load_definition(binary))
    assert not_text.expected == "the file is not text in UTF-8"
    huge = tmp_path / "huge.yaml"
    huge.write_bytes(b"#" * 500_001)
    (too_large,) = _problems(load_definition(huge))
    assert "larger than the limit of 500,000 bytes" in too_large.expected


def _with_history(folder: Path, csv: str, block: str) -> Path:
    (folder / "loads").mkdir()
    (folder / "loads" / "gust.csv").write_text(csv)
    path = folder / "test.yaml"
    path.write_text(f"schema: 1\nname: Gust\nblocks:\n  - {{kind: time_history, {block}}}\n")
    return path


def test_a_time_history_is_found_beside_the_test(tmp_path: Path) -> None:
    csv = "time_s;Kraft [kN]\n0;0\n0,5;1,5\n1;0\n"
    path = _with_history(tmp_path, csv, "file: loads/gust.csv, gain: 2")
    definition = load_definition(path)
    assert isinstance(definition, Definition), definition.detail
    found = outline(definition)
    assert found.peak_force_n == 3000
    assert found.duration_s == pytest.approx(0.1 + 1)
    assert load_definition(path) == definition
    assert parse_definition(to_yaml(definition), histories=Beside(tmp_path)) == definition
    csv_path = tmp_path / "loads" / "gust.csv"
    csv_path.write_text(csv.replace("1,5", "1,6"))
    assert load_definition(path) != definition


@pytest.mark.parametrize(
    ("csv", "block", "key", "says"),
    [
        ("t,f\n0,0\n1,x\n", "file: loads/gust.csv", "file", "gust.csv, line 3: 'x' is no number"),
        ("t,f\n0,0\n1,9\n", "file: gust.csv", "file", "no such file"),
        ("t,f\n0,0\n1,9\n", "file: loads", "file", "no such file"),
        ("t,f [mm]\n0,0\n1,9\n", "file: loads/gust.csv", "file", "is in m, must be in N"),
        ("t,f\n0,0\n1,9e4\n", "file: loads/gust.csv", "file", "reaches 90,000 N"),
        ("t,f\n0,0\n.01,3e4\n.02,0\n", "file: loads/gust.csv", "file", "at 0 s, must be at most"),
        ("t,f\n0,0\n.1,1\n", "file: loads/gust.csv, rate_hz: 4100", "rate_hz", "at most 4,000 Hz"),
        ("f\n0\n1\n", "file: loads/gust.csv", "file", "say its rate_hz"),
    ],
)
def test_what_is_wrong_with_a_time_history_is_said_at_its_block(
    tmp_path: Path, csv: str, block: str, key: str, says: str
) -> None:
    (problem,) = _problems(load_definition(_with_history(tmp_path, csv, block)))
    assert (problem.path, problem.line) == (f"blocks[0].{key}", 4)
    assert says in problem.expected


def test_a_rate_resamples_a_file_that_has_times(tmp_path: Path) -> None:
    csv = "t,f\n0,0\n1,10\n2,40\n"
    path = _with_history(tmp_path, csv, "file: loads/gust.csv, rate_hz: 8")
    definition = load_definition(path)
    assert isinstance(definition, Definition), definition.detail
    assert outline(definition).duration_s == pytest.approx(0.1 + 2)
