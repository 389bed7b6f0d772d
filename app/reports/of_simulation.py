"""What a report needs of a run on the virtual rig, from `forcerig simulate`: no database, no console."""

from collections.abc import Iterator
from functools import partial
from pathlib import Path

import numpy as np

from app.analysis.rainflow_counting import count_cycles
from app.analysis.time_domain import NEEDED, TimeReader
from app.definitions.limits import RIG
from app.definitions.windows import stretches
from app.documents.writing import to_data
from app.prediction.account import account
from app.prediction.setup import Setup
from app.prediction.simulation import Simulating
from app.recording.samples import Levels, ParquetSamples
from app.reports.found import Found
from app.reports.subject import Frozen, Happening, Subject
from app.run_analysis.schemas import RunAnalysis
from app.run_analysis.told import told
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
    through, came_of_it = simulating.through, account(simulating)
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
        measured=_measured(simulating, came_of_it),
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
    made_with = setup.definition, frozen.rig, frozen.controller
    first_tick = samples.first_tick
    analyse = partial(_analysed, setup, samples)
    return Found(*made_with, samples, RIG.period_s, first_tick, analyse)


def _analysed(setup: Setup, samples: ParquetSamples) -> RunAnalysis:
    """As of a run of the console, but that nothing is kept."""
    ends = samples.first_tick, samples.last_tick
    reader = TimeReader(stretches(setup.definition), RIG.period_s, setup.rig)
    for chunk in samples.chunks(NEEDED, *ends):
        reader.take(chunk)
    asked, applied = (
        count_cycles(np.asarray(chunk[name]) for chunk in samples.chunks((name,), *ends))
        for name in ("force_command_n", "force_n")
    )
    return told(reader.result(), asked, applied, RIG.period_s)


def _measured(simulating: Simulating, came_of_it: dict[str, object]) -> RunMeasurements:
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
            "verdict": came_of_it["verdict"],
            "criteria": came_of_it["acceptance"],
            "blocks": blocks,
            "run": came_of_it["measurements"],
        }
    )


def _happenings(simulating: Simulating, samples: ParquetSamples | None) -> Iterator[Happening]:
    origin = 0 if samples is None else samples.first_tick
    for e in simulating.through.events:
        yield Happening(round((e.tick - origin) * RIG.period_s, 9), e.kind, e.code, e.text)
