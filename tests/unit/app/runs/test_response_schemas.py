from typing import get_args

from app.analysis.response.transfers import EVERY
from app.runs.response_schemas import TransferName


def test_every_transfer_that_is_estimated_can_be_told() -> None:
    assert list(get_args(TransferName)) == list(EVERY)
