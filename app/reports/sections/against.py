"""One quantity against another: force over displacement of the unit, force over its setpoint."""

import numpy as np

from app.reports.figures.plain import Line, against
from app.reports.numbers import duration
from app.reports.report import Figure, Section
from app.reports.subject import Subject
from app.reports.telling import moment_of_run
from app.reports.views import ticks_of

MOST_POINTS = 2500
STILL_MM = 0.05  # less is noise: the unit stands still


def across(subject: Subject) -> Section | None:
    """The middle of the run as X-Y; nothing where it has too few samples."""
    if subject.samples is None:
        return None
    at = moment_of_run(subject)
    names = ("force_n", "force_command_n", "displacement_m")
    found = ticks_of(subject, names, at.from_s, at.to_s)
    if len(found["force_n"]) < 2:
        return None
    step = max(1, len(found["force_n"]) // MOST_POINTS)
    force, asked, moved = (np.asarray(found[name][::step]) for name in names)
    pairs = [("Setpoint (kN)", "Force (kN)", [Line("", asked, force)])]
    if np.ptp(moved) > STILL_MM:
        over = ("Displacement of the unit (mm)", "Force (kN)", [Line("", moved, force)])
        pairs.insert(0, over)
    shown = f"{duration(at.to_s - at.from_s)} at {at.text}"
    caption = f"Force against its setpoint, and displacement where the unit moves: {shown}"
    return Section("X-Y", (Figure(caption, against(pairs), caption),))
