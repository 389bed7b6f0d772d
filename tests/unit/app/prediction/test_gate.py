"""Which predictions let a test start."""

import pytest

from app.errors import Code, Refusal
from app.prediction.gate import gate
from app.prediction.schemas import Computing, PredictionVerdict, Reason
from tests.a_prediction import a_prediction


@pytest.mark.parametrize(
    ("verdict", "reason", "code"),
    [
        ("clear", None, None),
        ("clear", "as it happens", None),
        ("caution", None, Code.OVERRIDE_NEEDED),
        ("caution", "  ", Code.OVERRIDE_NEEDED),
        ("caution", "It is what is looked for", None),
        ("refused", None, Code.PREDICTION_REFUSED),
        ("refused", "I know better", Code.PREDICTION_REFUSED),
    ],
)
def test_the_verdict_and_a_reason_decide(
    verdict: str, reason: str | None, code: Code | None
) -> None:
    found = a_prediction("key")
    found.prediction.verdict = PredictionVerdict(verdict)
    found.prediction.reasons = [
        Reason(code="x", text="The valve would saturate", severity="caution")
    ]
    answer = gate(found, reason)
    if code is None:
        assert answer is found
        return
    assert isinstance(answer, Refusal)
    assert answer.code is code
    assert "The valve would saturate" in answer.detail
    about = answer.about["prediction"]
    assert isinstance(about, dict)
    assert about["verdict"] == verdict


def test_what_is_being_computed_says_how_long_yet() -> None:
    answer = gate(Computing(share=0.5, seconds_left=12.3), None)
    assert isinstance(answer, Refusal)
    assert answer.code is Code.PREDICTION_PENDING
    assert answer.about == {"share": 0.5, "seconds_left": 12.3}
    assert "12 s more" in answer.detail
