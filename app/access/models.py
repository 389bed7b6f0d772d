"""The tables of access. Of everything that lets somebody in, only a hash is kept."""

from datetime import datetime

from sqlalchemy import ForeignKey, String
from sqlalchemy.orm import Mapped, mapped_column, relationship

from app.db import Base, BigInt, UtcDateTime, key_text

LONGEST_NAME = 50
# The audit and the lease know them by their numbers: none is given twice.
_NEVER_TWICE = {"sqlite_autoincrement": True}


def _of_user() -> Mapped[int]:
    return mapped_column(BigInt, ForeignKey("users.id", ondelete="CASCADE"), index=True)


def _digest() -> Mapped[str]:
    return mapped_column(String(64), unique=True)


class User(Base):
    """Somebody who may come in. Without a password only a link lets them in."""

    __tablename__ = "users"
    __table_args__ = (_NEVER_TWICE,)

    id: Mapped[int] = mapped_column(BigInt, primary_key=True)
    name: Mapped[str] = mapped_column(key_text(LONGEST_NAME), unique=True)
    role: Mapped[str] = mapped_column(String(10))
    password_hash: Mapped[str | None] = mapped_column(String(200))  # Argon2, with its parameters
    disabled: Mapped[bool]
    created_at: Mapped[datetime] = mapped_column(UtcDateTime)


class SignedIn(Base):
    """A session of a browser."""

    __tablename__ = "sessions"
    __table_args__ = (_NEVER_TWICE,)

    id: Mapped[int] = mapped_column(BigInt, primary_key=True)
    user_id: Mapped[int] = _of_user()
    digest: Mapped[str] = _digest()
    csrf: Mapped[str] = mapped_column(String(64))
    created_at: Mapped[datetime] = mapped_column(UtcDateTime)
    last_seen_at: Mapped[datetime] = mapped_column(UtcDateTime)
    user: Mapped[User] = relationship(viewonly=True)


class ApiToken(Base):
    """A bearer token of a script. A revoked one stays, to be seen."""

    __tablename__ = "tokens"
    __table_args__ = (_NEVER_TWICE,)

    id: Mapped[int] = mapped_column(BigInt, primary_key=True)
    user_id: Mapped[int] = _of_user()
    name: Mapped[str] = mapped_column(String(LONGEST_NAME))
    scope: Mapped[str] = mapped_column(String(10))
    digest: Mapped[str] = _digest()
    created_at: Mapped[datetime] = mapped_column(UtcDateTime)
    expires_at: Mapped[datetime | None] = mapped_column(UtcDateTime)
    last_used_at: Mapped[datetime | None] = mapped_column(UtcDateTime)
    revoked_at: Mapped[datetime | None] = mapped_column(UtcDateTime)
    user: Mapped[User] = relationship(viewonly=True)


class SignInLink(Base):
    """A link that lets its user in once; gone when it was used."""

    __tablename__ = "sign_in_links"

    id: Mapped[int] = mapped_column(BigInt, primary_key=True)
    user_id: Mapped[int] = _of_user()
    digest: Mapped[str] = _digest()
    expires_at: Mapped[datetime] = mapped_column(UtcDateTime)
