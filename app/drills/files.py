"""The samples of the drills: a Parquet file each, every tick and every channel."""

from pathlib import Path
from typing import Any

import numpy.typing as npt

from app.first_outs.files import BoxSamples
from app.recording.columns import as_batch
from app.recording.parquet import write_run

Records = npt.NDArray[Any]

MOST_KEPT = 200


def path_of(folder: Path, number: int) -> Path:
    """The file of a drill."""
    return folder / f"{number}.parquet"


def keep(folder: Path, number: int, samples: Records, described: dict[str, object]) -> None:
    """Write the samples of a drill, (n,) TELEMETRY, and let go of those of one long ago. Raises `OSError`."""
    folder.mkdir(parents=True, exist_ok=True)
    write_run(path_of(folder, number), [as_batch(samples)], described)
    path_of(folder, number - MOST_KEPT).unlink(missing_ok=True)


def samples_of(folder: Path, number: int) -> BoxSamples | None:
    """The samples of a drill; None where there are none, or none any more."""
    try:
        return BoxSamples(path_of(folder, number))
    except FileNotFoundError:
        return None
