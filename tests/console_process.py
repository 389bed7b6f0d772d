"""The console as a process of its own, with a data directory of its own: for tests of the real thing."""

import contextlib
import json
import os
import re
import shutil
import signal
import ssl
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any, cast

import httpx2

from app.access.principal import Role
from app.access.schemas import RoleWord, TokenCreate, UserCreate
from app.access.scopes import scope_of
from app.access.tokens import Tokens
from app.access.users import Users
from app.commands.access import on_database
from app.commands.tokens import make_token
from app.errors import Code, Refusal
from app.interlocks.defaults import default_interlocks
from app.link.paths import block_path
from app.settings import Settings
from rtcore.memory.segment import attach_block

PATIENCE_S = 110.0  # a cold start compiles the loop's kernels
SERVE = "from app.main import serve; serve('127.0.0.1', 0, None)"


def wait_for(condition: Callable[[], Any], what: str, patience_s: float = PATIENCE_S) -> Any:
    """Wait until something is so, and return it."""
    give_up = time.monotonic() + patience_s
    while not (found := condition()):
        assert time.monotonic() < give_up, f"waited {patience_s:.0f} s for {what}"
        time.sleep(0.01)
    return found


def patient_interlocks(folder: Path) -> Path:
    """The shipped interlocks without the one that trips where other work holds up the loop."""
    table = default_interlocks().model_dump(mode="json")
    for detector in table["detectors"]:
        if detector["name"] == "deadlines_missed":
            detector["threshold"] = 1e6
    table["knowingly_weaker"] = ["deadlines_missed"]
    path = folder / "interlocks.json"
    path.write_text(json.dumps(table))
    return path


def loops_on(block: Path) -> list[int]:
    """The loop processes that were started on a block, those that have not got as far as its lock too."""
    wanted = b"\0--block\0" + os.fsencode(block) + b"\0"
    found = []
    for place in Path("/proc").glob("[0-9]*"):
        with contextlib.suppress(OSError):  # it has ended meanwhile
            if wanted in (place / "cmdline").read_bytes():
                found.append(int(place.name))
    return found


def bearer(token: str) -> dict[str, str]:
    """The header that bears a token."""
    return {"Authorization": f"Bearer {token}"}


# The console that the tests of a folder share: it ends with the last of them.
OF_FOLDER: dict[Path, "ConsoleProcess"] = {}


