"""A simulation on a terminal: what was measured, and how near each interlock came."""

from typing import Any

from rich.table import Table

from app.analysis.acceptance import Verdict
from app.commands.output import text_console
from app.documents.units import say
from app.link.words import Judging
from app.prediction.schemas import Margin, Prediction, PredictionVerdict
from rtcore.interlocks import Comparison, Form, Quantity

COLOURS = {
    PredictionVerdict.CLEAR: "green",
    PredictionVerdict.CAUTION: "yellow",
    PredictionVerdict.REFUSED: "red",
}
MARKS = {Verdict.PASS: "green", Verdict.FAIL: "red", Verdict.UNSET: "yellow"}


def print_measured(told: dict[str, Any]) -> None:
    """The outcome, every measurement that has a value, and the verdict."""
    console = text_console()
    console.print(told["test"], style="bold", markup=False)
    console.print(f"{told['outcome'].capitalize()} after {say(told['duration_s'], 's')}")
    if told["reason"]:
        console.print(told["reason"], style="red", markup=False)
    measured = Table("measurement", "unit")
    measured.add_column("value", justify="right")
    for m in told["measurements"]:
        if m["value"] is not None:
            measured.add_row(m["name"], m["unit"], say(m["value"]))
    console.print(measured)
    if told["acceptance"]:
        console.print(_criteria(told))
    console.print(f"Verdict: {told['verdict']}", style=MARKS[Verdict(told["verdict"])])


def _criteria(told: dict[str, Any]) -> Table:
    table = Table("acceptance")
    for heading in ("at least", "value", "at most", "outcome"):
        table.add_column(heading, justify="right")
    for c in told["acceptance"]:
        numbers = (c["at_least"], c["value"], c["at_most"])
        shown = ("" if number is None else say(number) for number in numbers)
        table.add_row(c["measurement"], *shown, c["outcome"], style=MARKS[Verdict(c["outcome"])])
    return table


def _judging(m: Margin) -> Judging:
    band = Comparison.ABOVE if m.low is None else Comparison.OUTSIDE
    quantity, form = Quantity[m.quantity.upper()], Form[m.form.upper()]
    return Judging(quantity, form, band, m.threshold, m.low, None)


def _without(prediction: Prediction) -> dict[str, list[str]]:
    """The interlocks of which nothing can be said, by the reason why."""
    found: dict[str, list[str]] = {}
    for m in prediction.margins:
        if m.margin is None:
            found.setdefault(m.note, []).append(m.detector)
    return found


def print_prediction(prediction: Prediction) -> None:
    """How near each interlock comes, what stands against the test, and the verdict."""
    console = text_console()
    table = Table("interlock")
    for heading in ("reaches", "limit", "margin", "at"):
        table.add_column(heading, justify="right")
    for m in (m for m in prediction.margins if m.margin is not None):
        judging = _judging(m)
        reaches = m.note if m.extreme is None else judging.write(m.extreme)
        share = "" if m.margin_share is None else f"{100 * m.margin_share:.0f} %"
        at = "" if m.time_s is None else f"{m.time_s:,.3f} s"
        row = (m.detector, reaches, judging.allowed(), share, at)
        table.add_row(*row, style="red" if m.margin is not None and m.margin < 0 else "")
    console.print(table)
    for note, names in _without(prediction).items():
        console.print(f"{note}: {', '.join(names)}", style="dim", markup=False, soft_wrap=True)
    for reason in prediction.reasons:
        colour = COLOURS[PredictionVerdict(reason.severity)]
        console.print(reason.text, style=colour, markup=False)
    console.print(f"Prediction: {prediction.verdict.value}", style=COLOURS[prediction.verdict])
