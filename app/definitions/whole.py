"""What can only be said of a test as a whole: how long, how steep, how deep."""

from collections.abc import Iterator, Sequence

from pydantic_core import PydanticCustomError

from app.definitions.blocks import Block
from app.definitions.checks import ROUNDING
from app.definitions.extent import Extent, Survey
from app.definitions.limits import RIG
from app.definitions.motions import Motion
from app.definitions.nodes import force_nodes, motion_nodes
from app.definitions.pieces import Node, loops_within
from app.documents.fields import wrong
from app.documents.tree import Path
from app.documents.units import say
from rtcore.program.segments import MAX_DEPTH

Found = tuple[Path, PydanticCustomError]


def problems_of(blocks: Sequence[Block], motion: Sequence[Motion]) -> list[Found]:
    """Everything wrong with a test whose blocks are each right by themselves."""
    forces, motions = force_nodes(blocks, "auto"), motion_nodes(motion)
    return [
        *_of_depth("blocks", forces),
        *_of_depth("motion", motions),
        *_of_course("blocks", forces, RIG.force_rate_limit_n_s, "N/s"),
        *_of_course("motion", motions, RIG.velocity_limit_m_s, "m/s"),
    ]


def _of_depth(name: str, blocks: Sequence[Sequence[Node]]) -> Iterator[Found]:
    for i, nodes in enumerate(blocks):
        depth = loops_within(nodes)
        if depth > MAX_DEPTH:
            message = f"repeats nested {depth} deep, must be at most {MAX_DEPTH}"
            yield (name, i), wrong("", message, value=depth, limit=MAX_DEPTH)


def _of_course(
    name: str, blocks: Sequence[Sequence[Node]], rate_limit_per_s: float, unit: str
) -> Iterator[Found]:
    survey = Survey()
    total = Extent()
    for i, nodes in enumerate(blocks):
        extent = survey.measure(nodes)
        yield from _of_block((name, i), extent, rate_limit_per_s, unit)
        total = total.then(extent)
    duration_s = total.ticks * RIG.period_s
    if duration_s > RIG.duration_limit_s:
        limit = RIG.duration_limit_s
        message = f"lasts {say(duration_s, 's')} in all, must be at most {say(limit, 's')}"
        yield (name,), wrong("", message, value=duration_s, limit=limit, unit="s")


def _of_block(path: Path, extent: Extent, rate_limit_per_s: float, unit: str) -> Iterator[Found]:
    if extent.idle_at:
        yield extent.idle_at, wrong("times", "a pass of this repeat takes no time")
    if extent.cycles > RIG.cycle_limit:
        message = f"{extent.cycles:,} cycles, must be at most {RIG.cycle_limit:,}"
        yield path, wrong("", message, value=extent.cycles, limit=RIG.cycle_limit)
    steepest = extent.steepest_per_s
    if steepest > rate_limit_per_s * ROUNDING:
        message = (
            f"the setpoint has to move at {say(steepest, unit)} to begin or blend here, "
            f"must be at most {say(rate_limit_per_s, unit)}: allow more time, or ramp there before"
        )
        error = wrong("", message, value=steepest, limit=rate_limit_per_s, unit=unit)
        yield extent.steepest_at, error
