"""What a run amounts to: its measurements, held against the test's acceptance criteria."""

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from typing import Any

import numpy.typing as npt

from app.analysis.acceptance import Verdict, judge, overall
from app.analysis.measurements import MEASUREMENTS, Values
from app.analysis.measuring import Measured, Measuring
from app.analysis.predicted import Predicted
from app.analysis.sine_responses import Required
from app.analysis.walk import Columns, Walk
from app.definitions.definition import Criterion, Definition
from app.definitions.nodes import force_nodes
from app.definitions.pieces import Node, Piece
from app.definitions.responses import FrequencyResponse
from app.definitions.windows import stretches

NEEDS_REFERENCE = "goodness_of_fit"


@dataclass(frozen=True)
class Judgement:
    """One criterion with the value that was measured and what it amounts to."""

    measurement: str
    unit: str
    value: float | None
    at_least: float | None
    at_most: float | None
    outcome: Verdict
    block: int | None = None  # None: the whole run


@dataclass(frozen=True)
class Judged:
    """All measurements of a run and its blocks, every criterion of its test, and the verdict."""

    measured: Measured
    criteria: tuple[Judgement, ...]
    verdict: Verdict

    @property
    def measurements(self) -> Mapping[str, float | None]:
        """Those of the run as a whole, by name."""
        return self.measured.run


def needs_reference(definition: Definition) -> bool:
    """Whether a criterion compares with a reference run."""
    return any(c.measurement == NEEDS_REFERENCE for c in definition.acceptance)


def measuring(
    definition: Definition,
    period_s: float,
    valve_limit: float = 1.0,
    predicted: Predicted | None = None,
    first_tick: int | None = None,
) -> Measuring:
    """Ready to take a run of a definition, chunk by chunk."""
    nodes = force_nodes(definition.blocks, definition.controller.compensation)
    return Measuring(
        stretches(definition),
        period_s,
        valve_limit=valve_limit,
        predicted=predicted,
        first_tick=first_tick,
        counts_cycles=any(_counts(block) for block in nodes),
        required=required_of(definition),
    )


def required_of(definition: Definition) -> list[Required]:
    """The bands that the frequency responses of a definition are required to keep to."""
    return [
        Required(number, **band.model_dump())
        for number, block in enumerate(definition.blocks)
        if isinstance(block, FrequencyResponse)
        for band in block.bands
    ]


def judge_measured(definition: Definition, measured: Measured, *, completed: bool) -> Judged:
    """Hold what was measured against the criteria of its test.

    What was cut short never passes: of a run that did not complete, a criterion is met only where
    it is about a block that was played to its end, and the run is not passed at all.
    """
    criteria = tuple(_judge(c, measured, completed) for c in definition.acceptance)
    verdict = overall(criterion.outcome for criterion in criteria)
    if verdict is Verdict.PASS and not completed:
        verdict = Verdict.UNSET
    return Judged(measured, criteria, verdict)


def judge_run(
    definition: Definition,
    records: npt.NDArray[Any],
    period_s: float,
    valve_limit: float = 1.0,
    reference: npt.NDArray[Any] | None = None,
    *,
    completed: bool = True,
) -> Judged:
    """Measure and judge all ticks of a run, (n,) TELEMETRY; the same of a reference run, if any."""
    predicted = None
    if reference is not None:
        predicted = Predicted(as_predicted(definition, [reference], period_s))
    run = measuring(definition, period_s, valve_limit, predicted)
    run.take(records)
    return judge_measured(definition, run.result(), completed=completed)


def as_predicted(
    definition: Definition, chunks: Iterable[Columns], period_s: float
) -> Iterator[Columns]:
    """The force of another run of a definition, as `Predicted` takes it."""
    walk = Walk(stretches(definition), period_s)
    for chunk in chunks:
        for part in walk.take(chunk):
            yield {"program_tick": part.positions, "force_n": part.columns["force_n"]}


def _counts(nodes: Iterable[Node]) -> bool:
    return any(bool(n.counts) if isinstance(n, Piece) else _counts(n.body) for n in nodes)


def _judge(criterion: Criterion, measured: Measured, completed: bool) -> Judgement:
    block = criterion.block
    values: Values = measured.run if block is None else dict(measured.blocks.get(block, {}))
    value = values.get(criterion.measurement)
    measurement = MEASUREMENTS[criterion.measurement]
    low, high = criterion.at_least, criterion.at_most
    outcome = judge(value, low, high)
    if not (completed or block in measured.finished):
        might_grow = measurement.grows and judge(value, None, high) is Verdict.PASS
        if outcome is Verdict.PASS or might_grow:
            outcome = Verdict.UNSET
    return Judgement(
        measurement.name,
        measurement.unit,
        value,
        low,
        high,
        outcome,
        block,
    )
