"""What must be had before the console can serve, and what is said where it cannot be had."""

import socket
import subprocess
import sys
from pathlib import Path

import pytest

from app.serving import CannotServe, bind, hold_data_folder, url_of


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
