"""The scene's process: `python -m app.scene SOCKET`. Told on its standard input, ends with it."""

import logging
import os
import signal
import sys
from pathlib import Path
from threading import Thread
from time import sleep

import viser

from app.scene.private import listen_at
from app.scene.stage import Stage
from app.scene.telling import RigTold, told_in

NICENESS = 15
FRAME_S = 1 / 30
BEAT_EACH = 30  # frames
READY, BEAT = b"ready\n", b"beat\n"


def main(path: Path) -> None:
    """Serve the scene until the console lets go of the standard input."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # whoever started it ends it
    os.setpriority(os.PRIO_PROCESS, 0, NICENESS)
    os.umask(0o177)
    logging.basicConfig(format="%(asctime)s %(levelname)s %(message)s", level=logging.INFO)
    answers = os.dup(1)
    os.dup2(2, 1)  # viser prints: that goes to the log
    first = told_in(sys.stdin.buffer.readline())
    assert isinstance(first, RigTold), "the rig is told first"
    listen_at(path)
    stage = Stage(first.chain)
    stage.open(viser.ViserServer(host="127.0.0.1", port=0, verbose=False))
    Thread(target=_listen, args=(stage,), daemon=True).start()
    os.write(answers, READY)
    frames = 0
    while True:
        stage.draw()
        frames += 1
        if frames % BEAT_EACH == 0:
            os.write(answers, BEAT)
        sleep(FRAME_S)


def _listen(stage: Stage) -> None:
    for line in sys.stdin.buffer:
        stage.take(told_in(line))
    os._exit(0)


if __name__ == "__main__":
    main(Path(sys.argv[1]))
