"""Tickets for a WebSocket: good once, for half a minute, for whoever asked."""

import time
from collections import OrderedDict
from collections.abc import Callable

from app.access.keys import digest, new_key
from app.access.principal import Principal

LIFE_S = 30.0
_MOST_KEPT = 1000


class Tickets:
    """The tickets that are out. They are in memory only: a new console knows none."""

    def __init__(self, clock_s: Callable[[], float] = time.monotonic) -> None:
        self._clock_s = clock_s
        self._out: OrderedDict[str, tuple[Principal, float]] = OrderedDict()

    def give(self, who: Principal) -> str:
        """A new ticket."""
        ticket = new_key()
        self._out[digest(ticket)] = (who, self._clock_s() + LIFE_S)
        if len(self._out) > _MOST_KEPT:
            self._out.popitem(last=False)
        return ticket

    def take(self, ticket: str) -> Principal | None:
        """Whose it is; None for one that is unknown, too old, or was taken before."""
        who, good_until_s = self._out.pop(digest(ticket), (None, 0.0))
        return who if self._clock_s() < good_until_s else None
