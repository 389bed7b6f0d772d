"""A frequency response: gain, phase and coherence, a line an amplitude, with its intervals."""

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np
import numpy.typing as npt
from matplotlib.axes import Axes
from matplotlib.figure import Figure as Canvas
from matplotlib.ticker import FuncFormatter, NullFormatter

from app.reports.figures.colours import GREY, INK, LIMIT, PALE
from app.reports.figures.style import SERIES, as_svg, canvas, styled, tell

Floats = npt.NDArray[np.float64]
_NONE = np.empty(0)


@dataclass(frozen=True)
class Response:
    """(n,) frequencies (Hz), gains (dB) and phases (°); intervals (n, 2) and coherence (n,) where known."""

    label: str
    frequency_hz: Floats
    gain_db: Floats
    phase_deg: Floats
    gain_95_db: Floats | None = None
    phase_95_deg: Floats | None = None
    coherence: Floats | None = None
    points: bool = True  # measured ones; a model is a line alone


@dataclass(frozen=True)
class Marked:
    """A point to call out, or a corridor from `from_hz` to `to_hz`."""

    frequency_hz: float
    gain_db: float
    text: str


@dataclass(frozen=True)
class Corridor:
    """What is required between two frequencies (dB); None for no limit on that side."""

    from_hz: float
    to_hz: float
    low_db: float | None
    high_db: float | None


@dataclass(frozen=True)
class Bode:
    """All of a figure. `gain` says what its gain is of."""

    responses: Sequence[Response]
    marked: Sequence[Marked] = ()
    corridors: Sequence[Corridor] = field(default=())
    gain: str = "Gain (dB)"


def bode_figure(bode: Bode) -> bytes:
    """SVG of it."""
    with styled():
        return as_svg(draw_bode(bode))


def draw_bode(bode: Bode) -> Canvas:
    """It, drawn; inside of `styled`."""
    coherent = any(r.coherence is not None for r in bode.responses)
    drawn = canvas(118.0 if coherent else 72.0)
    ratios = [3, 2, 1] if coherent else [3, 2]
    every = list(drawn.subplots(len(ratios), 1, sharex=True, height_ratios=ratios))
    for corridor in bode.corridors:
        _corridor(every[0], corridor)
    for i, response in enumerate(bode.responses):
        _response(every, i, response)
    for marked in bode.marked:
        _mark(every[0], marked)
    every[0].set_ylabel(bode.gain)
    every[1].set_ylabel("Phase (°)")
    if coherent:
        every[2].set_ylabel("Coherence")
        every[2].set_ylim(0.0, 1.05)
    _across(every[-1], bode.responses)
    tell(every[0])
    drawn.align_ylabels(every)
    return drawn


def _response(every: Sequence[Axes], i: int, response: Response) -> None:
    colour, dash, marker = SERIES[i % len(SERIES)]
    f = response.frequency_hz
    shape = {"ls": dash, "marker": marker if response.points and len(f) < 200 else ""}
    if not response.points:
        shape, colour = {"ls": "-", "marker": ""}, PALE
    every[0].plot(f, response.gain_db, color=colour, label=response.label, ms=2.0, **shape)  # type: ignore[arg-type]
    every[1].plot(f, response.phase_deg, color=colour, ms=2.2, **shape)  # type: ignore[arg-type]
    for axes, band in ((every[0], response.gain_95_db), (every[1], response.phase_95_deg)):
        if band is not None and len(band):
            axes.vlines(f, band[:, 0], band[:, 1], color=colour, lw=0.7)
    if response.coherence is not None and len(every) > 2:
        every[2].plot(f, response.coherence, color=colour, ms=2.2, **shape)  # type: ignore[arg-type]


def _corridor(axes: Axes, corridor: Corridor) -> None:
    for level in (corridor.low_db, corridor.high_db):
        if level is not None:
            axes.hlines(level, corridor.from_hz, corridor.to_hz, color=LIMIT, lw=0.9, ls="-")


def _mark(axes: Axes, marked: Marked) -> None:
    axes.plot([marked.frequency_hz], [marked.gain_db], "o", mfc="none", mec=INK, ms=5.0, mew=0.7)
    above = marked.gain_db >= 0.0
    axes.annotate(
        marked.text,
        (marked.frequency_hz, marked.gain_db),
        xytext=(0, 8 if above else -16),
        textcoords="offset points",
        ha="center",
        va="bottom" if above else "top",
        fontsize=6.5,
        color=INK,
    )
    axes.margins(y=0.18)


def _across(axes: Axes, responses: Sequence[Response]) -> None:
    axes.set_xscale("log")
    axes.set_xlabel("Frequency (Hz)")
    axes.xaxis.set_major_formatter(FuncFormatter(lambda f, _: f"{f:g}"))
    found = np.concatenate([r.frequency_hz for r in responses] or [_NONE])
    short = found.size and found.max() / max(found.min(), 1e-9) < 30.0
    minor = FuncFormatter(lambda f, _: f"{f:g}" if f"{f:e}"[0] in "25" else "")
    axes.xaxis.set_minor_formatter(minor if short or found.size else NullFormatter())
    axes.tick_params(which="minor", labelcolor=GREY)
    axes.grid(visible=True, which="minor", axis="x", lw=0.25)
