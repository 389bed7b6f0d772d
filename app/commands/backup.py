"""`forcerig backup` and `forcerig restore`."""

import sqlite3
from pathlib import Path

from app.commands.output import Exit, print_json, print_refusal, progress_bar, text_console
from app.errors import Code, Refusal
from app.settings import Settings
from app.storage.backup import DATABASE, Made, Source, back_up
from app.storage.restore import NotABackup, Restored, restore


def run_backup(target: Path, data: Path | None, with_samples: bool, as_json: bool) -> Exit:
    """Back up a data directory, whether its console runs or not."""
    settings = Settings() if data is None else Settings(data_dir=data)
    source = _source(settings, with_samples)
    if isinstance(source, Refusal):
        return print_refusal(source, as_json)
    if not target.absolute().parent.is_dir():
        return print_refusal(_refusal(f"There is no folder {target.parent}"), as_json)
    try:
        with progress_bar("Backing up") as progress:
            made = back_up(source, target, progress)
    except (OSError, sqlite3.Error) as error:
        return print_refusal(_refusal(f"The backup could not be made: {error}"), as_json)
    return _say_made(target, source, made, as_json)


def run_restore(archive: Path, data: Path, as_json: bool) -> Exit:
    """Put a backup back into an empty directory."""
    try:
        with progress_bar("Restoring") as progress:
            restored = restore(archive, data, progress)
    except (NotABackup, OSError) as error:
        return print_refusal(_refusal(str(error)), as_json)
    return _say_restored(data, restored, as_json)


def _source(settings: Settings, with_samples: bool) -> Source | Refusal:
    if not settings.data_dir.is_dir():
        return _refusal(f"There is no data directory {settings.data_dir}")
    if settings.database_url is not None and not settings.database_url.startswith("sqlite"):
        return Source(settings.data_dir, None, with_samples)
    address = settings.database_address.partition("///")[2]
    database = Path(address)
    if not database.is_file():
        return _refusal(f"There is no database {database}: has a console been started there?")
    return Source(settings.data_dir, database, with_samples)


def _say_made(target: Path, source: Source, made: Made, as_json: bool) -> Exit:
    if as_json:
        told = {"file": str(target), "runs": made.runs, "under_way": made.under_way}
        more = {"files": made.files, "bytes": made.bytes, "database": source.database is not None}
        print_json(told | more)
        return Exit.PASSED
    console = text_console()
    under_way = f", {made.under_way} of them under way" if made.under_way else ""
    samples = "" if source.with_samples else ", without samples"
    text = f"{target}: {made.runs} runs{under_way}{samples}, {made.bytes / 1e6:,.1f} MB"
    console.print(text, markup=False)
    if source.database is None:
        console.print("The database is on a server and not in here: back it up with pg_dump, now")
    return Exit.PASSED


def _say_restored(data: Path, restored: Restored, as_json: bool) -> Exit:
    if as_json:
        print_json({"data": str(data), "runs": restored.runs, "files": restored.files})
        return Exit.PASSED
    made = f"made {restored.told['made_at']} by version {restored.told['version']}"
    console = text_console()
    console.print(f"{data}: {restored.runs} runs from a backup {made}", markup=False)
    if restored.told["database"] != "sqlite":
        console.print(f"{DATABASE} is not in it: put the database back with pg_restore")
    return Exit.PASSED


def _refusal(detail: str) -> Refusal:
    return Refusal(Code.INVALID_REQUEST, detail)
