"""The users: entered, changed, removed. One admin always stays."""

from dataclasses import dataclass
from datetime import datetime, timedelta

from sqlalchemy.exc import IntegrityError
from sqlalchemy.orm import Session

from app.access import entries, repository
from app.access.book import Book
from app.access.keys import digest, new_key
from app.access.models import SignInLink, User
from app.access.passwords import Passwords, weak
from app.access.principal import Role
from app.access.refusals import DISABLED, LAST_ADMIN, OWN_ACCOUNT, unknown_user, user_exists
from app.access.schemas import RoleWord, UserChange, UserCreate, UserOut
from app.audit.record import record
from app.errors import Refusal

FIRST_ADMIN = "admin"
LINK_LIFE = timedelta(days=1)
LINK_PATH = "/sign-in?token="


@dataclass(frozen=True)
class MadeLink:
    """A new link; `path` holds the key, and is shown this once."""

    path: str
    expires_at: datetime


class Users:
    """Keeps the users. Passwords are hashed in the caller's thread: never call these on the event loop."""

    def __init__(self, book: Book, passwords: Passwords) -> None:
        self._book = book
        self._passwords = passwords

    def all(self) -> list[UserOut]:
        """Everybody, by name."""
        seen = self._book.last_seen()
        return [_shown(user, seen.get(user.id)) for user in self._book.users()]

    def get(self, user_id: int) -> UserOut | Refusal:
        """A user by number."""
        found = next((one for one in self.all() if one.id == user_id), None)
        return found or unknown_user(user_id)

    def number_of(self, name: str) -> int | Refusal:
        """The number of a user."""
        found = self._book.user(name)
        return unknown_user(name) if found is None else found.id

    def add(self, asked: UserCreate) -> UserOut | Refusal:
        """Enter a new user."""
        refusal = None if asked.password is None else weak(asked.name, asked.password)
        if refusal is not None:
            return refusal
        hashed = None if asked.password is None else self._passwords.hash(asked.password)
        try:
            with self._book.writing() as session:
                user = self._new(asked.name, Role.of(asked.role), hashed)
                session.add(user)
                record(session, entries.added(user))
        except IntegrityError:
            return user_exists(asked.name)
        return self.get(user.id)

    def change(self, user_id: int, asked: UserChange, by: int | None = None) -> UserOut | Refusal:
        """Change a user, on behalf of another or of nobody (the command line)."""
        hashed = self._hash_for(user_id, asked.password)
        if isinstance(hashed, Refusal):
            return hashed
        with self._book.writing() as session:
            user = repository.user(session, user_id)
            if user is None:
                return unknown_user(user_id)
            refusal = _keeps_an_admin(session, user, by) if _takes_rights(user, asked) else None
            if refusal is not None:
                return refusal
            before = entries.state_of(user)
            user.role = user.role if asked.role is None else asked.role.value
            user.disabled = user.disabled if asked.disabled is None else asked.disabled
            user.password_hash = hashed or user.password_hash
            if hashed is not None or user.disabled:
                repository.end_sessions(session, user_id)
                repository.drop_links(session, user_id)
            record(session, entries.changed(user, before, new_password=hashed is not None))
        return self.get(user_id)

    def remove(self, user_id: int, by: int | None = None) -> Refusal | None:
        """Remove a user with their sessions and tokens. What they did stays in the audit."""
        with self._book.writing() as session:
            user = repository.user(session, user_id)
            if user is None:
                return unknown_user(user_id)
            refusal = _keeps_an_admin(session, user, by)
            if refusal is None:
                record(session, entries.removed(user))
                session.delete(user)
            return refusal

    def link(self, user_id: int) -> MadeLink | Refusal:
        """A link that signs a user in once; one made before is no longer good."""
        with self._book.writing() as session:
            user = repository.user(session, user_id)
            if user is None:
                return unknown_user(user_id)
            return DISABLED if user.disabled else self._new_link(session, user)

    def first_link(self) -> MadeLink | None:
        """At a start: a link for an admin, made where there is nobody; None where one has a password."""
        with self._book.writing() as session:
            self._ensure_admin(session)
            admins = repository.admins(session)
            if any(admin.password_hash is not None for admin in admins):
                return None
            return self._new_link(session, admins[0])

    def first_admin(self) -> None:
        """Make the first admin where there is nobody."""
        if not self._book.users():
            with self._book.writing() as session:
                self._ensure_admin(session)

    def _ensure_admin(self, session: Session) -> None:
        if not repository.users(session):
            first = self._new(FIRST_ADMIN, Role.ADMIN, None)
            session.add(first)
            session.flush()
            record(session, entries.added(first))

    def _hash_for(self, user_id: int, password: str | None) -> str | Refusal | None:
        if password is None:
            return None
        user = self.get(user_id)
        if isinstance(user, Refusal):
            return user
        return weak(user.name, password) or self._passwords.hash(password)

    def _new(self, name: str, role: Role, hashed: str | None) -> User:
        return User(
            name=name,
            role=role.word,
            password_hash=hashed,
            disabled=False,
            created_at=self._book.now(),
        )

    def _new_link(self, session: Session, user: User) -> MadeLink:
        key = new_key()
        made = MadeLink(LINK_PATH + key, self._book.now() + LINK_LIFE)
        repository.drop_links(session, user.id)
        record(session, entries.linked(user))
        session.add(SignInLink(user_id=user.id, digest=digest(key), expires_at=made.expires_at))
        return made


def _shown(user: User, seen_at: datetime | None) -> UserOut:
    return UserOut(
        id=user.id,
        name=user.name,
        role=RoleWord(user.role),
        disabled=user.disabled,
        has_password=user.password_hash is not None,
        created_at=user.created_at,
        last_seen_at=seen_at,
    )


def _takes_rights(user: User, asked: UserChange) -> bool:
    demoted = asked.role is not None and Role.of(asked.role) < Role.of(user.role)
    return demoted or bool(asked.disabled)


def _keeps_an_admin(session: Session, user: User, by: int | None) -> Refusal | None:
    """Why this user's rights cannot be taken; None where they can."""
    if user.id == by:
        return OWN_ACCOUNT
    is_admin = user.role == Role.ADMIN.word and not user.disabled
    if not is_admin or any(other.id != user.id for other in repository.admins(session)):
        return None
    return LAST_ADMIN
