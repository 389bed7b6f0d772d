"""What tests leave behind of a console: nothing, whatever it was doing when it was killed."""

import signal
import subprocess
import sys
from pathlib import Path

import pytest

from rtcore.memory.segment import loop_is_running
from tests.console_process import ConsoleProcess, loops_on, wait_for

pytestmark = pytest.mark.process


def test_a_loop_that_has_not_even_its_lock_is_ended(tmp_path: Path) -> None:
    console = ConsoleProcess(tmp_path)
    loop = subprocess.Popen(
        [sys.executable, "-m", "rtcore", "--block", console.block, "--seed", "1"]
    )
    assert not loop_is_running(console.block)
    # A new program's command line can be read only a moment after Popen has come back.
    wait_for(lambda: loops_on(console.block) == [loop.pid], "the loop's command line")
    console.clean_up()
    assert loop.wait(10) == -signal.SIGKILL
    assert not console.block.exists()
