"""The exports of this console: made by a process apart, kept for an hour, never at the cost of a run's room."""

import threading
from collections.abc import Callable
from contextlib import ExitStack
from dataclasses import replace
from datetime import UTC, datetime
from pathlib import Path
from secrets import token_hex

from app.access.principal import Principal, Role, lacking
from app.audit.record import Entry, note
from app.errors import Code, Refusal
from app.exports.export import Export
from app.exports.extract import Extract, Wanted, extract
from app.exports.formats import FORMATS, FormatName
from app.exports.making import UNDER_WAY, make, stream
from app.exports.places import Places
from app.exports.schemas import ExportOut
from app.jobs.jobs import Jobs, JobState
from app.jobs.stream import Stream
from app.storage.space import space_of

LOOK_S = 20.0
MOST_STREAMS, MOST_STREAMS_EACH = 3, 2
MOST_EACH = 3  # exports that somebody has waiting or under way


class Exports:
    """Makes exports, one at a time, and keeps those that are made. From any thread."""

    def __init__(
        self, run_file: Callable[[int], Path | Refusal], folder: Path, reserved: Callable[[], int]
    ) -> None:
        self._run_file = run_file
        self._folder = folder
        self._reserved = reserved  # bytes of the disk that runs need
        self._jobs: Jobs[int] = Jobs("exports")
        self._known: dict[str, Export] = {}
        self._lock = threading.Lock()
        self._starting = threading.Lock()
        self._streams = Places("downloads", MOST_STREAMS, MOST_STREAMS_EACH)
        self._ended = threading.Event()
        self._sweeper = threading.Thread(target=self._sweep_often, name="exports", daemon=True)

    def open(self) -> None:
        """Nobody knows any more what a console before this one made: it goes."""
        self._folder.mkdir(parents=True, exist_ok=True)
        self._sweep()
        self._sweeper.start()

    def close(self) -> None:
        """Give up what is being made."""
        self._ended.set()
        self._jobs.close()

    def start(
        self, who: Principal, run_id: int, name: FormatName, wanted: Wanted
    ) -> ExportOut | Refusal:
        """Begin to make one."""
        found = self._find(run_id, name, wanted)
        if isinstance(found, Refusal):
            return found
        reserved = self._reserved()
        no_room = self._why_no_room(name, found, reserved)
        if no_room is not None:
            return no_room
        with self._starting:
            export = self._has_enough(who) or self._begin(who, run_id, name, found, reserved)
        if isinstance(export, Refusal):
            return export
        note(
            Entry(
                "runs.export",
                f"run {run_id}",
                after={"format": name.value, "channels": list(wanted.channels)},
            )
        )
        return export.shown()

    def all(self, run_id: int) -> list[ExportOut]:
        """Those of a run that are known, the newest first."""
        with self._lock:
            return [e.shown() for e in reversed(self._known.values()) if e.run_id == run_id]

    def get(self, run_id: int, export_id: str) -> ExportOut | Refusal:
        """One, and how far it is."""
        export = self._one(run_id, export_id)
        return export if isinstance(export, Refusal) else export.shown()

    def has_ended(self, run_id: int, export_id: str) -> bool | Refusal:
        """Whether nothing more comes of one."""
        export = self._one(run_id, export_id)
        return export if isinstance(export, Refusal) else export.job.ended.is_set()

    def made(self, run_id: int, export_id: str) -> Path | Refusal:
        """The file of one that has ended, or why there is none."""
        export = self._one(run_id, export_id)
        if isinstance(export, Refusal):
            return export
        if export.job.state is JobState.DONE:
            return export.path
        return export.job.why_not(f"The file of run {run_id} was not made", Code.BUSY)

    def file(self, run_id: int, export_id: str) -> Path | Refusal:
        """The file of one that is made."""
        export = self._one(run_id, export_id)
        if isinstance(export, Refusal):
            return export
        if export.job.state is not JobState.DONE or not export.path.exists():
            detail = f"The export is not there: it is {export.job.state.value}"
            return Refusal(Code.NO_DATA, detail)
        return export.path

    def remove(self, who: Principal, run_id: int, export_id: str) -> ExportOut | Refusal:
        """Give one up, or remove its file: one's own, and an operator anybody's."""
        export = self._one(run_id, export_id)
        if isinstance(export, Refusal):
            return export
        others = None if export.user_id == who.user_id else lacking(who, Role.OPERATOR)
        if others is not None:
            return replace(others, detail=f"Somebody else wants this export. {others.detail}")
        self._jobs.cancel(export_id)
        with self._lock:
            self._known.pop(export_id, None)
        export.path.unlink(missing_ok=True)
        note(Entry("runs.remove_export", f"run {run_id}", before=export.format.value))
        return export.shown()

    def stream(
        self, who: Principal, run_id: int, name: FormatName, wanted: Wanted
    ) -> tuple[Stream, Callable[[], None]] | Refusal:
        """One as bytes that come while it is made, and what to call when nobody reads them any more."""
        found = self._find(run_id, name, wanted)
        if isinstance(found, Refusal):
            return found
        refusal = self._streams.take(who.user_id)
        if refusal is not None:
            return refusal
        with ExitStack() as held:
            held.callback(self._streams.give_back, who.user_id)
            made = Stream(stream, name, found)
            held.callback(made.close)
            return made, held.pop_all().close

    def _has_enough(self, who: Principal) -> Refusal | None:
        with self._lock:
            theirs = [e.job for e in self._known.values() if e.user_id == who.user_id]
        if sum(not job.ended.is_set() for job in theirs) < MOST_EACH:
            return None
        detail = f"You have {MOST_EACH} exports under way: wait until one has ended, or remove one"
        return Refusal(Code.BUSY, detail)

    def _begin(
        self, who: Principal, run_id: int, name: FormatName, wanted: Extract, reserved: int
    ) -> Export | Refusal:
        path = self._folder / f"{token_hex(8)}.{name}"
        title = f"{FORMATS[name].title} of run {run_id}"
        job = self._jobs.start(title, make, path, name, wanted, reserved)
        if isinstance(job, Refusal):
            return job
        export = Export(who.user_id, run_id, name, wanted, path, job)
        with self._lock:
            self._known[job.id] = export
        return export

    def _find(self, run_id: int, name: FormatName, wanted: Wanted) -> Extract | Refusal:
        path = self._run_file(run_id)
        found = path if isinstance(path, Refusal) else extract(path, wanted)
        if isinstance(found, Refusal):
            return found
        return FORMATS[name].why_not(found) or found

    def _one(self, run_id: int, export_id: str) -> Export | Refusal:
        with self._lock:
            found = self._known.get(export_id)
        if found is None or found.run_id != run_id:
            detail = f"There is no export {export_id} of run {run_id}: it may be too old"
            return Refusal(Code.NOT_FOUND, detail)
        return found

    def _why_no_room(self, name: FormatName, wanted: Extract, reserved: int) -> Refusal | None:
        needed = FORMATS[name].bytes_needed(wanted)
        room = max(0, space_of(self._folder).free_bytes - reserved)
        if needed <= room:
            return None
        detail = (
            f"The file may take {needed / 1e6:,.0f} MB and {room / 1e6:,.0f} MB are free beside what "
            "runs need: choose fewer channels, a shorter window or Parquet, or remove samples of old runs"
        )
        return Refusal(Code.NO_SPACE, detail, about={"free_bytes": room, "needed_bytes": needed})

    def _sweep_often(self) -> None:
        while not self._ended.wait(LOOK_S):
            self._sweep()

    def _sweep(self) -> None:
        """Forget exports that are old, and remove files that nobody knows."""
        now = datetime.now(UTC)
        with self._lock:
            self._known = {key: e for key, e in self._known.items() if not e.is_old(now)}
            kept = {e.path.name for e in self._known.values()}
        wanted = kept | {name + UNDER_WAY for name in kept}
        for path in self._folder.iterdir():
            if path.name not in wanted:
                path.unlink(missing_ok=True)
