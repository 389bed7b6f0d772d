"""Every operation of the interface, asked anything by everybody while a test runs."""

from collections.abc import Iterator
from typing import Any

import pytest
import requests
import schemathesis
from schemathesis import Case, GenerationMode

from app.access.principal import Role
from tests.api.test_schema import CHECKS, DOCUMENT, PATIENCE_S
from tests.fuzz.under_way import UnderWay

pytestmark = [pytest.mark.process, pytest.mark.slow]
EXAMPLES = 4  # of each operation, each asked by everybody; tests/api/test_schema.py asks more

interface = schemathesis.openapi.from_path(str(DOCUMENT))
interface.config.generation.update(
    modes=list(GenerationMode), deterministic=True, max_examples=EXAMPLES, database="none"
)
interface.config.phases.update(phases=["fuzzing"])
AnyCase = Case[Any]

LOOKING = [None, Role.VIEWER]  # they may change nothing; None is nobody
CHANGING = [Role.OPERATOR, Role.ENGINEER, Role.ADMIN]
# What anybody may who sees the rig, and what would end the run by right.
ENDS_THE_RUN = ("stop", "shutdown")
# What ends, by right, somebody's being here: whoever is in command, and those who ask.
OF_SOMEBODY = {"user_id", "token_id"}
FEW = 20  # users and tokens that these tests have


@pytest.fixture(scope="module")
def session() -> Iterator[requests.Session]:
    with requests.Session() as made:
        yield made


def ends_by_right(case: AnyCase) -> bool:
    """Whether it is what the run, or who asks, does not outlive, and somebody has the right to."""
    body = case.body if isinstance(case.body, dict) else {}
    if body.get("command") in ENDS_THE_RUN:
        return True
    if body.get("take_over"):  # by an engineer: of the lease, and of the run with it
        return True
    ours = [value for name, value in case.path_parameters.items() if name in OF_SOMEBODY]
    return case.method != "GET" and any(
        str(value).isdecimal() and int(value) < FEW for value in ours
    )


def known(under_way: UnderWay, case: AnyCase) -> dict[str, Any]:
    """What there is of what its path names."""
    there = {"test_id": under_way.test_id, "run_id": under_way.run_id, "index": 0, "number": 1}
    return {name: there.get(name, value) for name, value in case.path_parameters.items()}


def ask(
    under_way: UnderWay, session: requests.Session, case: AnyCase, role: Role | None
) -> set[int]:
    """Ask with the path as it came, and with one that leads somewhere; what is answered."""
    statuses = set()
    for parameters in (case.path_parameters, known(under_way, case)):
        case.path_parameters = parameters
        answer = case.call_and_validate(
            base_url=under_way.console.url,
            session=session,
            headers=under_way.headers(role),
            checks=CHECKS,
            timeout=PATIENCE_S,
        )
        under_way.asked[role, answer.status_code] += 1
        statuses.add(answer.status_code)
    return statuses


@interface.parametrize()
def test_who_may_only_look_changes_nothing(
    case: AnyCase, under_way: UnderWay, session: requests.Session
) -> None:
    if ends_by_right(case):
        return
    state, entered = under_way.state(), under_way.entered()
    for role in LOOKING:
        statuses = ask(under_way, session, case, role)
        if role is None and case.operation.path not in ("/healthz", "/api/v1/auth/login"):
            assert statuses <= {401, 405}
    assert under_way.state() == state
    assert under_way.entered() == entered


@interface.parametrize()
def test_who_may_change_something_ends_nothing(
    case: AnyCase, under_way: UnderWay, session: requests.Session
) -> None:
    if ends_by_right(case):
        return
    for role in CHANGING:
        ask(under_way, session, case, role)
