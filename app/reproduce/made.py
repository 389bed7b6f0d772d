"""A reproduced figure as data: columns, numbers beside the paper's, and how it is drawn."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
from matplotlib.figure import Figure as Canvas

Floats = npt.NDArray[np.float64]
Progress = Callable[[float], None]


@dataclass(frozen=True)
class Beside:
    """A number of ours beside the paper's, or beside the rig's data sheet; None where that gives none."""

    what: str
    unit: str
    ours: float | None
    paper: float | None = None
    sheet: float | None = None
    note: str = ""


@dataclass(frozen=True)
class Sheet:
    """Columns of one length; each name ends in its unit, as everywhere."""

    name: str
    columns: Mapping[str, Floats]


@dataclass(frozen=True)
class Reproduced:
    """All of a figure. `caption` is the paper's own; `honest` says where ours differs, and why."""

    name: str
    caption: str
    numbers: tuple[Beside, ...]
    sheets: tuple[Sheet, ...]
    draw: Callable[[], Canvas]
    honest: tuple[str, ...]


Make = Callable[[Progress], Reproduced]
