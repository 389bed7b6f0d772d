"""What is expected of the runs under way: kept in memory, for the status asks ten times a second."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from app.db import Database
from app.runs import repository


@dataclass(frozen=True)
class Plan:
    """What a run comes to, as `app.definitions.outline` has it."""

    test_name: str
    blocks: tuple[dict[str, Any], ...]
    duration_s: float

    def cycles(self, block: int) -> int | None:
        """The counted cycles of a block, None where it has none."""
        known = 0 <= block < len(self.blocks)
        return (int(self.blocks[block]["cycles"]) or None) if known else None


class Plans:
    """The plan of the run under way, by its number."""

    def __init__(self) -> None:
        self._plans: dict[int, Plan] = {}

    def __getitem__(self, run_id: int) -> Plan | None:
        return self._plans.get(run_id)

    def remember(self, run_id: int, test_name: str, plan: Mapping[str, Any]) -> None:
        """A run has begun: forget those before it."""
        blocks, duration_s = tuple(plan["blocks"]), float(plan["duration_s"])
        self._plans = {run_id: Plan(test_name, blocks, duration_s)}

    def recall(self, database: Database) -> None:
        """After a restart of the app: the run that may still be under way."""
        with database.reading() as session:
            for run in repository.without_outcome(session):
                self.remember(run.id, run.test_name, run.plan)
