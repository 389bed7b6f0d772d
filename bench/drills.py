"""Every drill in every situation on the virtual clock: what trips, how soon, and how far the rig gets meanwhile."""

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache
from typing import NamedTuple

import numpy as np

from app.controller.record import to_record as gains_record
from app.controller.settings import ControllerSettings
from app.definitions.definition import Definition
from app.drills.drills import DRILLS, Drill, Reaction
from app.drills.score import Score
from app.drills.scoring import BLED_S, SAFE_S, TAIL_S, Limits, Seen, reaction_of, score
from app.interlocks.defaults import default_interlocks
from app.interlocks.record import to_record as interlocks_record
from bench.recorded import Floats, begin, make_test, true_force
from bench.report import Figure, show, tracked
from rtcore.codes import Opcode, Reply
from rtcore.modes import Mode
from rtcore.rig.faults import FAULTS
from rtcore.rig.parameters import load_rig
from rtcore.rig.plant import V_R, X_B, X_R, X_T
from rtcore.virtual import PERIOD_S, Virtual

END_STOP_M = 0.0397  # at which the piston meets its end caps
SECONDS = 30.0


class Situation(NamedTuple):
    """What the rig does as the fault comes."""

    name: str
    what: str
    test: Definition | None  # None: it is ready
    after_s: float  # from the start of the test


@cache
def situations() -> tuple[Situation, ...]:
    """Ready, holding, and moving."""
    moving = make_test(
        [{"kind": "harmonic", "amplitude_n": 2000, "frequency_hz": 50, "duration_s": SECONDS}],
        [{"kind": "harmonic", "amplitude_m": 0.002073, "frequency_hz": 4, "duration_s": SECONDS}],
    )
    return (
        Situation("ready", "ready", None, 1.0),
        Situation("holding_30_kn", "holding 30 kN", _holding(30e3), 1.5),
        Situation("moving", "2 kN at 50 Hz, unit moving", moving, 1.5),
        Situation("holding_45_kn", "holding 45 kN", _holding(45e3), 2.5),
    )


def _holding(force_n: float) -> Definition:
    return make_test([{"kind": "step", "to_n": force_n, "hold_s": SECONDS}])


@dataclass(frozen=True)
class Given:
    """A drill that was given: how it was scored, and the rig's true peaks, which no sensor tells."""

    drill: Drill
    situation: Situation
    reaction: Reaction
    score: Score
    force_n: float
    unit_m: float
    stroke_m: float
    rod_m_s: float
    states: Floats


def brought_to(situation: Situation, seed: int = 1) -> Virtual:
    """A rig with its twin, in the middle of it."""
    table = interlocks_record(default_interlocks(), PERIOD_S)
    virtual = Virtual(gains_record(ControllerSettings()), table, seed=seed, twin=True)
    virtual.bring_to_ready()
    virtual.advance(round(1.0 / PERIOD_S))
    if situation.test is not None:
        begin(virtual, situation.test)
    virtual.advance(round(situation.after_s / PERIOD_S))
    return virtual


def give(drill: Drill, situation: Situation, amount: float | None = None) -> Given | None:
    """Give a drill and wait until everything has been seen; None where it is not for this situation."""
    mode = Mode.READY if situation.test is None else Mode.RUNNING
    reaction = reaction_of(drill, mode)
    if reaction is None:
        return None
    virtual = brought_to(situation)
    virtual.events()  # what led here
    wanted = FAULTS[drill.fault].default if amount is None else amount
    reply = virtual.command(Opcode.INJECT_FAULT, drill.fault, wanted)
    if virtual.mode is not mode or reply is not Reply.ACCEPTED:
        raise RuntimeError(f"{drill.name} was not taken: {virtual.mode.name}, {reply.name}")
    tick = virtual.tick - 1
    virtual.keep_states = True
    parts, states = [], []
    for seconds in (reaction.within_s + TAIL_S, SAFE_S, BLED_S + TAIL_S):
        parts.append(virtual.advance(round(seconds / PERIOD_S)))
        states.append(virtual.states)
    driven = np.concatenate(states)
    detectors = default_interlocks().detectors
    seen = Seen(
        tick=tick,
        mode=mode,
        period_s=PERIOD_S,
        records=np.concatenate(parts),
        events=virtual.events(),
        detectors=virtual.block.fields["interlocks"][1]["detectors"][: len(detectors)],
        names=[d.name for d in detectors],
    )
    rig = load_rig()
    return Given(
        drill=drill,
        situation=situation,
        reaction=reaction,
        score=score(drill, reaction, seen, Limits.of(rig)),
        force_n=_greatest(true_force(rig, driven)),
        unit_m=_greatest(driven[:, X_T]),
        stroke_m=_greatest(driven[:, X_R] - driven[:, X_B]),
        rod_m_s=_greatest(driven[:, V_R]),
        states=driven,
    )


def _greatest(values: Floats) -> float:
    """The value of the greatest magnitude, with its sign."""
    return float(values[np.argmax(np.abs(values))])


def figures(given: Given) -> Iterator[Figure]:
    """How soon the rig knew, how far it got, and whether all was as expected."""
    key = f"{given.drill.name}_{given.situation.name}"
    what = f"{given.drill.kind.name}, {given.situation.what}"
    limits, scored, reaction = Limits.of(load_rig()), given.score, given.reaction
    if reaction.first_outs:
        ticks = scored.reaction_ticks
        yield Figure(
            f"{key}_reaction_ticks",
            f"{what}: reaction",
            None if ticks is None else float(ticks),
            "ticks",
            at_most=reaction.within_s / PERIOD_S,
            note=f"{scored.first_out}: {scored.action}, safe after {scored.safe_ticks} ticks",
        )
    for name, word, value, unit, limit in (
        ("force_n", "force", given.force_n, "N", limits.force_n),
        ("unit_m", "unit", given.unit_m, "m", limits.displacement_m),
        ("stroke_m", "piston's stroke", given.stroke_m, "m", END_STOP_M),
        ("rod_m_s", "rod", given.rod_m_s, "m/s", None),
    ):
        yield Figure(f"{key}_peak_{name}", f"{what}: {word}", abs(value), unit, at_most=limit)
    failed = [e.text for e in scored.expectations if not e.met]
    yield Figure(
        f"{key}_passed", f"{what}: as expected", float(not failed), "", 1.0, 1.0, "; ".join(failed)
    )


NOTES = [
    "reaction: ticks from the one in which the loop took the fault; safe: valve at null and supply off",
    "peaks are the plant's own, in the load cell, at the unit, of piston in cylinder, of the rod",
    f"the load cell ends at 60 kN, the unit's stroke at 30 mm, the piston's at {END_STOP_M * 1e3:g} mm",
]


def main(as_json: bool) -> int:
    """Give every drill in every situation and print. Exit code 0 whether targets were met or not."""
    cases = [(drill, situation) for drill in DRILLS for situation in situations()]
    found = [give(*case) for case in tracked(cases, "giving drills")]
    rows = [figure for given in found if given is not None for figure in figures(given)]
    show("drills", rows, NOTES, as_json)
    return 0
