"""Who may come in, for how long, and what ends it: with a clock that the test holds."""

import asyncio

import pytest
from sqlalchemy.exc import OperationalError

from app.access.book import Book
from app.access.credentials import Credentials
from app.access.identity import Identity
from app.access.keys import digest
from app.access.principal import Principal, Role
from app.access.schemas import RoleWord, TokenCreate, TokenMade, UserChange
from app.access.scopes import Scope
from app.errors import Code, Refusal
from tests.unit.app.access.at_a_time import LONG, Desk, code


def who(desk: Desk, brought: Credentials, *, changes: bool = False) -> Principal | Refusal:
    """Who asks with these."""
    return asyncio.run(desk.identity.who(brought, changes=changes))


def by_session(desk: Desk, key: str) -> Principal | Refusal:
    return who(desk, Credentials(session=key))


def by_token(desk: Desk, key: str) -> Principal | Refusal:
    return who(desk, Credentials(token=key))


def make_token(
    desk: Desk, user_id: int, scope: Scope = Scope.READ, days: float | None = 1
) -> TokenMade:
    made = desk.tokens.make_for(
        user_id, TokenCreate(name="night", scope=scope, expires_in_days=days)
    )
    assert isinstance(made, TokenMade), made
    return made


def test_a_session_ends_when_it_was_not_used_for_twelve_hours(desk: Desk) -> None:
    key = desk.sessions.begin(desk.enter("kl").id)
    for _ in range(3):
        desk.wait(hours=11.9)
        assert isinstance(by_session(desk, key), Principal)
    desk.wait(hours=12)
    assert code(by_session(desk, key)) is Code.NOT_SIGNED_IN


def test_a_session_ends_after_seven_days_however_often_it_is_used(desk: Desk) -> None:
    key = desk.sessions.begin(desk.enter("kl").id)
    for _ in range(7 * 24 - 1):
        desk.wait(hours=1)
        assert isinstance(by_session(desk, key), Principal)
    desk.wait(hours=1)
    assert code(by_session(desk, key)) is Code.NOT_SIGNED_IN


def test_when_a_session_was_used_is_known_to_the_next_console(desk: Desk) -> None:
    key = desk.sessions.begin(desk.enter("kl").id)
    desk.wait(hours=11)
    assert isinstance(by_session(desk, key), Principal)
    desk.book.note_seen()
    next_one = Book(desk.database, lambda: desk.now)
    next_one.read()
    desk.wait(hours=11)
    assert next_one.session(digest(key)) is not None
    desk.wait(hours=13)
    assert next_one.session(digest(key)) is None


def test_sessions_that_are_over_are_forgotten(desk: Desk) -> None:
    user = desk.enter("kl")
    desk.sessions.begin(user.id)
    desk.wait(days=1)
    kept = desk.sessions.begin(user.id)
    assert isinstance(by_session(desk, kept), Principal)
    desk.book.note_seen()
    with desk.database.reading() as session:
        rows = session.connection().exec_driver_sql("SELECT digest FROM sessions").scalars().all()
    assert rows == [digest(kept)]


def test_a_token_ends_when_it_expires_and_when_it_is_revoked(desk: Desk) -> None:
    user = desk.enter("kl")
    short, long = make_token(desk, user.id, days=1), make_token(desk, user.id, days=None)
    desk.wait(days=0.999)
    assert isinstance(by_token(desk, short.token), Principal)
    desk.wait(days=0.001)
    assert code(by_token(desk, short.token)) is Code.NOT_SIGNED_IN
    desk.wait(days=1000)
    assert isinstance(by_token(desk, long.token), Principal)
    assert desk.tokens.revoke(long.id) is None
    assert code(by_token(desk, long.token)) is Code.NOT_SIGNED_IN
    assert code(desk.tokens.revoke(long.id)) is Code.UNKNOWN_TOKEN


def test_a_token_may_do_what_its_scope_and_its_owner_may(desk: Desk) -> None:
    user = desk.enter("kl", "engineer")
    read, engineer = make_token(desk, user.id), make_token(desk, user.id, Scope.ENGINEER)
    wanted = TokenCreate(name="more", scope=Scope.ADMIN)
    assert code(desk.tokens.make_for(user.id, wanted)) is Code.NOT_ALLOWED

    def roles() -> list[Role]:
        found = [by_token(desk, one.token) for one in (read, engineer)]
        return [one.role for one in found if isinstance(one, Principal)]

    assert roles() == [Role.VIEWER, Role.ENGINEER]
    desk.users.change(user.id, UserChange(role=RoleWord.OPERATOR))
    assert roles() == [Role.VIEWER, Role.OPERATOR]
    desk.users.change(user.id, UserChange(disabled=True))
    assert roles() == []


