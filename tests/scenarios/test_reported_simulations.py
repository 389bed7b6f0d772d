"""`forcerig simulate --report`: what was printed is in the report, and the same seed gives the same bytes."""

from pathlib import Path

import pypdfium2
import pytest
from typer.testing import CliRunner

from app.cli import cli

pytestmark = pytest.mark.slow


def simulated(*arguments: object) -> None:
    found = CliRunner().invoke(cli, ["simulate", "step-2-kn", *map(str, arguments)])
    assert found.exit_code == 0, found.output


def test_a_simulation_is_reported(tmp_path: Path) -> None:
    simulated("--report", tmp_path / "r.pdf")
    document = pypdfium2.PdfDocument(tmp_path / "r.pdf")
    texts = [page.get_textpage().get_text_range() for page in document]
    document.close()
    assert "PASSED" in texts[0]
    assert "3 of 3 criteria met" in texts[0]
    assert "virtual rig and clock, seed 1" in texts[0]
    assert "no tick can be late" in " ".join(" ".join(texts).split())
    assert "The ticks of this simulation were not kept" in " ".join(" ".join(texts).split())


def test_nothing_is_put_beside_the_files_that_were_asked_for(tmp_path: Path) -> None:
    simulated("--report", tmp_path / "r.pdf", "--out", tmp_path / "run.parquet")
    assert sorted(path.name for path in tmp_path.iterdir()) == ["r.pdf", "run.parquet"]


def test_the_same_seed_gives_the_same_report_and_another_one_another(tmp_path: Path) -> None:
    made = []
    for name, seed in (("a.html", 3), ("b.html", 3), ("c.html", 4)):
        simulated("--seed", seed, "--report", tmp_path / name)
        made.append((tmp_path / name).read_bytes())
    assert made[0] == made[1]
    assert made[0] != made[2]
