"""Who may ask: this machine's own names, and pages of this console only."""

import pytest
from starlette.datastructures import Headers

from app.errors import Code
from app.security import refuse

HOSTS = frozenset({"localhost", "rig-3.lab"})


def asked(method: str = "POST", *, socket: bool = False, **headers: str) -> Code | None:
    named = {name.replace("_", "-"): value for name, value in headers.items()}
    refusal = refuse(method, Headers(named), HOSTS, socket=socket)
    return None if refusal is None else refusal.code


@pytest.mark.parametrize(
    "host", ["localhost:8000", "127.0.0.1:8000", "[::1]:8000", "RIG-3.lab", "192.168.1.7"]
)
def test_this_machine_is_known_by_its_names_and_addresses(host: str) -> None:
    assert asked("GET", host=host) is None


@pytest.mark.parametrize("host", ["evil.example:8000", "localhost.evil.example", "", "[::1"])
def test_another_name_is_refused_even_for_reading(host: str) -> None:
    assert asked("GET", host=host) is Code.UNKNOWN_HOST


@pytest.mark.parametrize(
    "origin",
    [
        "http://evil.example",
        "http://127.0.0.1:8000",
        "http://localhost:8001",
        "null",
        "http://localhost:8000.evil.example",
    ],
)
@pytest.mark.parametrize("socket", [True, False])
def test_a_foreign_origin_may_change_nothing_and_hear_nothing(origin: str, *, socket: bool) -> None:
    found = asked("GET" if socket else "POST", socket=socket, host="localhost:8000", origin=origin)
    assert found is Code.FOREIGN_ORIGIN


def test_the_consoles_own_page_may() -> None:
    assert asked(host="localhost:8000", origin="http://localhost:8000") is None
    assert asked("GET", socket=True, host="localhost:8000", origin="http://localhost:8000") is None


def test_what_is_no_browser_may() -> None:
    assert asked(host="localhost:8000") is None


@pytest.mark.parametrize("site", ["cross-site", "same-site"])
def test_a_browser_that_says_it_comes_from_elsewhere_is_believed(site: str) -> None:
    assert asked(host="localhost:8000", sec_fetch_site=site) is Code.FOREIGN_ORIGIN


def test_anybody_may_link_to_the_console() -> None:
    origin = "http://elsewhere.example"
    found = asked("GET", host="localhost:8000", sec_fetch_site="cross-site", origin=origin)
    assert found is None
