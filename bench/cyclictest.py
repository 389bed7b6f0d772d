"""cyclictest of rt-tests, the yardstick for wake-ups: run for a while, its histogram read back."""

import re
import shutil
import subprocess

import numpy as np

from rtcore.latency import RANGE_US, Counts

BINS = 400
_ROW = re.compile(r"^(\d{6}) (\d+)$", re.MULTILINE)
_OVERFLOW = re.compile(r"^# Histogram Overflows: (\d+)", re.MULTILINE)


def absent() -> str | None:
    """Why cyclictest cannot be run here; None where it can be tried."""
    if shutil.which("cyclictest") is None:
        return "cyclictest is not installed (Debian: rt-tests): no comparison with it"
    return None


def measure(seconds: float, period_ns: int, cpu: int) -> Counts | str:
    """Wake-ups of a FIFO task of priority 80 that only sleeps, or why there are none.

    A histogram like the loop's: bins of 1 µs; what is over 400 µs is in the last bin.
    """
    period_us = period_ns // 1000
    loops = round(seconds * 1e9 / period_ns)
    options = f"-m -p80 -i{period_us} -q -h{BINS} -a{cpu} -t1 -l{loops}"
    done = subprocess.run(["cyclictest", *options.split()], capture_output=True, text=True)
    if done.returncode != 0:
        said = (done.stderr or done.stdout).strip().splitlines()[-1:]
        return f"cyclictest failed: {said[0] if said else done.returncode}"
    return read(done.stdout)


def read(output: str) -> Counts:
    """The histogram that cyclictest prints for its one thread."""
    counts = np.zeros(RANGE_US + 1, np.int64)
    for time_us, count in _ROW.findall(output):
        counts[int(time_us)] = int(count)
    counts[-1] = sum(int(count) for count in _OVERFLOW.findall(output))
    return counts