def test_role_and_disabling_take_effect_at_once_on_whoever_is_in(desk: Desk) -> None:
    desk.enter("boss", "admin")
    user = desk.enter("kl")
    key = desk.sessions.begin(user.id)
    before = by_session(desk, key)
    assert isinstance(before, Principal)
    assert desk.book.still(before)
    desk.users.change(user.id, UserChange(role=RoleWord.ENGINEER))
    after = by_session(desk, key)
    assert isinstance(after, Principal)
    assert (before.role, after.role) == (Role.OPERATOR, Role.ENGINEER)
    assert not desk.book.still(before)
    assert desk.book.still(after)
    desk.users.change(user.id, UserChange(disabled=True))
    assert not desk.book.still(after)
    assert code(by_session(desk, key)) is Code.NOT_SIGNED_IN
    meanwhile = desk.sessions.begin(user.id)  # by who was signing in at that moment
    assert code(by_session(desk, meanwhile)) is Code.NOT_SIGNED_IN
    desk.users.change(user.id, UserChange(disabled=False))
    assert code(by_session(desk, key)) is Code.NOT_SIGNED_IN  # it does not come back


def test_a_change_from_a_page_needs_the_pages_token(desk: Desk) -> None:
    key = desk.sessions.begin(desk.enter("kl").id)
    other = desk.sessions.begin(desk.enter("other").id)
    csrf = {one: desk.book.session(digest(one)) for one in (key, other)}
    own, foreign = (found.csrf if found else "" for found in csrf.values())
    for given in (None, "", foreign, own[:-1], "ä"):
        assert code(who(desk, Credentials(session=key, csrf=given), changes=True)) is Code.CSRF
    assert isinstance(who(desk, Credentials(session=key, csrf=own), changes=True), Principal)
    assert isinstance(by_session(desk, key), Principal)


def test_a_ticket_is_good_once_for_half_a_minute_and_no_longer_than_whoever_took_it(
    desk: Desk,
) -> None:
    found = by_session(desk, desk.sessions.begin(desk.enter("kl").id))
    assert isinstance(found, Principal)

    def shows(ticket: str) -> Principal | Refusal:
        return who(desk, Credentials(ticket=ticket))

    used, late, ended = (desk.tickets.give(found) for _ in range(3))
    assert shows(used) == found
    assert code(shows(used)) is Code.NOT_SIGNED_IN
    assert desk.sessions.end(int(found.id.rpartition(":")[2]), found) is None
    assert code(shows(ended)) is Code.NOT_SIGNED_IN
    desk.wait(seconds=30)
    assert code(shows(late)) is Code.NOT_SIGNED_IN


def test_what_the_command_line_made_is_found_at_the_first_miss(desk: Desk) -> None:
    beside = Desk(desk.database, desk.passwords)
    user = beside.enter("kl")
    made = make_token(beside, user.id)
    assert isinstance(by_token(desk, made.token), Principal)
    assert code(by_token(desk, made.token + "x")) is Code.NOT_SIGNED_IN


def test_who_is_in_stays_in_while_the_database_is_down(
    desk: Desk, monkeypatch: pytest.MonkeyPatch
) -> None:
    key = desk.sessions.begin(desk.enter("kl").id)

    def down() -> None:
        raise OperationalError("SELECT", None, OSError("gone"))

    monkeypatch.setattr(desk.database, "reading", down)
    with pytest.raises(OperationalError):
        desk.book.read()
    assert isinstance(by_session(desk, key), Principal)


def test_nothing_that_lets_in_is_kept_itself(desk: Desk) -> None:
    user = desk.enter("kl", password=LONG)
    secrets = [
        desk.sessions.begin(user.id),
        make_token(desk, user.id).token,
        desk.link(user.id),
        LONG,
    ]
    with desk.database.reading() as session:
        for table in ("users", "sessions", "tokens", "sign_in_links"):
            rows = session.connection().exec_driver_sql(f"SELECT * FROM {table}").all()
            assert rows
            assert not any(secret in str(row) for row in rows for secret in secrets)


def test_the_id_of_a_session_is_never_given_twice(
    desk: Desk,
) -> None:
    user = desk.enter("kl")
    seen = set()
    for _ in range(3):
        found = by_session(desk, desk.sessions.begin(user.id))
        assert isinstance(found, Principal)
        seen.add(found.id)
        desk.sessions.end(int(found.id.rpartition(":")[2]), found)
    assert len(seen) == 3


def test_many_unknown_tokens_at_once_cost_one_reading(
    desk: Desk, monkeypatch: pytest.MonkeyPatch
) -> None:
    readings = []
    monkeypatch.setattr(desk.book, "read", lambda: readings.append(1))

    async def flood() -> list[Principal | Refusal]:
        identity = Identity(desk.book, desk.tickets)
        asking = (identity.who(Credentials(token=f"{i}"), changes=False) for i in range(200))
        found = await asyncio.gather(*asking)
        identity.close()
        return found

    assert {code(one) for one in asyncio.run(flood())} == {Code.NOT_SIGNED_IN}
    assert len(readings) == 1
