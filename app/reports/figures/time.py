"""Channels over time. Where ticks are many, the least and the greatest of each stretch: a spike is never lost."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt
from matplotlib.axes import Axes

from app.reports.figures.style import GREY, PALE, as_svg, canvas, styled, tell

Floats = npt.NDArray[np.float64]
PANEL_MM, AXIS_MM = 34.0, 10.0


@dataclass(frozen=True)
class Trace:
    """A channel: (n,) times (s), (n,) least and greatest, in the unit of its panel."""

    label: str
    time_s: Floats
    low: Floats
    high: Floats
    colour: str
    dash: str = "-"

    @property
    def is_band(self) -> bool:
        """Whether a stretch has more than one tick."""
        return self.low is not self.high


@dataclass(frozen=True)
class Panel:
    """Axes one above the other; `marks` are times (s) with a word each."""

    label: str
    traces: Sequence[Trace]
    lines: Sequence[tuple[float, str]] = ()


def time_figure(
    panels: Sequence[Panel], marks: Sequence[tuple[float, str]] = (), panel_mm: float = PANEL_MM
) -> bytes:
    """SVG of panels over one axis of time."""
    with styled():
        drawn = canvas(panel_mm * len(panels) + AXIS_MM)
        every = drawn.subplots(len(panels), 1, sharex=True, squeeze=False)[:, 0]
        for axes, panel in zip(every, panels, strict=True):
            for trace in panel.traces:
                _draw(axes, trace)
            for at, label in panel.lines:
                axes.axhline(at, color=GREY, lw=0.6, ls=":", label=label)
            for at_s, _ in marks:
                axes.axvline(at_s, color=PALE, lw=0.6, zorder=0)
            axes.set_ylabel(panel.label)
            axes.margins(x=0.0)
            tell(axes)
        every[-1].set_xlabel("Time (s)")
        drawn.align_ylabels(list(every))
        return as_svg(drawn)


def _draw(axes: Axes, trace: Trace) -> None:
    """A band is filled; one that is dashed is only outlined, so that what lies under it is seen."""
    style: dict[str, Any] = {"color": trace.colour, "label": trace.label}
    if not trace.is_band:
        axes.plot(trace.time_s, trace.low, ls=trace.dash, **style)
    elif trace.dash == "-":
        axes.fill_between(trace.time_s, trace.low, trace.high, lw=0.4, **style)
    else:
        axes.plot(trace.time_s, trace.high, lw=0.5, ls="-", **style)
        axes.plot(trace.time_s, trace.low, lw=0.5, ls="-", color=trace.colour)
