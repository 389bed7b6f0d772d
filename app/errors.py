"""Refusals: values that say why something was not done, in a sentence an operator can act on.

They know no HTTP; `app.problems` maps each code to a status.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import StrEnum


class Code(StrEnum):
    """Every reason to refuse. Programs match on these; sentences may change."""

    INVALID_REQUEST = "invalid_request"
    NOT_FOUND = "not_found"
    METHOD_NOT_ALLOWED = "method_not_allowed"
    NOT_SIGNED_IN = "not_signed_in"
    NOT_ALLOWED = "not_allowed"
    TWO_CREDENTIALS = "two_credentials"
    CSRF = "csrf"
    SIGN_IN_FAILED = "sign_in_failed"
    WRONG_PASSWORD = "wrong_password"
    WEAK_PASSWORD = "weak_password"
    TOO_MANY_ATTEMPTS = "too_many_attempts"
    TOO_MANY_REQUESTS = "too_many_requests"
    UNKNOWN_USER = "unknown_user"
    USER_EXISTS = "user_exists"
    LAST_ADMIN = "last_admin"
    OWN_ACCOUNT = "own_account"
    UNKNOWN_TOKEN = "unknown_token"
    UNKNOWN_SESSION = "unknown_session"
    FOREIGN_ORIGIN = "foreign_origin"
    UNKNOWN_HOST = "unknown_host"
    TOO_LARGE = "too_large"
    UNKNOWN_TEST = "unknown_test"
    UNKNOWN_REVISION = "unknown_revision"
    TEST_EXISTS = "test_exists"
    TEST_ARCHIVED = "test_archived"
    REVISION_NEEDED = "revision_needed"
    EDIT_CONFLICT = "edit_conflict"
    INVALID_HISTORY = "invalid_history"
    HISTORY_EXISTS = "history_exists"
    UNKNOWN_RUN = "unknown_run"
    UNKNOWN_FIRST_OUT = "unknown_first_out"
    UNKNOWN_DRILL = "unknown_drill"
    UNKNOWN_CHANNEL = "unknown_channel"
    INVALID_TEST = "invalid_test"
    RUN_UNDER_WAY = "run_under_way"
    NO_DATA = "no_data"
    INVALID_REPORT = "invalid_report"
    LOOP_LOST = "loop_lost"
    LOOP_SILENT = "loop_silent"
    WRONG_MODE = "wrong_mode"
    LEASE_NEEDED = "lease_needed"
    LEASE_HELD = "lease_held"
    STALE_LEASE = "stale_lease"
    EXPIRED = "expired"
    REPLAYED = "replayed"
    UNKNOWN_COMMAND = "unknown_command"
    CAUSE_PRESENT = "cause_present"
    INVALID_BANK = "invalid_bank"
    INTERLOCKS_WEAKENED = "interlocks_weakened"
    NO_PROGRAM = "no_program"
    BUSY = "busy"
    BROKE_OFF = "broke_off"
    NO_SPACE = "no_space"
    PREDICTION_REFUSED = "prediction_refused"
    PREDICTION_PENDING = "prediction_pending"
    OVERRIDE_NEEDED = "override_needed"
    DATABASE_UNAVAILABLE = "database_unavailable"
    INTERNAL = "internal"


@dataclass(frozen=True)
class Fault:
    """One thing that is wrong in what was sent: where, what it was, what would be right."""

    path: str
    value: object
    expected: str


@dataclass(frozen=True)
class Refusal:
    """Why something was not done. Returned, never raised, by services.

    `about` holds what a program needs besides the sentence (`current_revision` …), as JSON.
    """

    code: Code
    detail: str
    faults: tuple[Fault, ...] = field(default=())
    about: Mapping[str, object] = field(default_factory=dict)
