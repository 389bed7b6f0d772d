"""Access: everything about who may come in, of one console."""

import logging
from threading import Event, Thread

from sqlalchemy.exc import SQLAlchemyError

from app.access.attempts import Attempts
from app.access.book import Book, Clock, utc_now
from app.access.identity import Identity
from app.access.passwords import Passwords
from app.access.sessions import Sessions
from app.access.signing_in import SigningIn
from app.access.tickets import Tickets
from app.access.tokens import Tokens
from app.access.users import Users
from app.db import Database

_log = logging.getLogger(__name__)
_LOOK_S = 2.0  # how long a change from the command line may go unnoticed
_NOTE_EACH = 30  # looks


class Access:
    """The parts of access, and a thread that notices what the command line changes."""

    def __init__(self, database: Database, now: Clock = utc_now) -> None:
        self.book = Book(database, now)
        self.passwords = Passwords()
        self.tickets = Tickets()
        self.users = Users(self.book, self.passwords)
        self.sessions = Sessions(self.book)
        self.tokens = Tokens(self.book)
        self.identity = Identity(self.book, self.tickets)
        self.signing_in = SigningIn(self.book, self.sessions, self.passwords, Attempts())
        self._ending = Event()
        self._watcher = Thread(target=self._watch, name="access watcher", daemon=True)

    def open(self) -> None:
        """Read who may come in, and go on noticing."""
        self.passwords.open()
        self.book.read()
        self._watcher.start()

    def close(self) -> None:
        """Write down who was seen, and end the threads."""
        self._ending.set()
        if self._watcher.ident is not None:
            self._watcher.join()
        self.identity.close()
        self.passwords.close()

    def _watch(self) -> None:
        looks = 0
        while not self._ending.wait(_LOOK_S):
            looks += 1
            self._look(note=looks % _NOTE_EACH == 0)
        self._look(note=True)

    def _look(self, *, note: bool) -> None:
        """A database that does not answer changes nothing: who has come in may go on."""
        try:
            if note:
                self.book.note_seen()
            self.book.read()
        except SQLAlchemyError as error:
            _log.warning("access: the database does not answer: %s", error)
