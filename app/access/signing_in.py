"""Signing in by name and password, out again, and setting the password."""

from anyio.to_thread import run_sync

from app.access import entries, repository
from app.access.attempts import Attempts
from app.access.book import Book
from app.access.models import SignedIn
from app.access.passwords import Passwords, weak
from app.access.principal import Principal
from app.access.refusals import (
    NOT_SIGNED_IN,
    ONLY_SIGNED_IN,
    SIGN_IN_FAILED,
    WRONG_PASSWORD,
)
from app.access.schemas import Me, PasswordChange, RoleWord, SignIn
from app.access.sessions import Sessions
from app.audit.record import note, record
from app.errors import Refusal


class SigningIn:
    """On the event loop; hashes and queries go to threads."""

    def __init__(
        self, book: Book, sessions: Sessions, passwords: Passwords, attempts: Attempts
    ) -> None:
        self._book = book
        self._sessions = sessions
        self._passwords = passwords
        self._attempts = attempts

    async def sign_in(self, asked: SignIn, address: str) -> str | Refusal:
        """The key of a new session. A name that nobody has takes as long as a wrong password."""
        refusal = self._attempts.begin(asked.name, address)
        if refusal is not None:
            return refusal
        user = self._book.user(asked.name)
        kept = None if user is None or user.disabled else user.password_hash
        right = await self._passwords.compare(asked.password, kept)
        if isinstance(right, Refusal):
            return right
        if user is None or not right:
            note(entries.sign_in_refused(user, address))
            return SIGN_IN_FAILED
        self._attempts.succeeded(asked.name, address)
        return await run_sync(self._sessions.begin, user.id)

    async def sign_out(self, who: Principal) -> Refusal | None:
        """End the session that asks."""
        session = self._session_of(who)
        if session is None:
            return ONLY_SIGNED_IN
        return await run_sync(self._sessions.end, session.id, who)

    async def set_password(
        self, who: Principal, asked: PasswordChange, address: str
    ) -> Refusal | None:
        """Give oneself another password. One's other sessions end."""
        session = self._session_of(who)
        if session is None:
            return ONLY_SIGNED_IN
        user = session.user
        refusal = weak(user.name, asked.new)
        if refusal is None and user.password_hash is not None:
            refusal = await self._check_old(user.name, asked.old or "", address)
        if refusal is not None:
            return refusal
        hashed = await self._passwords.hashed(asked.new)
        return await run_sync(self._keep, session, user.password_hash, hashed)

    def me(self, who: Principal) -> Me | Refusal:
        """What somebody may know of themselves."""
        session = self._session_of(who)
        if session is None and who.kind == "session":
            return NOT_SIGNED_IN
        assert who.user_id is not None
        return Me(
            id=who.id,
            name=who.name,
            user_id=who.user_id,
            role=RoleWord(who.role.word),
            kind=who.kind,
            csrf_token=None if session is None else session.csrf,
            must_set_password=session is not None and session.user.password_hash is None,
        )

    async def _check_old(self, name: str, old: str, address: str) -> Refusal | None:
        refusal = self._attempts.begin(name, address)
        if refusal is not None:
            return refusal
        user = self._book.user(name)
        right = await self._passwords.compare(old, None if user is None else user.password_hash)
        if isinstance(right, Refusal):
            return right
        if not right:
            return WRONG_PASSWORD
        self._attempts.succeeded(name, address)
        return None

    def _keep(self, asking: SignedIn, before: str | None, hashed: str) -> Refusal | None:
        with self._book.writing() as session:
            user = repository.user(session, asking.user_id)
            if user is None or user.password_hash != before:  # set meanwhile, by an admin
                return WRONG_PASSWORD
            known = entries.state_of(user)
            user.password_hash = hashed
            record(session, entries.changed(user, known, new_password=True))
            repository.end_sessions(session, user.id, but=asking.id)
            repository.drop_links(session, user.id)
        return None

    def _session_of(self, who: Principal) -> SignedIn | None:
        found = self._book.by_id(who)
        return found if isinstance(found, SignedIn) else None
