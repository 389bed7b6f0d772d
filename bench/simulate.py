"""Speed of a closed-loop simulation with all channels kept, and beside it scipy's LSODA at equal accuracy."""

import time
from collections.abc import Callable, Iterator
from functools import partial
from statistics import median
from typing import Any

import numpy as np

from bench.equal_accuracy import CASES, SOLVERS, Matched, match, started
from bench.references import PERIOD_S, own_states, solver_states
from bench.report import Figure, progress, show, tracked
from rtcore.rig.parameters import load_rig
from rtcore.rig.plant import SUBSTEPS

AT_LEAST_REAL_TIME, AIM = 100.0, 200.0
AT_LEAST_LSODA = 70.0
REPEATS = 15
CLOSED_LOOP_TICKS = 3600
OFTEN = 15  # replays of a stretch at once, so that the clock can see them

Seconds = dict[str, list[float]]  # of what: for each repeat, how long a second of the rig took
CLOSED_LOOP, PLANT = "closed loop", "plant"
WHAT = {
    "solve_ivp": "LSODA behind solve_ivp",
    "odeint": "LSODA behind odeint",
}


def seconds_of(work: Callable[[], Any], rig_s: float) -> float:
    """How long a second of the rig takes."""
    start = time.perf_counter()
    work()
    return (time.perf_counter() - start) / rig_s


def measure(matched: Matched) -> Seconds:
    """All that is compared takes turns, so that a disturbance of the machine hits each alike."""
    run, plant, case = matched.run, matched.plant, matched.case
    inputs = run.inputs
    often = np.tile(inputs, (OFTEN, 1))
    own_states(plant, run.before, inputs, SUBSTEPS)  # compiles
    found: Seconds = {name: [] for name in (CLOSED_LOOP, PLANT, *SOLVERS)}

    def keep(name: str, ticks: int, work: Callable[[], Any]) -> None:
        found[name].append(seconds_of(work, ticks * PERIOD_S))

    for _ in tracked(range(REPEATS), f"timing {case.what}"):
        virtual = started(case, load_rig())
        keep(CLOSED_LOOP, CLOSED_LOOP_TICKS, partial(virtual.advance, CLOSED_LOOP_TICKS))
        keep(PLANT, len(often), partial(own_states, plant, run.before, often, SUBSTEPS))
        for name, solver in SOLVERS.items():
            tolerance = matched.solvers[name][0]
            again = partial(solver_states, solver, plant, run.before, inputs, tolerance)
            keep(name, len(inputs), again)
    return found


def figures_of(matched: Matched, seconds: Seconds) -> Iterator[Figure]:
    """The figures of one test. Ratios are of the best of all repeats: disturbances only ever add."""
    key, what = matched.case.test_id.replace("-", "_"), matched.case.what
    best = {name: min(values) for name, values in seconds.items()}
    middle = {name: median(values) for name, values in seconds.items()}
    yield Figure(
        f"{key}_real_time",
        f"{what}: closed loop / real time",
        1.0 / best[CLOSED_LOOP],
        "×",
        at_least=AT_LEAST_REAL_TIME,
        note=f"median {1.0 / middle[CLOSED_LOOP]:.0f} ×; aim {AIM:.0f} ×",
    )
    tick_s = best[CLOSED_LOOP] * PERIOD_S
    share = f"of it the plant {best[PLANT] * PERIOD_S * 1e6:.2f} µs"
    yield Figure(f"{key}_tick_s", f"{what}: whole tick", tick_s, "s", note=share)
    for name in SOLVERS:
        tolerance, error = matched.solvers[name]
        ratio, closed = best[name] / best[PLANT], best[name] / best[CLOSED_LOOP]
        yield Figure(
            f"{key}_{name}_ratio",
            f"{what}: {WHAT[name]} / plant",
            ratio,
            "×",
            at_least=AT_LEAST_LSODA if name == "solve_ivp" else None,
            note=f"median {middle[name] / middle[PLANT]:.0f} ×; {closed:.0f} × the closed loop; "
            f"rtol {tolerance:.1e}: {100 * error:.4f} %, own {100 * matched.own_error:.4f} %",
        )


NOTES = [
    f"best of {REPEATS} repeats, each a part of the test after its beginning, on one core, wall clock",
    "closed loop: the very tick with noise, all channels kept of every tick",
    "LSODA integrates the plant alone, restarted each tick, its right-hand side compiled and handed over"
    " by address; errors are the worst of the force in the load cell against Radau, in % of its peak",
    "odeint goes from step to step without Python, solve_ivp does not; both are scipy's LSODA",
]


def main(as_json: bool) -> int:
    """Measure and print. Exit code 0 when measured, whether targets were met or not."""
    figures: list[Figure] = []
    for case in CASES:
        progress(f"finding equal accuracy, {case.what}")
        matched = match(case)
        figures.extend(figures_of(matched, measure(matched)))
    show("simulate", figures, NOTES, as_json)
    return 0
