"""What a kill leaves of a part: whole batches, in order, each once, and nothing torn."""

import os
from pathlib import Path

import numpy as np
import numpy.typing as npt
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from app.recording.columns import as_records
from app.recording.extent import extent_of
from app.recording.part_index import read_index
from app.recording.parts import PartWriter, part_paths, read_part, read_parts
from rtcore.channels import TELEMETRY

BATCH = 50


def records(first: int, count: int = BATCH) -> npt.NDArray[np.void]:
    made = np.zeros(count, TELEMETRY)
    made["tick"] = np.arange(first, first + count)
    made["force_n"] = np.sin(made["tick"])
    return made


def written(folder: Path, batches: int = 4) -> Path:
    part = PartWriter(folder)
    for i in range(batches):
        part.append(records(i * BATCH))
    unended = part.path.read_bytes()
    part.close()
    part.path.write_bytes(unended)  # as after a kill
    return part.path


def ticks_of(path: Path) -> list[int]:
    return [tick for batch in read_part(path) for tick in batch.column("tick").to_pylist()]


def test_what_was_appended_is_read_back_to_the_bit(tmp_path: Path) -> None:
    path = written(tmp_path)
    back = np.concatenate([as_records(batch) for batch in read_part(path)])
    assert np.array_equal(back, records(0, 4 * BATCH))


@settings(max_examples=60, deadline=None)
@given(share=st.floats(0.0, 1.0))
def test_a_part_cut_anywhere_gives_its_whole_batches(
    tmp_path_factory: pytest.TempPathFactory, share: float
) -> None:
    path = written(tmp_path_factory.mktemp("run"))
    content = path.read_bytes()
    path.write_bytes(content[: int(share * len(content))])
    ticks = ticks_of(path)
    assert len(ticks) % BATCH == 0
    assert ticks == list(range(len(ticks)))
    assert len(ticks) >= BATCH * int(4 * (share * len(content) - 4096) / len(content))


@settings(max_examples=60, deadline=None)
@given(share=st.floats(0.0, 1.0, exclude_max=True), bit=st.integers(0, 7))
def test_a_flipped_bit_never_gives_a_wrong_sample(
    tmp_path_factory: pytest.TempPathFactory, share: float, bit: int
) -> None:
    path = written(tmp_path_factory.mktemp("run"))
    content = bytearray(path.read_bytes())
    content[int(share * len(content))] ^= 1 << bit
    path.write_bytes(content)
    truth = records(0, 4 * BATCH)
    for batch in read_part(path):
        back = as_records(batch)
        assert np.array_equal(back, truth[back["tick"][0] : back["tick"][-1] + 1])


def test_each_part_has_a_file_of_its_own(tmp_path: Path) -> None:
    for first in (0, 100):
        part = PartWriter(tmp_path)
        part.append(records(first))
        part.close()
    assert [path.name for path in part_paths(tmp_path)] == ["part-0001.arrows", "part-0002.arrows"]
    extent = extent_of(tmp_path)
    assert (extent.first_tick, extent.last_tick, extent.ticks) == (0, 149, 100)


def test_a_tick_that_two_parts_have_is_read_once(tmp_path: Path) -> None:
    for first, count in ((0, 100), (60, 100)):
        part = PartWriter(tmp_path)
        part.append(records(first, count))
        part.close()
    ticks = [tick for batch in read_parts(tmp_path) for tick in batch.column("tick").to_pylist()]
    assert ticks == list(range(160))


def test_an_empty_part_is_no_part(tmp_path: Path) -> None:
    PartWriter(tmp_path).close()
    (tmp_path / "part-0002.arrows").touch()
    assert list(read_parts(tmp_path)) == []
    assert extent_of(tmp_path).ticks == 0


def test_a_write_that_takes_only_some_is_gone_on_with(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A disk that is nearly full takes what it has room for, and says how much that was."""
    write = os.write
    part = PartWriter(tmp_path)
    with monkeypatch.context() as patch:
        patch.setattr(os, "write", lambda file, content: write(file, content[:1000]))
        part.append(records(0))
    part.append(records(BATCH))
    assert part.size_bytes == part.path.stat().st_size
    assert ticks_of(part.path) == list(range(2 * BATCH))
    part.close()


@pytest.mark.parametrize("first", [0, 3000, 4095, 4096, 9000, 20_000, 49_999])
def test_a_reader_that_begins_in_the_middle_finds_the_same(tmp_path: Path, first: int) -> None:
    part = PartWriter(tmp_path)
    for tick in range(0, 50_000, BATCH):
        part.append(records(tick))
    part.close()
    for verify in (True, False):
        begun = [
            b.column("tick").to_numpy()
            for b in read_parts(tmp_path, verify=verify, from_tick=first)
        ]
        ticks = np.concatenate(begun)
        assert np.array_equal(ticks, np.arange(first, 50_000))
    assert len(read_index(part.path)) == 13
