"""How each kind of block and motion is cut down: a table, a function a kind. What is not in it stays whole."""

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

from app.definitions import blocks as force
from app.definitions import motions as motion
from app.definitions.extent import AT_REST, State, Survey
from app.definitions.limits import RIG
from app.definitions.nodes import force_nodes, motion_nodes
from app.definitions.pieces import Node
from app.documents.tree import Path
from app.documents.units import say

KEEP_CYCLES = 2
RAMP_S = 60.0  # a ramp that takes longer is all but at rest, however long it takes


@dataclass(frozen=True)
class Cut:
    """What was left out: where, and in words."""

    path: str
    text: str


def cut_blocks(
    blocks: Sequence[force.Block], keep_s: float
) -> tuple[tuple[force.Block, ...], list[Cut]]:
    """The blocks with so much of whatever is steady or repeats, and what was left out."""
    cutter = _Cutter(keep_s, "block", lambda items: force_nodes(items, "auto"))
    return cutter.each(blocks, ("blocks",), AT_REST), cutter.cuts


def cut_motions(
    motions: Sequence[motion.Motion], keep_s: float
) -> tuple[tuple[motion.Motion, ...], list[Cut]]:
    """The same of motions."""
    cutter = _Cutter(keep_s, "motion", motion_nodes)
    return cutter.each(motions, ("motion",), AT_REST), cutter.cuts


@dataclass
class _Cutter:
    keep_s: float
    word: str
    nodes: Callable[[Sequence[Any]], Sequence[Sequence[Node]]]
    cuts: list[Cut] = field(default_factory=list)

    def each(self, items: Sequence[Any], path: Path, state: State) -> tuple[Any, ...]:
        """Items one after another, from a setpoint on."""
        found = []
        for i, item in enumerate(items):
            cut = _CUTS.get(item.kind)
            found.append(cut(self, item, (*path, i), state) if cut else item)
            _, state = self.measure([item], state)
        return tuple(found)

    def measure(self, items: Sequence[Any], state: State) -> tuple[float, State]:
        """How long items take from a setpoint, and where they leave it."""
        survey = Survey(state)
        extent = survey.measure(node for nodes in self.nodes(items) for node in nodes)
        return extent.ticks * RIG.period_s, survey.state

    def say(self, path: Path, text: str) -> None:
        """Note a cut."""
        self.cuts.append(Cut(_written(path), f"{self.word} {_spoken(path)}: {text}"))

    def fewer(self, cycles: int, frequency_hz: float) -> int:
        """How many cycles are kept of so many."""
        kept = max(KEEP_CYCLES, math.ceil(self.keep_s * frequency_hz))
        return kept if cycles > 2 * kept else cycles


def _hold(cutter: _Cutter, item: Any, path: Path, state: State) -> Any:
    return _rest(cutter, item, path, "duration_s")


def _step(cutter: _Cutter, item: Any, path: Path, state: State) -> Any:
    return _rest(cutter, item, path, "hold_s")


def _rest(cutter: _Cutter, item: Any, path: Path, name: str) -> Any:
    whole_s = getattr(item, name)
    if whole_s <= 2 * cutter.keep_s:
        return item
    cutter.say(path, f"{_seconds(cutter.keep_s)} of {_seconds(whole_s)} at rest")
    return item.model_copy(update={name: cutter.keep_s})


def _ramp(cutter: _Cutter, item: Any, path: Path, state: State) -> Any:
    whole_s, _ = cutter.measure([item], state)
    limit_s = max(RAMP_S, cutter.keep_s)
    if whole_s <= 2 * limit_s:
        return item
    cutter.say(path, f"its way in {_seconds(limit_s)} instead of {_seconds(whole_s)}")
    rate = "rate_n_s" if cutter.word == "block" else "rate_m_s"
    return item.model_copy(update={rate: None, "duration_s": limit_s})


