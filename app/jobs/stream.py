"""What a process apart writes, handed on piece by piece as it comes: of any length in bounded memory."""

from collections.abc import Callable, Iterator
from contextlib import suppress
from multiprocessing import get_context
from multiprocessing.connection import Connection
from typing import Any

from app.jobs.apart import BrokeOff, settle_down

PIECE_BYTES = 262_144
_END = b""


class Stream:
    """The bytes that `write(out, *arguments)` writes; `close` ends the process, however far it is.

    Iterating raises `BrokeOff` where it did not come to its end.
    """

    def __init__(self, write: Callable[..., None], *arguments: Any) -> None:
        context = get_context("spawn")
        self._ours, theirs = context.Pipe(duplex=False)
        self._process = context.Process(target=_work, args=(theirs, write, arguments), daemon=True)
        self._process.start()
        theirs.close()

    def __iter__(self) -> Iterator[bytes]:
        while True:
            try:
                piece = self._ours.recv_bytes()
            except (EOFError, OSError):
                raise BrokeOff("Its process ended before it was done") from None
            if piece == _END:
                return
            yield piece

    def close(self) -> None:
        """End it. Nobody may iterate any more afterwards."""
        self._process.kill()
        self._process.join()
        self._ours.close()


class _Out:
    """A file that can only be written: what libraries ask of one."""

    closed = False

    def __init__(self, connection: Connection) -> None:
        self._connection = connection
        self._waiting = bytearray()
        self._position = 0

    def write(self, data: Any) -> int:
        view = memoryview(data).cast("B") if not isinstance(data, bytes) else data
        self._waiting += view
        self._position += len(view)
        while len(self._waiting) >= PIECE_BYTES:
            self._connection.send_bytes(self._waiting[:PIECE_BYTES])
            del self._waiting[:PIECE_BYTES]
        return len(view)

    def writelines(self, pieces: Any) -> None:
        for piece in pieces:
            self.write(piece)

    def tell(self) -> int:
        return self._position

    def read(self, size: int = -1) -> bytes:  # asked for, to tell a file from a path
        raise OSError("This can only be written")

    def flush(self) -> None: ...

    def end(self) -> None:
        if self._waiting:
            self._connection.send_bytes(self._waiting)
        self._connection.send_bytes(_END)


def _work(connection: Connection, write: Callable[..., None], arguments: tuple[Any, ...]) -> None:
    settle_down()
    out = _Out(connection)
    with suppress(BrokenPipeError):  # nobody wants the rest
        write(out, *arguments)
        out.end()
