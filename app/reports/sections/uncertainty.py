"""The error budget of the dynamic force: how well it was measured and, apart from that, how well controlled."""

from app.reports.numbers import digits, quantity
from app.reports.report import Column, Facts, Row, Section, Table, Words
from app.reports.subject import Subject
from app.run_analysis.schemas import ContributionOut, UncertaintyOut


def uncertainty(subject: Subject) -> Section | None:
    """Nothing where there are no samples."""
    if subject.found is None:
        return None
    found = subject.found.analysis
    told, control = found.uncertainty, found.control
    facts = (
        ("Load cell's reading", f"±{_n(told.cell_expanded_n)} (k = {told.coverage:g})"),
        (
            "Force on the unit",
            f"±{_n(told.unit_expanded_n)} (k = {told.coverage:g}){_of_range(told)}",
        ),
        ("Of the rated force", f"{digits(told.share_of_rated_percent, 3)} %"),
        (
            "Range of the force",
            f"{_n(told.range_n)}: {_n(told.unit_lowest_n)} … {_n(told.unit_highest_n)}",
        ),
        ("Inertia between them", f"{_n(told.inertia_rms_n)} rms, {_n(told.inertia_peak_n)} peak"),
        ("Control: load cell", f"{_n(control.error_rms_n)} rms, {_n(control.error_peak_n)} peak"),
        (
            "Control: unit",
            f"{_n(control.unit_error_rms_n)} rms, {_n(control.unit_error_peak_n)} peak",
        ),
    )
    text = (
        "How well the force was measured and how well it was controlled are two things. The budget is of the "
        "force at any one instant, after ISO 4965-1's idea of error as a share of the range, with "
        "independent contributions added in squares."
    )
    items = (Words(text), Facts(facts), _budget(told))
    return Section("Uncertainty", items)


def _budget(told: UncertaintyOut) -> Table:
    columns = (
        Column("Contribution", share=3.4),
        Column("Value", number=True, share=1.3),
        Column("Distribution", share=1.5),
        Column("Standard", number=True, share=1.3),
        Column("Source", share=2.0),
        Column("How", share=5.0),
    )
    return Table("Error budget", columns, tuple(_row(one) for one in told.contributions))


def _row(one: ContributionOut) -> Row:
    of = "unit: " if one.of_unit else ""
    cells = (f"{of}{one.name}", _n(one.value_n), one.shape.value, _n(one.standard_n))
    return Row((*cells, one.source.value, one.how))


def _of_range(told: UncertaintyOut) -> str:
    share = told.share_of_range_percent
    return "" if share is None else f", {digits(share, 3)} % of its range"


def _n(value_n: float) -> str:
    """Small forces in N: a budget in thousandths of a kN reads badly."""
    return f"{digits(value_n, 3)} N" if abs(value_n) < 1000.0 else quantity(value_n, "N")
