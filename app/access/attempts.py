"""How often somebody may try to sign in: after some failures each next one must wait, longer each time."""

import math
import time
from collections import OrderedDict
from collections.abc import Callable
from dataclasses import dataclass

from app.errors import Code, Refusal

LONGEST_WAIT_S = 60.0
FORGOTTEN_S = 900.0  # after so long without an attempt
_MOST_KEPT = 10_000
_PER_NAME = 5  # attempts without a wait
_PER_ADDRESS = 20  # several people may sit behind one


@dataclass
class _Tried:
    times: int = 0
    last_s: float = 0.0
    next_s: float = 0.0


class Attempts:
    """Attempts for each name and from each address. An attempt counts until it has succeeded."""

    def __init__(self, clock_s: Callable[[], float] = time.monotonic) -> None:
        self._clock_s = clock_s
        self._tried: OrderedDict[tuple[str, str], _Tried] = OrderedDict()

    def begin(self, name: str, address: str) -> Refusal | None:
        """Count an attempt; refused, and not counted, where it comes too early."""
        kept = {("name", name.casefold()): _PER_NAME, ("address", address): _PER_ADDRESS}
        now_s = self._clock_s()
        tried = {key: self._of(key, now_s) for key in kept}
        wait_s = max(one.next_s for one in tried.values()) - now_s
        if wait_s > 0.0:
            return _too_early(wait_s)
        for key, one in tried.items():
            one.times, one.last_s = one.times + 1, now_s
            one.next_s = now_s + _wait_s(one.times - kept[key])
        return None

    def succeeded(self, name: str, address: str) -> None:
        """Forget the attempts for a name, and that this one came from its address."""
        self._tried.pop(("name", name.casefold()), None)
        of_address = self._tried.get(("address", address))
        if of_address is not None:
            of_address.times = max(0, of_address.times - 1)
            of_address.next_s = 0.0

    def _of(self, key: tuple[str, str], now_s: float) -> _Tried:
        found = self._tried.pop(key, None)
        if found is None or now_s - found.last_s > FORGOTTEN_S:
            found = _Tried()
        self._tried[key] = found  # the newest last
        if len(self._tried) > _MOST_KEPT:
            self._tried.popitem(last=False)
        return found


def _wait_s(beyond: int) -> float:
    """1, 2, 4 … s after the first so many."""
    return 0.0 if beyond < 0 else min(2.0 ** min(beyond, 30), LONGEST_WAIT_S)


def _too_early(wait_s: float) -> Refusal:
    seconds = math.ceil(wait_s)
    detail = f"Too many attempts to sign in: wait {seconds} s, then try again"
    return Refusal(Code.TOO_MANY_ATTEMPTS, detail, about={"retry_after_s": seconds})
