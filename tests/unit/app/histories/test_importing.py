"""CSV files as measuring systems write them; what is wrong in one is said with its line."""

import errno
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scipy.interpolate import PchipInterpolator

from app.documents.refusal import Problem
from app.errors import Code, Refusal
from app.histories import columns
from app.histories.history import History
from app.histories.importing import HistoryInfo
from app.histories.store import Beside, Store, import_history

VALUES = [0.0, 1000.0, 2500.0, -500.0]


def _kept(folder: Path, text: str | bytes, name: str = "a.csv", **chosen: Any) -> HistoryInfo:
    found = _tried(folder, text, name, **chosen)
    assert isinstance(found, HistoryInfo), found.detail
    return found


def _tried(
    folder: Path, text: str | bytes, name: str = "a.csv", **chosen: Any
) -> HistoryInfo | Refusal:
    body = text if isinstance(text, bytes) else text.encode()
    parts = [body[i : i + 7] for i in range(0, len(body), 7)]
    return import_history(parts, name, folder, **chosen)


def _values(folder: Path, name: str = "a.csv") -> list[float]:
    history = Store(folder).find(name, None)
    assert isinstance(history, History)
    return [float(value) for value in history.values]


@pytest.mark.parametrize(
    ("text", "chosen"),
    [
        ("time_s,force_n\n0,0\n0.1,1000\n0.2,2500\n0.3,-500\n", {}),
        ("t [ms];Kraft [kN]\r\n0;0\r\n100;1,0\r\n200;2,5\r\n300;-0,5\r\n", {}),
        ("Time\tForce\ns\tkN\n0\t0\n0.1\t1\n0.2\t2.5\n0.3\t-0.5", {}),
        ("# exported\n\nkN\n0\n1\n2.5\n\n-0.5\n", {"rate_hz": 10}),
        ("Kraft / kN\n0,0\n1,0\n2,5\n-0,5\n", {"rate_hz": 10}),
        ("0,0\n0.1,1e3\n0.2,2.5e3\n0.3,-5e2\n", {}),
        ('"x","y"\n"9","0"\n"9","1000"\n"9","2500"\n"9","-500"\n', {"rate_hz": 10, "column": "y"}),
        ("1,0\n1,1000\n1,2500\n1,-500\n", {"rate_hz": 10, "column": "2"}),
        (
            "\ufefftime,disp [mm],force [N]\n0,0,0\n.1,1,1000\n.2,1,2500\n.3,1,-500\n",
            {"column": "Force"},
        ),
        ("time , force\n 0 , 0\n 0.1 , 1000\n 0.2 , 2500\n 0.3 , -500\n", {}),
    ],
)
def test_the_same_history_however_it_is_written(
    tmp_path: Path, text: str, chosen: dict[str, Any]
) -> None:
    info = _kept(tmp_path, text, **chosen)
    assert _values(tmp_path) == pytest.approx(VALUES)
    assert (info.samples, info.rate_hz, info.resampled) == (4, 10.0, False)
    assert (info.min, info.max) == (-500.0, 2500.0)
    assert info.duration_s == pytest.approx(0.3)


def test_lengths_become_metres(tmp_path: Path) -> None:
    assert _kept(tmp_path, "t,x [mm]\n0,0\n1,20\n").unit == "m"
    assert _values(tmp_path) == [0, 0.02]


@pytest.mark.parametrize(
    ("text", "chosen", "line", "says"),
    [
        ("", {}, None, "the file holds no data"),
        ("hello\nworld\n", {}, 1, "no line holds a number"),
        ("t,f\n0,1\n0.1,two\n", {}, 3, "'two' is no number (column 2)"),
        ("t,f\n0,1\n\n0.1,\n", {}, 4, "a value is missing (column 2)"),
        ("t,f\n0,1\n0.1\n", {}, 3, "has 1 of 2 columns"),
        ("t,f\n0,1\n0.1,nan\n", {}, 3, "'nan' is no number"),
        ("t,f\n0,1\n0.1,1e999\n", {}, 3, "'1e999' is no number"),
        ("t,f\n0,1\n0.1,-1e160\n", {}, 3, "-1e+160 is too large (column 2)"),
        ("t,f\n0,1\n1e200,1\n", {}, 3, "1e+200 is too large (column 1)"),
        ("t,f\n0,1\n0.1,2\n0.1,3\n", {}, 4, "0.1 s does not come after 0.1 s"),
        ("t,f\n0,1\n\n0.1,2\n0.05,3\n", {}, 5, "0.05 s does not come after 0.1 s"),
        ("t,f\n0,1\n1,2\n2,3\n3,4\n30,5\n", {}, 5, "a gap of 27 s follows"),
        ("t,f\n0,1\n", {}, 2, "needs two samples at least"),
        ("f\n1\n2\n", {}, None, "the file has no column of times: say its rate_hz"),
        ("t,f,g\n0,1,2\n1,2,3\n", {}, None, "which column? f, g"),
        ("t,f,g\n0,1,2\n1,2,3\n", {"column": "h"}, None, "there is no column 'h'"),
        ("t,force\n0,1\n1,2\n", {"column": "forc"}, None, "did you mean force?"),
        ("t,f [Hz]\n0,1\n1,2\n", {}, None, "'f [Hz]' is in Hz, must be in N or m"),
        ("t\n0\n1\n", {}, None, "a column of times but none of values"),
        (b"\xff\xfe0\x00", {}, 1, "the file is in UTF-16"),
        ("t,f\n0,1\n1e9,2\n", {"rate_hz": 1e5}, None, "samples, must be 2 to 2,000,000,000"),
    ],
)
def test_what_is_wrong_is_said_with_its_line_and_nothing_is_kept(
    tmp_path: Path, text: str | bytes, chosen: dict[str, Any], line: int | None, says: str
) -> None:
    refusal = _tried(tmp_path, text, **chosen)
    assert isinstance(refusal, Refusal)
    assert refusal.code is Code.INVALID_HISTORY
    (problem,) = refusal.faults
    assert isinstance(problem, Problem)
    assert problem.line == line
    assert says in problem.expected
    assert Store(tmp_path).all() == []
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("name", ["../a.csv", "a/b.csv", ".csv", "a.npy", "", "a.csv\n", "x" * 200])
def test_a_name_leads_nowhere_else(tmp_path: Path, name: str) -> None:
    refusal = _tried(tmp_path / "store", "f\n1\n2\n", name, rate_hz=1.0)
    assert isinstance(refusal, Refusal)
    assert not (tmp_path / "store").exists()
    assert "there is no time history" in str(Store(tmp_path).find(name, None))


