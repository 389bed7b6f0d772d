"""Every operation with every role; and every path parameter with what leads elsewhere."""

import http.client
from collections.abc import Iterator
from typing import Any, NamedTuple
from urllib.parse import urlsplit

import httpx2
import pytest

from app.access.principal import Role
from tests.console_process import ConsoleProcess

pytestmark = [pytest.mark.process, pytest.mark.slow]

# The table of the roles: to read takes a viewer, to change something an operator, but for these.
OPEN = {"signIn", "getHealth"}
VIEWER = {  # what computes and changes nothing, what stops the rig, and what is one's own
    *("checkTest", "previewTest", "readSpectrum", "predictText", "predictTest"),
    *("commandRig", "signOut", "setPassword", "getTicket"),
    *("makeToken", "revokeToken", "endSession"),
    *("checkInterlocks", "replayFirstOut", "rerunFirstOut", "pointScene"),
    *("exportRun", "removeExport"),
    *("checkController", "previewController", "giveUpControllerPreview"),
}
ENGINEER = {
    *("changeController", "restoreControllerRevision"),
    *("changeRigConfiguration", "restoreRigConfigurationRevision"),
    *("changeInterlocks", "removeFirstOut", "changeRetention", "listAudit", "verifyAudit"),
    *("giveDrill", "clearDrills"),
    *("startIdentification", "cancelIdentification", "removeIdentification"),
    "adoptIdentification",
}
ADMIN = {"listUsers", "addUser", "changeUser", "removeUser", "linkUser"}


class Operation(NamedTuple):
    """One of the OpenAPI document, and a path of it that leads to nothing."""

    id: str
    method: str
    path: str
    names: tuple[str, ...]

    def at(self, **values: str) -> str:
        """Its path with these values, and harmless ones where none is given."""
        parameters = {name: values.get(name, "999999") for name in self.names}
        return self.path.format(**parameters)

    @property
    def needs(self) -> Role:
        """The role that the table says."""
        for role, those in ((Role.VIEWER, VIEWER), (Role.ENGINEER, ENGINEER), (Role.ADMIN, ADMIN)):
            if self.id in those:
                return role
        return Role.VIEWER if self.method == "GET" else Role.OPERATOR


@pytest.fixture(scope="module")
def operations(console: ConsoleProcess) -> list[Operation]:
    document = console.http.get(f"{console.url}/openapi.json").json()
    return [
        Operation(operation["operationId"], method.upper(), path, tuple(_names(operation)))
        for path, methods in document["paths"].items()
        for method, operation in methods.items()
        if operation["operationId"] not in OPEN
    ]


def _names(operation: dict[str, Any]) -> Iterator[str]:
    for parameter in operation.get("parameters", []):
        if parameter["in"] == "path":
            yield parameter["name"]


def ask(client: httpx2.Client, console: ConsoleProcess, operation: Operation) -> dict[str, Any]:
    """Ask with nothing in it, so that nothing is changed; what the problem says, `{}` for none."""
    body: dict[str, Any] | None = None if operation.method == "GET" else {}
    answer = client.request(operation.method, console.url + operation.at(), json=body)
    assert answer.status_code < 500, f"{operation.id}: {answer.text}"
    problem = answer.headers.get("content-type") == "application/problem+json"
    found: dict[str, Any] = answer.json() if problem else {}
    return found


def test_the_table_of_roles_names_operations_that_there_are(operations: list[Operation]) -> None:
    assert {operation.id for operation in operations} >= VIEWER | ENGINEER | ADMIN


def test_nobody_may_do_anything_without_signing_in(
    console: ConsoleProcess, operations: list[Operation]
) -> None:
    with console.client() as stranger:
        let_in = [
            operation.id
            for operation in operations
            if ask(stranger, console, operation).get("code") != "not_signed_in"
        ]
    assert let_in == []


@pytest.mark.parametrize("role", list(Role))
def test_each_role_may_do_what_the_table_says(
    console: ConsoleProcess, operations: list[Operation], role: Role
) -> None:
    with console.as_role(role) as client:
        found = {one.id: ask(client, console, one).get("role_needed") for one in operations}
    expected = {one.id: one.needs.word if role < one.needs else None for one in operations}
    assert found == expected


ELSEWHERE = [
    *("..", "../..", "..%2f..%2f..%2fetc%2fpasswd", "%2e%2e%2f%2e%2e%2fetc%2fpasswd"),
    *("..%5c..%5cetc%5cpasswd", "%2fetc%2fpasswd", "....//etc/passwd", "%252e%252e%252fetc"),
    *("file:%2f%2f%2fetc%2fpasswd", "~root", ".", "%0a", "a%00b"),
]


def _raw(console: ConsoleProcess, method: str, path: str) -> tuple[int, bytes]:
    """What is answered to a path as it stands: a client would clear it up."""
    address = urlsplit(console.url)
    assert address.hostname
    connection = http.client.HTTPConnection(address.hostname, address.port, timeout=30)
    try:
        connection.putrequest(method, path)
        for name, value in console.headers.items():
            connection.putheader(name, value)
        connection.putheader("Content-Length", "0")
        connection.endheaders()
        answer = connection.getresponse()
        return answer.status, answer.read()
    finally:
        connection.close()


def test_no_path_parameter_leads_elsewhere(
    console: ConsoleProcess, operations: list[Operation]
) -> None:
    for operation in operations:
        for name in operation.names:
            for value in ELSEWHERE:
                status, body = _raw(console, operation.method, operation.at(**{name: value}))
                asked = f"{operation.method} {operation.at(**{name: value})}"
                assert 300 <= status < 500, f"{asked}: {status}"
                assert b"root:" not in body, asked


@pytest.mark.parametrize("folder", ["/", "/assets/", "/api/v1/../../", "//", "/docs/../"])
def test_no_file_outside_the_console_is_served_to_whoever_is_in(
    console: ConsoleProcess, folder: str
) -> None:
    for value in ELSEWHERE:
        _, body = _raw(console, "GET", folder + value)
        assert b"root:" not in body
        assert b"BaseSettings" not in body
