"""The loop process: started in a session of its own, so that it outlives the app."""

import os
import signal
import subprocess
import sys
import time
from dataclasses import dataclass
from pathlib import Path

from app.settings import Settings
from rtcore.memory.segment import loop_is_running


@dataclass(frozen=True)
class LoopCommand:
    """How to start a loop."""

    block: Path
    log: Path
    arguments: tuple[str, ...]

    @staticmethod
    def of(settings: Settings, block: Path) -> "LoopCommand":
        """The command for these settings."""
        optional = {
            "--rig": settings.rig_file and settings.rig_file.resolve(),
            "--cpu": settings.cpu,
        }
        arguments = [
            *("--block", str(block), "--seed", str(settings.seed)),
            *("--margin-us", str(settings.margin_us)),
            *(str(part) for pair in optional.items() if pair[1] is not None for part in pair),
        ]
        return LoopCommand(block, settings.data_dir.resolve() / "loop.log", tuple(arguments))

    def start(self) -> subprocess.Popen[bytes]:
        """Start the loop process; what it says goes to its log."""
        with self.log.open("ab") as log:
            return subprocess.Popen(
                [sys.executable, "-m", "rtcore", *self.arguments],
                stdin=subprocess.DEVNULL,
                stdout=log,
                stderr=log,
                start_new_session=True,
            )

    def last_words(self) -> str:
        """The last line of the log."""
        lines = self.log.read_text(errors="replace").strip().splitlines()[-1:]
        return lines[0] if lines else "it said nothing"


def end_loop(block: Path, pid: int, timeout_s: float = 5.0) -> None:
    """Ask a loop to end, and kill it where it does not."""
    for request in (signal.SIGTERM, signal.SIGKILL):
        if not loop_is_running(block):
            return
        try:
            os.kill(pid, request)
        except ProcessLookupError:
            return
        deadline = time.monotonic() + timeout_s
        while loop_is_running(block) and time.monotonic() < deadline:
            time.sleep(0.02)
