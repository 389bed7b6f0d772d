"""Places that are few: so many in all, and so many for each of those who want one."""

from collections import Counter
from collections.abc import Hashable
from threading import Lock

from app.errors import Code, Refusal


class Places:
    """From any thread. `what` is what they are taken for, in the plural."""

    def __init__(self, what: str, most: int, most_each: int) -> None:
        self._what = what
        self._most = most
        self._most_each = most_each
        self._taken: Counter[Hashable] = Counter()
        self._lock = Lock()

    def take(self, who: Hashable) -> Refusal | None:
        """Take one, or say why there is none."""
        with self._lock:
            if self._taken.total() >= self._most:
                taken = f"{self._most} {self._what} are being made already"
            elif self._taken[who] >= self._most_each:
                taken = f"You have {self._most_each} {self._what} under way"
            else:
                self._taken[who] += 1
                return None
        return Refusal(Code.BUSY, f"{taken}: try again when one has ended")

    def give_back(self, who: Hashable) -> None:
        """It is free for another."""
        with self._lock:
            self._taken[who] -= 1
            self._taken += Counter()  # forgets those who have none
