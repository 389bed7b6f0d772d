"""The test that a run was made with, as it was then."""

from app.db import Database
from app.definitions.definition import Definition
from app.definitions.reading import definition_from
from app.errors import Code, Refusal
from app.histories.store import Store
from app.runs import repository


class TestsOfRuns:
    """Reads the definitions that runs were made with."""

    def __init__(self, database: Database, histories: Store) -> None:
        self._database = database
        self._histories = histories

    def definition(self, run_id: int) -> Definition | Refusal:
        """The definition of a run; refused where it or one of its time histories is gone."""
        with self._database.reading() as session:
            run = repository.get(session, run_id)
            if run is None:
                return Refusal(Code.UNKNOWN_RUN, f"There is no run {run_id} any more to run again")
            data = run.definition
        return definition_from(data, histories=self._histories)
