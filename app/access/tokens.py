"""Bearer tokens for scripts: made, shown once, revoked."""

from dataclasses import dataclass
from datetime import timedelta

from app.access import entries, repository
from app.access.book import Book
from app.access.keys import TOKEN_PREFIX, digest, new_key
from app.access.models import ApiToken
from app.access.principal import Principal, Role, lacking
from app.access.refusals import ONLY_SIGNED_IN, beyond_owner, unknown_token, unknown_user
from app.access.schemas import TokenCreate, TokenMade, TokenOut
from app.access.scopes import Scope, role_of
from app.audit.record import record
from app.errors import Refusal


@dataclass(frozen=True)
class Tokens:
    """Keeps the tokens. An admin sees all of them, anybody else their own."""

    _book: Book

    def of(self, who: Principal) -> list[TokenOut]:
        """The tokens that somebody may see, the newest first."""
        return [self._shown(one) for one in self._book.tokens() if _may_see(who, one)]

    def all(self) -> list[TokenOut]:
        """Every token, the newest first."""
        return [self._shown(one) for one in self._book.tokens()]

    def make(self, who: Principal, asked: TokenCreate) -> TokenMade | Refusal:
        """A token of one's own, for no more than one may oneself."""
        if who.kind == "token" and who.role < Role.ADMIN:
            return ONLY_SIGNED_IN  # a token that leaked is to leave no others behind
        refusal = lacking(who, role_of(asked.scope))
        if refusal is not None:
            return refusal
        assert who.user_id is not None
        return self.make_for(who.user_id, asked)

    def make_for(self, user_id: int, asked: TokenCreate) -> TokenMade | Refusal:
        """A token of a user's, on behalf of nobody (the command line)."""
        key, now = TOKEN_PREFIX + new_key(), self._book.now()
        days = asked.expires_in_days
        with self._book.writing() as session:
            user = repository.user(session, user_id)
            if user is None:
                return unknown_user(user_id)
            if Role.of(user.role) < role_of(asked.scope):
                return beyond_owner(user.name, user.role)
            row = ApiToken(
                user_id=user_id,
                name=asked.name,
                scope=asked.scope.value,
                digest=digest(key),
                created_at=now,
                expires_at=None if days is None else now + timedelta(days=days),
            )
            session.add(row)
            owner = user.name
            session.flush()
            record(session, entries.token_made(row, owner))
        return TokenMade(token=key, **_plain(row, owner).model_dump())

    def revoke(self, token_id: int, who: Principal | None = None) -> Refusal | None:
        """End a token: of one's own, of anybody's for an admin or the command line.

        A token that is no admin's ends itself only: one that leaked is to stop no other work.
        """
        with self._book.writing() as session:
            row = repository.token(session, token_id)
            unseen = row is None or (who is not None and not _may_see(who, row))
            if row is None or unseen or row.revoked_at is not None:
                return unknown_token(token_id)
            if who is not None and who.kind == "token" and not _may_end(who, token_id):
                return ONLY_SIGNED_IN
            row.revoked_at = self._book.now()
            record(session, entries.token_revoked(row))
            return None

    def _shown(self, token: ApiToken) -> TokenOut:
        shown = _plain(token, token.user.name)
        return shown.model_copy(update={"last_used_at": self._book.used_at(token)})


def _may_see(who: Principal, token: ApiToken) -> bool:
    return who.role >= Role.ADMIN or token.user_id == who.user_id


def _may_end(who: Principal, token_id: int) -> bool:
    return who.role >= Role.ADMIN or who.id == f"token:{token_id}"


def _plain(token: ApiToken, owner: str) -> TokenOut:
    return TokenOut(
        id=token.id,
        name=token.name,
        owner=owner,
        scope=Scope(token.scope),
        created_at=token.created_at,
        expires_at=token.expires_at,
        last_used_at=token.last_used_at,
        revoked_at=token.revoked_at,
    )
