"""What the audit is told of access."""

from app.access.models import ApiToken, SignedIn, User
from app.audit.entry import Entry

NOBODY = "nobody known"  # a name that is no user's may be a password in the wrong field


def state_of(user: User) -> dict[str, object]:
    """What a change may change of a user."""
    has_password = user.password_hash is not None
    return {"role": user.role, "disabled": user.disabled, "has_password": has_password}


def added(user: User) -> Entry:
    """A new user."""
    return Entry("users.add", user.name, after=state_of(user))


def changed(user: User, before: dict[str, object], *, new_password: bool) -> Entry:
    """A user who is another now; a password may be another without a trace in their state."""
    after = state_of(user) | ({"password_changed": True} if new_password else {})
    return Entry("users.change", user.name, before=before, after=after)


def removed(user: User) -> Entry:
    """A user who is gone."""
    return Entry("users.remove", user.name, before=state_of(user))


def linked(user: User) -> Entry:
    """A link that signs a user in."""
    return Entry("users.link", user.name)


def token_made(token: ApiToken, owner: str) -> Entry:
    """A new token."""
    about = {"token_id": token.id, "scope": token.scope, "expires_at": token.expires_at}
    return Entry("tokens.make", f"{token.name} of {owner}", after=about)


def token_revoked(token: ApiToken) -> Entry:
    """A token that is none any more."""
    return Entry(
        "tokens.revoke", f"{token.name} of {token.user.name}", before={"token_id": token.id}
    )


def session_begun(user: User, how: str) -> Entry:
    """Somebody has signed in: by password, or by a link."""
    return Entry("sessions.begin", user.name, after={"by": how})


def session_ended(session: SignedIn) -> Entry:
    """Somebody has signed out, or was sent away."""
    return Entry("sessions.end", session.user.name, before={"session_id": session.id})


def sign_in_refused(user: User | None, address: str) -> Entry:
    """A wrong name or password."""
    name = NOBODY if user is None else user.name
    return Entry("sessions.begin", name, after={"from": address}, refused="sign_in_failed")
