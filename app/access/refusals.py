"""Why somebody is not let in, or something about users and tokens is not done."""

from app.errors import Code, Refusal

NOT_SIGNED_IN = Refusal(
    Code.NOT_SIGNED_IN,
    "Sign in first; a script gives a token that still holds, as Authorization: Bearer …",
)
TWO_CREDENTIALS = Refusal(
    Code.TWO_CREDENTIALS,
    "This came with the session of a browser and with a token: give one of them",
)
CSRF = Refusal(
    Code.CSRF, "This came without the token of the page (X-CSRF-Token): load the page again"
)
SIGN_IN_FAILED = Refusal(Code.SIGN_IN_FAILED, "Name or password is wrong")
WRONG_PASSWORD = Refusal(Code.WRONG_PASSWORD, "The old password is wrong")
LAST_ADMIN = Refusal(
    Code.LAST_ADMIN, "Nobody else could keep the users: make somebody else admin first"
)
OWN_ACCOUNT = Refusal(
    Code.OWN_ACCOUNT, "Nobody takes their own rights away: ask another admin to do it"
)
DISABLED = Refusal(Code.NOT_ALLOWED, "This user is disabled: enable them first")
ONLY_SIGNED_IN = Refusal(
    Code.NOT_ALLOWED, "A token cannot do this: sign in, or take a token with the scope admin"
)


def unknown_user(who: int | str) -> Refusal:
    """There is no such user."""
    return Refusal(Code.UNKNOWN_USER, f"There is no user {who}")


def user_exists(name: str) -> Refusal:
    """The name is taken."""
    return Refusal(Code.USER_EXISTS, f"There is a user {name} already: take another name")


def unknown_token(token_id: int) -> Refusal:
    """There is no such token, or it is somebody else's."""
    return Refusal(Code.UNKNOWN_TOKEN, f"There is no token {token_id} that still holds")


def beyond_owner(name: str, role: str) -> Refusal:
    """A token that its owner's role does not bear."""
    detail = f"{name} is {role}, and a token may do no more than its owner: take another scope"
    return Refusal(Code.NOT_ALLOWED, detail)


def unknown_session(session_id: int) -> Refusal:
    """There is no such session, or it is somebody else's."""
    return Refusal(Code.UNKNOWN_SESSION, f"There is no session {session_id}")
