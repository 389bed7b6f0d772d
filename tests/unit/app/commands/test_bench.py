"""`forcerig bench` finds the benchmarks by themselves, and adds them up."""

import json

import pytest

from app.commands import bench


def _benchmark(figure: int, code: int) -> bench.Benchmark:
    def main(as_json: bool) -> int:
        print(json.dumps({"figure": figure}) if as_json else f"figure {figure}")
        return code

    return main


@pytest.fixture
def _known(monkeypatch: pytest.MonkeyPatch) -> None:
    known = {"loop": _benchmark(1, 0), "streaming": _benchmark(2, 1)}
    monkeypatch.setattr(bench, "benchmarks", lambda: known)


@pytest.mark.usefixtures("_known")
def test_one_benchmark_prints_what_it_prints(capsys: pytest.CaptureFixture[str]) -> None:
    assert bench.run("loop", as_json=True) == 0
    assert json.loads(capsys.readouterr().out) == {"figure": 1}


@pytest.mark.usefixtures("_known")
def test_all_benchmarks_make_one_document_and_the_worst_exit_code(
    capsys: pytest.CaptureFixture[str],
) -> None:
    assert bench.run("all", as_json=True) == 1
    document = json.loads(capsys.readouterr().out)
    assert document == {"loop": {"figure": 1}, "streaming": {"figure": 2}}
    assert bench.run("all", as_json=False) == 1
    assert capsys.readouterr().out == "figure 1\nfigure 2\n"


@pytest.mark.usefixtures("_known")
def test_an_unknown_benchmark_is_refused_with_those_there_are(
    capsys: pytest.CaptureFixture[str],
) -> None:
    assert bench.run("lop", as_json=False) == 2
    said = capsys.readouterr()
    assert said.out == ""
    assert "did you mean loop?" in said.err
    assert "loop, streaming, all" in said.err


def test_what_shows_the_figures_is_no_benchmark() -> None:
    assert "report" not in bench.benchmarks()


@pytest.mark.usefixtures("_known")
def test_only_what_measures_for_a_time_is_told_for_how_long(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    told: list[float] = []

    def recording(as_json: bool, minutes: float = 2.0) -> int:
        told.append(minutes)
        return 0

    monkeypatch.setattr(bench, "benchmarks", lambda: {"recording": recording, "loop": len})
    assert bench.run("recording", as_json=False, minutes=60.0) == 0
    assert bench.run("recording", as_json=False) == 0
    assert told == [60.0, 2.0]
    assert bench.run("loop", as_json=False, minutes=60.0) == 2
    assert "leave --minutes out" in capsys.readouterr().err
