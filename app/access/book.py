"""Who may come in, as the database has it, kept in memory.

A request looks here and waits for no query; whoever is signed in can stop the rig while the database
is down. Every change goes through `writing`, so that it holds from the moment it is committed. What
the command line changes beside a running console is found by reading again.
"""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from datetime import UTC, datetime, timedelta
from functools import cached_property
from threading import RLock

from sqlalchemy.orm import Session

from app.access import repository
from app.access.models import ApiToken, SignedIn, User
from app.access.principal import Principal, Role
from app.access.scopes import role_of
from app.db import Database

IDLE = timedelta(hours=12)
LONGEST = timedelta(days=7)
Clock = Callable[[], datetime]


def utc_now() -> datetime:
    """The wall clock."""
    return datetime.now(UTC)


@dataclass
class _Contents:
    users: dict[str, User] = field(default_factory=dict)  # by name
    sessions: dict[str, SignedIn] = field(default_factory=dict)  # by digest
    tokens: dict[str, ApiToken] = field(default_factory=dict)

    @cached_property
    def by_id(self) -> dict[str, "SignedIn | ApiToken"]:
        """Sessions and tokens, by the ids of who comes with them."""
        sessions = {f"session:{one.id}": one for one in self.sessions.values()}
        return sessions | {f"token:{one.id}": one for one in self.tokens.values()}


class Book:
    """The users, sessions and tokens. Looking up never waits; it may be done in any thread."""

    def __init__(self, database: Database, now: Clock = utc_now) -> None:
        self._database = database
        self.now = now
        self._changing = RLock()  # so that no older reading replaces a newer one
        self._contents = _Contents()
        self._seen: dict[int, datetime] = {}
        self._used: dict[int, datetime] = {}

    def read(self) -> None:
        """Read everything again. Raises `OperationalError`, and keeps what it had."""
        with self._changing, self._database.reading() as session:
            self._contents = _Contents(
                {user.name: user for user in repository.users(session)},
                {one.digest: one for one in repository.sessions(session)},
                {one.digest: one for one in repository.tokens(session)},
            )
            session.expunge_all()

    @contextmanager
    def writing(self) -> Iterator[Session]:
        """A session for a change: when it is committed, it holds for the next request."""
        with self._changing:
            with self._database.writing() as session:
                yield session
            self.read()

    def note_seen(self) -> None:
        """Write down who was seen since the last time, and forget sessions that are over."""
        seen, used = dict(self._seen), dict(self._used)
        if not seen and not used:
            return
        with self.writing() as session:
            repository.note_seen(session, seen, used)
            repository.end_sessions_before(session, self.now() - LONGEST, self.now() - IDLE)
        for noted, kept in ((seen, self._seen), (used, self._used)):
            for number, at in noted.items():
                if kept.get(number) == at:
                    kept.pop(number, None)

    # ---- looking up ----

    def users(self) -> list[User]:
        """Everybody, by name."""
        return list(self._contents.users.values())

    def last_seen(self) -> dict[int, datetime]:
        """When users, by their numbers, were last seen; who has no session is not in it."""
        seen: dict[int, datetime] = {}
        for one in self._contents.sessions.values():
            seen[one.user_id] = max(self.seen_at(one), seen.get(one.user_id, one.created_at))
        return seen

    def sessions(self) -> list[SignedIn]:
        """The sessions that still hold, the newest first."""
        return [one for one in self._contents.sessions.values() if self._holds(one)]

    def tokens(self) -> list[ApiToken]:
        """All tokens, the newest first."""
        return list(self._contents.tokens.values())

    def used_at(self, token: ApiToken) -> datetime | None:
        """When a token was last used."""
        return self._used.get(token.id, token.last_used_at)

    def user(self, name: str) -> User | None:
        """A user by name."""
        return self._contents.users.get(name)

    def session(self, digest: str) -> SignedIn | None:
        """A session that still holds, and note that it was seen."""
        found = self._contents.sessions.get(digest)
        if found is None or not self._holds(found):
            return None
        self._seen[found.id] = self.now()
        return found

    def token(self, digest: str) -> ApiToken | None:
        """A token that still holds, and note that it was used."""
        found = self._contents.tokens.get(digest)
        if found is None or not self._is_good(found):
            return None
        self._used[found.id] = self.now()
        return found

    def still(self, who: Principal) -> bool:
        """Whether somebody who came in may still be here, and with the same role."""
        found = self.by_id(who)
        if isinstance(found, SignedIn):
            return self._holds(found) and of_session(found) == who
        return found is not None and self._is_good(found) and of_token(found) == who

    def by_id(self, who: Principal) -> SignedIn | ApiToken | None:
        """The session or token that somebody came with, None where it is gone."""
        return self._contents.by_id.get(who.id)

    def seen_at(self, session: SignedIn) -> datetime:
        """When a session was last seen."""
        return max(session.last_seen_at, self._seen.get(session.id, session.last_seen_at))

    def _holds(self, session: SignedIn) -> bool:
        now = self.now()
        in_time = now < session.created_at + LONGEST and now < self.seen_at(session) + IDLE
        return in_time and not session.user.disabled

    def _is_good(self, token: ApiToken) -> bool:
        in_time = token.expires_at is None or self.now() < token.expires_at
        return in_time and token.revoked_at is None and not token.user.disabled


def of_session(session: SignedIn) -> Principal:
    """Who comes with a session."""
    user = session.user
    return Principal(f"session:{session.id}", user.name, Role.of(user.role), "session", user.id)


def of_token(token: ApiToken) -> Principal:
    """Who comes with a token: its owner, with no more than the token's scope."""
    user = token.user
    role = min(Role.of(user.role), role_of(token.scope))
    return Principal(f"token:{token.id}", f"{user.name} ({token.name})", role, "token", user.id)
