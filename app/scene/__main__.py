"""The scene's process: `python -m app.scene SOCKET`. Told on its standard input, ends with it."""

import logging
import os
import signal
import sys
import threading
from pathlib import Path
from time import sleep

from app.scene.private import listen_at
from app.scene.server import PrivateServer
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
    threading.excepthook = _give_up
    answers = os.dup(1)
    os.dup2(2, 1)  # viser prints: that goes to the log
    first = told_in(sys.stdin.buffer.readline())
    assert isinstance(first, RigTold), "the rig is told first"
    os.chdir(path.parent)  # the name of a socket may not be long, that of a folder may
    listen_at(Path(path.name))
    stage = Stage(first.chain)
    stage.open(PrivateServer(host="127.0.0.1", port=0, verbose=False))
    threading.Thread(target=_listen, args=(stage,), daemon=True).start()
    os.write(answers, READY)
    frames = 0
    while True:
        stage.draw()
        frames += 1
        if frames % BEAT_EACH == 0:
            os.write(answers, BEAT)
        sleep(FRAME_S)


def _give_up(what: threading.ExceptHookArgs) -> None:
    """A scene without its server is of no use: the console starts another."""
    logging.getLogger(__name__).error("a thread has failed: %s", what.exc_value)
    os._exit(1)


def _listen(stage: Stage) -> None:
    for line in sys.stdin.buffer:
        stage.take(told_in(line))
    os._exit(0)


if __name__ == "__main__":
    main(Path(sys.argv[1]))
