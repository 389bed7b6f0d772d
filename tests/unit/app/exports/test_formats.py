"""Each format is read back by a library that others wrote, and is what was recorded, bit for bit."""

import json
from pathlib import Path
from typing import Any

import h5py
import numpy as np
import numpy.typing as npt
import pyarrow.parquet as pq
import pytest
import scipy.io
from nptdms import TdmsFile

from app.errors import Refusal
from app.exports.extract import Extract, Wanted, extract
from app.exports.formats import FORMATS, FormatName, by_suffix, write
from app.exports.matlab import why_not_mat
from app.recording.parquet import read_metadata
from rtcore.channels import CHANNELS
from tests.unit.app.exports.reading import DESCRIPTION, PERIOD_S, READ, recorded, records

ALL = Wanted()
TICKS = 70_000  # more than a row group
MISSING = (30_000, 30_100)


@pytest.fixture(scope="module")
def run(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("recording")
    return recorded(folder / "run.parquet", records(TICKS, MISSING))


def wanted_of(path: Path, wanted: Wanted = ALL) -> Extract:
    found = extract(path, wanted)
    assert isinstance(found, Extract)
    return found


def made(name: FormatName, of: Extract, folder: Path) -> Path:
    path = folder / f"out.{name}"
    write(path, name, of, lambda share: None)
    return path


def same(found: npt.NDArray[Any], truth: npt.NDArray[Any]) -> bool:
    """Bit for bit; what is not a number is only itself."""
    return np.array_equal(found, truth, equal_nan=truth.dtype.kind == "f")


def test_a_window_in_which_nothing_was_recorded_is_refused(run: Path) -> None:
    first, last = MISSING
    inside = Wanted(from_s=first * PERIOD_S, to_s=(last - 1) * PERIOD_S)
    found = extract(run, inside)
    assert isinstance(found, Refusal)
    assert "Nothing was recorded between 7.5 s and 7.52475 s" in found.detail
    edge = wanted_of(run, Wanted(from_s=first * PERIOD_S, to_s=last * PERIOD_S))
    assert edge.rows() == 1


@pytest.mark.parametrize("name", list(FormatName))
def test_the_whole_recording_comes_back(name: FormatName, run: Path, tmp_path: Path) -> None:
    told: list[float] = []
    path = tmp_path / f"out.{name}"
    write(path, name, wanted_of(run), told.append)
    found, truth = READ[name](path), records(TICKS, MISSING)
    assert list(found) == [c.name for c in CHANNELS] or set(found) == {c.name for c in CHANNELS}
    for channel in CHANNELS:
        assert found[channel.name].dtype == np.dtype(channel.dtype), channel.name
        assert same(found[channel.name], truth[channel.name]), channel.name
    assert told == sorted(told)
    assert told[-1] == pytest.approx(1.0)


@pytest.mark.parametrize("name", list(FormatName))
def test_any_window_and_any_channels_come_back(name: FormatName, run: Path, tmp_path: Path) -> None:
    truth, random = records(TICKS, MISSING), np.random.default_rng(11)
    names = [c.name for c in CHANNELS]
    for case in range(4):
        channels = random.choice(names, random.integers(1, 6), replace=False).tolist()
        first, last = np.sort(random.integers(0, TICKS, 2))
        of = wanted_of(run, Wanted(tuple(channels), first * PERIOD_S, last * PERIOD_S))
        found = READ[name](made(name, of, tmp_path))
        assert set(found) == {*channels, "time_s"}, case
        inside = truth[(truth["tick"] >= 1000 + first) & (truth["tick"] <= 1000 + last)]
        for channel in found:
            assert same(found[channel], inside[channel]), f"case {case}: {channel}"


def test_each_says_units_and_what_was_tested(run: Path, tmp_path: Path) -> None:
    of = wanted_of(run, Wanted(("force_n", "velocity_m_s"), 0.0, 1.0))
    paths = {name: made(name, of, tmp_path) for name in FormatName}
    schema = pq.read_schema(paths[FormatName.PARQUET])
    assert schema.field("velocity_m_s").metadata[b"unit"] == b"m/s"
    assert read_metadata(paths[FormatName.PARQUET])["definition"] == DESCRIPTION["definition"]
    csv = paths[FormatName.CSV].read_text(encoding="utf-8").splitlines()
    assert "# test_name: A test with an umlaut: Prüfung" in csv
    assert "time_s [s],force_n [N],velocity_m_s [m/s]" in csv
    mat = scipy.io.loadmat(paths[FormatName.MAT], squeeze_me=True)
    assert mat["units"]["velocity_m_s"] == "m/s"
    assert json.loads(str(mat["run_json"]))["test_name"] == DESCRIPTION["test_name"]
    tdms = TdmsFile.read(paths[FormatName.TDMS])
    assert tdms["recording"]["force_n"].properties["unit_string"] == "N"
    assert tdms.properties["test_name"] == DESCRIPTION["test_name"]
    with h5py.File(paths[FormatName.HDF5]) as file:
        assert file["force_n"].attrs["unit"] == "N"
        assert file.attrs["outcome"] == "completed"
        assert json.loads(file["settings/definition"][()]) == DESCRIPTION["definition"]


def test_a_waveform_has_its_timing_only_where_no_tick_is_missing(run: Path, tmp_path: Path) -> None:
    without = wanted_of(run, Wanted(("force_n",), 0.5, 1.0))
    properties = TdmsFile.read(made(FormatName.TDMS, without, tmp_path))["recording"][
        "force_n"
    ].properties
    assert (properties["wf_start_offset"], properties["wf_increment"]) == (0.5, PERIOD_S)
    across = wanted_of(run, Wanted(("force_n",), 7.0, 8.0))
    across_properties = TdmsFile.read(made(FormatName.TDMS, across, tmp_path))["recording"][
        "force_n"
    ].properties
    assert "wf_increment" not in across_properties


def test_an_export_can_be_exported_again(run: Path, tmp_path: Path) -> None:
    part = made(FormatName.PARQUET, wanted_of(run, Wanted(("force_n", "tick"), 2.0, 9.0)), tmp_path)
    again = wanted_of(part, Wanted((), 3.0, 4.0))
    ticks = READ[FormatName.CSV](made(FormatName.CSV, again, tmp_path))["tick"]
    assert (ticks[0], ticks[-1]) == (1000 + 12_000, 1000 + 16_000)


def test_what_cannot_be_is_refused_in_a_sentence(run: Path, tmp_path: Path) -> None:
    def refused(wanted: Wanted, path: Path = run) -> str:
        found = extract(path, wanted)
        assert isinstance(found, Refusal)
        return found.detail

    assert "did you mean force_n" in refused(Wanted(("force",)))
    assert "the run lasted 17.5 s" in refused(Wanted((), 18.0))
    assert "from 3 s to 2 s" in refused(Wanted((), 3.0, 2.0))
    assert "No such file" in refused(Wanted(), tmp_path / "none.parquet")
    (tmp_path / "text.parquet").write_text("no Parquet")
    assert "is no recording" in refused(Wanted(), tmp_path / "text.parquet")


def test_matlab_is_told_where_a_variable_would_be_too_long(run: Path) -> None:
    of = wanted_of(run)
    assert why_not_mat(of) is None
    a_day = Extract(*(of.path, of.names, 0, 4000 * 86_400), of.origin_tick, PERIOD_S, {})
    refusal = why_not_mat(a_day)
    assert refusal is not None
    assert "at most 19 h" in refusal.detail


def test_the_ending_of_a_name_says_the_format() -> None:
    assert by_suffix(Path("a/run.MAT")) is FormatName.MAT
    assert by_suffix(Path("run.xlsx")) is None
    assert all((form.stream is None) != (form.whole is None) for form in FORMATS.values())
