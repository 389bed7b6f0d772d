"""Tests in the catalogue: ids, revisions that never change, conflicts, and what can still be run."""

from concurrent.futures import ThreadPoolExecutor

import pytest
from sqlalchemy import update

from app.catalogue.models import Test, TestRevision
from app.catalogue.saving import Saved
from app.catalogue.service import Catalogue, StoredTest
from app.catalogue.shipped import enter_shipped
from app.catalogue.written import Reader, Written, slug
from app.db import Database
from app.definitions.library import library, library_text
from app.errors import Code, Refusal
from tests.a_run import a_run
from tests.unit.app.catalogue.written_tests import YAML, entered, written


@pytest.mark.parametrize(
    ("name", "expected"),
    [
        ("Hold 50 kN", "hold-50-kn"),
        ("  Größte Kraft! ", "grosste-kraft"),
        ("試験", "test"),
        ("a" * 200, "a" * 80),
        ("--", "test"),
    ],
)
def test_a_name_becomes_an_id(name: str, expected: str) -> None:
    assert slug(name) == expected


def test_of_the_same_name_each_has_a_number(catalogue: Catalogue) -> None:
    assert [entered(catalogue).id for _ in range(3)] == [
        "morning-hold",
        "morning-hold-2",
        "morning-hold-3",
    ]
    longer = entered(catalogue, YAML.replace("Morning hold ", "Morning hold 2 x "))
    assert longer.id == "morning-hold-2-x"


def test_many_who_enter_the_same_name_at_once_all_get_their_own(catalogue: Catalogue) -> None:
    with ThreadPoolExecutor(4) as threads:
        made = list(threads.map(lambda _: entered(catalogue).id, range(8)))
    assert len(set(made)) == 8


def test_of_many_who_save_on_top_of_the_same_one_is_first(catalogue: Catalogue) -> None:
    test_id = entered(catalogue).id

    def save(force_n: int) -> Test | Refusal:
        text = YAML.replace("1000,", f"{force_n},")
        return catalogue.save(test_id, written(text), Saved(f"number {force_n}"), 1)

    with ThreadPoolExecutor(4) as threads:
        results = list(threads.map(save, range(100, 106)))
    refused = [result for result in results if isinstance(result, Refusal)]
    assert [refusal.code for refusal in refused] == [Code.EDIT_CONFLICT] * 5
    assert {refusal.about["current_revision"] for refusal in refused} == {2}
    revisions = catalogue.revisions(test_id)
    assert not isinstance(revisions, Refusal)
    assert [revision.number for revision in revisions] == [2, 1]


def test_what_comes_as_data_keeps_the_comments_where_nothing_changed(
    catalogue: Catalogue, reader: Reader
) -> None:
    test_id = entered(catalogue).id
    data = reader.data(written().data)
    assert isinstance(data, Written)
    kept = catalogue.save(test_id, data, Saved(), 1)
    assert not isinstance(kept, Refusal)
    assert kept.revision == 1
    detail = catalogue.get_test(test_id)
    assert not isinstance(detail, Refusal)
    assert detail.yaml == YAML


def test_a_comment_alone_is_a_new_revision(catalogue: Catalogue) -> None:
    test_id = entered(catalogue).id
    saved = catalogue.save(test_id, written(YAML + "# more\n"), Saved(), 1)
    assert not isinstance(saved, Refusal)
    assert saved.revision == 2


def test_what_is_run_is_the_revision_that_was_asked_for(catalogue: Catalogue) -> None:
    test_id = entered(catalogue).id
    catalogue.save(test_id, written(YAML.replace("Morning", "Evening")), Saved(), 1)
    newest, first = catalogue.definition_of(test_id), catalogue.definition_of(test_id, 1)
    assert isinstance(newest, StoredTest)
    assert isinstance(first, StoredTest)
    assert (newest.revision, newest.name) == (2, "Evening hold")
    assert (first.revision, first.definition.name) == (1, "Morning hold")
    assert isinstance(catalogue.definition_of(test_id, 3), Refusal)
    catalogue.set_archived(test_id, True)
    refused = catalogue.definition_of(test_id)
    assert isinstance(refused, Refusal)
    assert refused.code is Code.TEST_ARCHIVED


def test_what_is_valid_no_longer_is_shown_and_not_run(
    catalogue: Catalogue, database: Database
) -> None:
    test_id = entered(catalogue).id
    with database.writing() as session:  # as an earlier version may have saved it
        text = YAML.replace("kind: ramp", "kind: jerk")
        session.execute(update(TestRevision).values(yaml=text))
    detail = catalogue.get_test(test_id)
    assert not isinstance(detail, Refusal)
    assert detail.outline is None
    refused = catalogue.definition_of(test_id)
    assert isinstance(refused, Refusal)
    assert "was valid when it was saved" in refused.detail
    assert refused.faults[0].path == "blocks[0].kind"


def test_runs_are_counted_for_each_test(catalogue: Catalogue, database: Database) -> None:
    test_id = entered(catalogue).id
    with database.writing() as session:
        session.add_all([a_run(session, test_id=test_id) for _ in range(3)])
        session.add(a_run(session, test_id="another"))
    (summary,) = catalogue.list_tests()
    assert summary.runs == 3
    assert summary.last_run_at is not None


def test_what_ships_is_entered_once_and_then_left_alone(
    catalogue: Catalogue, database: Database, reader: Reader
) -> None:
    enter_shipped(database, reader)
    ids = sorted(library())
    assert [test.id for test in catalogue.list_tests()] == ids
    catalogue.set_archived(ids[0], True)
    changed = written(library_text(ids[1]) + "# mine\n")
    catalogue.save(ids[1], changed, Saved("Anna"), 1)
    enter_shipped(database, reader)
    assert [test.id for test in catalogue.list_tests()] == ids[1:]
    detail = catalogue.get_test(ids[1])
    assert not isinstance(detail, Refusal)
    assert (detail.revision, detail.author) == (2, "Anna")


def test_a_copy_has_a_name_of_its_own_and_the_same_text_otherwise(catalogue: Catalogue) -> None:
    test_id = entered(catalogue, tags=["a"]).id
    copy = catalogue.clone(test_id, "off: # 1", "Otto")
    assert not isinstance(copy, Refusal)
    detail = catalogue.get_test(copy.id)
    assert not isinstance(detail, Refusal)
    assert (detail.name, detail.tags, detail.author) == ("off: # 1", ["a"], "Otto")
    assert detail.yaml == YAML.replace("name: Morning hold   # said aloud", 'name: "off: # 1"')


def test_a_name_with_a_character_that_cannot_be_kept_is_refused(reader: Reader) -> None:
    refused = reader.data(written().data | {"name": "a\0b"})
    assert isinstance(refused, Refusal)
    assert refused.faults[0].path == "name"
