"""Users: one admin always stays, nobody locks themselves out, a link lets in once."""

from typing import Any

import pytest
from pydantic import ValidationError

from app.access.credentials import Credentials, cookie_name, credentials_in
from app.access.principal import Principal, Role
from app.access.schemas import RoleWord, TokenCreate, TokenMade, UserChange, UserCreate, UserOut
from app.access.scopes import Scope, role_of, scope_of
from app.access.users import LINK_PATH
from app.errors import Code
from tests.unit.app.access.at_a_time import LONG, Desk, code

TAKEN = [UserChange(role=RoleWord.ENGINEER), UserChange(disabled=True)]


def test_the_first_admin_is_made_once_and_invited_until_they_have_a_password(desk: Desk) -> None:
    first, second = desk.users.first_link(), desk.users.first_link()
    assert first is not None
    assert second is not None
    assert [(user.name, user.role) for user in desk.users.all()] == [("admin", RoleWord.ADMIN)]
    keys = [made.path.removeprefix(LINK_PATH) for made in (first, second)]
    assert desk.sessions.by_link(keys[0]) is None  # only the newest is good
    assert desk.sessions.by_link(keys[1]) is not None
    desk.users.change(desk.row("admin").id, UserChange(password=LONG))
    assert desk.users.first_link() is None


def test_nobody_is_invited_while_another_admin_has_a_password(desk: Desk) -> None:
    desk.enter("admin", "admin")
    desk.enter("boss", "admin", LONG)
    assert desk.users.first_link() is None


def test_a_link_lets_in_once(desk: Desk) -> None:
    key = desk.link(desk.enter("kl").id)
    assert desk.sessions.by_link(key) is not None
    assert desk.sessions.by_link(key) is None
    assert desk.sessions.by_link("") is None


def test_a_link_is_good_for_a_day_and_until_a_password_is_set(desk: Desk) -> None:
    user = desk.enter("kl")
    late = desk.link(user.id)
    desk.wait(hours=24)
    assert desk.sessions.by_link(late) is None
    left = desk.link(user.id)
    desk.users.change(user.id, UserChange(password=LONG))
    assert desk.sessions.by_link(left) is None


@pytest.mark.parametrize("asked", TAKEN)
def test_the_last_admin_stays(desk: Desk, asked: UserChange) -> None:
    admin, kl = desk.enter("boss", "admin"), desk.enter("kl")
    assert code(desk.users.change(admin.id, asked, kl.id)) is Code.LAST_ADMIN
    assert code(desk.users.remove(admin.id)) is Code.LAST_ADMIN
    assert desk.users.get(admin.id) == admin
    other = desk.enter("other", "admin")
    desk.users.change(other.id, UserChange(disabled=True))
    assert code(desk.users.change(admin.id, asked)) is Code.LAST_ADMIN  # a disabled one is none
    desk.users.change(other.id, UserChange(disabled=False))
    assert isinstance(desk.users.change(admin.id, asked), UserOut)


@pytest.mark.parametrize("asked", TAKEN)
def test_nobody_takes_their_own_rights_away(desk: Desk, asked: UserChange) -> None:
    admin, other = desk.enter("boss", "admin"), desk.enter("other", "admin")
    assert code(desk.users.change(admin.id, asked, admin.id)) is Code.OWN_ACCOUNT
    assert code(desk.users.remove(admin.id, admin.id)) is Code.OWN_ACCOUNT
    assert isinstance(desk.users.change(admin.id, asked, other.id), UserOut)


def test_a_user_who_is_removed_takes_sessions_and_tokens_along(desk: Desk) -> None:
    user = desk.enter("kl")
    desk.sessions.begin(user.id)
    desk.tokens.make_for(user.id, TokenCreate(name="night", scope=Scope.READ))
    assert desk.users.remove(user.id) is None
    assert (desk.users.all(), desk.book.sessions(), desk.book.tokens()) == ([], [], [])
    assert code(desk.users.remove(user.id)) is Code.UNKNOWN_USER
    assert code(desk.users.change(user.id, UserChange(password=LONG))) is Code.UNKNOWN_USER
    assert code(desk.users.link(user.id)) is Code.UNKNOWN_USER


def test_a_name_is_taken_once(desk: Desk) -> None:
    desk.enter("kl")
    again = UserCreate(name="kl", role=RoleWord.ADMIN)
    assert code(desk.users.add(again)) is Code.USER_EXISTS
    assert [user.role for user in desk.users.all()] == [RoleWord.OPERATOR]


@pytest.mark.parametrize("name", ["", " kl", "a\0b", "a\nb", "../admin", "<b>", "x" * 51])
def test_what_cannot_be_a_name(name: str) -> None:
    with pytest.raises(ValidationError):
        UserCreate(name=name, role=RoleWord.VIEWER)


@pytest.mark.parametrize("name", ["kl", "Jörg Müller", "a.b@lab-3", "李"])
def test_what_can_be_a_name(name: str) -> None:
    assert UserCreate(name=name, role=RoleWord.VIEWER).name == name


