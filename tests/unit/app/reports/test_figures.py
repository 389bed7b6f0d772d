"""Charts as SVG: nothing lost, nothing interpreted, the same bytes for the same data."""

import re
from collections.abc import Callable
from xml.etree import ElementTree

import numpy as np
import pytest

from app.reports.figures.bode import Bode, Marked, Response, bode_figure
from app.reports.figures.plain import Line, against, bars, histogram
from app.reports.figures.ticks import axis
from app.reports.figures.time import Panel, Trace, time_figure

TIME = np.linspace(0.0, 1.0, 200)


def curve(svg: bytes, colour: str) -> str:
    """The path in a colour."""
    found = re.search(rf'<path d="([^"]*)"[^>]*stroke="{colour}"', svg.decode())
    assert found is not None
    return found.group(1)


def heights(path: str) -> list[float]:
    return [float(point.split()[1]) for point in re.findall(r"[ML]([\d. ]+)", path)]


def test_a_spike_of_one_stretch_is_the_highest_point() -> None:
    low, high = np.zeros(200), np.zeros(200)
    high[77] = 9.0
    trace = Trace("", TIME, low, high, "#123456")
    path = curve(time_figure([Panel("Force (kN)", [trace])]), "#123456")
    assert len(heights(path)) == 400
    assert min(heights(path)) < sorted(heights(path))[1] - 10.0


def test_where_there_is_no_number_the_line_has_a_gap() -> None:
    values = np.sin(TIME)
    values[50:60] = np.nan
    values[199] = np.inf
    path = curve(time_figure([Panel("", [Trace("", TIME, values, values, "#123456")])]), "#123456")
    assert path.count("M") == 2
    assert len(heights(path)) == 189
    assert "nan" not in path


@pytest.mark.parametrize("values", [np.full(200, np.nan), np.zeros(200), np.empty(0)])
def test_a_channel_of_nothing_still_has_axes(values: np.ndarray) -> None:
    trace = Trace("", TIME[: len(values)], values, values, "#123456")
    root = ElementTree.fromstring(time_figure([Panel("Force (kN)", [trace])]))
    texts = [e.text for e in root if e.text and e.text.strip()]
    assert {"Force (kN)", "Time (s)"} < set(texts)
    assert [text for text in texts if text[-1].isdigit()]  # its ticks


def test_names_are_never_markup() -> None:
    wicked = '</text><script>"&$x^2$'
    trace = Trace(wicked, TIME, TIME, TIME, "#123456")
    root = ElementTree.fromstring(time_figure([Panel(wicked, [trace])]))
    assert [e.text for e in root if e.text == wicked] == [wicked, wicked]
    ElementTree.fromstring(bars([wicked], [0.5], [wicked], wicked))


def test_a_response_whose_coherence_is_not_known_is_drawn_without() -> None:
    f = np.geomspace(1.0, 100.0, 20)
    for unknown in (np.full(20, np.nan), np.where(f < 10.0, np.nan, 1.0)):
        svg = bode_figure(Bode([Response("1 kN", f, -0.1 * f, -f, coherence=unknown)]))
        assert "nan" not in svg.decode().lower()


def test_every_kind_of_figure_has_the_same_bytes_twice() -> None:
    f = np.geomspace(1.0, 100.0, 20)
    response = Response("1 kN", f, -0.1 * f, -f, coherence=np.ones(20))
    bode = Bode([response], [Marked(35.0, 3.6, "+3.6 dB")])
    made: tuple[Callable[[], bytes], ...] = (
        lambda: time_figure([Panel("Force (kN)", [Trace("a", TIME, TIME, TIME, "#123456", "--")])]),
        lambda: bode_figure(bode),
        lambda: against([("x", "y", [Line("", f, f)])]),
        lambda: bars(["Force"], [1.2], ["66 kN of 55 kN"], "Share"),
        lambda: histogram([("Tick", np.array([0, 10_000_000, 1, 0]))], 2.0, "µs"),
    )
    for make in made:
        assert make() == make()


@pytest.mark.parametrize(
    ("low", "high", "texts"),
    [
        (0.0, 10.0, ["0", "2", "4", "6", "8", "10"]),
        (-0.25, 0.25, ["−0.2", "−0.1", "0", "0.1", "0.2"]),
        (0.0, 1.2e4, ["0", "2,500", "5,000", "7,500", "10,000"]),
    ],
)
def test_ticks_are_round_and_within(low: float, high: float, texts: list[str]) -> None:
    assert [text for _, text in axis(low, high, 5).ticks] == texts
