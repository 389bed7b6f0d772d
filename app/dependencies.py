"""What routers may ask for: parts of the one console that runs in this process."""

from concurrent.futures import Executor
from typing import Annotated, cast

from fastapi import Depends
from fastapi.requests import HTTPConnection

from app.audit.service import Audit
from app.authority.service import Authority
from app.catalogue.exchange import Library
from app.catalogue.service import Catalogue
from app.comparison.service import Comparisons
from app.controller.previews import Previews
from app.controller.service import ControllerSettingsBook
from app.drills.service import Drills
from app.exports.service import Exports
from app.first_outs.again import Again
from app.first_outs.service import FirstOuts
from app.histories.store import Store
from app.identification.service import Identifications
from app.interlocks.live import LiveTable
from app.interlocks.service import InterlockTables
from app.metrics.service import Metrics
from app.prediction.service import Predictions
from app.reports.service import Reports
from app.rig_configuration.service import RigConfigurations
from app.rigs.service import Rig
from app.rigs.status import StatusReader
from app.run_analysis.service import Analyses
from app.runs.predicted import RunPredictions
from app.runs.responses import Responses
from app.runs.results import Results
from app.runs.samples import RunWindows
from app.runs.service import Runs
from app.runs.starting import Starter
from app.scene.service import Scene
from app.storage.service import Storage
from app.system.service import System
from app.wiring.console import Console


def console(connection: HTTPConnection) -> Console:
    """The console of this process."""
    return cast(Console, connection.app.state.console)


ThisConsole = Annotated[Console, Depends(console)]


def _audit(this: ThisConsole) -> Audit:
    return this.audit


def _authority(this: ThisConsole) -> Authority:
    return this.authority


def _histories(this: ThisConsole) -> Store:
    return this.histories


def _status(this: ThisConsole) -> StatusReader:
    return this.status


def _rig(this: ThisConsole) -> Rig:
    return this.rig


def _command_threads(this: ThisConsole) -> Executor:
    return this.command_threads


def _catalogue(this: ThisConsole) -> Catalogue:
    return this.catalogue


def _library(this: ThisConsole) -> Library:
    return this.library


def _exports(this: ThisConsole) -> Exports:
    return this.results.exports


def _first_outs(this: ThisConsole) -> FirstOuts:
    return this.first_outs.kept


def _first_outs_again(this: ThisConsole) -> Again:
    return this.first_outs.again


def _drills(this: ThisConsole) -> Drills:
    return this.drills


def _runs(this: ThisConsole) -> Runs:
    return this.results.runs


def _responses(this: ThisConsole) -> Responses:
    return this.results.responses


def _results(this: ThisConsole) -> Results:
    return this.results.results


def _scene(this: ThisConsole) -> Scene:
    return this.scene


def _analyses(this: ThisConsole) -> Analyses:
    return this.results.analyses


def _comparisons(this: ThisConsole) -> Comparisons:
    return this.results.comparisons


def _run_windows(this: ThisConsole) -> RunWindows:
    return this.results.windows


def _storage(this: ThisConsole) -> Storage:
    return this.storage


def _system(this: ThisConsole) -> System:
    return this.system


def _metrics(this: ThisConsole) -> Metrics:
    return this.metrics


def _predictions(this: ThisConsole) -> Predictions:
    return this.in_force.predictions


def _run_predictions(this: ThisConsole) -> RunPredictions:
    return this.results.predictions


def _interlocks(this: ThisConsole) -> InterlockTables:
    return this.in_force.interlocks


def _controllers(this: ThisConsole) -> ControllerSettingsBook:
    return this.in_force.controllers


def _previews(this: ThisConsole) -> Previews:
    return this.previews


def _rig_configurations(this: ThisConsole) -> RigConfigurations:
    return this.in_force.rig_configurations


def _identifications(this: ThisConsole) -> Identifications:
    return this.identifications


def _live_interlocks(this: ThisConsole) -> LiveTable:
    return this.in_force.live_interlocks


def _reports(this: ThisConsole) -> Reports:
    return this.results.reports


def _starter(this: ThisConsole) -> Starter:
    return this.starter


AuditService = Annotated[Audit, Depends(_audit)]
AuthorityService = Annotated[Authority, Depends(_authority)]
HistoryStore = Annotated[Store, Depends(_histories)]
Status = Annotated[StatusReader, Depends(_status)]
RigService = Annotated[Rig, Depends(_rig)]
CommandThreads = Annotated[Executor, Depends(_command_threads)]
CatalogueService = Annotated[Catalogue, Depends(_catalogue)]
LibraryService = Annotated[Library, Depends(_library)]
ExportsService = Annotated[Exports, Depends(_exports)]
FirstOutsService = Annotated[FirstOuts, Depends(_first_outs)]
FirstOutsAgain = Annotated[Again, Depends(_first_outs_again)]
DrillsService = Annotated[Drills, Depends(_drills)]
RunsService = Annotated[Runs, Depends(_runs)]
ResponsesService = Annotated[Responses, Depends(_responses)]
ResultsService = Annotated[Results, Depends(_results)]
SceneService = Annotated[Scene, Depends(_scene)]
AnalysesService = Annotated[Analyses, Depends(_analyses)]
ComparisonsService = Annotated[Comparisons, Depends(_comparisons)]
RunWindowsService = Annotated[RunWindows, Depends(_run_windows)]
StorageService = Annotated[Storage, Depends(_storage)]
SystemService = Annotated[System, Depends(_system)]
MetricsService = Annotated[Metrics, Depends(_metrics)]
PredictionsService = Annotated[Predictions, Depends(_predictions)]
RunPredictionsService = Annotated[RunPredictions, Depends(_run_predictions)]
InterlocksService = Annotated[InterlockTables, Depends(_interlocks)]
ControllerService = Annotated[ControllerSettingsBook, Depends(_controllers)]
PreviewsService = Annotated[Previews, Depends(_previews)]
RigConfigurationService = Annotated[RigConfigurations, Depends(_rig_configurations)]
IdentificationsService = Annotated[Identifications, Depends(_identifications)]
LiveInterlocksTable = Annotated[LiveTable, Depends(_live_interlocks)]
StarterService = Annotated[Starter, Depends(_starter)]
ReportsService = Annotated[Reports, Depends(_reports)]
