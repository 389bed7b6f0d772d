"""One style for every figure: greys and one dark blue, lines told apart by dashes as well, no clock, no chance."""

from collections.abc import Iterator
from contextlib import contextmanager
from io import BytesIO
from typing import Any, cast

import matplotlib as mpl
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.backends.backend_svg import FigureCanvasSVG
from matplotlib.figure import Figure as Canvas

from app.reports.figures.colours import GREY, GRID, INK

WIDTH_MM = 170.0  # the text's, on A4
SERIES = (  # colour, dash and marker: any of the three tells them apart
    ("#12476b", "-", "o"),
    ("#b06a00", "--", "s"),
    ("#4d7a3a", "-.", "^"),
    ("#7a3b69", ":", "D"),
    ("#5a5f63", (0, (5, 1, 1, 1, 1, 1)), "v"),
    ("#1a1a1a", (0, (1, 1)), "x"),
)
_STYLE: dict[str, Any] = {
    "font.family": "DejaVu Sans",  # comes with matplotlib: no font of the machine's
    "font.size": 7.0,
    "axes.edgecolor": GREY,
    "axes.labelcolor": INK,
    "axes.linewidth": 0.5,
    "axes.grid": True,
    "axes.axisbelow": True,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.formatter.use_mathtext": False,
    "axes.formatter.useoffset": False,
    "axes.unicode_minus": True,
    "grid.color": GRID,
    "grid.linewidth": 0.5,
    "lines.linewidth": 0.9,
    "lines.markersize": 3.0,
    "legend.frameon": False,
    "legend.fontsize": 6.5,
    "legend.handlelength": 2.2,
    "xtick.color": GREY,
    "ytick.color": GREY,
    "xtick.labelcolor": INK,
    "ytick.labelcolor": INK,
    "xtick.major.width": 0.5,
    "ytick.major.width": 0.5,
    "xtick.minor.width": 0.3,
    "ytick.minor.width": 0.3,
    "figure.constrained_layout.use": True,
    "path.simplify": True,
    "text.parse_math": False,  # a name with dollars in it is a name
    "svg.fonttype": "path",
    "svg.hashsalt": "forcerig",
}


@contextmanager
def styled() -> Iterator[None]:
    """Draw in here."""
    with mpl.rc_context():
        mpl.rcdefaults()  # whatever the machine's own matplotlibrc says
        for name, value in _STYLE.items():
            mpl.rcParams[name] = value  # type: ignore[index]  # mypy wants each name as a literal
        yield


def canvas(height_mm: float, width_mm: float = WIDTH_MM) -> Canvas:
    """An empty figure; never by pyplot, which keeps all of them."""
    return Canvas(figsize=(width_mm / 25.4, height_mm / 25.4))


def as_svg(drawn: Canvas) -> bytes:
    """The same bytes for the same drawing."""
    written, painter = BytesIO(), cast(Any, FigureCanvasSVG(drawn))
    # Not `savefig`, which draws everything once more only to ask how large it is.
    painter.print_svg(written, metadata={"Date": None, "Creator": None})
    return written.getvalue()


def as_png(drawn: Canvas, dpi: float = 200.0) -> bytes:
    """The same, in pixels."""
    FigureCanvasAgg(drawn)
    written = BytesIO()
    drawn.savefig(written, format="png", dpi=dpi, metadata={"Software": None})
    return written.getvalue()


def tell(axes: Axes, **more: Any) -> None:
    """A legend above the axes, out of the way of the data."""
    lines, labels = axes.get_legend_handles_labels()
    if labels:
        many = len(labels)
        axes.legend(
            lines,
            labels,
            loc="lower right",
            bbox_to_anchor=(1.0, 1.0),
            borderaxespad=0.1,
            ncols=min(many, 6),
            **more,
        )
