"""Who asks: what a request brought, looked up in memory."""

import asyncio
from concurrent.futures import ThreadPoolExecutor

from app.access.book import Book, of_session, of_token
from app.access.credentials import Credentials
from app.access.keys import digest, same
from app.access.principal import Principal
from app.access.refusals import CSRF, NOT_SIGNED_IN
from app.access.tickets import Tickets
from app.errors import Refusal

_PAUSE_S = 0.2  # between readings: a flood of wrong tokens is no flood of queries


class Identity:
    """Tells who asks. On the event loop: only a token that is not known waits, for one query."""

    def __init__(self, book: Book, tickets: Tickets) -> None:
        self._book = book
        self._tickets = tickets
        self._threads = ThreadPoolExecutor(1, thread_name_prefix="access")
        self._reading: asyncio.Task[None] | None = None

    def close(self) -> None:
        """End the thread."""
        self._threads.shutdown(cancel_futures=True)

    async def who(self, brought: Credentials, *, changes: bool) -> Principal | Refusal:
        """Who asks with these. `changes`: whether the request may change something."""
        if brought.token is not None:
            return await self._bearer(digest(brought.token))
        if brought.ticket is not None:
            return self._holder(brought.ticket)
        if brought.session is not None:
            return self._signed_in(brought.session, brought.csrf, changes=changes)
        return NOT_SIGNED_IN

    async def _bearer(self, kept: str) -> Principal | Refusal:
        if self._book.token(kept) is None:
            await self._read_again()  # the command line may just have made it
        found = self._book.token(kept)
        return NOT_SIGNED_IN if found is None else of_token(found)

    def _holder(self, ticket: str) -> Principal | Refusal:
        who = self._tickets.take(ticket)
        return NOT_SIGNED_IN if who is None or not self._book.still(who) else who

    def _signed_in(self, key: str, csrf: str | None, *, changes: bool) -> Principal | Refusal:
        found = self._book.session(digest(key))
        if found is None:
            return NOT_SIGNED_IN
        forged = changes and not same(csrf or "", found.csrf)
        return CSRF if forged else of_session(found)

    async def _read_again(self) -> None:
        """Read what is in the database. Many who ask at once share one reading."""
        if self._reading is None or self._reading.done():
            self._reading = asyncio.create_task(self._read_soon())
        await asyncio.shield(self._reading)

    async def _read_soon(self) -> None:
        await asyncio.sleep(_PAUSE_S)
        await asyncio.get_running_loop().run_in_executor(self._threads, self._book.read)
