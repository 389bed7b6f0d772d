"""What commands print goes where it belongs."""

import json

import pytest

from app.commands.output import Exit, print_refusal, progress_bar
from app.documents.refusal import Problem, refuse
from app.errors import Code

REFUSAL = refuse(
    Code.INVALID_TEST, "[bold]x.yaml", [Problem("a", 1, "must be [2]", limit=2.0, unit="N", line=3)]
)


def test_a_refusal_is_one_document_on_standard_output_and_a_sentence_beside_it(
    capsys: pytest.CaptureFixture[str],
) -> None:
    assert print_refusal(REFUSAL, as_json=True) is Exit.BAD_INPUT
    said = capsys.readouterr()
    assert json.loads(said.out)["errors"][0]["limit"] == 2.0
    assert said.err == "[bold]x.yaml: line 3, a: must be [2]\n"  # as it is: nothing is markup


def test_progress_is_shown_on_terminals_only(capsys: pytest.CaptureFixture[str]) -> None:
    with progress_bar("Simulating") as progress:
        progress(0.5)
    said = capsys.readouterr()
    assert (said.out, said.err) == ("", "")
