"""Tests as people write them."""

from app.catalogue.models import Test
from app.catalogue.saving import Saved
from app.catalogue.service import Catalogue
from app.catalogue.written import Reader, Written
from app.errors import Refusal

YAML = """\
# For the morning.
schema: 1
name: Morning hold   # said aloud
blocks:
  - {kind: ramp, to_n: 1000, rate_n_s: 1000}
"""


def written(text: str = YAML) -> Written:
    """A test that is valid."""
    found = Reader(_NoHistories()).yaml(text)
    assert isinstance(found, Written), found
    return found


def entered(catalogue: Catalogue, text: str = YAML, **saved: object) -> Test:
    """A test that is in the catalogue."""
    test = catalogue.create(written(text), Saved(**saved))  # type: ignore[arg-type]
    assert not isinstance(test, Refusal), test.detail
    return test


class _NoHistories:
    def find(self, name: str, rate_hz: float | None) -> str:
        return f"there is no time history {name}"
