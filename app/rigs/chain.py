"""The hard-wired chain, as the loop's own detector of it saw it in its latest tick."""

from app.link.life import Life
from app.rigs.schemas import Chain
from rtcore.interlocks import Quantity


def chain_of(life: Life | None) -> Chain:
    """Its state; null where no loop lives, or none of its detectors looks at the chain."""
    if life is None or not life.alive:
        return Chain(closed=None)
    table = life.detectors()
    looking = [i for i, one in enumerate(table["quantity"]) if one == Quantity.CHAIN_OPEN]
    if not looking:
        return Chain(closed=None)
    return Chain(closed=bool(life.block.fields["detector_values"][looking[0]] == 0.0))
