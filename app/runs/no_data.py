"""Why there are no samples of a run."""

from app.errors import Code, Refusal
from app.runs.models import Run


def no_data(run: Run) -> Refusal:
    """None were recorded, or they were removed since."""
    if run.samples_removed_at is not None:
        day = run.samples_removed_at.date().isoformat()
        detail = f"The samples of run {run.id} were removed by retention on {day}"
        return Refusal(Code.NO_DATA, detail, about={"samples_removed_at": day})
    return Refusal(Code.NO_DATA, f"Run {run.id} has no samples")
