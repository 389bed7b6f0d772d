"""Where the data are, and how to know that they are the same ones: SHA-256 of the file."""

import hashlib
from pathlib import Path

from app.reports.numbers import duration
from app.reports.report import Facts, Section, Words
from app.reports.subject import Subject

_PIECE = 1 << 22


def data(subject: Subject) -> Section:
    """File, ticks and checksum."""
    path = subject.data_file
    if path is None or not path.exists():
        return Section("Data", (Words(f"{subject.without_samples}: there is no file to check."),))
    facts = (
        ("File", path.name),
        ("Size", f"{path.stat().st_size:,} bytes"),
        ("SHA-256", checksum(path)),
        ("Ticks", f"{subject.ticks:,}, {duration(subject.ticks * subject.period_s)}"),
        ("First tick", f"{subject.origin:,}"),
    )
    return Section("Data", (Facts(facts),))


def checksum(path: Path) -> str:
    """SHA-256 of a file, in hexadecimal. Raises `OSError`."""
    found = hashlib.sha256()
    with path.open("rb") as file:
        while piece := file.read(_PIECE):
            found.update(piece)
    return found.hexdigest()
