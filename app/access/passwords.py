"""Passwords: what one must be, and their Argon2 hashes, made beside the event loop."""

import asyncio
import os
from concurrent.futures import Future, ThreadPoolExecutor
from threading import get_native_id

from pwdlib import PasswordHash
from pwdlib.exceptions import UnknownHashError
from pwdlib.hashers.argon2 import Argon2Hasher

from app.access.keys import new_key
from app.errors import Code, Fault, Refusal

SHORTEST = 12
LONGEST = 1000
_WORKERS = 2
_MOST_WAITING = 20  # of 64 MB and some 50 ms each
_AFTER_OTHER_WORK = 5


def weak(name: str, password: str) -> Refusal | None:
    """Why this cannot be the password of somebody; None where it can."""
    wrong = None
    if len(password) < SHORTEST:
        wrong = f"at least {SHORTEST} characters: a few words will do"
    elif len(password) > LONGEST:
        wrong = f"at most {LONGEST} characters"
    elif password.casefold() == name.casefold():
        wrong = "something else than the name"
    elif len(set(password)) == 1:
        wrong = "more than one character again and again"
    if wrong is None:
        return None
    fault = Fault("body.password", "", wrong)
    return Refusal(Code.WEAK_PASSWORD, f"The password must be {wrong}", (fault,))


def _step_back() -> None:
    """A thread that hashes goes after the console's others, which go before other work."""
    os.setpriority(os.PRIO_PROCESS, get_native_id(), _AFTER_OTHER_WORK)


class Passwords:
    """Hashes and compares, a few at a time, in threads of its own."""

    def __init__(self) -> None:
        self._hasher = PasswordHash((Argon2Hasher(),))
        self._threads = ThreadPoolExecutor(
            _WORKERS, thread_name_prefix="passwords", initializer=_step_back
        )
        self._nobodys: Future[str] | None = None
        self._waiting = 0

    def open(self) -> None:
        """Make the hash that names which nobody has are compared with."""
        self._nobodys = self._threads.submit(self.hash, new_key())

    def close(self) -> None:
        """End the threads."""
        self._threads.shutdown(cancel_futures=True)

    def hash(self, password: str) -> str:
        """The hash to keep; takes some 50 ms of this thread."""
        return self._hasher.hash(password)

    def is_right(self, password: str, kept: str | None) -> bool:
        """Whether it is the password. Where there is none it takes as long, and is not."""
        if kept is None:
            if self._nobodys is not None:
                self._hasher.verify(password, self._nobodys.result())
            return False
        try:
            return self._hasher.verify(password, kept)
        except UnknownHashError:
            return False

    async def compare(self, password: str, kept: str | None) -> bool | Refusal:
        """`is_right`, beside the event loop; refused where too many wait for it."""
        if self._waiting >= _MOST_WAITING:
            detail = "Too many are signing in at this moment: try again in a second"
            return Refusal(Code.TOO_MANY_ATTEMPTS, detail, about={"retry_after_s": 1})
        self._waiting += 1
        try:
            loop = asyncio.get_running_loop()
            return await loop.run_in_executor(self._threads, self.is_right, password, kept)
        finally:
            self._waiting -= 1

    async def hashed(self, password: str) -> str:
        """`hash`, beside the event loop."""
        loop = asyncio.get_running_loop()
        return await loop.run_in_executor(self._threads, self.hash, password)
