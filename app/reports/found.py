"""What is found in the samples of a run for its report: frequency responses, and what it was like in time.

What the console has found already and keeps in the run's folder is taken from there.
"""

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

from app.analysis.response.transfers import EVERY
from app.conducting.found import Found as Point
from app.conducting.responding import NEEDS, Responding, responds, responses_in
from app.definitions.definition import Definition
from app.definitions.responses import FrequencyResponse
from app.recording.samples import Columns, Samples
from app.run_analysis.schemas import RunAnalysis
from app.runs.measuring import read_rig
from app.runs.response_file import read_points
from app.runs.response_loop import (
    LOOP,
    available_of,
    loop_margins,
    loop_points,
    without_extremes,
)
from app.runs.response_model import Loop, loads_of, model_curve, position_curve
from app.runs.response_schemas import ModelCurve, ResponseOut, ResponseSeries, TransferName
from app.runs.response_series import bands_of, series_of


@dataclass(frozen=True)
class Found:
    """What can be found in the samples of a run that is over; each found once, when it is asked for.

    `rig` and `controller` are those that it was made with, as JSON. `folder` is the run's, where it has one.
    """

    definition: Definition
    rig: Mapping[str, Any]
    controller: Mapping[str, Any]
    samples: Samples
    period_s: float
    first_tick: int
    analyse: Callable[[], RunAnalysis]
    folder: Path | None = None

    @cached_property
    def responses(self) -> tuple[ResponseOut, ...]:
        """Every transfer of which there are points."""
        if not responds(self.definition):
            return ()
        asked = responses_in(self.definition)
        points = None if self.folder is None else read_points(self.folder)
        if points is None:
            points = self._points()
        return tuple(self._response(name, points, asked) for name in available_of(points) if points)

    @cached_property
    def analysis(self) -> RunAnalysis:
        """Layers, steps, rainflow and the error budget."""
        return self.analyse()

    def _points(self) -> list[Point]:
        rig = read_rig(self.rig)
        responding = Responding(self.definition, self.period_s, self.first_tick, rig)
        for chunk in self._chunks(NEEDS):
            responding.take(chunk)
        return responding.points()

    def _chunks(self, names: Sequence[str]) -> Iterator[Columns]:
        samples = self.samples
        return samples.chunks(names, samples.first_tick, samples.last_tick)

    def _response(
        self, name: TransferName, points: Sequence[Point], asked: Sequence[FrequencyResponse]
    ) -> ResponseOut:
        if name == LOOP:
            points = loop_points(points, self.definition, self.controller, self.period_s)
        series = series_of(points, name)
        return ResponseOut(
            transfer=name,
            unit=EVERY[name].unit,
            available=[],
            series=without_extremes(series) if name == LOOP else series,
            model=list(self._models(name, series)),
            bands=bands_of(asked) if name == "force" else [],
            margins=loop_margins(series) if name == LOOP else [],
            progress=None,
        )

    def _models(self, name: TransferName, series: Iterable[ResponseSeries]) -> Iterator[ModelCurve]:
        made_with = {"rig": self.rig, "controller": self.controller}
        for load in loads_of(series) if name in ("force", "position", LOOP) else ():
            loop = Loop() if name == LOOP else None
            curve = (
                position_curve(made_with, load)
                if name == "position"
                else model_curve(made_with, load, self.period_s, loop)
            )
            if curve is not None:
                yield curve
