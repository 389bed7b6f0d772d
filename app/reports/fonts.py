"""Where the fonts of reports are: typst brings the text's, matplotlib those of the figures; none is the machine's."""

from importlib.util import find_spec
from pathlib import Path


def figure_fonts() -> Path:
    """The folder of DejaVu Sans, found without loading matplotlib."""
    found = find_spec("matplotlib")
    assert found is not None
    assert found.origin is not None
    return Path(found.origin).parent / "mpl-data" / "fonts" / "ttf"