def test_a_fault_far_into_a_file_is_found_by_its_line(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(columns, "BLOCK_BYTES", 1000)
    lines = [f"{i / 10},{i % 7}" for i in range(5000)]
    _kept(tmp_path, "t,f\n" + "\n".join(lines), "whole.csv")
    assert _values(tmp_path, "whole.csv") == [i % 7 for i in range(5000)]
    lines[4321] = "432.1,x"
    refusal = _tried(tmp_path, "t,f\n" + "\n".join(lines))
    assert isinstance(refusal, Refusal)
    assert "line 4323: 'x' is no number" in refusal.detail


def test_times_that_were_rounded_are_even(tmp_path: Path) -> None:
    lines = [f"{i / 300:.4f},{i}" for i in range(3000)]
    info = _kept(tmp_path, "t,f\n" + "\n".join(lines))
    assert (info.rate_hz, info.resampled, info.samples) == (300.0, False, 3000)


def test_uneven_samples_are_resampled_along_the_monotone_curve(tmp_path: Path) -> None:
    random = np.random.default_rng(3)
    steps_s = np.where(random.random(150_000) < 0.5, 0.01, 0.01 * random.uniform(0.5, 1.5, 150_000))
    times = np.cumsum(steps_s)
    values = np.round(1000 * np.sin(times), 3)
    rows = np.column_stack([times, values])
    text = "\n".join(f"{t:.9f},{v:.3f}" for t, v in rows)
    info = _kept(tmp_path, text)
    assert info.resampled
    assert info.rate_hz == pytest.approx(100, rel=1e-3)
    written = np.round(times, 9)
    wanted = np.minimum(written[0] + np.arange(info.samples) / info.rate_hz, written[-1])
    truth = PchipInterpolator(written, values)(wanted)
    np.testing.assert_allclose(_values(tmp_path), truth, atol=1e-6)
    assert abs(info.duration_s - (written[-1] - written[0])) < 0.02


def test_a_rate_resamples_and_what_was_fast_is_not_forgotten(tmp_path: Path) -> None:
    times = np.arange(4000) / 1000
    text = "t,f\n" + "\n".join(f"{t:.4f},{np.sin(2 * np.pi * 300 * t):.6f}" for t in times)
    info = _kept(tmp_path, text, rate_hz=100.0)
    assert (info.samples, info.rate_hz, info.resampled) == (400, 100.0, True)
    assert info.bandwidth_hz == pytest.approx(300, abs=2)


def test_a_name_stands_for_its_content_for_ever(tmp_path: Path) -> None:
    first = _kept(tmp_path, "f\n1\n2\n", rate_hz=1.0)
    assert _kept(tmp_path, "f\n1\n2\n", rate_hz=1.0) == first
    for text, rate_hz in (("f\n1\n3\n", 1.0), ("f\n1\n2\n", 2.0)):
        refusal = _tried(tmp_path, text, rate_hz=rate_hz)
        assert isinstance(refusal, Refusal)
        assert refusal.code is Code.HISTORY_EXISTS
    assert _values(tmp_path) == [1, 2]
    assert [info.file for info in Store(tmp_path).all()] == ["a.csv"]
    assert [path.name for path in tmp_path.iterdir()] == ["a.csv"]


def test_a_history_beside_a_test_is_read_where_it_lies(tmp_path: Path) -> None:
    (tmp_path / "data").mkdir()
    (tmp_path / "data" / "gust.csv").write_text("t,f [kN]\n0,1\n0.5,2\n1,x\n")
    beside = Beside(tmp_path)
    assert "line 4: 'x' is no number" in str(beside.find("data/gust.csv", None))
    assert "no such file" in str(beside.find("gust.csv", None))
    (tmp_path / "good.csv").write_text("t,f [kN]\n0,1\n0.5,2\n1,3\n")
    history = beside.find("good.csv", None)
    assert isinstance(history, History)
    assert history.values.tolist() == [1000, 2000, 3000]
    assert [path.name for path in tmp_path.iterdir() if path.suffix] == ["good.csv"]


def test_a_full_disk_keeps_nothing_and_says_so(tmp_path: Path) -> None:
    def parts() -> Iterator[bytes]:
        yield b"f\n1\n"
        raise OSError(errno.ENOSPC, "No space left on device")

    refusal = import_history(parts(), "a.csv", tmp_path, rate_hz=1.0)
    assert isinstance(refusal, Refusal)
    assert refusal.code is Code.NO_SPACE
    assert list(tmp_path.iterdir()) == []


def test_an_upload_that_breaks_off_keeps_nothing(tmp_path: Path) -> None:
    def parts() -> Iterator[bytes]:
        yield b"f\n1\n"
        raise ConnectionError

    with pytest.raises(ConnectionError):
        import_history(parts(), "a.csv", tmp_path, rate_hz=1.0)
    assert list(tmp_path.iterdir()) == []
