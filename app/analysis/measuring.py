"""Measures a run in one pass over its chunks, with memory that does not grow with its length."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

from app.analysis.cycles import CycleReader
from app.analysis.evidence import Kind, Stretch
from app.analysis.findings import CycleStatistics, Findings, StepStatistics
from app.analysis.measurements import Values, nothing, read_all
from app.analysis.predicted import Predicted
from app.analysis.sine_responses import Required
from app.analysis.sines import FoundSine, SineFit
from app.analysis.step_response import StepFollower
from app.analysis.tally import Tally, Tallying
from app.analysis.walk import Columns, Part, Walk


@dataclass(frozen=True)
class Measured:
    """Every measurement of a run, and of each block that it reached, by name.

    `finished` are the blocks that were played to their last tick. `sines` are all that were
    fitted: a spectrum's layers, the steps of a frequency response.
    """

    run: Values
    blocks: Mapping[int, Values]
    finished: frozenset[int]
    sines: tuple[FoundSine, ...]


class _Block:
    """What is found in one block while it goes on."""

    def __init__(self) -> None:
        self.whole, self.data, self.counted = Tally(), Tally(), Tally()
        self.cycles = CycleStatistics()
        self.steps = StepStatistics()
        self.counts = False


class Measuring:
    """Takes a run chunk by chunk: each with the columns `app.analysis.walk.NEEDED`, in order."""

    def __init__(
        self,
        stretches: Iterable[Stretch],
        period_s: float,
        *,
        valve_limit: float = 1.0,
        predicted: Predicted | None = None,
        first_tick: int | None = None,
        counts_cycles: bool = True,
        required: Sequence[Required] = (),
    ) -> None:
        """`first_tick` is that of the run, where it is not that of its first record.

        `counts_cycles` says whether the test counts cycles anywhere: then only they are data of the
        run as a whole, even where it did not get so far.
        """
        self._walk = Walk(stretches, period_s, first_tick)
        self._period_s = period_s
        self._counts_cycles = counts_cycles
        self._required = required
        self._predicted = predicted
        self._tallying = Tallying(valve_limit)
        self._sines = SineFit(period_s)
        self._cycles = CycleReader()
        self._step: StepFollower | None = None
        self._blocks: dict[int, _Block] = {}
        self._at: Stretch | None = None
        self._position = -1  # last tick of the program so far

    def take(self, chunk: Columns) -> None:
        """The next ticks of the run."""
        for part in self._walk.take(chunk):
            self._take(part)

    def result(self) -> Measured:
        """What it all amounts to; nothing can be taken afterwards."""
        self._end_stretch()
        blocks = {number: read_all(self._of_block(number)) for number in sorted(self._blocks)}
        run = read_all(self._of_run()) if self._blocks else nothing()
        sines = tuple(sine for number in blocks for sine in self._sines.of_block(number))
        return Measured(run, blocks, self._finished(), sines)

    def _take(self, part: Part) -> None:
        if part.begins:
            self._begin(part.stretch)
        stretch = part.stretch
        block = self._blocks[stretch.block]
        reference_n = None if self._predicted is None else self._predicted.at(part.positions)
        found = self._tallying.of(part, reference_n)
        block.whole.add(found)
        if stretch.kind is not Kind.LEAD:
            block.data.add(found)
        if stretch.counts:
            block.counted.add(found)
        self._sines.take(part)
        block.cycles.take(self._cycles.take(part))
        if self._step is not None:
            self._step.take(part.positions - stretch.first, part.columns["force_n"])
        self._position = int(part.positions[-1])

    def _begin(self, stretch: Stretch) -> None:
        self._end_stretch()
        self._at = stretch
        block = self._blocks.setdefault(stretch.block, _Block())
        block.counts |= stretch.counts
        if stretch.kind is Kind.STEP and stretch.begin_n != stretch.end_n:
            steady_from = (stretch.last - stretch.first) // 2
            self._step = StepFollower(stretch.begin_n, stretch.end_n, self._period_s, steady_from)

    def _end_stretch(self) -> None:
        if self._at is None:
            return
        block = self._blocks[self._at.block]
        block.cycles.take(self._cycles.close())
        step, self._step = self._step, None
        if step is not None:
            block.steps.take(step.read())

    def _of_block(self, number: int) -> Findings:
        block = self._blocks[number]
        data = block.counted if block.counts else block.data
        sines = self._sines.of_block(number)
        whole, cycles, steps = block.whole, block.cycles, block.steps
        return Findings(
            whole, data, cycles, steps, sines, self._required, block.counts, self._period_s
        )

    def _of_run(self) -> Findings:
        found = Findings(
            required=self._required, has_cycles=self._counts_cycles, period_s=self._period_s
        )
        for block in self._blocks.values():
            found.whole.add(block.whole)
            found.data.add(block.counted if self._counts_cycles else block.data)
            found.cycles.add(block.cycles)
            if block.steps.worst is not None:
                found.steps.take(block.steps.worst)
        found.sines = self._sines.of_run()
        return found

    def _finished(self) -> frozenset[int]:
        """The blocks before the present one, and that one where its last tick was played."""
        if self._at is None:
            return frozenset()
        following = self._walk.following()
        over = following is None or following.block != self._at.block
        at_end = self._position + 1 >= self._at.last and over
        return frozenset(range(self._at.block + at_end))