class ConsoleProcess:
    """Starts, kills and restarts the console on one data directory."""

    def __init__(
        self,
        folder: Path,
        database_url: str | None = None,
        interlocks: Path | None = None,
        certificate: tuple[Path, Path] | None = None,
        program: str = SERVE,
    ) -> None:
        self._program = program
        self.data = folder / "data"
        self.block = block_path(self.data)
        self._log = folder / "console.log"
        self._environment = os.environ | {
            "FORCERIG_DATA_DIR": str(self.data),
            "FORCERIG_INTERLOCKS_FILE": str(interlocks or patient_interlocks(folder)),
        }
        if database_url is not None:
            self._environment["FORCERIG_DATABASE_URL"] = database_url
        self.database_url = database_url or f"sqlite:///{self.data / 'forcerig.sqlite'}"
        self._verify: ssl.SSLContext | bool = True
        if certificate is not None:
            names = ("FORCERIG_TLS_CERT", "FORCERIG_TLS_KEY")
            self._environment |= dict(zip(names, map(str, certificate), strict=True))
            self._verify = ssl.create_default_context(cafile=str(certificate[0]))
        self._process: subprocess.Popen[bytes] | None = None
        self.url = ""
        self._epoch = 0  # of the lease that the tests took last
        self._clients: list[httpx2.Client] = []
        self.token = ""  # of an admin; a console that starts again knows it

    def start(self, *, wait: bool = True) -> "ConsoleProcess":
        """Start it, and wait until its loop is there."""
        self.token = self.token or self.new_token()
        already_said = len(self.said())
        with self._log.open("ab") as log:
            self._process = subprocess.Popen(
                [sys.executable, "-c", self._program], env=self._environment, stdout=log, stderr=log
            )
        pattern = re.compile(r"forcerig console: (\S+)/\n")
        found = wait_for(
            lambda: self._lives() and pattern.search(self.said(), already_said), "its address"
        )
        self.url = found.group(1)
        self.http = self.client(self.token)
        wait_for(self.answers, "an answer")
        if wait:
            wait_for(lambda: self.status()["loop"]["alive"], "a living loop")
        return self

    @property
    def headers(self) -> dict[str, str]:
        """What shows that it is the tests that ask: for a WebSocket, say."""
        return bearer(self.token)

    def client(self, token: str | None = None) -> httpx2.Client:
        """Somebody who asks, with this token or with nothing."""
        headers = {} if token is None else bearer(token)
        made = httpx2.Client(
            base_url=f"{self.url}/api/v1", timeout=30, headers=headers, verify=self._verify
        )
        self._clients.append(made)
        return made

    def as_role(self, role: Role) -> httpx2.Client:
        """Somebody of this role."""
        return self.client(self.new_token(role))

    def new_token(self, role: Role = Role.ADMIN) -> str:
        """A token as `forcerig token create` makes it, for a user of that role."""
        settings, owner = self._settings(), role.word
        if role is not Role.ADMIN:
            asked = UserCreate(name=owner, role=RoleWord(owner))
            found = on_database(settings, lambda users, _: users.add(asked))
            assert not isinstance(found, Refusal) or found.code is Code.USER_EXISTS
        wanted = TokenCreate(name="tests", scope=scope_of(role), expires_in_days=1)
        made = make_token(settings, owner, wanted)
        assert not isinstance(made, Refusal), made
        return made.token

    def new_link(self, name: str = "admin") -> str:
        """A path that signs a user in once, as `forcerig user link` makes it."""

        def work(users: Users, _: Tokens) -> str:
            number = users.number_of(name)
            assert isinstance(number, int), number
            made = users.link(number)
            assert not isinstance(made, Refusal), made
            return made.path

        path = on_database(self._settings(), work)
        assert isinstance(path, str), path
        return path

    def _settings(self) -> Settings:
        return Settings(data_dir=self.data, database_url=self.database_url)

    def said(self) -> str:
        """Everything that it has logged."""
        return self._log.read_text() if self._log.exists() else ""

    def _lives(self) -> bool:
        assert self._process is not None
        assert self._process.poll() is None, self.said()
        return True

    def answers(self) -> bool:
        """Whether it answers at all."""
        assert self._lives()
        try:
            self.http.get("/channels")
        except httpx2.TransportError:
            return False
        return True

    @property
    def pid(self) -> int:
        """The process id of the app."""
        assert self._process is not None
        return self._process.pid

    @property
    def loop_pid(self) -> int:
        """The process id of the loop."""
        return int(attach_block(self.block).fields["loop_pid"])

    def kill(self) -> None:
        """kill -9 of the app."""
        self._end(signal.SIGKILL)

    def signal(self, number: int) -> None:
        """Send the app a signal."""
        assert self._process is not None
        self._process.send_signal(number)

    def stop(self) -> int:
        """SIGTERM to the app; returns its exit status."""
        return self._end(signal.SIGTERM)

    def _end(self, number: int) -> int:
        assert self._process is not None
        for client in self._clients:
            client.close()
        self._process.send_signal(number)
        return self._process.wait(60)

    def clean_up(self) -> None:
        """Leave nothing behind, whatever the test did."""
        if self._process is not None and self._process.poll() is None:
            self.kill()
        # One that is still starting holds no lock and has no block, only its command line.
        for pid in loops_on(self.block):
            with contextlib.suppress(ProcessLookupError):
                os.kill(pid, signal.SIGKILL)
        wait_for(lambda: not loops_on(self.block), "the end of the loop")
        self.block.unlink(missing_ok=True)
        self.block.with_suffix(".lock").unlink(missing_ok=True)
        shutil.rmtree(self.data, ignore_errors=True)

    # ---- what an operator does ----

    def status(self) -> dict[str, Any]:
        """The status of the rig."""
        return cast(dict[str, Any], self.http.get("/rig").json())

    def mode(self) -> str:
        """The mode of the rig."""
        return str(self.status()["mode"])

    def command(self, command: str) -> httpx2.Response:
        """Give a command, in command."""
        self.take_command()
        return self.http.post("/rig/commands", json={"command": command})

    def take_command(self) -> None:
        """Be in command, over whoever is, for as long as tests go on asking."""
        lease = self.http.get("/lease").json()
        if lease is None or lease["epoch"] != self._epoch:
            wish = {"reason": "The tests", "take_over": True, "ttl_s": 600}
            taken = self.http.post("/lease", json=wish)
            if taken.is_success:  # it may be a loop that has just been killed
                self._epoch = taken.json()["epoch"]

    def make_ready(self) -> None:
        """Reset and pressurise, in command, from wherever the rig is."""
        self.take_command()
        wait_for(
            lambda: self.mode() not in ("running", "holding", "stopping"), "the last run's end"
        )
        if self.mode() == "ready":
            return
        self.reset()
        assert self.command("pressurise").is_success
        wait_for(lambda: self.mode() == "ready", "pressure")

    def reset(self) -> None:
        """Reset, where the cause has gone. One that follows another at once is a key held down: let go of it."""
        for _ in range(5):
            if self.command("reset").is_success:
                return
            time.sleep(0.5)
        raise AssertionError("the rig does not take a reset")

    def start_run(self, test_id: str) -> int:
        """Start a test, in command; returns the number of the run."""
        self.take_command()
        wait_for(lambda: self.status()["commands"]["start"] is None, "leave to start")
        answer = self.http.post("/runs", json={"test_id": test_id})
        assert answer.status_code == 201, answer.text
        return int(answer.json()["id"])

    def run(self, run_id: int) -> dict[str, Any]:
        """A run as it is now."""
        return cast(dict[str, Any], self.http.get(f"/runs/{run_id}").json())

    def ended_run(self, run_id: int) -> dict[str, Any]:
        """A run once it has ended."""
        wait_for(lambda: self.run(run_id)["outcome"], f"the end of run {run_id}")
        return self.run(run_id)
