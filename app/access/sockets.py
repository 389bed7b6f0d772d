"""Open sockets: each ends when whoever opened it may no longer be here."""

import asyncio

from app.access.book import Book
from app.access.principal import Principal

LOOK_S = 0.5  # a socket that is to be closed is, within a second


async def until_sent_away(who: Principal, book: Book) -> None:
    """Return when their session or token has ended, or their role is another.

    Looks in memory: revocation, signing out, disabling and expiry are all the same to it.
    """
    while book.still(who):  # noqa: ASYNC110  # nobody tells when something expires
        await asyncio.sleep(LOOK_S)
