"""The store of time histories: a folder each, which appears whole or not at all and never changes."""

import errno
import hashlib
import re
import tempfile
from collections.abc import Iterable
from contextlib import suppress
from functools import cache
from pathlib import Path

from app.audit.record import Entry, note
from app.documents.messages import nearest
from app.documents.refusal import Problem, refuse
from app.errors import Code, Refusal
from app.histories.history import History
from app.histories.importing import ABOUT, About, HistoryInfo, convert, opened
from app.histories.layout import Unreadable

_NAME = re.compile(r"[A-Za-z0-9][A-Za-z0-9._ -]{0,95}\.(?:csv|tsv|txt)")
_UPLOADED = "uploaded"


class Store:
    """Time histories in a folder; what definitions look their files up in."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder

    def find(self, name: str, rate_hz: float | None) -> History | str:
        """The history of a name, or a sentence why there is none."""
        about = self.about(name) if _NAME.fullmatch(name) else None
        if about is None:
            guess = nearest(name, [info.file for info in self.all()])
            return f"there is no time history '{name}' in the store{guess}"
        return opened(self.folder / name, about)

    def all(self) -> list[HistoryInfo]:
        """Every history, in the order of names."""
        if not self.folder.is_dir():
            return []
        found = (self.about(path.name) for path in sorted(self.folder.iterdir()))
        return [HistoryInfo(**dict(about)) for about in found if about is not None]

    def about(self, name: str) -> About | None:
        """What is known of a history; None where there is none."""
        try:
            text = (self.folder / name / ABOUT).read_text(encoding="utf-8")
        except (FileNotFoundError, NotADirectoryError):
            return None
        return About.model_validate_json(text)


class Beside:
    """Time histories in CSV files beside a test in a file, for the command line."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder
        self._known: dict[tuple[str, float | None], History | str] = {}

    def find(self, name: str, rate_hz: float | None) -> History | str:
        """The history in the file of that name, or a sentence why there is none."""
        key = (name, rate_hz)
        if key not in self._known:
            self._known[key] = self._read(name, rate_hz)
        return self._known[key]

    def _read(self, name: str, rate_hz: float | None) -> History | str:
        path = self._folder / name
        if not path.is_file():
            return f"no such file: {path}"
        work = Path(tempfile.mkdtemp(dir=_scratch().name))
        try:
            about = convert(path, work, name, _digest_of(path), None, rate_hz)
        except Unreadable as error:
            return f"{path}{_at(error.line)}: {error.message}"
        except OSError as error:
            return f"{path} cannot be read: {error.strerror}"
        return opened(work, about)


def import_history(
    stream: Iterable[bytes],
    name: str,
    folder: Path,
    column: str | None = None,
    rate_hz: float | None = None,
) -> HistoryInfo | Refusal:
    """Keep a CSV file as a time history. The same file again is the same history.

    Refused where the name stands for other content, or with the line where the file is wrong.
    """
    if not _NAME.fullmatch(name):
        message = "must be letters, digits, dots, dashes and blanks, and end in .csv, .tsv or .txt"
        return refuse(Code.INVALID_HISTORY, name[:100], [Problem("name", name[:100], message)])
    try:
        return _imported(stream, name, folder, column, rate_hz)
    except OSError as error:
        if error.errno not in (errno.ENOSPC, errno.EDQUOT):
            raise
        return Refusal(Code.NO_SPACE, f"There is no room on the disk for {name}")


def _imported(
    stream: Iterable[bytes], name: str, folder: Path, column: str | None, rate_hz: float | None
) -> HistoryInfo | Refusal:
    folder.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory(prefix=".incoming-", dir=folder) as work:
        place = Path(work) / name
        place.mkdir()
        digest = _received(stream, place / _UPLOADED)
        try:
            about = convert(place / _UPLOADED, place, name, digest, column, rate_hz)
        except Unreadable as error:
            problem = Problem("", None, error.message, line=error.line)
            return refuse(Code.INVALID_HISTORY, name, [problem])
        for raw in place.glob("*.raw"):
            raw.unlink()
        with suppress(OSError):  # somebody was first: is it the same?
            place.rename(folder / name)
            note(Entry("histories.import", name, after=HistoryInfo(**dict(about))))
    return _settled(Store(folder), about)


@cache
def _scratch() -> tempfile.TemporaryDirectory[str]:
    """A place for samples that lasts as long as this process."""
    return tempfile.TemporaryDirectory(prefix="forcerig-", ignore_cleanup_errors=True)


def _settled(store: Store, about: About) -> HistoryInfo | Refusal:
    """What is in the store under the name now, unless it is something else."""
    kept = store.about(about.file)
    mine = HistoryInfo(**dict(about))
    if kept is not None and HistoryInfo(**dict(kept)) == mine:
        return mine
    message = f"There is another time history named {about.file}, and names stand for ever: choose another"
    return Refusal(Code.HISTORY_EXISTS, message)


def _received(stream: Iterable[bytes], path: Path) -> str:
    digest = hashlib.sha256()
    with path.open("wb") as file:
        for part in stream:
            digest.update(part)
            file.write(part)
    return digest.hexdigest()


def _digest_of(path: Path) -> str:
    with path.open("rb") as file:
        return hashlib.file_digest(file, "sha256").hexdigest()


def _at(line: int | None) -> str:
    return f", line {line}" if line else ""
