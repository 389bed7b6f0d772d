"""What a re-run plays: the test and its faults as they led to a first-out, from how long before."""

from collections.abc import Mapping
from dataclasses import dataclass
from itertools import chain

from app.definitions.definition import Definition
from app.definitions.expansion import expand
from app.definitions.limits import RIG
from app.definitions.midway import Begun, Hold, begun_at
from app.definitions.nodes import force_nodes, motion_nodes
from app.first_outs.account import Account, Step
from rtcore.core import make_core
from rtcore.program.stream import Program
from rtcore.rig.faults import Fault

WHOLE_S = 120.0  # of a run that is played from its beginning
LEAD_S = 20.0  # before the first-out of a longer one, and of one outside a run


@dataclass(frozen=True)
class Scene:
    """Ticks count from where the re-run begins; `begun` is where a long test is set down."""

    program: Program | None  # None outside a run
    begun: tuple[Begun, Begun] | None
    trip_tick: int
    steps: tuple[Step, ...]
    began: str  # mode in which it begins, outside a run
    faults: Mapping[int, float]  # kinds and amounts that are there from the beginning


def scene_of(account: Account, definition: Definition | None) -> Scene:
    """What led to a first-out."""
    if account.run_tick is None or definition is None:
        return _outside(account)
    run_began = account.tick - account.run_tick
    steps = [step.model_copy(update={"tick": step.tick - run_began}) for step in account.steps]
    if account.run_tick > round(WHOLE_S / RIG.period_s):
        return _midway(account.run_tick, steps, definition)
    there, later = _faults_at(steps, 0), tuple(s for s in steps if s.tick > 0)
    return Scene(expand(definition), None, account.run_tick, later, "running", there)


def _faults_at(steps: list[Step], tick: int) -> dict[int, float]:
    """The faults that are there at a tick."""
    there: dict[int, float] = {}
    for step in steps:
        if step.tick <= tick and step.opcode == "inject_fault":
            there.pop(step.argument, None)
            if step.value != 0.0:
                there[step.argument] = step.value
    return there


def _outside(account: Account) -> Scene:
    lead = round(LEAD_S / RIG.period_s)
    since = account.tick - lead
    steps = tuple(s.model_copy(update={"tick": s.tick - since}) for s in account.steps)
    changed = {s.argument for s in steps if s.opcode == "inject_fault"}
    injected = {int(Fault[name.upper()]): amount for name, amount in account.injected.items()}
    there = {kind: amount for kind, amount in injected.items() if kind not in changed}
    return Scene(None, None, lead, steps, account.began, there)


def _midway(trip_tick: int, steps: list[Step], definition: Definition) -> Scene:
    """A long run from shortly before; what was frozen by holds does not count as program time."""
    holds = _holds(steps, trip_tick)
    first = trip_tick - round(LEAD_S / RIG.period_s)
    for begin, end in reversed(holds):
        if begin <= first < end:
            first = max(0, begin - 1)
    left_out = sum(round(s.value) for s in steps if s.opcode == "skip" and s.tick <= first)
    held, still = [], -left_out
    for begin, end in holds:
        if end <= first:
            held.append(Hold(begin - still, end - begin))
            still += end - begin
    force = list(chain(*force_nodes(definition.blocks, definition.controller.compensation)))
    motion = list(chain(*motion_nodes(definition.motion)))
    begun = begun_at(force, first - still, held), begun_at(motion, first - still, held)
    program = Program(begun[0].course, begun[1].course)
    later = (
        s.model_copy(update={"tick": s.tick - first})
        for s in steps
        if s.tick > first and s.opcode != "skip"
    )
    return Scene(
        program, begun, trip_tick - first, tuple(later), "running", _faults_at(steps, first)
    )


def _holds(steps: list[Step], trip_tick: int) -> list[tuple[int, int]]:
    """From which tick to which the program stood still: held, and fading in again."""
    fade = int(make_core(RIG.period_s, {})["settings"]["hold_fade_ticks"][0])
    found, held = [], None
    for step in steps:
        if step.opcode == "hold" and held is None:
            held = step.tick
        elif step.opcode == "resume" and held is not None:
            found.append((held, step.tick + min(step.tick - held, fade) - 1))
            held = None
    return [*found, (held, trip_tick + 1)] if held is not None else found
