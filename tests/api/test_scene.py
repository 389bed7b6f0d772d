"""The 3-D view behind the sign-in: who sees it, what it shows, and what becomes of it when its process dies."""

import os
import signal
from pathlib import Path
from typing import Any

import pytest
from websockets.exceptions import ConnectionClosed, InvalidStatus
from websockets.sync.client import connect

from app.scene import words
from tests.api.test_access import Person, told
from tests.api.test_rights import ELSEWHERE, _raw
from tests.console_process import ConsoleProcess, wait_for
from tests.scene_viewer import PROTOCOL, SceneViewer

pytestmark = [pytest.mark.process, pytest.mark.slow]
PISTON, UNIT = "/rig/piston", "/rig/unit_rod"


def scene(console: ConsoleProcess) -> dict[str, Any]:
    found: dict[str, Any] = console.http.get("/scene").json()
    return found


def point(console: ConsoleProcess, **cursor: Any) -> int:
    return console.http.post("/scene/cursor", json=cursor).status_code


@pytest.fixture(scope="module")
def drawn(console: ConsoleProcess) -> ConsoleProcess:
    """A console whose 3-D view has been looked for, and is there."""
    assert point(console) == 200
    wait_for(lambda: scene(console)["state"] == "ready", "the 3-D view")
    return console


def scene_pid(console: ConsoleProcess) -> int:
    """The process that draws for this console."""
    for folder in Path("/proc").glob("[0-9]*"):
        try:
            words = (folder / "cmdline").read_bytes().split(b"\0")
            parent = int((folder / "stat").read_text().rpartition(")")[2].split()[1])
        except (OSError, ValueError):
            continue
        if parent == console.pid and b"app.scene" in words:
            return int(folder.name)
    raise AssertionError("no process draws")


# ---- who sees it ----


def refused(console: ConsoleProcess, **headers: str) -> int | None:
    """With which status the socket is refused; None where it opens."""
    address = console.url.replace("http", "ws") + "/scene/a-view"
    try:
        with connect(address, additional_headers=headers, subprotocols=[PROTOCOL]):  # type: ignore[list-item]
            return None
    except InvalidStatus as error:
        return error.response.status_code


def test_nobody_sees_it_without_signing_in(drawn: ConsoleProcess) -> None:
    with drawn.client() as stranger:
        for address in ("/scene/", "/scene/a-view/"):
            assert told(stranger.get(drawn.url + address)) == (401, "not_signed_in")
    assert refused(drawn) == 403
    assert refused(drawn, **drawn.headers) is None


def test_no_page_of_another_origin_sees_it_whatever_it_brings(drawn: ConsoleProcess) -> None:
    person = Person(drawn, "viewer").sign_in()
    for origin in ("http://evil.example", "null", "http://127.0.0.1:1"):
        assert refused(drawn, **person.cookies, Origin=origin) == 403
        assert refused(drawn, **drawn.headers, Origin=origin) == 403
    assert refused(drawn, **person.cookies, Origin=drawn.url) is None


def test_its_page_is_shown_in_the_consoles_own_pages_alone(drawn: ConsoleProcess) -> None:
    answer = drawn.http.get(drawn.url + "/scene/a-view/")
    assert answer.is_success
    assert answer.headers["x-frame-options"] == "SAMEORIGIN"
    policy = answer.headers["content-security-policy"]
    assert "frame-ancestors 'self'" in policy
    assert "default-src 'none'" in policy


def test_it_serves_no_other_file(drawn: ConsoleProcess) -> None:
    for value in [*ELSEWHERE, "index.html", "a-view/index.html", "a-view/../../etc/passwd"]:
        for path in (f"/scene/{value}", f"/scene/{value}/", f"/scene//{value}"):
            status, body = _raw(drawn, "GET", path)
            assert b"root:" not in body, path
            assert status in (200, 307, 401, 404, 422), path
            assert status != 200 or b"<title>" in body, path


def test_its_process_listens_on_no_port_and_to_no_other_user(drawn: ConsoleProcess) -> None:
    pid = scene_pid(drawn)
    links = [
        str(link.readlink()) for link in Path(f"/proc/{pid}/fd").iterdir() if link.is_symlink()
    ]
    own = {link[8:-1] for link in links if link.startswith("socket:[")}
    for table in ("tcp", "tcp6"):
        lines = Path(f"/proc/{pid}/net/{table}").read_text().splitlines()[1:]
        assert not own & {line.split()[9] for line in lines}
    path = Path(Path(f"/proc/{pid}/cmdline").read_bytes().split(b"\0")[3].decode())
    assert path.is_socket()
    assert path.parent.stat().st_mode & 0o077 == 0
    assert path.stat().st_mode & 0o077 == 0


def test_it_closes_with_the_right_to_it(drawn: ConsoleProcess) -> None:
    person = Person(drawn, "viewer").sign_in()
    with SceneViewer(drawn.url, person.cookies) as viewer:
        viewer.until(PISTON, "position", lambda place: True)
        assert person.browser.post("/auth/logout").is_success
        with pytest.raises(ConnectionClosed) as closed:
            viewer.read_on()
    assert closed.value.rcvd is not None
    assert closed.value.rcvd.code == 4401


