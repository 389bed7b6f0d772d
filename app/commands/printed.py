"""How the result of a command is printed."""

from dataclasses import dataclass


@dataclass(frozen=True)
class Printed:
    """A table for people where neither is asked for."""

    as_json: bool = False
    as_csv: bool = False
