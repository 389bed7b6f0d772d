"""How the result of a command is printed."""

import csv
import sys
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any


@dataclass(frozen=True)
class Printed:
    """A table for people where neither is asked for."""

    as_json: bool = False
    as_csv: bool = False


def print_csv(rows: Sequence[dict[str, Any]]) -> None:
    """Rows of the same names, which are the header."""
    if rows:
        writer = csv.DictWriter(sys.stdout, list(rows[0]), lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)
