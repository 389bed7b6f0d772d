"""`forcerig stop`: take the load off without the console, through the block that the loop reads."""

import sys
from pathlib import Path

from app.errors import Refusal
from app.link.paths import block_path
from app.link.stopping import stop_directly
from app.settings import Settings
from rtcore.modes import Mode


def run(data: Path | None) -> int:
    """0 where the loop is stopping or has nothing to stop, else 1 and why on standard error."""
    answer = stop_directly(block_path(Settings().data_dir if data is None else data))
    if isinstance(answer, Refusal):
        print(f"forcerig: {answer.detail}", file=sys.stderr)
        return 1
    stopping = answer.mode is Mode.STOPPING
    print("Stopping" if stopping else f"Nothing to stop: {answer.mode.name.lower()}")
    return 0
