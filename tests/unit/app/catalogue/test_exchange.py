"""Libraries of tests as files: out and in without loss, and nothing hostile gets in."""

import io
import zipfile
from pathlib import Path
from typing import Any

import pytest
from hypothesis import HealthCheck, assume, given, settings
from hypothesis import strategies as st

from app.catalogue import archive
from app.catalogue.archive import pack, unpack
from app.catalogue.exchange import Library
from app.catalogue.saving import Saved
from app.catalogue.service import Catalogue
from app.catalogue.written import Reader, Written
from app.db import Database
from app.errors import Code, Refusal
from app.histories.store import Store
from tests.unit.app.catalogue.written_tests import YAML, entered
from tests.unit.app.definitions import strategies

tags = st.lists(
    st.text(st.characters(codec="utf-8", exclude_categories=["C", "Z"]), min_size=1), max_size=3
)


def unpacked(packed: bytes | Refusal) -> dict[str, str]:
    assert isinstance(packed, bytes)
    files = unpack(packed)
    assert not isinstance(files, Refusal), files.detail
    return files


def contents(catalogue: Catalogue) -> dict[str, tuple[Any, str, list[str]]]:
    found = {}
    for summary in catalogue.list_tests():
        detail = catalogue.get_test(summary.id)
        assert not isinstance(detail, Refusal)
        found[detail.id] = (detail.definition, detail.yaml, detail.tags)
    return found


@settings(max_examples=15, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(st.lists(st.tuples(strategies.definitions(strategies.smooth_blocks), tags), max_size=4))
def test_what_is_exported_and_imported_elsewhere_is_the_same(
    tmp_path_factory: pytest.TempPathFactory, made: list[tuple[Any, list[str]]]
) -> None:
    folder = tmp_path_factory.mktemp("exchange")
    reader = Reader(Store(folder / "histories"))
    here, there = (Database(f"sqlite:///{folder / name}") for name in ("here", "there"))
    for database in (here, there):
        database.upgrade()
    catalogue, other = Catalogue(here, reader), Catalogue(there, reader)
    for data, given_tags in made:
        read = reader.data(data)
        assume(isinstance(read, Written))
        assert isinstance(read, Written)
        entered_as = catalogue.create(read, Saved(tags=sorted({t[:50] for t in given_tags})))
        assert not isinstance(entered_as, Refusal)
    files = unpacked(Library(here, reader).export(None, None))
    imported = Library(there, reader).enter(files)
    if made:
        assert not isinstance(imported, Refusal), imported.detail
        assert {one.action for one in imported.imported} == {"created"}
    assert contents(other) == contents(catalogue)
    here.close()
    there.close()


def test_what_is_there_gets_a_revision_only_where_it_differs(
    catalogue: Catalogue, library: Library
) -> None:
    same, other = entered(catalogue).id, entered(catalogue).id
    catalogue.set_archived(same, True)
    changed = YAML.replace("1000,", "1500,")
    done = library.enter({f"{same}.yaml": YAML, f"{other}.yml": changed, "new.yaml": YAML}, "Anna")
    assert not isinstance(done, Refusal)
    assert [(one.id, one.action) for one in done.imported] == [
        (same, "unchanged"),
        (other, "revised"),
        ("new", "created"),
    ]
    detail = catalogue.get_test(other)
    assert not isinstance(detail, Refusal)
    assert (detail.revision, detail.author, detail.yaml) == (2, "Anna", changed)
    assert same in [test.id for test in catalogue.list_tests()]


def test_where_one_is_refused_none_is_entered(catalogue: Catalogue, library: Library) -> None:
    refused = library.enter(
        {
            "good.yaml": YAML,
            "bad.yaml": YAML.replace("ramp", "jerk"),
            "folder/in.yaml": YAML,
            "..": YAML,
            "c:\\x.yaml": YAML,
            "readme.txt": "hello",
            "good.json": "{}",
        }
    )
    assert isinstance(refused, Refusal)
    assert {fault.path.split(":")[0] for fault in refused.faults} == {
        *("bad.yaml", "folder/in.yaml", "..", "c", "readme.txt", "good.json"),
    }
    assert catalogue.list_tests() == []


def test_two_files_of_one_id_are_refused(library: Library) -> None:
    refused = library.enter({"a b.yaml": YAML, "a-b.yaml": YAML})
    assert isinstance(refused, Refusal)
    assert "has the id of a b.yaml" in refused.detail


def test_nothing_to_import_is_said(library: Library) -> None:
    assert isinstance(library.enter({}), Refusal)


def zipped(**options: Any) -> bytes:
    buffer = io.BytesIO()
    with zipfile.ZipFile(buffer, "w", zipfile.ZIP_DEFLATED) as file:
        for name, content in options.items():
            file.writestr(name, content)
    return buffer.getvalue()


def test_a_zip_that_unpacks_to_too_much_is_refused_before_it_has(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(archive, "MOST_UNPACKED_BYTES", 1_000_000)
    bomb = zipped(**{f"{i}.yaml": b" " * 400_000 for i in range(4)})
    assert len(bomb) < 10_000
    refused = unpack(bomb)
    assert isinstance(refused, Refusal)
    assert refused.faults[0].path == "2.yaml"


def test_a_zip_that_lies_about_a_size_is_refused() -> None:
    packed = bytearray(pack({"a.yaml": "x" * 1000}))
    for signature, offset in ((b"PK\x03\x04", 22), (b"PK\x01\x02", 24)):
        at = packed.index(signature) + offset
        packed[at : at + 4] = (5).to_bytes(4, "little")
    assert isinstance(unpack(bytes(packed)), Refusal)


@pytest.mark.parametrize(
    "packed",
    [
        b"",
        b"PK\x03\x04",
        b"no zip",
        pack({"a.yaml": YAML})[:-30],
        zipped(**{"a.yaml": b"\xff\xfe"}),
    ],
    ids=["empty", "begun", "text", "cut off", "no UTF-8"],
)
def test_what_is_no_zip_is_refused(packed: bytes) -> None:
    refused = unpack(packed)
    assert isinstance(refused, Refusal)
    assert refused.code is Code.INVALID_REQUEST


def test_the_same_library_is_the_same_file(library: Library, catalogue: Catalogue) -> None:
    entered(catalogue)
    assert library.export(None, None) == library.export(["morning-hold"], None)
    missing = library.export(["nowhere"], None)
    assert isinstance(missing, Refusal)
    assert missing.code is Code.UNKNOWN_TEST


def test_a_broken_zip_never_raises(tmp_path: Path) -> None:
    whole = pack({"library.yaml": "library: 1", "a.yaml": YAML})
    for i in range(len(whole)):
        for value in (0, 255, whole[i] ^ 1):
            found = unpack(whole[:i] + bytes([value]) + whole[i + 1 :])
            assert isinstance(found, dict | Refusal)