def test_an_oversized_frame_ends_that_view_and_no_other(drawn: ConsoleProcess) -> None:
    with SceneViewer(drawn.url, drawn.headers, "one") as one:
        with SceneViewer(drawn.url, drawn.headers, "other") as other:
            other.stream.send(b"\0" * 100_000)
            with pytest.raises(ConnectionClosed):
                other.read_on()
        one.until(UNIT, "position", lambda place: True)


# ---- what it shows ----


@pytest.fixture(scope="module")
def run_id(drawn: ConsoleProcess) -> int:
    drawn.make_ready()
    number = drawn.start_run("step-2-kn")
    drawn.ended_run(number)
    return number


def test_the_rig_now_is_drawn_as_it_moves(drawn: ConsoleProcess, run_id: int) -> None:
    with SceneViewer(drawn.url, drawn.headers, "live") as viewer:
        viewer.until("/label/force", "text", lambda text: text.endswith(" kN"))
        at_rest = viewer.parts["/rig/mass_1"]["position"]
        point(drawn, view="live", deformation=100.0)
        drawn.start_run("step-2-kn")
        viewer.until("/rig/mass_1", "position", lambda place: abs(place[0] - at_rest[0]) > 1e-3)
        viewer.until(
            "/label/force", "text", lambda text: abs(float(text.split()[0].replace("−", "-"))) > 1.0
        )


def force_at(console: ConsoleProcess, run_id: int, time_s: float) -> float:
    query: dict[str, str | float] = {"channels": "force_n", "from_s": time_s, "to_s": time_s}
    query["points"] = 1
    found = console.http.get(f"/runs/{run_id}/samples", params=query).json()
    return float(found["channels"]["force_n"]["min"][0])


def test_each_view_has_its_own_moment_of_a_run(drawn: ConsoleProcess, run_id: int) -> None:
    duration_s = drawn.run(run_id)["duration_s"]
    times_s = [round(share * duration_s / 0.00025) * 0.00025 for share in (0.3, 0.7)]
    with (
        SceneViewer(drawn.url, drawn.headers, "first") as first,
        SceneViewer(drawn.url, drawn.headers, "second") as second,
    ):
        for name, time_s in zip(("first", "second"), times_s, strict=True):
            assert point(drawn, view=name, run_id=run_id, time_s=time_s) == 200
        for viewer, time_s in ((first, times_s[0]), (second, times_s[1])):
            viewer.until("/label/force", "text", words.force(force_at(drawn, run_id, time_s)))


def test_nobody_steers_the_view_of_another(drawn: ConsoleProcess, run_id: int) -> None:
    person = Person(drawn, "viewer").sign_in()
    with SceneViewer(drawn.url, person.cookies, "mine") as viewer:
        assert (
            point(drawn, view="mine", deformation=100.0, travel=3.0, run_id=run_id, time_s=1.0)
            == 200
        )
        cursor = {"view": "mine", "run_id": run_id, "time_s": 2.0}
        assert person.browser.post("/scene/cursor", json=cursor).is_success
        viewer.until("/label/force", "text", words.force(force_at(drawn, run_id, 2.0)))


@pytest.mark.parametrize(
    ("cursor", "expected"),
    [
        ({"run_id": 999_999, "time_s": 0.0}, 404),
        ({"run_id": 1, "time_s": 1e8}, 404),
        ({"view": "../.."}, 422),
        ({"deformation": 1e9}, 422),
        ({"zoom": 2}, 422),
    ],
    ids=str,
)
def test_what_cannot_be_shown_is_refused(
    drawn: ConsoleProcess, run_id: int, cursor: dict[str, Any], expected: int
) -> None:
    assert point(drawn, **cursor) == expected


# ---- what becomes of it ----


def test_its_process_is_killed_and_the_console_lives_on(drawn: ConsoleProcess) -> None:
    before = scene(drawn)["life"]
    missed = drawn.status()["loop"]["deadlines_missed"]
    with SceneViewer(drawn.url, drawn.headers) as viewer:
        viewer.until(PISTON, "position", lambda place: True)
        os.kill(scene_pid(drawn), signal.SIGKILL)
        with pytest.raises(ConnectionClosed) as closed:
            viewer.read_on()
    assert closed.value.rcvd is not None
    assert closed.value.rcvd.code == 1012
    status = drawn.status()
    assert status["loop"]["alive"]
    assert status["loop"]["deadlines_missed"] - missed < 4000
    wait_for(lambda: scene(drawn)["life"] > before, "another process")
    wait_for(lambda: scene(drawn)["state"] == "ready", "the 3-D view again")
    with SceneViewer(drawn.url, drawn.headers) as viewer:
        viewer.until(PISTON, "position", lambda place: True)


def test_its_process_hangs_and_the_console_lives_on(drawn: ConsoleProcess) -> None:
    before = scene(drawn)["life"]
    with SceneViewer(drawn.url, drawn.headers) as viewer:
        viewer.until(PISTON, "position", lambda place: True)
        os.kill(scene_pid(drawn), signal.SIGSTOP)
        wait_for(lambda: scene(drawn)["life"] > before, "another process")
    assert drawn.status()["loop"]["alive"]
