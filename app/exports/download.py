"""The answer that is made while it is read."""

from collections.abc import Callable
from typing import Any

import anyio
from fastapi.concurrency import iterate_in_threadpool, run_in_threadpool
from fastapi.responses import StreamingResponse
from starlette.types import Receive, Scope, Send

from app.jobs.stream import Stream


class Download(StreamingResponse):
    """`end` is called once nobody reads it any more, or nobody ever did."""

    def __init__(self, made: Stream, end: Callable[[], None], **how: Any) -> None:
        super().__init__(iterate_in_threadpool(made), **how)
        self._end = end

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        try:
            await super().__call__(scope, receive, send)
        finally:
            with anyio.CancelScope(shield=True):
                await run_in_threadpool(self._end)
