"""The virtual rig beside the real one: the same model on the same outputs, with ideal sensors and no faults.

What the two forces differ by is what the model does not know of: a fault, or a rig that has changed.
"""

from typing import Any

import numpy.typing as npt

from rtcore.compiled import Record, kernel
from rtcore.rig.integrate import advance
from rtcore.rig.parameters import RigParameters
from rtcore.rig.plant import SUBSTEPS, X_S, Y_F
from rtcore.rig.world import make_world, write_world


def make_twin(rig: RigParameters) -> npt.NDArray[Any]:
    """(1,) WORLD at rest."""
    return make_world(rig, seed=0)


@kernel
def move_twin(twin: Record, outputs: Record, period_s: float) -> tuple[float, float]:
    """Give the twin what the rig was given a tick ago, carry it to now; returns its force (N) and spool."""
    write_world(twin, outputs, period_s)
    advance(twin.plant, twin.y, twin.u, twin.work, period_s, SUBSTEPS)
    return twin.y[Y_F], twin.y[X_S] / twin.plant.spool_stroke_m
