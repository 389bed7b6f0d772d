"""What the lab's own limits have against a test."""

from app.definitions.outline import Outline
from app.documents.units import say
from app.errors import Code, Refusal
from app.revisions.kind import Revision
from app.rig_configuration.configuration import RigConfiguration


def why_not(plan: Outline, in_force: Revision[RigConfiguration]) -> Refusal | None:
    """Why a test cannot be started on this rig; None where it can."""
    limits = in_force.document.limits
    asked = (
        ("force", plan.peak_force_n, limits.force_n, "N"),
        ("displacement", plan.peak_displacement_m, limits.displacement_m, "m"),
    )
    for name, peak, limit, unit in asked:
        if limit is not None and not peak <= limit:
            detail = (
                f"Cannot start: the test reaches a {name} of {say(peak, unit)}, and revision"
                f" {in_force.number} of the rig configuration allows {say(limit, unit)}"
            )
            return Refusal(Code.INVALID_TEST, detail)
    return None
