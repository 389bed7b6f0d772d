"""HTTPS, and what is not served in clear to other machines."""

import re
import ssl
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import httpx2
import pytest

from tests.console_process import ConsoleProcess

pytestmark = [pytest.mark.process, pytest.mark.slow]
_NAMES = "subjectAltName=IP:127.0.0.1,DNS:localhost"


@pytest.fixture(scope="module")
def certificate(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, Path]:
    """A certificate that this machine gave itself, and its key."""
    folder = tmp_path_factory.mktemp("tls")
    made, key = folder / "certificate.pem", folder / "key.pem"
    asked = ["openssl", "req", "-x509", "-newkey", "rsa:2048", "-nodes", "-days", "2"]
    asked += ["-subj", "/CN=localhost", "-addext", _NAMES, "-out", str(made), "-keyout", str(key)]
    try:
        subprocess.run(asked, check=True, capture_output=True)
    except FileNotFoundError:
        pytest.skip("there is no openssl here to make a certificate with")
    return made, key


@pytest.fixture
def secure(tmp_path: Path, certificate: tuple[Path, Path]) -> Iterator[ConsoleProcess]:
    process = ConsoleProcess(tmp_path, certificate=certificate)
    try:
        yield process.start()
    finally:
        process.clean_up()


def test_under_tls_the_cookie_goes_nowhere_else(
    secure: ConsoleProcess, certificate: tuple[Path, Path]
) -> None:
    assert re.fullmatch(r"https://127\.0\.0\.1:\d+", secure.url)
    trusted = ssl.create_default_context(cafile=str(certificate[0]))
    with httpx2.Client(base_url=secure.url, verify=trusted) as browser:
        answer = browser.get(secure.new_link())
        assert answer.status_code == 303
        said = answer.headers["set-cookie"]
        assert said.startswith("__Host-forcerig-")
        assert {"Secure", "HttpOnly", "Path=/"} <= {part.strip() for part in said.split(";")}
        assert "max-age=" in answer.headers["strict-transport-security"]
        me = browser.get("/api/v1/auth/me").json()
        origin = {"Origin": secure.url, "X-CSRF-Token": me["csrf_token"]}
        stop = browser.post("/api/v1/rig/commands", json={"command": "stop"}, headers=origin)
        assert stop.is_success, stop.text


def serve(folder: Path, *options: str) -> tuple[int, str]:
    """What `forcerig serve` ends with, and what it says."""
    command = [sys.executable, "-c", "from app.cli import main; main()", "serve"]
    done = subprocess.run(
        [*command, "--port", "0", "--data", str(folder / "data"), *options],
        capture_output=True,
        text=True,
        timeout=60,
        check=False,
    )
    return done.returncode, done.stderr


@pytest.mark.parametrize(
    ("options", "what_to_do"),
    [
        (("--host", "0.0.0.0"), "--tls-cert and --tls-key, or say --plain-http"),
        (("--host", "::"), "--tls-cert and --tls-key, or say --plain-http"),
        (("--tls-cert", "nowhere.pem"), "needs both"),
        (("--tls-cert", "nowhere.pem", "--tls-key", "nowhere.pem"), "cannot read nowhere.pem"),
    ],
)
def test_what_would_be_served_in_clear_is_refused_in_one_line(
    tmp_path: Path, options: tuple[str, ...], what_to_do: str
) -> None:
    status, said = serve(tmp_path, *options)
    assert status == 2
    assert what_to_do in said
    assert said.count("\n") == 1
    assert not (tmp_path / "data").exists()


def test_stop_on_its_own_path_is_under_tls_too(secure: ConsoleProcess) -> None:
    url = secure.status()["stop_url"]
    assert url.startswith("https://")
    assert secure.http.post(url).json()["mode"] == "tripped"
    policy = secure.http.get(f"{secure.url}/healthz").headers["content-security-policy"]
    assert f"connect-src 'self' {url.removesuffix('/stop')};" in policy
