"""Who is in command, over REST and the live stream: two people and a script at one rig."""

import json
from collections.abc import Iterator

import httpx2
import pytest
from websockets.sync.client import connect

from app.access.principal import Role
from rtcore.codes import Opcode, Reply
from rtcore.memory.commands import acknowledgement, post
from rtcore.memory.segment import attach_block
from tests.console_process import ConsoleProcess, wait_for

pytestmark = [pytest.mark.process, pytest.mark.slow]
PATIENCE_S = 30


@pytest.fixture
def ann(console: ConsoleProcess) -> Iterator[httpx2.Client]:
    """An operator, in command for ten minutes without a sign of her."""
    console.take_command()
    console.http.delete("/lease").raise_for_status()
    with console.as_role(Role.OPERATOR) as client:
        client.post("/lease", json={"reason": "warm-up", "ttl_s": 600}).raise_for_status()
        yield client
        client.delete("/lease")


@pytest.fixture
def bob(console: ConsoleProcess) -> Iterator[httpx2.Client]:
    """Another operator's script."""
    with console.as_role(Role.OPERATOR) as client:
        yield client


@pytest.fixture
def eve(console: ConsoleProcess) -> Iterator[httpx2.Client]:
    with console.as_role(Role.ENGINEER) as client:
        yield client


def refused(answer: httpx2.Response) -> tuple[int, str]:
    assert answer.headers["content-type"] == "application/problem+json"
    return answer.status_code, answer.json()["code"]


def credentials(client: httpx2.Client) -> dict[str, str]:
    return {"Authorization": client.headers["authorization"]}


def command(client: httpx2.Client, word: str, lease: int | None = None) -> httpx2.Response:
    body = {"command": word} | ({} if lease is None else {"lease": lease})
    return client.post("/rig/commands", json=body)


def test_the_second_is_refused_with_the_name_of_the_first(
    console: ConsoleProcess, ann: httpx2.Client, bob: httpx2.Client
) -> None:
    for answer in (
        bob.post("/lease", json={}),
        command(bob, "reset"),
        bob.post("/runs", json={"test_id": "step-2-kn"}),
        bob.delete("/lease"),
    ):
        assert refused(answer) == (409, "lease_held")
        assert "operator (tests) (operator) has been in command for" in answer.json()["detail"]
        assert "take over as an engineer with a reason" in answer.json()["detail"]
    lease = console.status()["lease"]
    assert (lease["holder"], lease["role"], lease["reason"]) == (
        *("operator (tests)", "operator"),
        "warm-up",
    )
    assert lease == bob.get("/lease").json() | {"expires_in_s": lease["expires_in_s"]}


def test_without_anybody_in_command_nothing_is_commanded(
    ann: httpx2.Client, bob: httpx2.Client
) -> None:
    assert ann.delete("/lease").status_code == 204
    assert bob.get("/lease").json() is None
    assert refused(command(ann, "reset")) == (409, "lease_needed")
    assert refused(bob.post("/lease/requests", json={})) == (409, "lease_needed")


def test_command_is_asked_for_and_handed_over(ann: httpx2.Client, bob: httpx2.Client) -> None:
    made = bob.post("/lease/requests", json={"reason": "my specimen"})
    assert made.status_code == 201
    (shown,) = ann.get("/lease").json()["requests"]
    assert shown == made.json()
    assert shown["reason"] == "my specimen"
    before = ann.get("/lease").json()["epoch"]
    given = ann.post("/lease/hand-over", json={"request_id": shown["id"]}).json()
    assert given["epoch"] > before
    assert given["requests"] == []
    assert refused(command(ann, "reset", before)) == (409, "lease_held")
    assert bob.post("/lease/beat", json={"epoch": given["epoch"]}).status_code == 204
    assert refused(bob.post("/lease/beat", json={"epoch": before})) == (409, "stale_lease")
    assert bob.delete("/lease").status_code == 204


def test_a_request_is_declined_by_the_holder_and_withdrawn_by_its_maker(
    ann: httpx2.Client, bob: httpx2.Client, eve: httpx2.Client
) -> None:
    for client in (ann, bob):
        made = bob.post("/lease/requests", json={}).json()
        assert refused(eve.delete(f"/lease/requests/{made['id']}")) == (409, "lease_held")
        assert client.delete(f"/lease/requests/{made['id']}").status_code == 204
        assert ann.get("/lease").json()["requests"] == []
    assert refused(ann.delete("/lease/requests/999999"))[0] == 404


def test_taking_over_takes_an_engineer_and_a_reason(
    ann: httpx2.Client, bob: httpx2.Client, eve: httpx2.Client
) -> None:
    over = {"take_over": True, "reason": "Ann has left"}
    assert refused(bob.post("/lease", json=over)) == (403, "not_allowed")
    assert refused(eve.post("/lease", json={"take_over": True})) == (422, "invalid_request")
    taken = eve.post("/lease", json=over)
    assert taken.is_success
    assert refused(command(ann, "reset")) == (409, "lease_held")
    assert eve.delete("/lease").status_code == 204


