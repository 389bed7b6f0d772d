"""How load and motion meet: how much of a motion goes by under a block, and at which of its phases the load comes.

What is cut out of a test moves the rest of it against the motion. So a shorter test tells of a block under a motion
only where it shows as much of that motion, and the load at every phase at which the whole test has it.
"""

from collections.abc import Iterable, Iterator, Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

from app.definitions.definition import Definition
from app.definitions.extent import AT_REST, State, Survey
from app.definitions.limits import RIG
from app.definitions.nodes import force_nodes
from app.definitions.outline import BlockOutline, MotionOutline, Outline, outline
from app.documents.tree import Path

BINS = 128  # of a cycle of the motion
NEAR_BINS = 8  # 22.5°: so far from what was seen, a sine is within 8 % of its peak
MOST_PASSES = 4096  # that are looked at, spread over however many there are
FULL_CYCLES = 2  # of a swinging motion, after its taper
REST_S = 5.0  # of a unit at rest

Phases = npt.NDArray[np.bool_]  # (BINS,): at which phases of the motion something begins
Pair = tuple[int, int]


def unlike(whole: Definition, shorter: Definition) -> set[Pair]:
    """Pairs of block and motion, by number, of which the shorter test shows less than there is."""
    first, second = outline(whole), outline(shorter)
    found = {pair for pair in meetings(first) if _less(whole, first, second, pair)}
    rhythms = {j: hz for j, item in enumerate(whole.motion) if (hz := _rhythm_hz(item, first, j))}
    states = list(_states(whole))
    for i, j in meetings(first) - found:
        if j in rhythms:
            began = [
                (d.blocks[i], plan.blocks[i].start_s - plan.motion[j].start_s)
                for d, plan in ((whole, first), (shorter, second))
            ]
            seen = [_phases(item, at_s, states[i], rhythms[j]) for item, at_s in began]
            if not all(_covers(seen[1][path], wanted) for path, wanted in seen[0].items()):
                found.add((i, j))
    return found


def meetings(plan: Outline) -> set[Pair]:
    """Which block meets which motion."""
    return {(b.index, m.index) for b in plan.blocks for m in plan.motion if _overlap_s(b, m) > 0}


def _overlap_s(block: BlockOutline, motion: MotionOutline) -> float:
    ends_s = min(block.start_s + block.duration_s, motion.start_s + motion.duration_s)
    return ends_s - max(block.start_s, motion.start_s)


def _less(whole: Definition, first: Outline, second: Outline, pair: Pair) -> bool:
    """Whether less of a motion goes by under a block than there is to be seen of it."""
    i, j = pair
    has_s, shows_s = (_overlap_s(plan.blocks[i], plan.motion[j]) for plan in (first, second))
    enough_s = min(_all_of_s(whole.motion[j], first, j), second.motion[j].duration_s)
    return shows_s < min(has_s, enough_s) - RIG.period_s


def _all_of_s(item: Any, plan: Outline, index: int) -> float:
    """How long it takes to see everything that a motion does."""
    lasts_s = plan.motion[index].duration_s
    if item.kind == "harmonic":
        return float((FULL_CYCLES + item.taper_cycles) / item.frequency_hz)
    if item.kind == "time_history":
        return float(lasts_s / item.repeats)
    return min(lasts_s, REST_S) if item.kind in ("hold", "step") else lasts_s


def _rhythm_hz(item: Any, plan: Outline, index: int) -> float:
    """How often a motion comes back to where it was; 0 for one that does not."""
    if item.kind == "harmonic":
        return float(item.frequency_hz)
    repeats = item.repeats if item.kind == "time_history" else 1
    return repeats / plan.motion[index].duration_s if repeats > 1 else 0.0


def _states(definition: Definition) -> Iterator[State]:
    """The setpoint at which each block begins."""
    survey = Survey(AT_REST)
    for nodes in force_nodes(definition.blocks, definition.controller.compensation):
        yield survey.state
        survey.measure(nodes)


def _covers(seen: Phases, wanted: Phases) -> bool:
    near = np.zeros(BINS, np.bool_)
    for shift in range(-NEAR_BINS, NEAR_BINS + 1):
        near |= np.roll(seen, shift)
    return bool(near[wanted].all())


def _phases(item: Any, at_s: float, state: State, hz: float) -> dict[Path, Phases]:
    """At which phases of a motion of a frequency a block begins, and all that repeats in it."""
    begins = np.zeros(BINS, np.bool_)
    begins[_bin(at_s * hz)] = True
    return dict(_within(item, (), begins, state, hz))


def _within(
    item: Any, path: Path, begins: Phases, state: State, hz: float
) -> Iterator[tuple[Path, Phases]]:
    if item.kind == "harmonic":
        cycles = item.cycles or item.duration_s * item.frequency_hz
        yield path, _again(begins, hz / item.frequency_hz, int(cycles))
    elif item.kind == "layers":
        yield from _of_layers(item, path, begins, hz)
    elif item.kind == "repeat":
        yield from _of_repeat(item, path, begins, state, hz)
    elif item.kind == "time_history":
        once, _ = _measure([item.model_copy(update={"repeats": 1})], state)
        yield path, _again(begins, once * hz, item.repeats)
    elif item.kind == "step" or _is_quick(item, state, hz):
        yield path, begins


def _is_quick(item: Any, state: State, hz: float) -> bool:
    """Whether a block is over before the motion has come round: then it matters when it comes."""
    if item.kind == "hold" and item.force_n is None:
        return False
    return item.kind == "hold" or _measure([item], state)[0] * hz < 1.0


def _of_layers(item: Any, path: Path, begins: Phases, hz: float) -> Iterator[tuple[Path, Phases]]:
    pass_s = sum(x.cycles / x.frequency_hz + item.transition_s for x in item.layers)
    begins = _again(begins, pass_s * hz, item.repeats)
    at_s = 0.0
    for i, layer in enumerate(item.layers):
        cycles = _again(begins, hz / layer.frequency_hz, layer.cycles)
        yield (*path, i), np.roll(cycles, _bin(at_s * hz))
        at_s += layer.cycles / layer.frequency_hz + item.transition_s


def _of_repeat(
    item: Any, path: Path, begins: Phases, state: State, hz: float
) -> Iterator[tuple[Path, Phases]]:
    _, state = _measure(item.blocks, state)
    pass_s, _ = _measure(item.blocks, state)
    begins = _again(begins, pass_s * hz, item.times)
    at_s = 0.0
    for i, inner in enumerate(item.blocks):
        yield from _within(inner, (*path, i), np.roll(begins, _bin(at_s * hz)), state, hz)
        lasts_s, state = _measure([inner], state)
        at_s += lasts_s


def _measure(items: Sequence[Any], state: State) -> tuple[float, State]:
    survey = Survey(state)
    nodes: Iterable[Any] = (node for part in force_nodes(items, "auto") for node in part)
    return survey.measure(nodes).ticks * RIG.period_s, survey.state


def _again(begins: Phases, cycles: float, times: int) -> Phases:
    """What begins at some phases, so many times in all, so many cycles of the motion apart."""
    passes = np.arange(min(times, MOST_PASSES), dtype=np.float64)
    if times > MOST_PASSES:
        passes = np.concatenate([passes, np.linspace(0, times - 1, MOST_PASSES).round()])
    found = np.zeros(BINS, np.bool_)
    for shift in np.unique(np.round(passes * cycles % 1.0 * BINS).astype(np.int64) % BINS):
        found |= np.roll(begins, shift)
    return found


def _bin(cycles: float) -> int:
    return round(cycles % 1.0 * BINS) % BINS