def _harmonic(cutter: _Cutter, item: Any, path: Path, state: State) -> Any:
    hz = item.frequency_hz
    cycles = item.cycles or math.floor(item.duration_s * hz)
    kept = cutter.fewer(cycles, hz)
    if kept == cycles:
        return item
    cutter.say(path, f"{kept:,} of {cycles:,} cycles")
    if item.cycles:
        return item.model_copy(update={"cycles": kept})
    return item.model_copy(update={"duration_s": item.duration_s - (cycles - kept) / hz})


def _layers(cutter: _Cutter, item: Any, path: Path, state: State) -> Any:
    kept = []
    for i, layer in enumerate(item.layers):
        cycles = cutter.fewer(layer.cycles, layer.frequency_hz)
        kept.append(layer.model_copy(update={"cycles": cycles}))
        if cycles < layer.cycles:
            cutter.say((*path, "layers", i), f"{cycles:,} of {layer.cycles:,} cycles")
    shorter = item.model_copy(update={"layers": tuple(kept)})
    pass_s = sum(x.cycles / x.frequency_hz + item.transition_s for x in kept)
    return _passes(cutter, shorter, path, "repeats", pass_s, alike=False)


def _repeat(cutter: _Cutter, item: Any, path: Path, state: State) -> Any:
    blocks = cutter.each(item.blocks, (*path, "blocks"), state)
    shorter = item.model_copy(update={"blocks": blocks})
    _, end = cutter.measure(item.blocks, state)
    pass_s, _ = cutter.measure(blocks, end)
    return _passes(cutter, shorter, path, "times", pass_s, alike=_alike(end, state))


def _time_history(cutter: _Cutter, item: Any, path: Path, state: State) -> Any:
    once = item.model_copy(update={"repeats": 1})
    _, end = cutter.measure([once], state)
    pass_s, _ = cutter.measure([once], end)
    return _passes(cutter, item, path, "repeats", pass_s, alike=_alike(end, state))


def _passes(
    cutter: _Cutter, item: Any, path: Path, name: str, pass_s: float, *, alike: bool
) -> Any:
    """Some passes of many; `alike` is whether the first begins where all others do."""
    times = getattr(item, name)
    enough = math.ceil(cutter.keep_s / pass_s - 1e-9) if pass_s > 0 else times
    kept = min(times, max(enough, 1 if alike else 2))
    if kept == times:
        return item
    cutter.say(path, f"{'one' if kept == 1 else f'{kept:,}'} of {times:,} passes")
    return item.model_copy(update={name: kept})


_CUTS: Mapping[str, Callable[[_Cutter, Any, Path, State], Any]] = {
    "hold": _hold,
    "step": _step,
    "ramp": _ramp,
    "harmonic": _harmonic,
    "layers": _layers,
    "repeat": _repeat,
    "time_history": _time_history,
}


def _alike(a: State, b: State) -> bool:
    """Whether two setpoints are one and the same, but for rounding; where nothing swings, so is every phase."""
    near = all(
        math.isclose(x, y, rel_tol=1e-9, abs_tol=1e-9)
        for x, y in ((a.value, b.value), (a.mean, b.mean), (a.amplitude, b.amplitude))
    )
    swings = a.amplitude != 0.0 or b.amplitude != 0.0
    return near and not (
        swings and (a.frequency_hz, a.phase_cycles) != (b.frequency_hz, b.phase_cycles)
    )


def _seconds(value_s: float) -> str:
    return say(float(f"{value_s:.4g}"), "s")


def _written(path: Path) -> str:
    """`blocks[2].blocks[0]`."""
    return "".join(f"[{p}]" if isinstance(p, int) else f".{p}" for p in path).lstrip(".")


def _spoken(path: Path) -> str:
    """`3.1` for the first block within the third, `3, layer 2` for a layer of it."""
    numbers = [p + 1 for p in path if isinstance(p, int)]
    if "layers" in path:
        return f"{'.'.join(map(str, numbers[:-1]))}, layer {numbers[-1]}"
    return ".".join(map(str, numbers))
