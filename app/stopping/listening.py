"""The threads that listen for Stop: bounded, and no slow client keeps another from being heard."""

import logging
import socket
import ssl
from collections import OrderedDict
from collections.abc import Callable, Collection, Iterator
from contextlib import contextmanager, suppress
from threading import Event, Lock, Thread

from app.access.book import Book
from app.stopping.answering import Answering
from app.stopping.door import StopDoor
from app.stopping.request import WITHIN_S, Answer, NoRequest, Request, read_request
from app.stopping.service import Stops

MOST = 32  # connections
_log = logging.getLogger(__name__)


@contextmanager
def listening_for_stop(
    door: StopDoor | None, hosts: Collection[str], book: Book, stops: Stops
) -> Iterator[None]:
    """Answer what comes to the door meanwhile, where there is one."""
    if door is None:
        yield
        return
    listener = StopListener(door, Answering(door, hosts, book, stops))
    listener.start()
    try:
        yield
    finally:
        listener.close()


class StopListener:
    """Answers what comes to the door, each connection in a thread of its own and once."""

    def __init__(self, door: StopDoor, answer: Callable[[Request], Answer]) -> None:
        self._door = door
        self._answer = answer
        self._open: OrderedDict[int, socket.socket] = OrderedDict()
        self._counting = Lock()
        self._ended = Event()
        self._thread = Thread(target=self._listen, name="stop", daemon=True)

    def start(self) -> None:
        """Begin to listen."""
        self._thread.start()

    def close(self) -> None:
        """Listen no longer. What is being answered still is."""
        self._ended.set()
        if self._thread.is_alive():
            self._thread.join()

    def _listen(self) -> None:
        listener = self._door.listener
        listener.settimeout(0.1)  # how often it looks whether it has ended
        while not self._ended.is_set():
            try:
                connection, _ = listener.accept()
            except TimeoutError:
                continue
            except OSError as error:  # too many files are open, say
                _log.warning("stop: %s", error)
                self._ended.wait(0.05)
                continue
            self._take(connection)

    def _take(self, connection: socket.socket) -> None:
        """Answer a connection in a thread; of too many, the oldest is sent away."""
        try:
            stream = self._secured(connection)
            with self._counting:
                while len(self._open) >= MOST:
                    _hang_up(self._open.popitem(last=False)[1])
                self._open[id(stream)] = stream
            Thread(target=self._serve, args=(stream,), name="stop", daemon=True).start()
        except (OSError, RuntimeError) as error:  # it is gone already, or there are no more threads
            _log.warning("stop: %s", error)
            connection.close()

    def _secured(self, connection: socket.socket) -> socket.socket:
        """The connection, under TLS where the console has it; its thread shakes hands."""
        connection.settimeout(WITHIN_S)
        if self._door.tls is None:
            return connection
        return self._door.tls.wrap_socket(
            connection, server_side=True, do_handshake_on_connect=False
        )

    def _serve(self, stream: socket.socket) -> None:
        try:
            with stream:
                if isinstance(stream, ssl.SSLSocket):
                    stream.do_handshake()
                answer = self._answer(read_request(stream)).written()
                stream.settimeout(WITHIN_S)
                stream.sendall(answer)
                stream.shutdown(socket.SHUT_WR)
        except (NoRequest, OSError):
            pass  # nobody is there to be told
        except Exception:
            _log.exception("stop: could not answer")
        finally:
            with self._counting:
                self._open.pop(id(stream), None)


def _hang_up(stream: socket.socket) -> None:
    with suppress(OSError):
        stream.shutdown(socket.SHUT_RDWR)  # which ends the thread that reads it