def test_a_viewer_commands_nothing_and_stops_the_rig(ready: ConsoleProcess) -> None:
    with ready.as_role(Role.VIEWER) as viewer:
        run_id = ready.start_run("harmonic-2-kn-50-hz")
        for answer in (
            viewer.post("/lease", json={}),
            viewer.post("/lease/requests", json={}),
            command(viewer, "hold"),
            command(viewer, "shutdown"),
        ):
            assert refused(answer) == (403, "not_allowed")
        assert command(viewer, "stop").is_success
        assert ready.ended_run(run_id)["outcome"] == "stopped"


def test_an_operator_out_of_command_may_shut_down(ready: ConsoleProcess) -> None:
    with ready.as_role(Role.OPERATOR) as other:
        assert refused(command(other, "depressurise")) == (409, "lease_held")
        assert command(other, "shutdown").is_success
        assert ready.mode() == "tripped"


def test_the_loop_itself_refuses_a_stale_epoch(ready: ConsoleProcess) -> None:
    """Past the app: what is posted straight into the block, as a script gone astray could."""
    block = attach_block(ready.block)
    stale = int(block.fields["lease"])
    ready.http.delete("/lease").raise_for_status()
    ready.take_command()
    present = int(block.fields["lease"])
    assert present > stale

    def reply(opcode: Opcode, lease: int) -> Reply:
        sequence = post(block, opcode, lease=lease)
        return Reply(wait_for(lambda: acknowledgement(block, sequence), "the loop's answer")[0])

    for lease in (stale, 0, present + 1):
        assert reply(Opcode.DEPRESSURISE, lease) is Reply.STALE_LEASE
        assert ready.mode() == "ready"
    assert reply(Opcode.TAKE_LEASE, stale) is Reply.STALE_LEASE
    assert reply(Opcode.DEPRESSURISE, present) is Reply.ACCEPTED


def test_a_run_whose_epoch_is_stale_does_not_start(ready: ConsoleProcess) -> None:
    lease = ready.http.get("/lease").json()["epoch"]
    asked = {"test_id": "step-2-kn", "lease": lease - 1}
    assert refused(ready.http.post("/runs", json=asked)) == (409, "stale_lease")
    assert ready.status()["run"] is None


def test_everybody_hears_of_it_and_a_beat_of_an_old_epoch_is_answered(
    console: ConsoleProcess, ann: httpx2.Client, eve: httpx2.Client
) -> None:
    address = console.url.replace("http", "ws") + "/api/v1/live"
    epoch = eve.get("/lease").json()["epoch"]
    with connect(address, additional_headers=credentials(ann)) as stream:
        stream.send(json.dumps({"type": "beat", "epoch": epoch}))
        eve.post("/lease", json={"take_over": True, "reason": "Drill"}).raise_for_status()
        texts: list[str] = []
        while "engineer (tests) (engineer) has taken over" not in " ".join(texts):
            message = json.loads(stream.recv(PATIENCE_S, decode=True))
            if message["type"] == "event" and message["event"]["kind"] == "lease":
                texts.append(message["event"]["text"])
        assert texts[-1].endswith("from operator (tests) (operator): Drill")
        stream.send(json.dumps({"type": "beat", "epoch": epoch}))
        error = {"type": "?"}
        while error["type"] != "error":
            error = json.loads(stream.recv(PATIENCE_S, decode=True))
        assert error["code"] == "lease_held"
    eve.delete("/lease").raise_for_status()


def test_a_lease_without_a_sign_ends_and_the_test_goes_on(ready: ConsoleProcess) -> None:
    with ready.as_role(Role.ENGINEER) as silent:
        over = {"take_over": True, "reason": "Silent", "ttl_s": 5}
        ready.start_run("flight-spectrum")  # which takes longer than the lease
        silent.post("/lease", json=over).raise_for_status()
    wait_for(lambda: ready.status()["lease"] is None, "the end of the lease")
    assert ready.mode() == "running"
    with ready.as_role(Role.VIEWER) as viewer:
        assert command(viewer, "stop").is_success


def test_changes_of_command_are_in_the_audit(
    console: ConsoleProcess, ann: httpx2.Client, eve: httpx2.Client
) -> None:
    over = {"take_over": True, "reason": "For the audit"}
    eve.post("/lease", json=over).raise_for_status()
    eve.delete("/lease").raise_for_status()

    def entries() -> list[dict[str, object]]:
        answer = console.http.get("/audit", params={"action": "lease"}).json()
        return [row for row in answer["entries"] if row["why"] == "For the audit"]

    (row,) = wait_for(entries, "its row")
    assert (row["action"], row["who"]) == ("lease.taken_over", "engineer (tests)")
