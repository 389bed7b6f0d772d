"""The examples that ship with forcerig: entered once each, then tests like all others."""

from app.catalogue import repository
from app.catalogue.saving import Saved, enter
from app.catalogue.written import Reader
from app.db import Database
from app.definitions.library import library, library_text
from app.errors import Refusal
from app.settings import VERSION

_SHIPPED = Saved("forcerig", f"Ships with forcerig {VERSION}", ["example"])


def enter_shipped(database: Database, reader: Reader) -> None:
    """Enter the examples that are not there yet. What was changed or archived stays as it is."""
    with database.writing() as session:
        known = repository.ids(session)
        for test_id in library():
            if test_id not in known:
                written = reader.yaml(library_text(test_id), test_id)
                assert not isinstance(written, Refusal), written.detail
                enter(session, test_id, written, _SHIPPED)
