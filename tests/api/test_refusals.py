"""What is refused, and that every refusal says why in one form."""

import socket
from urllib.parse import urlsplit

import httpx2
import pytest

from app.errors import Code
from app.problems import STATUS
from tests.console_process import ConsoleProcess

pytestmark = [pytest.mark.process, pytest.mark.slow]


def test_every_code_has_a_status() -> None:
    assert set(STATUS) == set(Code)


@pytest.mark.parametrize(
    ("path", "status", "code"),
    [
        ("/tests/nowhere", 404, "unknown_test"),
        ("/runs/999999", 404, "unknown_run"),
        ("/runs/999999/events", 404, "unknown_run"),
        ("/runs/999999/samples?channels=force_n", 404, "unknown_run"),
        ("/runs/999999/data.parquet", 404, "unknown_run"),
        ("/runs/1/samples?channels=force", 422, "unknown_channel"),
        ("/runs/1/samples?channels=force_n&points=0", 422, "invalid_request"),
        ("/runs/1/samples?channels=force_n&points=1000000", 422, "invalid_request"),
        ("/runs/1/samples?channels=force_n&from_s=nan", 422, "invalid_request"),
        ("/runs/1/samples", 422, "invalid_request"),
        ("/runs/0", 422, "invalid_request"),
        ("/runs/99999999999999999999", 422, "invalid_request"),
        ("/runs?limit=100000", 422, "invalid_request"),
        ("/nowhere", 404, "not_found"),
    ],
)
def test_a_refused_reading(console: ConsoleProcess, path: str, status: int, code: str) -> None:
    answer = console.http.get(path)
    assert answer.headers["content-type"] == "application/problem+json"
    body = answer.json()
    assert (answer.status_code, body["status"], body["code"]) == (status, status, code)
    assert body["detail"]


@pytest.mark.parametrize(
    ("path", "body", "where"),
    [
        ("/rig/commands", {"command": "explode"}, "body.command"),
        ("/rig/commands", {}, "body.command"),
        ("/rig/commands", {"command": "stop", "hard": True}, "body.hard"),
        ("/runs", {"test_id": 3}, "body.test_id"),
        ("/runs", {"test_id": ""}, "body.test_id"),
        ("/runs", [], "body"),
    ],
)
def test_a_refused_request_names_the_place_the_value_and_what_would_be_right(
    console: ConsoleProcess, path: str, body: object, where: str
) -> None:
    answer = console.http.post(path, json=body)
    assert answer.status_code == 422
    (fault,) = answer.json()["errors"]
    assert fault["path"] == where
    assert fault["expected"]
    assert where in answer.json()["detail"]


def test_an_unknown_test_is_not_run(ready: ConsoleProcess) -> None:
    answer = ready.http.post("/runs", json={"test_id": "../../etc/passwd"})
    assert (answer.status_code, answer.json()["code"]) == (404, "unknown_test")


def test_a_wrong_method_says_which_is_right(console: ConsoleProcess) -> None:
    answer = console.http.delete("/rig")
    assert (answer.status_code, answer.json()["code"]) == (405, "method_not_allowed")
    assert answer.headers["allow"] == "GET"


@pytest.mark.parametrize("command", ["stop", "reset"])
def test_a_page_of_another_site_may_not_command(console: ConsoleProcess, command: str) -> None:
    headers = {"Origin": "http://evil.example"}
    answer = console.http.post("/rig/commands", json={"command": command}, headers=headers)
    assert (answer.status_code, answer.json()["code"]) == (403, "foreign_origin")


def test_a_name_that_was_rebound_is_refused(console: ConsoleProcess) -> None:
    answer = console.http.get("/rig", headers={"Host": "evil.example"})
    assert (answer.status_code, answer.json()["code"]) == (403, "unknown_host")


def test_answers_bear_security_headers(console: ConsoleProcess) -> None:
    for path in ("/api/v1/rig", "/", "/docs", "/api/v1/nowhere"):
        headers = httpx2.get(console.url + path).headers
        assert "frame-ancestors 'none'" in headers["content-security-policy"]
        assert "unsafe-eval" not in headers["content-security-policy"]
        assert headers["x-content-type-options"] == "nosniff"


@pytest.mark.parametrize(
    "path", ["/../../../etc/passwd", "/..%2f..%2f..%2fetc%2fpasswd", "/assets/../../settings.py"]
)
def test_no_file_outside_the_console_is_served(console: ConsoleProcess, path: str) -> None:
    address = urlsplit(console.url)
    with socket.create_connection((address.hostname, address.port), timeout=10) as raw:
        raw.sendall(f"GET {path} HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n".encode())
        answer = b"".join(iter(lambda: raw.recv(65536), b""))
    assert b"root:" not in answer
    assert b"BaseSettings" not in answer


def test_an_endless_request_head_is_cut_off(console: ConsoleProcess) -> None:
    address = urlsplit(console.url)
    with socket.create_connection((address.hostname, address.port), timeout=10) as raw:
        raw.sendall(b"GET / HTTP/1.1\r\nX: ")
        try:
            for _ in range(100):
                raw.sendall(b"x" * 65536)
            answer = raw.recv(100)
        except (BrokenPipeError, ConnectionResetError):
            answer = b""
    assert answer == b"" or b" 4" in answer[:20]


def test_health_and_documents(console: ConsoleProcess) -> None:
    assert httpx2.get(f"{console.url}/healthz").json()["ok"] is True
    assert "commandRig" not in httpx2.get(f"{console.url}/docs").text
    assert "/api/v1/rig/commands" in httpx2.get(f"{console.url}/docs").text
    document = httpx2.get(f"{console.url}/openapi.json").json()
    operations = [o for path in document["paths"].values() for o in path.values()]
    identities = [operation["operationId"] for operation in operations]
    assert len(set(identities)) == len(identities)
    assert all("_" not in identity for identity in identities)