def test_a_weak_password_changes_nothing(desk: Desk) -> None:
    user = desk.enter("kl")
    asked = UserChange(role=RoleWord.ADMIN, password="short")
    assert code(desk.users.change(user.id, asked)) is Code.WEAK_PASSWORD
    weak = UserCreate(name="other", role=RoleWord.VIEWER, password="short")
    assert code(desk.users.add(weak)) is Code.WEAK_PASSWORD
    assert desk.users.all() == [user]


def test_tokens_and_sessions_of_others_are_an_admins_alone(desk: Desk) -> None:
    desk.enter("boss", "admin")
    one, other = desk.enter("one"), desk.enter("other")
    people = {
        name: Principal(f"session:{i}", name, Role.of(role), "session", desk.row(name).id)
        for i, (name, role) in enumerate({"boss": "admin", "one": "operator"}.items(), 90)
    }
    desk.sessions.begin(one.id)
    desk.sessions.begin(other.id)
    made = desk.tokens.make_for(other.id, TokenCreate(name="night", scope=Scope.READ))
    assert isinstance(made, TokenMade)
    (foreign,) = (s.id for s in desk.sessions.of(people["boss"]) if s.user == "other")
    assert [s.user for s in desk.sessions.of(people["one"])] == ["one"]
    assert desk.tokens.of(people["one"]) == []
    assert len(desk.tokens.of(people["boss"])) == 1
    assert code(desk.tokens.revoke(made.id, people["one"])) is Code.UNKNOWN_TOKEN
    assert code(desk.sessions.end(foreign, people["one"])) is Code.UNKNOWN_SESSION
    assert desk.tokens.revoke(made.id, people["boss"]) is None
    assert desk.sessions.end(foreign, people["boss"]) is None


def test_a_token_is_made_up_to_ones_own_role_and_not_by_a_token(desk: Desk) -> None:
    user = desk.enter("kl", "engineer")
    seated = Principal("session:1", "kl", Role.ENGINEER, "session", user.id)
    program = Principal("token:1", "kl (night)", Role.ENGINEER, "token", user.id)
    wanted = TokenCreate(name="night", scope=Scope.ENGINEER)
    assert isinstance(desk.tokens.make(seated, wanted), TokenMade)
    assert code(desk.tokens.make(program, wanted)) is Code.NOT_ALLOWED
    more = wanted.model_copy(update={"scope": Scope.ADMIN})
    assert code(desk.tokens.make(seated, more)) is Code.NOT_ALLOWED


def test_scopes_and_roles_are_the_same_ladder() -> None:
    assert [role_of(scope) for scope in Scope] == list(Role)
    assert [scope_of(role) for role in Role] == list(Scope)


COOKIE = cookie_name(8000, secure=False)


@pytest.mark.parametrize(
    ("headers", "cookies", "query", "expected"),
    [
        ({}, {}, b"", Credentials()),
        ({}, {COOKIE: "s"}, b"", Credentials(session="s")),
        ({"x-csrf-token": "c"}, {COOKIE: "s"}, b"", Credentials(session="s", csrf="c")),
        ({}, {cookie_name(8001, secure=False): "s"}, b"", Credentials()),
        ({}, {cookie_name(8000, secure=True): "s"}, b"", Credentials()),
        ({"authorization": "Bearer t"}, {}, b"", Credentials(token="t")),
        ({"authorization": "bearer t"}, {}, b"", Credentials(token="t")),
        ({"authorization": "Basic dDp0"}, {}, b"", Code.NOT_SIGNED_IN),
        ({"authorization": "Bearer t"}, {COOKIE: "s"}, b"", Code.TWO_CREDENTIALS),
        ({"authorization": "Basic x"}, {COOKIE: ""}, b"", Code.TWO_CREDENTIALS),
        ({"authorization": "Bearer t"}, {}, b"ticket=x", Code.TWO_CREDENTIALS),
        ({}, {COOKIE: "s"}, b"a=1&ticket=x", Credentials(session="s", ticket="x")),
        ({}, {}, b"ticket=%ff&\xff", Credentials(ticket="�")),
    ],
)
def test_what_a_request_brings(
    headers: Any, cookies: Any, query: bytes, expected: Credentials | Code
) -> None:
    found = credentials_in(headers, cookies, query, COOKIE)
    assert (code(found) or found) == expected


def test_a_token_that_leaked_ends_itself_and_nothing_else_of_its_owners(desk: Desk) -> None:
    user = desk.enter("kl", "engineer")
    desk.sessions.begin(user.id)
    (session,) = desk.book.sessions()
    leaked, other = (
        desk.tokens.make_for(user.id, TokenCreate(name=name, scope=Scope.READ))
        for name in ("leaked", "other")
    )
    assert isinstance(leaked, TokenMade)
    assert isinstance(other, TokenMade)
    thief = Principal(f"token:{leaked.id}", "kl (leaked)", Role.VIEWER, "token", user.id)
    assert code(desk.sessions.end(session.id, thief)) is Code.NOT_ALLOWED
    assert code(desk.tokens.revoke(other.id, thief)) is Code.NOT_ALLOWED
    assert [one.id for one in desk.book.sessions()] == [session.id]
    assert [one.revoked_at for one in desk.book.tokens()] == [None, None]
    assert desk.tokens.revoke(leaked.id, thief) is None
