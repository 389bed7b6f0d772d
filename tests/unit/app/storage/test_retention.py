"""Retention: samples go, entries stay and say so; a kill in the middle is made good at the next start."""

from datetime import timedelta
from pathlib import Path

import pytest

from app.db import Database
from app.errors import Code, Refusal
from app.runs import repository
from app.runs.samples import RunWindows
from app.storage import retention as module
from app.storage.retention import Retainer
from app.storage.rule import Limits
from app.storage.schemas import RetentionChange, RetentionOut
from tests.unit.app.storage.stored_runs import FILES, NOW, REDUCED, database, enter, files

__all__ = ["database"]  # the fixture


def retainer(database: Database, tmp_path: Path, days_later: float = 0.0) -> Retainer:
    return Retainer(database, tmp_path / "runs", lambda: NOW + timedelta(days=days_later))


def change(keep_days: float | None, based_on: int = 0, *, apply: bool = False) -> RetentionChange:
    return RetentionChange(
        keep_days=keep_days, keep_bytes=None, keep_tags=["keep"], based_on=based_on, apply=apply
    )


def test_samples_go_and_the_entry_stays(database: Database, tmp_path: Path) -> None:
    runs_dir = tmp_path / "runs"
    old, kept, new = (
        enter(database, runs_dir, 40),
        enter(database, runs_dir, 40, "keep"),
        enter(database, runs_dir, 1),
    )
    rule = retainer(database, tmp_path).change(change(30, apply=True))
    assert isinstance(rule, RetentionOut)
    assert (rule.revision, rule.applied_at) == (1, NOW)
    assert files(runs_dir, old) == set(REDUCED)
    assert files(runs_dir, kept) == files(runs_dir, new) == set(FILES | REDUCED)
    with database.reading() as session:
        row = repository.get(session, old)
        assert row is not None
        assert (row.outcome, row.samples_removed_at) == ("completed", NOW)
    refusal = RunWindows(database, runs_dir).window(old, ["force_n"], 0, None, 10)
    assert isinstance(refusal, Refusal)
    assert refusal.detail == f"The samples of run {old} were removed by retention on 2026-03-01"


def test_a_preview_removes_nothing(database: Database, tmp_path: Path) -> None:
    run_id = enter(database, tmp_path / "runs", 40)
    preview = retainer(database, tmp_path).preview(Limits(keep_days=30))
    assert [(gone.id, gone.bytes) for gone in preview.runs] == [(run_id, 1010)]
    assert preview.bytes == 1010
    assert files(tmp_path / "runs", run_id) == set(FILES | REDUCED)
    assert retainer(database, tmp_path).preview().runs == []


def test_two_people_who_change_the_rule_do_not_overwrite_each_other(
    database: Database, tmp_path: Path
) -> None:
    assert not isinstance(retainer(database, tmp_path).change(change(30)), Refusal)
    refusal = retainer(database, tmp_path).change(change(1))
    assert isinstance(refusal, Refusal)
    assert refusal.code is Code.EDIT_CONFLICT
    assert retainer(database, tmp_path).rule().keep_days == 30


def test_it_is_applied_once_a_day(database: Database, tmp_path: Path) -> None:
    runs_dir = tmp_path / "runs"
    retainer(database, tmp_path).change(change(30))
    retainer(database, tmp_path).apply_daily()
    run_id = enter(database, runs_dir, 31)
    retainer(database, tmp_path, 0.9).apply_daily()
    assert files(runs_dir, run_id) == set(FILES | REDUCED)
    retainer(database, tmp_path, 1.0).apply_daily()
    assert files(runs_dir, run_id) == set(REDUCED)


def test_a_kill_between_book_and_files_is_made_good(
    database: Database, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    runs_dir = tmp_path / "runs"
    run_id = enter(database, runs_dir, 40)

    def killed(folder: Path) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr(module, "remove_samples", killed)
    with pytest.raises(KeyboardInterrupt):
        retainer(database, tmp_path).change(change(30, apply=True))
    monkeypatch.undo()
    assert files(runs_dir, run_id) == set(FILES | REDUCED)
    retainer(database, tmp_path).finish_removing()
    assert files(runs_dir, run_id) == set(REDUCED)
