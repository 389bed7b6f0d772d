"""Access on a database of its own, at a time that the test says."""

from dataclasses import dataclass, field
from datetime import UTC, datetime, timedelta

from app.access.book import Book
from app.access.identity import Identity
from app.access.models import User
from app.access.passwords import Passwords
from app.access.schemas import RoleWord, UserCreate, UserOut
from app.access.sessions import Sessions
from app.access.tickets import Tickets
from app.access.tokens import Tokens
from app.access.users import LINK_PATH, Users
from app.db import Database
from app.errors import Code, Refusal

NOON = datetime(2026, 3, 1, 12, tzinfo=UTC)
LONG = "correct horse battery"


@dataclass
class Desk:
    """What the tests ask."""

    database: Database
    passwords: Passwords
    now: datetime = NOON
    later_s: float = 0.0
    book: Book = field(init=False)

    def __post_init__(self) -> None:
        self.book = Book(self.database, lambda: self.now)
        self.users = Users(self.book, self.passwords)
        self.sessions = Sessions(self.book)
        self.tokens = Tokens(self.book)
        self.tickets = Tickets(lambda: self.later_s)
        self.identity = Identity(self.book, self.tickets)

    def wait(self, **time: float) -> None:
        """Let time go by."""
        self.now += timedelta(**time)
        self.later_s += timedelta(**time).total_seconds()

    def enter(self, name: str, role: str = "operator", password: str | None = None) -> UserOut:
        """Enter a user."""
        made = self.users.add(UserCreate(name=name, role=RoleWord(role), password=password))
        assert isinstance(made, UserOut), made
        return made

    def link(self, user_id: int) -> str:
        """The key of a new link."""
        made = self.users.link(user_id)
        assert not isinstance(made, Refusal), made
        return made.path.removeprefix(LINK_PATH)

    def row(self, name: str) -> User:
        """A user as the book has them."""
        found = self.book.user(name)
        assert found is not None
        return found


def code(found: object) -> Code | None:
    """Of a refusal; None for what was granted."""
    return found.code if isinstance(found, Refusal) else None
