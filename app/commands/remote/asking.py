"""Requests to a running console: its refusals as refusals, and a console that does not answer as one too."""

import time
from collections.abc import Callable
from types import TracebackType
from typing import Any, Self

import httpx2

from app.errors import Code, Refusal

PATIENCE_S = 60.0  # a console that is started anew is there again by then
AGAIN_S = 1.0
ANSWER_S = 40.0
_REPEATED = frozenset({"GET"})  # what changes nothing is asked again where the connection breaks


class Asking:
    """A console as a token sees it. `lost` is told once each time the connection breaks."""

    def __init__(
        self,
        url: str,
        token: str,
        lost: Callable[[str], None],
        transport: httpx2.BaseTransport | None = None,
    ) -> None:
        self._lost = lost
        self._was_there = False
        self._client = httpx2.Client(
            base_url=f"{url.rstrip('/')}/api/v1",
            headers={"Authorization": f"Bearer {token}"},
            timeout=ANSWER_S,
            transport=transport,
        )

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self._client.close()

    def get(self, path: str) -> Any | Refusal:
        """What is there, as JSON."""
        return self.ask("GET", path)

    def post(self, path: str, body: Any) -> Any | Refusal:
        """What came of it, as JSON. Never asked twice."""
        return self.ask("POST", path, body)

    def ask(self, method: str, path: str, body: Any = None) -> Any | Refusal:
        """The answer as JSON, None where it is empty."""
        answer = self._answer(method, path, body)
        if isinstance(answer, Refusal) or not answer.content:
            return answer if isinstance(answer, Refusal) else None
        return answer.json()

    def file(self, path: str) -> bytes | Refusal:
        """The answer as it is."""
        answer = self._answer("GET", path, None, timeout_s=3 * ANSWER_S)
        return answer if isinstance(answer, Refusal) else answer.content

    def _answer(
        self, method: str, path: str, body: Any, timeout_s: float = ANSWER_S
    ) -> httpx2.Response | Refusal:
        give_up = time.monotonic() + PATIENCE_S
        told = False
        while True:
            try:
                answer = self._client.request(method, path, json=body, timeout=timeout_s)
                return answer if answer.is_success else _refusal(answer)
            except httpx2.TransportError as error:
                if method not in _REPEATED or not self._was_there or time.monotonic() > give_up:
                    return _no_answer(str(self._client.base_url), error)
                if not told:
                    self._lost(f"The console does not answer ({error}); trying again")
                    told = True
            time.sleep(AGAIN_S)

    def reached(self) -> Any | Refusal:
        """Whether it is there and the token is good: the status of the rig. From then on it is waited for."""
        status = self.get("rig")
        self._was_there = not isinstance(status, Refusal)
        return status


def _refusal(answer: httpx2.Response) -> Refusal:
    """A problem document, or what something on the way said instead."""
    try:
        problem = answer.json()
        return Refusal(Code(problem["code"]), str(problem["detail"]))
    except (ValueError, KeyError, TypeError):
        detail = f"The console answered {answer.status_code} {answer.reason_phrase}"
        return Refusal(Code.INTERNAL, detail)


def _no_answer(url: str, error: Exception) -> Refusal:
    console = url.removesuffix("/").removesuffix("/api/v1")
    return Refusal(Code.LOOP_SILENT, f"No console answers at {console}: {error}")
