"""Channels over time. Where ticks are many, the least and the greatest of each stretch: a spike is never lost."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from app.reports.figures.colours import GREY, GRID, PALE
from app.reports.figures.drawing import CHARACTER, Drawing
from app.reports.figures.ticks import Axis, axis

Floats = npt.NDArray[np.float64]
MM = 72.0 / 25.4
WIDTH = 170.0 * MM
LEFT, RIGHT, ABOVE, BELOW, GAP = 42.0, 6.0, 11.0, 24.0, 5.0
PANEL_MM = 30.0
SAMPLE = 16.0  # how long a line in a legend is
DASHES = {"-": "", "--": "3 1.5", ":": "1 1.2", "-.": "4 1.5 1 1.5"}


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
    """Axes with what is up, and the traces in them."""

    label: str
    traces: Sequence[Trace]


def time_figure(
    panels: Sequence[Panel], marks: Sequence[float] = (), panel_mm: float = PANEL_MM
) -> bytes:
    """SVG of panels one above the other over one axis of time; `marks` are times (s) to be seen."""
    height = panel_mm * MM
    drawing = Drawing(WIDTH, height * len(panels) + BELOW)
    ends = [t.time_s[[0, -1]] for panel in panels for t in panel.traces if len(t.time_s)]
    low, high = (min(e[0] for e in ends), max(e[1] for e in ends)) if ends else (0.0, 1.0)
    time = axis(float(low), float(high), 10)
    for i, panel in enumerate(panels):
        _Axes(drawing, time, i * height + ABOVE, (i + 1) * height - GAP).draw(panel, marks)
    bottom = height * len(panels) - GAP
    for at, text in time.ticks:
        drawing.words(_across(time, at), bottom + 9.0, text, anchor="middle")
    middle = 0.5 * (LEFT + WIDTH - RIGHT)
    drawing.words(middle, bottom + 20.0, "Time (s)", anchor="middle")
    return drawing.svg()


@dataclass(frozen=True)
class _Axes:
    """A panel's place in the drawing, between two heights."""

    drawing: Drawing
    time: Axis
    top: float
    bottom: float

    def draw(self, panel: Panel, marks: Sequence[float]) -> None:
        """Grid first, then what is measured, then the words."""
        up = _up(panel.traces)
        draw = self.drawing
        for at, _ in self.time.ticks:
            draw.line(
                _across(self.time, at), self.top, _across(self.time, at), self.bottom, GRID, 0.5
            )
        for at, text in up.ticks:
            y = self._height(up, at)
            draw.line(LEFT, y, WIDTH - RIGHT, y, GRID, 0.5)
            draw.words(LEFT - 3.0, y + 2.3, text, anchor="end")
        for mark in marks:
            draw.line(
                _across(self.time, mark), self.top, _across(self.time, mark), self.bottom, PALE, 0.7
            )
        for trace in panel.traces:
            self._trace(up, trace)
        draw.line(LEFT, self.top, LEFT, self.bottom, GREY, 0.5)
        draw.line(LEFT, self.bottom, WIDTH - RIGHT, self.bottom, GREY, 0.5)
        middle = 0.5 * (self.top + self.bottom)
        draw.words(8.0, middle, panel.label, anchor="middle", turned=True)
        self._legend(panel.traces)

    def _trace(self, up: Axis, trace: Trace) -> None:
        """A band is filled; one that is dashed is outlined only, so that what lies under it is seen."""
        x = np.asarray(LEFT + (trace.time_s - self.time.low) * _scale(self.time))
        low, high = self._heights(up, trace.low), self._heights(up, trace.high)
        if not trace.is_band:
            self.drawing.curve(x, low, trace.colour, 0.8, DASHES[trace.dash])
        elif trace.dash == "-":
            self.drawing.area(x, low, high, trace.colour)
        else:
            self.drawing.curve(x, low, trace.colour, 0.5)
            self.drawing.curve(x, high, trace.colour, 0.5)

    def _legend(self, traces: Sequence[Trace]) -> None:
        x, y = WIDTH - RIGHT, self.top - 4.0
        for trace in reversed([trace for trace in traces if trace.label]):
            self.drawing.words(x, y, trace.label, anchor="end")
            x -= CHARACTER * len(trace.label) + 3.0
            ends = np.array([x - SAMPLE, x])
            self.drawing.curve(ends, np.full(2, y - 2.2), trace.colour, 1.0, DASHES[trace.dash])
            x -= SAMPLE + 8.0

    def _height(self, up: Axis, value: float) -> float:
        return self.bottom - up.share(value) * (self.bottom - self.top)

    def _heights(self, up: Axis, values: Floats) -> Floats:
        share = (values - up.low) / (up.high - up.low)
        return np.asarray(self.bottom - share * (self.bottom - self.top))


def _up(traces: Sequence[Trace]) -> Axis:
    values = [part[np.isfinite(part)] for t in traces for part in (t.low, t.high)]
    every = np.concatenate([np.empty(0), *values])
    if len(every) == 0:
        return axis(0.0, 1.0, 5)
    return axis(float(every.min()), float(every.max()), 5, around=0.06)


def _scale(time: Axis) -> float:
    return (WIDTH - LEFT - RIGHT) / (time.high - time.low)


def _across(time: Axis, at: float) -> float:
    return LEFT + (at - time.low) * _scale(time)
