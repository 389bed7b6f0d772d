"""`forcerig audit verify` and `forcerig audit list`: whether a console runs or not."""

from collections.abc import Callable
from pathlib import Path
from typing import TypeVar

from sqlalchemy.exc import SQLAlchemyError

from app.audit.schemas import AuditEntry
from app.audit.service import Audit
from app.audit.sought import Sought
from app.commands.output import Exit, print_json, print_refusal, text_console
from app.db import Database
from app.errors import Code, Refusal
from app.settings import Settings

T = TypeVar("T")


def verify(data: Path | None, as_json: bool) -> Exit:
    """Walk the chain. Ends with 0 intact, 1 broken, 2 not found or not readable."""
    found = _asked(data, Audit.verify)
    if isinstance(found, Refusal):
        return print_refusal(found, as_json)
    if as_json:
        print_json(found.model_dump(mode="json"))
    else:
        console = text_console()
        console.print(f"{'Intact' if found.intact else 'Broken'}: {found.detail}", markup=False)
        console.print(f"Newest hash in order: {found.hash or 'none'}")
    return Exit.PASSED if found.intact else Exit.FAILED


def list_entries(data: Path | None, sought: Sought, limit: int, as_json: bool) -> Exit:
    """Print the newest entries among those that are sought, the newest first."""
    found = _asked(data, lambda audit: audit.page(sought, limit, None))
    if isinstance(found, Refusal):
        return print_refusal(found, as_json)
    if as_json:
        print_json([entry.model_dump(mode="json") for entry in found.entries])
    else:
        for entry in found.entries:
            text_console().print(_line(entry), markup=False)
    return Exit.PASSED


def _asked(data: Path | None, ask: Callable[[Audit], T]) -> T | Refusal:
    settings = Settings() if data is None else Settings(data_dir=data)
    address = settings.database_address
    path = Path(address.removeprefix("sqlite:///"))
    if address.startswith("sqlite") and not path.is_file():
        return _refusal(f"There is no database {path}: has a console been started there?")
    database = Database(address)
    try:
        return ask(Audit(database, settings.data_dir))
    except SQLAlchemyError as error:
        first = str(error).partition("\n")[0]
        return _refusal(f"The audit cannot be read: {first}")
    finally:
        database.close()


def _refusal(detail: str) -> Refusal:
    return Refusal(Code.INVALID_REQUEST, detail)


def _line(entry: AuditEntry) -> str:
    why = f" ({entry.why})" if entry.why else ""
    who = f"{entry.who}, {entry.role}"
    return f"{entry.id:>6}  {entry.at}  {who}: {entry.action} {entry.target}, {entry.outcome}{why}"
