"""Queries of access."""

from collections.abc import Mapping, Sequence
from datetime import datetime

from sqlalchemy import delete, or_, select, update
from sqlalchemy.orm import Session, joinedload

from app.access.models import ApiToken, SignedIn, SignInLink, User
from app.access.principal import Role


def users(session: Session) -> Sequence[User]:
    """Everybody, by name."""
    return session.scalars(select(User).order_by(User.name)).all()


def user(session: Session, user_id: int) -> User | None:
    """A user by number."""
    return session.get(User, user_id)


def user_named(session: Session, name: str) -> User | None:
    """A user by name."""
    return session.scalars(select(User).where(User.name == name)).first()


def admins(session: Session) -> Sequence[User]:
    """The administrators who can come in, the first one first. They stay so until the end."""
    query = select(User).where(User.role == Role.ADMIN.word, User.disabled.is_(False))
    return session.scalars(query.order_by(User.id).with_for_update()).all()


def sessions(session: Session) -> Sequence[SignedIn]:
    """All sessions with their users, the newest first."""
    query = select(SignedIn).options(joinedload(SignedIn.user)).order_by(SignedIn.id.desc())
    return session.scalars(query).all()


def tokens(session: Session) -> Sequence[ApiToken]:
    """All tokens with their owners, the newest first."""
    query = select(ApiToken).options(joinedload(ApiToken.user)).order_by(ApiToken.id.desc())
    return session.scalars(query).all()


def token(session: Session, token_id: int) -> ApiToken | None:
    """A token by number."""
    return session.get(ApiToken, token_id)


def end_sessions(session: Session, user_id: int, but: int | None = None) -> None:
    """Remove the sessions of a user, all but one."""
    session.execute(delete(SignedIn).where(SignedIn.user_id == user_id, SignedIn.id != (but or 0)))


def end_session(session: Session, session_id: int) -> None:
    """Remove a session, where it is still there."""
    session.execute(delete(SignedIn).where(SignedIn.id == session_id))


def end_sessions_before(session: Session, created_at: datetime, seen_at: datetime) -> None:
    """Remove the sessions that began, or were last seen, before these times."""
    old = or_(SignedIn.created_at < created_at, SignedIn.last_seen_at < seen_at)
    session.execute(delete(SignedIn).where(old))


def note_seen(session: Session, seen: Mapping[int, datetime], used: Mapping[int, datetime]) -> None:
    """Write down when sessions and tokens, by their numbers, were last used."""
    for session_id, at in seen.items():
        session.execute(update(SignedIn).where(SignedIn.id == session_id).values(last_seen_at=at))
    for token_id, at in used.items():
        session.execute(update(ApiToken).where(ApiToken.id == token_id).values(last_used_at=at))


def drop_links(session: Session, user_id: int) -> None:
    """Remove the links of a user: the newest alone is good."""
    session.execute(delete(SignInLink).where(SignInLink.user_id == user_id))


def take_link(session: Session, digest: str) -> SignInLink | None:
    """Remove a link and return it; of two who use it at once, one gets it."""
    query = delete(SignInLink).where(SignInLink.digest == digest).returning(SignInLink)
    return session.scalars(query).first()
