"""An identification as a process of its own does it: everything comes in and goes out as plain data."""

import os
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any

from app.errors import Code, Refusal
from app.identification.identify import identify
from app.identification.schemas import Fit, Identified
from app.identification.windows import Source
from app.recording.samples import open_samples
from rtcore.rig.parameters import RigParameters


def fit_to_runs(
    report: Callable[[float], None],
    folders: Sequence[tuple[int, Path]],
    model: Mapping[str, Any],
    fit: Fit,
    period_s: float,
) -> Identified | Refusal:
    """Fit a model to the runs in these folders. Half of the processors are left to everybody else."""
    rig = RigParameters.model_validate(model)
    sources = []
    for run_id, folder in folders:
        samples = open_samples(folder)
        if samples is None:
            return Refusal(Code.NO_DATA, f"Run {run_id} has no samples any more")
        sources.append(Source(run_id, samples, rig.sensors.bits))
    threads = max(1, (os.cpu_count() or 1) // 2)
    return identify(sources, rig, fit, period_s, report, threads)
