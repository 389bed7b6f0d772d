"""What processes and folders take up."""

import os
from pathlib import Path

_PROC = Path("/proc")
_KILOBYTE = 1024


def memory_bytes(pid: int, proc: Path = _PROC) -> int | None:
    """What a process holds in RAM; None where that cannot be seen."""
    try:
        lines = (proc / str(pid) / "status").read_text().splitlines()
    except OSError:
        return None
    held = next((line for line in lines if line.startswith("VmRSS:")), None)
    return None if held is None else int(held.split()[1]) * _KILOBYTE


def folder_bytes(folder: Path) -> int:
    """What all files below a folder take up; what goes meanwhile counts nothing."""
    return sum(
        _size(os.path.join(parent, name))  # noqa: PTH118 - a walk of many thousand files
        for parent, _, names in os.walk(folder)
        for name in names
    )


def _size(path: str) -> int:
    try:
        return os.lstat(path).st_size
    except OSError:
        return 0
