"""Where Stop has its own path, and what is done where it cannot have one."""

import logging
import socket
from collections.abc import Iterator

import pytest

from app.serving import CannotServe
from app.settings import Settings
from app.stopping.door import open_door, wanted_port


@pytest.fixture
def console() -> Iterator[socket.socket]:
    """Any socket that listens."""
    with socket.create_server(("127.0.0.1", 0)) as listener:
        yield listener


def port_of(listener: socket.socket) -> int:
    return int(listener.getsockname()[1])


def test_it_is_beside_the_consoles() -> None:
    assert wanted_port(Settings(port=8000)) == 8001
    assert wanted_port(Settings(port=0)) == 0
    assert wanted_port(Settings(port=8000, stop_port=9000)) == 9000


def test_any_free_port_will_do_where_the_console_has_any(console: socket.socket) -> None:
    with open_door(Settings(port=0), console) as door:
        assert door is not None
        assert door.url == f"http://127.0.0.1:{door.port}/stop"
        assert door.console_port == port_of(console)
        with socket.create_connection(("127.0.0.1", door.port)):
            pass


def test_what_else_keeps_the_console_from_serving_is_still_said(console: socket.socket) -> None:
    with pytest.raises(CannotServe, match="another"), open_door(Settings(port=0), console):
        raise CannotServe("another reason")


@pytest.mark.parametrize("settings", [{"stop_port": None}, {"port": 65535}])
def test_where_the_port_cannot_be_had_the_log_says_so_and_the_console_goes_on(
    console: socket.socket, caplog: pytest.LogCaptureFixture, settings: dict[str, int | None]
) -> None:
    with socket.create_server(("127.0.0.1", 0)) as taken:
        given = {"port": port_of(taken) - 1} | {k: v for k, v in settings.items() if v}
        with caplog.at_level(logging.WARNING):  # noqa: SIM117  # the door is what is tested
            with open_door(Settings(**given), console) as door:  # type: ignore[arg-type]
                assert door is None
    assert "Stop has no path of its own" in caplog.text
