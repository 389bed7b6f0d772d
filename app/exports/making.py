"""What the process apart does: write a file as a whole, or bytes as they come."""

import shutil
from pathlib import Path
from typing import BinaryIO

from app.exports.extract import Extract, Progress
from app.exports.formats import FORMATS, FormatName, write

UNDER_WAY = ".part"


def make(
    report: Progress, path: Path, name: FormatName, wanted: Extract, keep_free_bytes: int
) -> int:
    """Write the file; its size in bytes. Raises `OSError` before the disk is too full for runs."""

    def watched(share: float) -> None:
        if shutil.disk_usage(path.parent).free < keep_free_bytes:
            raise OSError("The disk has no room left beside what runs need")
        report(share)

    unfinished = path.with_name(path.name + UNDER_WAY)
    try:
        write(unfinished, name, wanted, watched)
        unfinished.rename(path)
    except BaseException:
        unfinished.unlink(missing_ok=True)
        raise
    return path.stat().st_size


def stream(out: BinaryIO, name: FormatName, wanted: Extract) -> None:
    """Write it from beginning to end."""
    written = FORMATS[name].stream
    assert written is not None, f"{name} goes back in its file"
    written(out, wanted, lambda share: None)
