"""Sessions of browsers: begun when somebody signs in, ended when they sign out or are sent away."""

from dataclasses import dataclass

from app.access import entries, repository
from app.access.book import LONGEST, Book
from app.access.keys import digest, new_key
from app.access.models import SignedIn
from app.access.principal import Principal, Role
from app.access.refusals import ONLY_SIGNED_IN, unknown_session
from app.access.schemas import SessionOut
from app.audit.actor import Actor, acting
from app.audit.record import record
from app.errors import Refusal


@dataclass(frozen=True)
class Sessions:
    """Keeps the sessions. An admin sees all of them, anybody else their own."""

    _book: Book

    def begin(self, user_id: int, how: str = "password") -> str:
        """A new session of a user; returns its key, for the cookie."""
        key, now = new_key(), self._book.now()
        with self._book.writing() as session:
            row = SignedIn(
                user_id=user_id,
                digest=digest(key),
                csrf=new_key(),
                created_at=now,
                last_seen_at=now,
            )
            session.add(row)
            session.flush()
            user = row.user
            with acting(Actor(user.name, user.role, f"session:{row.id}")):
                record(session, entries.session_begun(user, how))
        return key

    def by_link(self, key: str) -> str | None:
        """A new session for a link that was not used before, None for any other."""
        with self._book.writing() as session:
            link = repository.take_link(session, digest(key))
            good = link is not None and self._book.now() < link.expires_at
        return self.begin(link.user_id, "link") if link is not None and good else None

    def of(self, who: Principal) -> list[SessionOut]:
        """The sessions that somebody may see, the newest first."""
        seen = [one for one in self._book.sessions() if _may_see(who, one)]
        return [self._shown(one, who) for one in seen]

    def end(self, session_id: int, who: Principal) -> Refusal | None:
        """End a session, one's own or for an admin anybody's. No token that leaked signs its owner out."""
        found = next((one for one in self._book.sessions() if one.id == session_id), None)
        if found is None or not _may_see(who, found):
            return unknown_session(session_id)
        if who.kind == "token" and who.role < Role.ADMIN:
            return ONLY_SIGNED_IN
        with self._book.writing() as session:
            repository.end_session(session, session_id)
            record(session, entries.session_ended(found))
        return None

    def _shown(self, one: SignedIn, who: Principal) -> SessionOut:
        return SessionOut(
            id=one.id,
            user=one.user.name,
            created_at=one.created_at,
            last_seen_at=self._book.seen_at(one),
            expires_at=one.created_at + LONGEST,
            present=who.id == f"session:{one.id}",
        )


def _may_see(who: Principal, session: SignedIn) -> bool:
    return who.role >= Role.ADMIN or session.user_id == who.user_id
