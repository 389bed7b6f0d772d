"""From recorded runs to fitted parameters: windows, the search, and how well it is known."""

import time
from collections.abc import Callable, Sequence
from dataclasses import replace

import numpy as np
import numpy.typing as npt

from app.analysis.goodness import goodness_of_fit
from app.errors import Code, Refusal
from app.identification.choosing import information, most_telling
from app.identification.fitting import Fitted, Problem, Search
from app.identification.model import FORCE, MEASURED, Model
from app.identification.noise import deviations
from app.identification.parameters import PARAMETER, coordinates, placed, read
from app.identification.schemas import (
    ChannelResidual,
    Entangled,
    Fit,
    FittedParameter,
    Goodness,
    Identified,
    WindowUsed,
)
from app.identification.sensitivities import (
    Sensitivities,
    driven,
    in_threads,
    residual_of,
    root_mean_square,
)
from app.identification.windows import LENGTH, Source, Window, candidates
from rtcore.channels import CHANNEL
from rtcore.rig.parameters import RigParameters

Floats = npt.NDArray[np.float64]
Progress = Callable[[float], None]  # told the share that is done, 0…1

LEAST_WINDOWS = 4
CHOSEN_AT, SEARCHED_AT = 0.25, 0.95  # of the whole
VAGUE = 0.5  # of a coordinate: half an interval beyond which the data do not tell a parameter
ENTANGLED = 0.7
TOO_SHORT = (
    "The runs hold too few stretches of 0.4 s that can be used: they need to be undisturbed by holds,"
    " trips and gaps. Record the library test identification, or a longer run"
)


def identify(
    sources: Sequence[Source],
    rig: RigParameters,
    fit: Fit,
    period_s: float,
    progress: Progress,
    threads: int = 1,
) -> Identified | Refusal:
    """Fit a rig model, beginning with `rig`, to recorded runs. Refused where they hold too little."""
    began = time.perf_counter()
    found = list(candidates(sources, fit.candidates, period_s))
    if len(found) < LEAST_WINDOWS:
        return Refusal(Code.INVALID_REQUEST, TOO_SHORT)
    wanted = [PARAMETER[path] for path in fit.parameters]
    noise = deviations(rig.sensors)
    whole = Problem(rig, wanted, found, len(sources), noise, period_s, threads)
    chosen = _choose(whole, fit.windows, lambda share: progress(CHOSEN_AT * share))
    problem = replace(whole, windows=[found[i] for i in chosen])
    span = SEARCHED_AT - CHOSEN_AT
    fitted = Search(problem).run(lambda share: progress(CHOSEN_AT + span * share))
    progress(SEARCHED_AT)
    unseen = [w for i, w in enumerate(found) if i not in set(chosen)] or list(problem.windows)
    parameters = _told(problem, fitted)
    return Identified(
        parameters=parameters,
        correlation=np.round(fitted.known.correlation[: len(wanted), : len(wanted)], 4).tolist(),
        residuals=_residuals(problem, fitted),
        force_zeros_n=fitted.at[len(wanted) :].tolist(),
        goodness=_goodness(replace(problem, windows=unseen), fitted),
        windows=[_used(sources, window, period_s) for window in problem.windows],
        iterations=fitted.iterations,
        settled=fitted.settled,
        took_s=time.perf_counter() - began,
        notes=_notes(parameters, settled=fitted.settled),
    )


def _choose(problem: Problem, count: int, progress: Progress) -> list[int]:
    begun, zeros = coordinates(problem.rig, problem.wanted), np.zeros(problem.runs)
    there = Sensitivities(problem.rig, problem.wanted, begun, zeros, problem.period_s)

    def told(window: Window) -> Floats:
        return information(there.seen(window).slopes, problem.noise)

    informations = []
    for found in in_threads(told, problem.windows, problem.threads):
        informations.append(found)
        progress(len(informations) / len(problem.windows))
    return most_telling(informations, np.diag(1.0 / problem.prior**2), count)


def _told(problem: Problem, fitted: Fitted) -> list[FittedParameter]:
    correlation = np.abs(fitted.known.correlation[: len(problem.wanted), : len(problem.wanted)])
    np.fill_diagonal(correlation, 0.0)
    return [_parameter(problem, fitted, i, correlation[i]) for i in range(len(problem.wanted))]


def _parameter(problem: Problem, fitted: Fitted, i: int, correlation: Floats) -> FittedParameter:
    p, at = problem.wanted[i], float(fitted.at[i])
    half = float(fitted.known.reach * fitted.known.deviation[i])
    before = read(problem.rig, p.path)
    low, high = p.bounds(before)
    value, interval = p.value(at), half * p.slope(at)
    other = int(np.argmax(correlation))
    signed = float(fitted.known.correlation[i, other])
    return FittedParameter(
        path=p.path,
        title=p.title,
        unit=p.unit,
        group=p.group,
        before=before,
        after=value,
        low=p.value(at - half),
        high=p.value(at + half),
        half_percent=None if p.scale is not None else 100.0 * interval / value,
        at_bound=not low + 1e-9 < at < high - 1e-9,
        determined=half < VAGUE,
        entangled=Entangled(path=problem.wanted[other].path, correlation=signed)
        if abs(signed) >= ENTANGLED
        else None,
    )


def _residuals(problem: Problem, fitted: Fitted) -> list[ChannelResidual]:
    model, zeros = Model(problem.rig, problem.period_s), np.zeros(problem.runs)
    before = root_mean_square(
        residual_of(driven(model, window), window, zeros) for window in problem.windows
    )
    return [
        ChannelResidual(
            channel=name,
            unit=CHANNEL[name].unit,
            noise=float(problem.noise[i]),
            before_rms=float(before[i]),
            after_rms=float(fitted.remained[i]),
        )
        for i, name in enumerate(MEASURED)
    ]


def _goodness(problem: Problem, fitted: Fitted) -> Goodness:
    n = len(problem.wanted)
    after = placed(problem.rig, problem.wanted, fitted.at[:n])
    begun, zeros = np.zeros(problem.runs), fitted.at[n:]
    return Goodness(
        before_percent=_percent(problem, problem.rig, begun),
        after_percent=_percent(problem, after, zeros),
        windows=len(problem.windows),
    )


def _percent(problem: Problem, rig: RigParameters, zeros_n: Floats) -> float | None:
    model = Model(rig, problem.period_s)
    forces = list(
        in_threads(lambda w: driven(model, w)[:, FORCE], problem.windows, problem.threads)
    )
    simulated = [f + zeros_n[w.source] for f, w in zip(forces, problem.windows, strict=True)]
    measured = [w.measured[:, FORCE] for w in problem.windows]
    percent = goodness_of_fit(np.concatenate(measured), np.concatenate(simulated))
    return percent if np.isfinite(percent) else None


def _used(sources: Sequence[Source], window: Window, period_s: float) -> WindowUsed:
    source = sources[window.source]
    first = window.first_tick - source.samples.first_tick
    return WindowUsed(
        run_id=source.run_id, from_s=first * period_s, to_s=(first + LENGTH) * period_s
    )


def _notes(parameters: Sequence[FittedParameter], *, settled: bool) -> list[str]:
    notes = [] if settled else ["The search did not settle: its values may not be the best"]
    for p in parameters:
        if not p.determined:
            why = f", which moves together with {p.entangled.path}" if p.entangled else ""
            notes.append(f"{p.path}: the runs do not tell it{why}; it stays as it was")
        elif p.at_bound:
            notes.append(f"{p.path}: it went as far as it may; look whether this is the right rig")
    return notes
