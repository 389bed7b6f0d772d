"""What of a recording is exported: some channels of some time, read chunk by chunk."""

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt
import pyarrow as pa
import pyarrow.parquet as pq

from app.documents.messages import nearest
from app.errors import Code, Fault, Refusal
from app.recording.bins import Columns
from app.recording.parquet import METADATA_KEY, read_metadata
from app.recording.samples import ParquetSamples
from rtcore.channels import CHANNEL

TIME = "time_s"  # is always exported: a signal without its time is of no use to anybody
Progress = Callable[[float], None]  # told the share that is done, 0…1


@dataclass(frozen=True)
class Wanted:
    """What somebody asks for: all channels where none are named; times (s) from the run's first tick."""

    channels: tuple[str, ...] = ()
    from_s: float = 0.0
    to_s: float | None = None


@dataclass(frozen=True)
class Extract:
    """The ticks from `first_tick` to `last_tick` of a recording, both included, and its `names`.

    `origin_tick` is the run's first, `description` what its file says of it: definition, settings,
    outcome. May be sent to another process.
    """

    path: Path
    names: tuple[str, ...]
    first_tick: int
    last_tick: int
    origin_tick: int
    period_s: float
    description: Mapping[str, Any]

    @property
    def ticks(self) -> int:
        """At most so many rows: ticks that were not recorded are not among them."""
        return self.last_tick - self.first_tick + 1

    @property
    def from_s(self) -> float:
        """When it begins, from the run's first tick."""
        return (self.first_tick - self.origin_tick) * self.period_s

    def rows(self) -> int:
        """How many ticks were recorded in it, counted in the file."""
        samples = ParquetSamples(self.path, mapped=False)
        return sum(len(c["tick"]) for c in samples.chunks((), self.first_tick, self.last_tick))

    def chunks(self, progress: Progress, names: Sequence[str] | None = None) -> Iterator[Columns]:
        """The columns, a row group at a time, with `tick` whether it is exported or not."""
        wanted = self.names if names is None else names
        samples = ParquetSamples(self.path, mapped=False)
        for chunk in samples.chunks(wanted, self.first_tick, self.last_tick):
            if len(chunk["tick"]):
                yield chunk
                progress((int(chunk["tick"][-1]) - self.first_tick + 1) / self.ticks)


def dtype_of(name: str) -> npt.DTypeLike:
    """In which type a channel is recorded, and exported."""
    return np.dtype(CHANNEL[name].dtype)


def extract(path: Path, wanted: Wanted) -> Extract | Refusal:
    """Find what is wanted in a recording's file. Reads its end, and which ticks it has at the beginning."""
    try:
        description = read_metadata(path)
        recorded = pq.read_schema(path).names
        samples = ParquetSamples(path)
    except (OSError, KeyError, ValueError, pa.ArrowException) as error:
        return _unreadable(path, error)
    names = _names(wanted.channels, recorded)
    if isinstance(names, Refusal):
        return names
    period_s = description["period_ns"] * 1e-9
    origin = description.get("first_tick", samples.first_tick)
    first, last = _between(wanted, origin, period_s, samples)
    if first > last:
        length_s = (samples.last_tick - origin + 1) * period_s
        return _nothing_there(wanted, length_s)
    if not any(len(chunk["tick"]) for chunk in samples.chunks((), first, last)):
        return _gap((first - origin) * period_s, (last - origin) * period_s)
    window = {
        "first_tick": origin,
        "exported_from_s": round((first - origin) * period_s, 9),
        "exported_to_s": round((last - origin) * period_s, 9),
    }
    return Extract(path, names, first, last, origin, period_s, description | window)


def _between(
    wanted: Wanted, origin: int, period_s: float, samples: ParquetSamples
) -> tuple[int, int]:
    most = float(2**53)
    first = origin + math.ceil(min(wanted.from_s / period_s, most) - 1e-6)
    to = most if wanted.to_s is None else min(wanted.to_s / period_s, most)
    last = origin + math.floor(to + 1e-6)
    return max(first, samples.first_tick), min(last, samples.last_tick)


def _names(channels: Sequence[str], recorded: Sequence[str]) -> tuple[str, ...] | Refusal:
    """In the order of the recording, time among them."""
    known = [name for name in recorded if name in CHANNEL]
    unknown = [name for name in dict.fromkeys(channels) if name not in known]
    if unknown:
        faults = tuple(Fault("channels", name, f"one of {', '.join(known)}") for name in unknown)
        detail = f"There is no channel '{unknown[0]}' in this recording{nearest(unknown[0], known)}"
        return Refusal(Code.UNKNOWN_CHANNEL, detail, faults)
    asked = {TIME, *channels} if channels else set(known)
    return tuple(name for name in known if name in asked)


def _unreadable(path: Path, error: Exception) -> Refusal:
    if isinstance(error, OSError) and error.strerror:
        return Refusal(Code.NO_DATA, f"{path.name} cannot be read: {error.strerror}")
    with_key = METADATA_KEY.decode()
    detail = f"{path.name} is no recording: a Parquet file is needed that {with_key} has written"
    return Refusal(Code.NO_DATA, detail)


def _nothing_there(wanted: Wanted, length_s: float) -> Refusal:
    to = "its end" if wanted.to_s is None else f"{wanted.to_s:g} s"
    detail = f"Nothing was recorded from {wanted.from_s:g} s to {to}: the run lasted {length_s:g} s"
    return Refusal(Code.INVALID_REQUEST, detail)


def _gap(from_s: float, to_s: float) -> Refusal:
    detail = f"Nothing was recorded between {from_s:.6g} s and {to_s:.6g} s: choose a longer window"
    return Refusal(Code.INVALID_REQUEST, detail)
