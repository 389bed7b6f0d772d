"""How near the run was predicted to come to each detector."""

from app.link.words import Judging
from app.prediction.schemas import Margin
from app.reports.figures.plain import bars
from app.reports.numbers import spoken
from app.reports.report import Figure, Item, Section, Words
from app.reports.subject import Subject
from rtcore.interlocks import Comparison, Form, Quantity


def margins(subject: Subject) -> Section | None:
    """The detectors of which something can be said, the nearest first."""
    if subject.prediction is None:
        return None
    known = [m for m in subject.prediction.margins if m.margin_share is not None]
    items: list[Item] = []
    if known:
        known.sort(key=lambda m: m.margin_share if m.margin_share is not None else 1.0)
        names = [spoken(m.detector) for m in known]
        shares = [1.0 - (m.margin_share or 0.0) for m in known]
        svg = bars(names, shares, [_note(m) for m in known], "Share of the limit that is used")
        caption = "How much of each detector's limit the test uses, on the virtual rig"
        items.append(Figure(caption, svg, caption))
    items += [Words(reason.text) for reason in subject.prediction.reasons]
    unsaid = [
        spoken(m.detector).lower() for m in subject.prediction.margins if m.margin_share is None
    ]
    if unsaid:
        items.append(Words(f"Nothing can be predicted of: {', '.join(unsaid)}."))
    return Section("Margins to the detectors", tuple(items)) if items else None


def _note(m: Margin) -> str:
    band = Comparison.ABOVE if m.low is None else Comparison.OUTSIDE
    quantity, form = Quantity[m.quantity.upper()], Form[m.form.upper()]
    judging = Judging(quantity, form, band, m.threshold, m.low, None)
    reached = "" if m.extreme is None else f"{judging.write(m.extreme)} of "
    return f"{reached}{judging.allowed()}"
