"""Lines, areas and words as SVG, written directly: a report of forty pages has no time for more.

Lengths are in points. Words are text in DejaVu Sans, which the PDF embeds (`app.reports.fonts`).
"""

from collections.abc import Sequence
from html import escape

import numpy as np
import numpy.typing as npt

Floats = npt.NDArray[np.float64]
FONT = "'DejaVu Sans',sans-serif"
SIZE, CHARACTER = 6.6, 4.1  # of letters, and how wide one is on average


class Drawing:
    """An SVG of some size that things are put into, in order."""

    def __init__(self, width: float, height: float) -> None:
        self._width, self._height = width, height
        self._parts: list[str] = []

    def line(self, x1: float, y1: float, x2: float, y2: float, colour: str, width: float) -> None:
        """From one point to another."""
        place = f'x1="{x1:.2f}" y1="{y1:.2f}" x2="{x2:.2f}" y2="{y2:.2f}"'
        self._parts.append(f'<line {place} stroke="{colour}" stroke-width="{width}"/>')

    def curve(self, x: Floats, y: Floats, colour: str, width: float, dash: str = "") -> None:
        """Through (n,) points; it has a gap where there is none."""
        path = "".join(f"M{_points(part_x, part_y)}" for part_x, part_y in _whole(x, y))
        dashed = f' stroke-dasharray="{dash}"' if dash else ""
        style = f'fill="none" stroke="{colour}" stroke-width="{width}" stroke-linejoin="round"'
        self._parts.append(f'<path d="{path}" {style}{dashed}/>')

    def area(self, x: Floats, low: Floats, high: Floats, colour: str) -> None:
        """Between (n,) points and (n,) others; an edge is drawn too, so that a thin one is seen."""
        path = ""
        for part_x, both in _whole(x, np.stack([low, high], axis=1)):
            there, back = both[:, 0], both[::-1, 1]
            path += f"M{_points(part_x, there)}L{_points(part_x[::-1], back)}Z"
        self._parts.append(
            f'<path d="{path}" fill="{colour}" stroke="{colour}" stroke-width="0.4"/>'
        )

    def words(
        self, x: float, y: float, text: str, *, anchor: str = "start", turned: bool = False
    ) -> None:
        """At a place: its beginning, `middle` or `end`."""
        turn = f' transform="rotate(-90 {x:.2f} {y:.2f})"' if turned else ""
        place = f'x="{x:.2f}" y="{y:.2f}" text-anchor="{anchor}"{turn}'
        self._parts.append(f"<text {place}>{escape(text)}</text>")

    def svg(self) -> bytes:
        """All of it."""
        size = f'width="{self._width:.2f}pt" height="{self._height:.2f}pt"'
        box = f'viewBox="0 0 {self._width:.2f} {self._height:.2f}"'
        style = f'font-family="{FONT}" font-size="{SIZE}" fill="#1a1a1a"'
        head = f'<svg xmlns="http://www.w3.org/2000/svg" {size} {box} {style}>'
        return "\n".join([head, *self._parts, "</svg>"]).encode()


def _whole(x: Floats, y: Floats) -> Sequence[tuple[Floats, Floats]]:
    """The stretches of points in which every value is a number."""
    sound = np.isfinite(y) if y.ndim == 1 else np.isfinite(y).all(axis=1)
    edges = np.flatnonzero(np.diff(np.concatenate([[False], sound, [False]]).astype(np.int8)))
    return [(x[a:b], y[a:b]) for a, b in zip(edges[::2], edges[1::2], strict=True)]


def _points(x: Floats, y: Floats) -> str:
    return "L".join(f"{a:.2f} {b:.2f}" for a, b in zip(x.tolist(), y.tolist(), strict=True))
