"""What was read of a file, kept for the next request: a few files, each as long as it is the same one."""

from collections import OrderedDict
from collections.abc import Callable
from pathlib import Path
from threading import Lock
from typing import Generic, TypeVar

T = TypeVar("T")


class Recent(Generic[T]):
    """Values made from files, by path, time and size; the least recently used goes first."""

    def __init__(self, make: Callable[[Path], T], most: int = 16) -> None:
        self._make = make
        self._most = most
        self._kept: OrderedDict[tuple[Path, int, int], T] = OrderedDict()
        self._lock = Lock()

    def get(self, path: Path) -> T:
        """The value of a file as it is now. Raises what making it does, `OSError` where it is gone."""
        status = path.stat()
        key = (path, status.st_mtime_ns, status.st_size)
        with self._lock:
            if key in self._kept:
                self._kept.move_to_end(key)
                return self._kept[key]
        value = self._make(path)
        with self._lock:
            self._kept[key] = value
            while len(self._kept) > self._most:
                self._kept.popitem(last=False)
        return value
