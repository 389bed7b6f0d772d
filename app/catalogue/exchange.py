"""Tests that come from files and go into files: all of them, or none."""

from collections.abc import Collection, Mapping
from dataclasses import dataclass
from pathlib import PurePosixPath
from typing import Literal

from sqlalchemy.orm import Session

from app.catalogue import repository
from app.catalogue.archive import pack
from app.catalogue.library_index import INDEX, Entry, Index, index_text, read_index
from app.catalogue.refusals import unknown
from app.catalogue.saving import (
    Saved,
    add_revision,
    enter,
    is_unchanged,
    set_archived,
    set_tags,
)
from app.catalogue.schemas import Imported, ImportedTest
from app.catalogue.written import Reader, Written, slug
from app.db import Database
from app.documents.refusal import Problem
from app.errors import Code, Fault, Refusal

_SUFFIXES = (".yaml", ".yml", ".json")


@dataclass(frozen=True)
class _Incoming:
    """A file that is a valid test."""

    name: str
    test_id: str
    written: Written
    tags: Collection[str]


class Library:
    """All tests, as files."""

    def __init__(self, database: Database, reader: Reader) -> None:
        self._database = database
        self._reader = reader

    def export(self, ids: Collection[str] | None, tag: str | None) -> bytes | Refusal:
        """A zip of these tests, or of all that are not archived (with a tag), and an index."""
        with self._database.reading() as session:
            if ids is None:
                rows = repository.newest(session, archived=False, tag=tag, after=None, limit=None)
                ids = [row.test.id for row in rows]
            rows = repository.newest_of(session, ids)
            missing = sorted(set(ids) - {row.test.id for row in rows})
            if missing:
                return unknown(missing[0])
            tags = repository.tags_of(session, [row.test.id for row in rows])
            files = {f"{row.test.id}.yaml": row.revision.yaml for row in rows}
            entries = [
                Entry(file=f"{row.test.id}.yaml", id=row.test.id, tags=tags.get(row.test.id, []))
                for row in rows
            ]
        return pack({INDEX: index_text(Index(tests=tuple(entries))), **files})

    def enter(self, files: Mapping[str, str], author: str = "") -> Imported | Refusal:
        """Enter the tests in some files; where one is refused, none is entered.

        A file's test is the one that the index names, else the one whose id is the file's name.
        """
        incoming = _read(self._reader, files)
        if isinstance(incoming, Refusal):
            return incoming
        with self._database.writing() as session:
            done = [_enter(session, one, author) for one in incoming]
        return Imported(imported=done)


def _read(reader: Reader, files: Mapping[str, str]) -> list[_Incoming] | Refusal:
    index = read_index(files[INDEX]) if INDEX in files else Index()
    if isinstance(index, Refusal):
        return index
    entries = {entry.file: entry for entry in index.tests}
    found: dict[str, _Incoming] = {}
    faults = [
        Fault(f"{INDEX}:tests", name, "is not among the files")
        for name in entries
        if name not in files
    ]
    for name, text in files.items():
        if name == INDEX:
            continue
        one = _read_one(reader, name, text, entries.get(name))
        if isinstance(one, Refusal):
            faults += [_in_file(name, fault) for fault in one.faults]
        elif one.test_id in found:
            first = found[one.test_id].name
            faults.append(Fault(name, one.test_id, f"has the id of {first}: rename one of them"))
        else:
            found[one.test_id] = one
    if not found and not faults:
        faults = [Fault("", None, "there is no test in it: a test is a .yaml or .json file")]
    if faults:
        lines = [f"{fault.path}: {fault.expected}".removeprefix(": ") for fault in faults]
        return Refusal(Code.INVALID_TEST, "\n".join(lines), tuple(faults))
    return list(found.values())


def _read_one(reader: Reader, name: str, text: str, entry: Entry | None) -> _Incoming | Refusal:
    refusal = _why_no_test(name)
    if refusal is not None:
        return refusal
    path = PurePosixPath(name)
    written = reader.yaml(text, name or "test", is_json=path.suffix.lower() == ".json")
    if isinstance(written, Refusal):
        return written
    if entry is not None:
        return _Incoming(name, entry.id, written, entry.tags)
    return _Incoming(name, slug(path.stem or written.definition.name), written, ())


def _why_no_test(name: str) -> Refusal | None:
    """What is wrong with a file's name; a text that came without one is named after its test."""
    path = PurePosixPath(name)
    if path.name != name or "\\" in name or name.startswith("."):
        return _refuse("must be a file by itself, in no folder")
    if name and path.suffix.lower() not in _SUFFIXES:
        return _refuse("must be a test as .yaml or .json")
    return None


def _refuse(message: str) -> Refusal:
    return Refusal(Code.INVALID_TEST, message, (Fault("", None, message),))


def _in_file(name: str, fault: Fault) -> Problem:
    path = f"{name}:{fault.path}" if fault.path else name
    more = {key: getattr(fault, key, None) for key in ("limit", "unit", "line")}
    return Problem(path, fault.value, fault.expected, **more)


def _enter(session: Session, one: _Incoming, author: str) -> ImportedTest:
    """Enter a test, or a revision on top of what is there; its tags come to those that it has."""
    action: Literal["created", "revised", "unchanged"] = "created"
    origin = f"Imported from {one.name}" if one.name else "Imported"
    saved = Saved(author, origin, list(one.tags))
    test = repository.to_change(session, one.test_id)
    if test is None:
        enter(session, one.test_id, one.written, saved)
        return ImportedTest(name=one.name, id=one.test_id, action=action)
    newest = repository.revision(session, test.id, test.revision)
    action = "unchanged"
    if newest is None or not is_unchanged(newest, one.written):
        add_revision(session, test, one.written, saved)
        action = "revised"
    known = repository.tags_of(session, [test.id]).get(test.id, [])
    if not set(one.tags) <= set(known):
        set_tags(session, test.id, sorted({*known, *one.tags}))
    set_archived(session, test, False)  # who imports it wants to have it
    return ImportedTest(name=one.name, id=test.id, action=action)
