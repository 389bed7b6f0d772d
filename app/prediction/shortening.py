"""A long test cut down to what has to be predicted: one of whatever repeats. A pure function of its definition.

Whole cycles and whole passes are left out, so the setpoint goes through the same joints at the same phase, and no
block is lost. A first pass may begin elsewhere than those after it: then two are kept.
"""

from collections.abc import Iterator
from dataclasses import dataclass

from app.definitions.definition import Definition
from app.definitions.outline import outline
from app.prediction.cutting import Cut, cut_blocks, cut_motions
from app.prediction.meeting import unlike

WHOLE_S = 60.0  # a test that lasts no longer is predicted whole
TOGETHER_S = (
    1800.0  # nor is one of which loads and motions would come apart, as long as that takes a minute
)
KEEP_S = (
    5.0,
    60.0,
    300.0,
)  # of a steady load, a hold or what repeats; more where a motion needs it


@dataclass(frozen=True)
class Shortened:
    """A definition that is as long as it need be, and what of the whole is not in it.

    `apart` are pairs of block and motion, by number, that do not meet in this one as they do in the
    whole test: not for as long, or not at every phase.
    """

    definition: Definition
    cuts: tuple[Cut, ...] = ()
    apart: tuple[tuple[int, int], ...] = ()


def shorten(definition: Definition, wait_s: float = 0.0) -> Shortened:
    """The definition itself where it is short enough, or what stands for all of it.

    `wait_s` is for how long a detector wants to see what it trips at: no steady load is cut below that.
    """
    whole_s = outline(definition).duration_s
    if whole_s <= WHOLE_S:
        return Shortened(definition)
    found = min(_tried(definition, wait_s), key=lambda tried: len(tried.apart))
    if (found.apart and whole_s <= TOGETHER_S) or _lasts_s(found) >= whole_s:
        return Shortened(definition)
    return found


def _tried(definition: Definition, wait_s: float) -> Iterator[Shortened]:
    """Cut ever less, until load and motion meet in it as they do in the whole."""
    for keep_s in (max(kept, 1.5 * wait_s) for kept in KEEP_S):
        found = _cut(definition, keep_s)
        yield found
        if not found.apart:
            return
        moved_s = outline(
            found.definition
        ).motion_duration_s  # so long that each meets every motion
        more = _cut(definition, max(keep_s, moved_s), motion=found)
        if _lasts_s(more) <= TOGETHER_S:
            yield more
            if not more.apart:
                return


def _lasts_s(found: Shortened) -> float:
    return outline(found.definition).duration_s


def _cut(definition: Definition, keep_s: float, motion: Shortened | None = None) -> Shortened:
    """Blocks cut to `keep_s`, and motions as cut before, or to what the blocks then last."""
    blocks, cuts = cut_blocks(definition.blocks, keep_s)
    shorter = definition.model_copy(update={"blocks": blocks})
    if motion is None:
        moved, more = cut_motions(definition.motion, outline(shorter).duration_s)
    else:
        moved = motion.definition.motion
        more = [cut for cut in motion.cuts if cut.path.startswith("motion")]
    shorter = shorter.model_copy(update={"motion": moved})
    apart = unlike(definition, shorter) if definition.motion else set()
    return Shortened(shorter, (*cuts, *more), tuple(sorted(apart)))
