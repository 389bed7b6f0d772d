"""A long test cut down to what has to be predicted: one of whatever repeats. A pure function of its definition.

Whole cycles and whole passes are left out, so the setpoint goes through the same joints at the same phase, and no
block is lost. A first pass may begin elsewhere than those after it: then two are kept.
"""

from dataclasses import dataclass

from app.definitions.definition import Definition
from app.definitions.outline import BlockOutline, MotionOutline, Outline, outline
from app.prediction.cutting import Cut, cut_blocks, cut_motions

WHOLE_S = 60.0  # a test that lasts no longer is predicted whole
TOGETHER_S = (
    1800.0  # nor is one of which loads and motions would come apart, as long as that takes a minute
)
KEEP_S = 5.0  # of a steady load, a hold or what repeats


@dataclass(frozen=True)
class Shortened:
    """A definition that is as long as it need be, and what of the whole is not in it.

    `apart` are pairs of block and motion, by number, that meet in the whole test and not in this one.
    """

    definition: Definition
    cuts: tuple[Cut, ...] = ()
    apart: tuple[tuple[int, int], ...] = ()


def shorten(definition: Definition) -> Shortened:
    """The definition itself where it is short enough, or what stands for all of it."""
    whole = outline(definition)
    if whole.duration_s <= WHOLE_S:
        return Shortened(definition)
    found = _cut(definition, whole, KEEP_S)
    if found.apart:  # blocks so long that each meets every motion
        moved_s = outline(found.definition).motion_duration_s
        found = _cut(definition, whole, max(KEEP_S, moved_s), motion=found)
    shorter_s = outline(found.definition).duration_s
    if (found.apart and whole.duration_s <= TOGETHER_S) or shorter_s >= whole.duration_s:
        return Shortened(definition)
    return found


def _cut(
    definition: Definition, whole: Outline, keep_s: float, motion: Shortened | None = None
) -> Shortened:
    """Blocks cut to `keep_s`, and motions as cut before, or to what the blocks then last."""
    blocks, cuts = cut_blocks(definition.blocks, keep_s)
    shorter = definition.model_copy(update={"blocks": blocks})
    if motion is None:
        moved, more = cut_motions(definition.motion, outline(shorter).duration_s)
    else:
        moved = motion.definition.motion
        more = [cut for cut in motion.cuts if cut.path.startswith("motion")]
    shorter = shorter.model_copy(update={"motion": moved})
    apart = _meetings(whole) - _meetings(outline(shorter))
    return Shortened(shorter, (*cuts, *more), tuple(sorted(apart)))


def _meetings(plan: Outline) -> set[tuple[int, int]]:
    """Which block meets which motion."""
    return {(b.index, m.index) for b in plan.blocks for m in plan.motion if _meet(b, m)}


def _meet(block: BlockOutline, motion: MotionOutline) -> bool:
    began_s = max(block.start_s, motion.start_s)
    return began_s < min(block.start_s + block.duration_s, motion.start_s + motion.duration_s)
