"""Small figures: one quantity against another, bars of shares, a histogram."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
from matplotlib.ticker import FuncFormatter, NullLocator

from app.reports.figures.colours import GREY, INK, LIMIT, MEASURED, PALE
from app.reports.figures.style import SERIES, WIDTH_MM, as_svg, canvas, styled, tell

Floats = npt.NDArray[np.float64]
BAR_MM, AROUND_MM = 5.0, 12.0


@dataclass(frozen=True)
class Line:
    """(n,) values against (n,) values; only points where `joined` is false."""

    label: str
    x: Floats
    y: Floats
    joined: bool = True


def against(pairs: Sequence[tuple[str, str, Sequence[Line]]], height_mm: float = 75.0) -> bytes:
    """SVG of axes side by side: what is across, what is up, and the lines of each."""
    with styled():
        drawn = canvas(height_mm)
        every = drawn.subplots(1, len(pairs), squeeze=False)[0]
        for axes, (across, up, lines) in zip(every, pairs, strict=True):
            for line, (colour, dash, marker) in zip(lines, _cycled(len(lines)), strict=True):
                if line.joined:
                    axes.plot(
                        line.x, line.y, ls=dash, color=colour, lw=0.8, label=line.label or None
                    )
                else:
                    axes.plot(
                        line.x, line.y, marker, color=colour, ms=2.0, label=line.label or None
                    )
            axes.set_xlabel(across)
            axes.set_ylabel(up)
            tell(axes)
        return as_svg(drawn)


def stacked(
    across: str, rows: Sequence[tuple[str, Sequence[Line]]], *, logarithmic: bool = False
) -> bytes:
    """SVG of axes one above the other over one axis across: what is up, and the lines of each."""
    with styled():
        drawn = canvas(40.0 * len(rows) + 10.0)
        every = drawn.subplots(len(rows), 1, sharex=True, squeeze=False)[:, 0]
        for axes, (up, lines) in zip(every, rows, strict=True):
            for line, (colour, dash, marker) in zip(lines, _cycled(len(lines)), strict=True):
                shown = {"ls": dash} if line.joined else {"ls": "", "marker": marker, "ms": 2.0}
                axes.plot(line.x, line.y, color=colour, label=line.label or None, **shown)
            if logarithmic:
                axes.set_xscale("log")
            axes.set_ylabel(up)
            tell(axes)
        every[-1].set_xlabel(across)
        drawn.align_ylabels(list(every))
        return as_svg(drawn)


def bars(names: Sequence[str], shares: Sequence[float], notes: Sequence[str], across: str) -> bytes:
    """SVG of a bar a name, from 0 to its share, with the limit at 1 and a note behind each."""
    with styled():
        drawn = canvas(BAR_MM * len(names) + AROUND_MM)
        axes = drawn.subplots()
        places = np.arange(len(names))[::-1]
        shown = np.clip(shares, 0.0, 1.15)
        over = np.asarray(shares) >= 1.0
        axes.barh(places, shown, height=0.6, color=np.where(over, LIMIT, MEASURED))
        axes.axvline(1.0, color=INK, lw=0.8)
        for place, share, note in zip(places, shown, notes, strict=True):
            axes.text(
                max(float(share), 0.0) + 0.015, place, note, va="center", fontsize=6.0, color=INK
            )
        axes.set_yticks(places, names)
        axes.set_xlim(0.0, 1.55)
        axes.set_xticks(np.arange(0.0, 1.01, 0.25), [f"{p} %" for p in range(0, 101, 25)])
        axes.tick_params(axis="y", length=0)
        axes.grid(visible=False, axis="y")
        axes.spines["left"].set_visible(False)
        axes.set_xlabel(across, loc="left")
        return as_svg(drawn)


def histogram(
    counts: Sequence[tuple[str, npt.NDArray[np.int64]]], bin_us: float, across: str
) -> bytes:
    """SVG of counts (n_bins,) side by side, on a logarithmic axis: one tick in ten million shows."""
    with styled():
        drawn = canvas(52.0, WIDTH_MM)
        every = drawn.subplots(1, len(counts), squeeze=False, sharey=True)[0]
        for axes, (name, found) in zip(every, counts, strict=True):
            last = min(len(found), int(np.flatnonzero(found)[-1]) + 2) if found.any() else 2
            edges = np.arange(last + 1) * bin_us
            axes.stairs(
                np.maximum(found[:last], 0.5), edges, baseline=0.5, fill=True, color=MEASURED
            )
            axes.set_yscale("log")
            axes.yaxis.set_minor_locator(NullLocator())
            axes.yaxis.set_major_formatter(FuncFormatter(lambda n, _: f"{n:,.0f}"))
            axes.set_ylim(bottom=0.5)
            axes.set_title(name, fontsize=7.0, color=INK, loc="left")
            axes.set_xlabel(across)
        every[0].set_ylabel("Ticks")
        return as_svg(drawn)


def _cycled(count: int) -> list[tuple[object, object, str]]:
    return [SERIES[i % len(SERIES)] for i in range(count)]


__all__ = ["GREY", "PALE", "Line", "against", "bars", "histogram", "stacked"]
