"""What of access is in the audit: every change with who made it, and no secret."""

import asyncio
import json
from typing import Any

from app.access.attempts import Attempts
from app.access.principal import Principal, Role
from app.access.schemas import (
    PasswordChange,
    RoleWord,
    SignIn,
    TokenCreate,
    TokenMade,
    UserChange,
)
from app.access.scopes import Scope
from app.access.signing_in import SigningIn
from app.audit.actor import Actor, acting
from app.audit.entry import Act
from app.audit.models import AuditRow
from app.audit.record import take_notes
from tests.unit.app.access.at_a_time import LONG, Desk

BOSS = Actor("boss", "admin", "session:7")
OTHER = "another long one"


def entered(desk: Desk) -> list[Any]:
    """The rows of the audit, oldest first."""
    with desk.database.reading() as session:
        return list(session.query(AuditRow).order_by(AuditRow.id).all())


def told(desk: Desk) -> list[tuple[str, str, str]]:
    return [(row.who, row.action, row.target) for row in entered(desk)]


def test_every_change_is_entered_with_who_made_it(desk: Desk) -> None:
    with acting(BOSS):
        user = desk.enter("kl")
        desk.users.change(user.id, UserChange(role=RoleWord.ENGINEER, password=LONG))
        made = desk.tokens.make_for(user.id, TokenCreate(name="night", scope=Scope.READ))
        assert isinstance(made, TokenMade)
        desk.tokens.revoke(made.id)
        desk.link(user.id)
        desk.users.remove(user.id)
    actions = ["users.add", "users.change", "tokens.make", "tokens.revoke", "users.link"]
    rows = entered(desk)
    assert [row.action for row in rows] == [*actions, "users.remove"]
    assert {(row.who, row.role, row.credential) for row in rows} == {("boss", "admin", "session:7")}
    before, after = (json.loads(text) for text in (rows[1].before, rows[1].after))
    assert (before["role"], after["role"]) == ("operator", "engineer")
    assert (before["has_password"], after["password_changed"]) == (False, True)
    assert not any(secret in str(vars(row)) for row in rows for secret in (LONG, made.token))


def test_what_is_refused_is_not_entered_as_done(desk: Desk) -> None:
    user = desk.enter("kl", "admin")
    before = told(desk)
    desk.users.change(user.id, UserChange(role=RoleWord.VIEWER))
    desk.users.remove(user.id)
    desk.tokens.revoke(1)
    assert told(desk) == before


def test_signing_in_and_out_is_entered_and_a_refused_one_noted(desk: Desk) -> None:
    desk.enter("kl", password=LONG)
    noted: list[Act] = []
    take_notes(noted.append)
    signing_in = SigningIn(desk.book, desk.sessions, desk.passwords, Attempts())

    async def a_day() -> None:
        await signing_in.sign_in(SignIn(name="kl", password="wrong"), "10.0.0.1")
        await signing_in.sign_in(SignIn(name=LONG, password="kl"), "10.0.0.1")
        await signing_in.sign_in(SignIn(name="kl", password=LONG), "10.0.0.1")
        (session,) = desk.book.sessions()
        who = Principal(f"session:{session.id}", "kl", Role.OPERATOR, "session", session.user_id)
        change = PasswordChange(old=LONG, new=OTHER)
        assert await signing_in.set_password(who, change, "10.0.0.1") is None
        assert await signing_in.sign_out(who) is None

    try:
        asyncio.run(a_day())
    finally:
        take_notes(None)
    assert [row.action for row in entered(desk)][1:] == [
        "sessions.begin",
        "users.change",
        "sessions.end",
    ]
    begun = entered(desk)[1]
    assert (begun.who, begun.role) == ("kl", "operator")
    assert [(one.target, one.outcome) for one in noted] == [
        ("kl", "refused: sign_in_failed"),
        ("nobody known", "refused: sign_in_failed"),
    ]
    assert LONG not in str(noted)
