"""What must be had before the console can serve, and what is said where it cannot be had."""

import socket
import subprocess
import sys
from pathlib import Path

import pytest

from app.serving import CannotServe, bind, check_exposure, hold_data_folder, url_of
from app.settings import Settings


def test_any_free_port_and_its_address() -> None:
    with bind("127.0.0.1", 0) as listener:
        port = listener.getsockname()[1]
        assert url_of(listener) == f"http://127.0.0.1:{port}/"
        with socket.create_connection(("127.0.0.1", port), timeout=5):
            pass


def test_a_taken_port_is_told_with_what_to_do() -> None:
    with bind("127.0.0.1", 0) as listener:
        port = listener.getsockname()[1]
        with pytest.raises(CannotServe) as refused, bind("127.0.0.1", port):
            pass
    assert str(refused.value).startswith(f"port {port} is taken: give another with --port")
    assert "\n" not in str(refused.value)


def test_an_unknown_host_is_told() -> None:
    with pytest.raises(CannotServe, match="--host"), bind("nowhere.invalid", 0):
        pass


def test_a_data_directory_serves_one_console(tmp_path: Path) -> None:
    folder = tmp_path / "new" / "data"
    with (
        hold_data_folder(folder),
        pytest.raises(CannotServe, match="another console"),
        hold_data_folder(folder),
    ):
        pass
    with hold_data_folder(folder):
        pass


def test_a_data_directory_that_cannot_be_made_is_told(tmp_path: Path) -> None:
    (tmp_path / "file").touch()
    with pytest.raises(CannotServe, match="cannot use"), hold_data_folder(tmp_path / "file" / "x"):
        pass


def test_the_console_goes_before_other_work_where_it_may() -> None:
    """In a process of its own: what is taken here cannot be given back by everybody."""
    script = (
        "import os; from app.serving import go_before_other_work; before = os.nice(0);"
        "go_before_other_work(); print(before, os.nice(0), os.geteuid())"
    )
    said = subprocess.run(
        [sys.executable, "-c", script], capture_output=True, text=True, check=True
    )
    before, after, user = (int(word) for word in said.stdout.split())
    assert after == (-10 if user == 0 else before)


@pytest.mark.parametrize("host", ["127.0.0.1", "127.0.0.5", "::1", "localhost"])
def test_this_machine_alone_is_served_in_clear(host: str) -> None:
    check_exposure(Settings(host=host))


@pytest.mark.parametrize("host", ["0.0.0.0", "::", "192.0.2.1"])
def test_other_machines_are_served_in_clear_only_by_the_explicit_word(host: str) -> None:
    with pytest.raises(CannotServe, match="--plain-http") as refused:
        check_exposure(Settings(host=host))
    assert "\n" not in str(refused.value)
    check_exposure(Settings(host=host, plain_http=True))


def test_what_is_no_certificate_is_told(tmp_path: Path) -> None:
    file = tmp_path / "certificate.pem"
    file.write_text("nothing of the kind")
    with pytest.raises(CannotServe, match="no certificate"):
        check_exposure(Settings(tls_cert=file, tls_key=file))
    with pytest.raises(CannotServe, match="needs both"):
        check_exposure(Settings(tls_key=file, plain_http=True))
