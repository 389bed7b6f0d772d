"""Every frequency response of a run, as far as it has got: chunk after chunk, with flat memory."""

from collections.abc import Callable, Iterable

from app.analysis.response.stepped import SteppedSine, channels_of
from app.analysis.response.transfers import TRANSFERS
from app.analysis.walk import NEEDED, Columns, Part, Walk
from app.conducting.found import Found
from app.conducting.multisines import Multisine, played_of
from app.conducting.positions import CHANNELS as OF_MOTION
from app.conducting.positions import PositionResponses, multisines_in
from app.conducting.sweeps import Stillness, SweptSine
from app.definitions.blocks import Block, Repeat, Sweep
from app.definitions.definition import Definition
from app.definitions.responses import FrequencyResponse
from app.definitions.windows import stretches
from app.documents.tree import Path
from rtcore.rig.parameters import RigParameters

CHANNELS = channels_of(TRANSFERS.values())
NEEDS = tuple(dict.fromkeys([*NEEDED, *CHANNELS, *OF_MOTION]))


def responds(definition: Definition) -> bool:
    """Whether there is anything in a test that has a response: sines, multisines, sweeps."""
    return _excites(definition.blocks) or bool(multisines_in(definition))


def _excites(blocks: Iterable[Block]) -> bool:
    return any(
        _excites(block.blocks)
        if isinstance(block, Repeat)
        else isinstance(block, FrequencyResponse | Sweep)
        for block in blocks
    )


def responses_in(definition: Definition | Repeat) -> list[FrequencyResponse]:
    """The frequency responses of a test, those that are repeated once."""
    found: list[FrequencyResponse] = []
    for block in definition.blocks:
        if isinstance(block, Repeat):
            found += responses_in(block)
        elif isinstance(block, FrequencyResponse):
            found.append(block)
    return found


class Responding:
    """Takes a run chunk by chunk, each with the columns `NEEDS`; gives its points."""

    def __init__(
        self,
        definition: Definition,
        period_s: float,
        first_tick: int | None = None,
        rig: RigParameters | None = None,
    ) -> None:
        """`first_tick` is that of the run, where it is not that of its first record.

        With a model of the `rig` the unit's own stiffness and admittance are told too.
        """
        self._definition = definition
        self._walk = Walk(stretches(definition), period_s, first_tick, also=CHANNELS)
        self._stepped = SteppedSine(period_s, rig=rig)
        self._multisines: dict[Path, Multisine] = {}
        self._sweeps: dict[Path, SweptSine] = {}
        self._stillness = Stillness()
        self._positions = PositionResponses(definition, period_s, first_tick)

    def take(self, chunk: Columns, also: Callable[[Part], None] | None = None) -> None:
        """The next ticks of the run; each part of a response of the force goes to `also` too."""
        self._positions.take(chunk)
        for part in self._walk.take(chunk):
            asked = block_at(self._definition, part.stretch.path)
            if isinstance(asked, Sweep):
                self._sweep(part, asked, chunk).take(part)
            if not isinstance(asked, FrequencyResponse):
                continue
            if asked.method == "multisine":
                self._multisine(part, asked).take(part)
            else:
                self._stepped.take(part)
            if also is not None:
                also(part)
        for sweep in self._sweeps.values():
            sweep.follow(chunk)
        self._stillness.take(chunk)

    def points(self) -> list[Found]:
        """All that there are so far; the last may still change."""
        stepped = [Found("stepped_sine", point) for point in self._stepped.points()]
        multisines = [found for one in self._multisines.values() for found in one.points()]
        sweeps = [found for one in self._sweeps.values() for found in one.points()]
        return stepped + multisines + sweeps + self._positions.points()

    def latest(self) -> list[Found]:
        """The stepped sine that is being measured now, of each transfer."""
        return [Found("stepped_sine", point) for point in self._stepped.latest()]

    def _sweep(self, part: Part, asked: Sweep, chunk: Columns) -> SweptSine:
        path = part.stretch.path
        if path not in self._sweeps:
            still_ticks = self._stillness.before(chunk, int(part.columns["tick"][0]))
            self._sweeps[path] = SweptSine(part.stretch.block, asked, still_ticks)
        return self._sweeps[path]

    def _multisine(self, part: Part, asked: FrequencyResponse) -> Multisine:
        path = part.stretch.path
        if path not in self._multisines:
            self._multisines[path] = Multisine(part.stretch.block, played_of(asked))
        return self._multisines[path]


def block_at(definition: Definition, path: Path) -> Block | None:
    """The block of a path, ("blocks", 1, "blocks", 0)."""
    found: Definition | Block = definition
    for key in path[1::2]:
        if not isinstance(found, Definition | Repeat):
            return None
        found = found.blocks[int(key)]
    return None if isinstance(found, Definition) else found
