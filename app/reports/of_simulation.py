"""What a report needs of a run on the virtual rig, from `forcerig simulate`: no database, no console."""

from collections.abc import Iterator
from pathlib import Path

from app.definitions.limits import RIG
from app.documents.writing import to_data
from app.prediction.account import account
from app.prediction.setup import Setup
from app.prediction.simulation import Simulating
from app.recording.samples import Levels, ParquetSamples
from app.reports.found import Found
from app.reports.subject import Frozen, Happening, Subject
from app.runs.results_schemas import RunMeasurements
from app.settings import VERSION


class _Alone(ParquetSamples):
    """A file that nothing is to be put beside: whoever asked for it did not ask for an overview."""

    def levels(self) -> Levels:
        return ()


def subject_of_simulation(
    simulating: Simulating, test_id: str, recorded: Path, kept: Path | None
) -> Subject:
    """A simulation that is through; `recorded` has its ticks, `kept` is the file that the user has of them."""
    through, told = simulating.through, account(simulating)
    setup, samples = through.setup, _Alone(recorded) if through.ticks else None
    frozen = Frozen(
        definition=to_data(setup.definition),
        controller=to_data(setup.controller),
        interlocks=to_data(setup.interlocks),
        rig=setup.rig.model_dump(mode="json"),
        conditions=(),
    )
    return Subject(
        label=f"Simulation, seed {setup.seed}",
        test_id=test_id,
        test_name=setup.definition.name,
        revision=None,
        frozen=frozen,
        measured=_measured(simulating, told),
        outcome=through.ending.outcome.value,
        reason=through.ending.reason,
        period_s=RIG.period_s,
        ticks=through.ticks,
        missing_ticks=0,
        software=VERSION,
        events=tuple(_happenings(simulating, samples)),
        prediction=simulating.prediction(),
        samples=samples,
        found=None if samples is None else _found(setup, frozen, samples),
        data_file=kept,
        without_samples="The ticks of this simulation were not kept (--out keeps them)",
        virtual_seed=setup.seed,
    )


def _found(setup: Setup, frozen: Frozen, samples: ParquetSamples) -> Found:
    made_with = frozen.rig, frozen.controller
    return Found(setup.definition, *made_with, samples, RIG.period_s, samples.first_tick)


def _measured(simulating: Simulating, told: dict[str, object]) -> RunMeasurements:
    blocks = [
        {
            "block": block.index,
            "kind": block.kind,
            "measurements": [m.model_dump() for m in block.measurements],
        }
        for block in simulating.prediction().blocks
    ]
    return RunMeasurements.model_validate(
        {
            "verdict": told["verdict"],
            "criteria": told["acceptance"],
            "blocks": blocks,
            "run": told["measurements"],
        }
    )


def _happenings(simulating: Simulating, samples: ParquetSamples | None) -> Iterator[Happening]:
    origin = 0 if samples is None else samples.first_tick
    for e in simulating.through.events:
        yield Happening(round((e.tick - origin) * RIG.period_s, 9), e.kind, e.code, e.text)
