"""Force, displacement and valve over time: the whole run, and what it came to at its end."""

from collections.abc import Sequence

import numpy as np

from app.reports.figures.colours import ASKED, GREY, MEASURED, PREDICTED
from app.reports.figures.time import Panel, time_figure
from app.reports.numbers import duration
from app.reports.report import Figure, Item, Section, Words
from app.reports.subject import Subject
from app.reports.telling import SHOWN_S, Moment, moment_of_run
from app.reports.views import Floats, View, predicted_view, view

CHANNELS = (
    *("force_n", "force_command_n", "force_error_n", "displacement_m", "displacement_command_m"),
    *("valve_command", "pressure_1_pa", "pressure_2_pa", "supply_pressure_pa"),
)
SHORT = ("force_n", "force_command_n", "force_error_n", "valve_command")


def time(subject: Subject) -> Section | None:
    """The whole run from afar, and its middle tick by tick; a sentence where it has no samples."""
    if subject.samples is None:
        return Section("Over time", (Words(f"{subject.without_samples}."),))
    lasts_s = (subject.samples.last_tick - subject.origin) * subject.period_s
    items: list[Item] = [_whole(subject, lasts_s)]
    if lasts_s > 4.0 * SHOWN_S:
        items.append(close_up(subject, moment_of_run(subject)))
    return Section("Over time", tuple(items))


def close_up(subject: Subject, moment: Moment) -> Figure:
    """Every tick of a moment."""
    caption = f"{duration(moment.to_s - moment.from_s)} at {moment.text}, every tick"
    return near(subject, moment.from_s, moment.to_s, caption)


def overview(subject: Subject) -> Section | None:
    """The whole run at a glance."""
    if subject.samples is None:
        return Section("Over time", (Words(f"{subject.without_samples}."),))
    return Section("Over time", (near(subject, 0.0, None, "The whole run: least and greatest"),))


def near(subject: Subject, from_s: float, to_s: float | None, caption: str) -> Figure:
    """Force, error and valve between two times, with the prediction where there was one."""
    seen = view(subject, SHORT, from_s, to_s)
    panels = [_force(subject, seen, from_s, to_s), _error(seen), _valve(seen)]
    return Figure(caption, time_figure(panels, panel_mm=30.0), _told(caption))


def _whole(subject: Subject, lasts_s: float) -> Figure:
    seen = view(subject, CHANNELS)
    panels = [_force(subject, seen, 0.0, None), _error(seen)]
    panels += [_motion(seen)] if moves(seen.low["displacement_command_m"]) else []
    panels.append(_valve(seen))
    panels.append(
        Panel(
            "Pressure (bar)",
            [
                seen.trace("supply_pressure_pa", "supply", GREY),
                seen.trace("pressure_1_pa", "chamber 1", MEASURED),
                seen.trace("pressure_2_pa", "chamber 2", PREDICTED, "--"),
            ],
        )
    )
    of = "every tick" if seen.low is seen.high else "least and greatest of each stretch"
    caption = f"The whole run, {duration(lasts_s)}: {of}"
    return Figure(caption, time_figure(panels, _marks(subject), panel_mm=29.0), _told(caption))


def _force(subject: Subject, seen: View, from_s: float, to_s: float | None) -> Panel:
    traces = []
    predicted = predicted_view(subject, from_s, to_s)
    if predicted is not None:
        traces.append(predicted.trace("force_n", "predicted", PREDICTED, "--"))
    traces.append(seen.trace("force_n", "load cell", MEASURED))
    traces.append(seen.trace("force_command_n", "setpoint", ASKED, ":"))
    return Panel("Force (kN)", traces)


def _error(seen: View) -> Panel:
    return Panel("Error (kN)", [seen.trace("force_error_n", "", MEASURED)])


def _valve(seen: View) -> Panel:
    return Panel("Valve (−1…+1)", [seen.trace("valve_command", "", MEASURED)])


def _motion(seen: View) -> Panel:
    traces = [
        seen.trace("displacement_m", "LVDT", MEASURED),
        seen.trace("displacement_command_m", "command", ASKED, ":"),
    ]
    return Panel("Unit (mm)", traces)


def moves(values: Floats) -> bool:
    """Whether a channel does anything at all."""
    return len(values) > 0 and bool(np.nanmax(values) > np.nanmin(values))


def _marks(subject: Subject) -> Sequence[float]:
    """Where blocks begin, as long as they can be told apart."""
    starts = [event.time_s for event in subject.events if event.kind == "block"]
    return starts if len(starts) <= 40 else ()


def _told(caption: str) -> str:
    return f"Chart over time of force, force error and valve command. {caption}"
