"""The parts of a running console and how they hang together: made at the start, ended in order."""

import logging
from concurrent.futures import ThreadPoolExecutor
from functools import partial
from pathlib import Path

from app.access.service import Access
from app.audit.record import note
from app.audit.service import Audit
from app.authority.changes import Change
from app.authority.keeper import LeaseKeeper
from app.authority.service import Authority
from app.catalogue.exchange import Library
from app.catalogue.service import Catalogue
from app.catalogue.shipped import enter_shipped
from app.catalogue.written import Reader
from app.comparison.service import Comparisons
from app.conducting.live import LiveResponses
from app.controller.loop_gains import LoopGains
from app.controller.previews import Previews
from app.controller.record import to_record as gains_record
from app.controller.service import CONTROLLER, ControllerSettingsBook
from app.db import Database
from app.definitions.limits import RIG
from app.drills.scoring import Limits
from app.drills.service import Drills
from app.exports.service import Exports
from app.first_outs.again import Again
from app.first_outs.book import Book
from app.first_outs.box import InForce
from app.first_outs.keeper import Keeper
from app.first_outs.reruns import Reruns
from app.first_outs.run_tests import TestsOfRuns
from app.first_outs.service import FirstOuts
from app.histories.store import Store
from app.identification.service import Identifications
from app.interlocks.live import LiveTable
from app.interlocks.loop_table import LoopTable
from app.interlocks.record import to_record as interlocks_record
from app.interlocks.service import INTERLOCKS, InterlockTables
from app.interlocks.table import Interlocks
from app.link.leasing import LoopLease
from app.link.life import Life
from app.link.link import Link
from app.link.paths import block_path
from app.link.process import LoopCommand
from app.live.broadcaster import Broadcaster
from app.metrics.facts import Sources as MetricSources
from app.metrics.service import Metrics
from app.prediction.service import Predictions
from app.presets import Presets
from app.recording.clerk import Clerk
from app.recording.recorder import Recorder
from app.recording.recovery import close_orphans, sweep
from app.reports.orders import Sources
from app.reports.service import Reports
from app.revisions.kind import D, Preset
from app.rig_configuration.limits import why_not
from app.rig_configuration.loop_model import LoopModel, model_record
from app.rig_configuration.record import frozen
from app.rig_configuration.service import RIG_CONFIGURATION, RigConfigurations
from app.rigs.service import Rig
from app.rigs.status import StatusReader
from app.run_analysis.service import Analyses
from app.runs.entering import Frozen
from app.runs.ledger import Ledger
from app.runs.measuring import measure
from app.runs.plans import Plans
from app.runs.predicted import RunPredictions
from app.runs.response_following import KnownRuns, teller
from app.runs.responses import Responses
from app.runs.results import Results
from app.runs.samples import RunWindows
from app.runs.service import Runs
from app.runs.starting import Needs, Starter
from app.scene.moments import Moments
from app.scene.service import Scene
from app.settings import Settings
from app.stopping.service import Stops
from app.storage.service import Storage, StorageSettings
from app.storage.watcher import Watcher
from app.system.service import System
from rtcore.codes import Opcode

_log = logging.getLogger(__name__)


class Console:
    """Everything that a request may need."""

    def __init__(self, settings: Settings, presets: Presets, stop_url: str | None = None) -> None:
        self.settings = settings
        self.database = Database(settings.database_address)
        self.audit = Audit(self.database, settings.data_dir)
        self.access = Access(self.database)
        self.histories = Store(settings.histories_dir)
        measuring = partial(measure, histories=self.histories)
        ledger = Ledger(self.database, settings.runs_dir, measuring, self._runs_changed)
        self._clerk = Clerk(settings.runs_dir, ledger)
        self.recorder = Recorder(settings.runs_dir, self._clerk)
        block = block_path(settings.data_dir)
        self.link = Link(LoopCommand.of(settings, block), self._follow, self._configure)
        self._keeper = Keeper(Book(self.database, settings.first_outs_dir), self._in_force)
        self.first_outs = FirstOuts(
            self.database, settings.first_outs_dir, lambda: self._keeper.trouble
        )
        self._reruns = Reruns(TestsOfRuns(self.database, self.histories).definition)
        self.first_outs_again = Again(self.first_outs, self._reruns)
        self._plans = plans = Plans()
        kept = StorageSettings(settings.runs_dir, RIG.period_s, settings.reserve_bytes)
        self.storage = Storage(kept, self.database, self.recorder.state)
        supply_pa = presets.rig.supply.high_pa
        self.authority = Authority(
            LoopLease(self.link), self.access.book.still, self._command_changed
        )
        self._lease_keeper = LeaseKeeper(self.authority)
        self.status = StatusReader(
            *(self.link, self.recorder, plans, supply_pa, self.storage.state),
            lease=self.authority.shown,
            stop_url=stop_url,
        )
        self.rig = Rig(self.link, lambda: self.status.read().commands, self.authority.check)
        self.stops = Stops(lambda: self.link.life)
        reader = Reader(self.histories)
        self.catalogue = Catalogue(self.database, reader)
        self.library = Library(self.database, reader)
        self.runs = Runs(self.database, settings.runs_dir)
        self.results = Results(self.database, settings.runs_dir, self.histories)
        self.exports = Exports(self.runs.parquet, settings.exports_dir, self.storage.reserved_bytes)
        self._watcher = Watcher(
            self.storage,
            self.recorder.state,
            self.recorder.stopped_because,
            lambda: self.link.ask(Opcode.STOP),
        )
        self.run_predictions = RunPredictions(self.database, settings.runs_dir)
        look = (settings.report_logo, settings.report_template)
        places = settings.runs_dir, settings.histories_dir
        sources = Sources(settings.database_address, *places, *look)
        self.reports = Reports(self.database, sources)
        self.analyses = Analyses(self.database, settings.runs_dir, self.histories)
        self.comparisons = Comparisons(self.database, settings.runs_dir, self.histories)
        self.run_windows = RunWindows(self.database, settings.runs_dir)
        self.predictions = Predictions(
            presets.controller, presets.interlocks, presets.configuration.model
        )
        needs = Needs(
            self.catalogue,
            self.predictions,
            self.storage,
            self.authority.check,
            self.rig.why_not_start,
            self._clerk.never_began,
            lambda plan: why_not(plan, self.rig_configurations.in_force),
        )
        self.starter = Starter(
            self.database, settings.runs_dir, self.link, self.recorder, self._frozen, plans, needs
        )
        kept_in = self.database
        starting = self.starter.one_at_a_time
        self.interlocks = InterlockTables(
            *(INTERLOCKS, kept_in, LoopTable(self.link)),
            *(_preset(presets.interlocks, settings.interlocks_file), starting, self._turn_to),
        )
        self.controllers = ControllerSettingsBook(
            *(CONTROLLER, kept_in, LoopGains(self.link)),
            *(_preset(presets.controller, settings.controller_file), starting),
            lambda controller: self.predictions.turn_to(controller=controller),
        )
        self.rig_configurations = RigConfigurations(
            *(RIG_CONFIGURATION, kept_in, LoopModel(self.link)),
            *(_preset(presets.configuration, settings.rig_configuration_file), starting),
            lambda configuration: self.predictions.turn_to(rig=configuration.model),
        )
        self.identifications = Identifications(
            *(self.database, settings.runs_dir, self.rig_configurations, self.authority.check)
        )
        self.previews = Previews(
            self.catalogue, self.controllers, self.interlocks, self.rig_configurations
        )
        self.drills = Drills(
            *(self.database, settings.drills_dir, self.link, self.authority.check),
            names=lambda: [d.name for d in self.interlocks.in_force.document.detectors],
            limits=Limits.of(presets.rig),
        )
        self.live_interlocks = LiveTable(self.link, presets.interlocks)
        self.broadcaster = Broadcaster(lambda: self.link.life, self.status.read)
        self.scene = Scene(
            settings.data_dir,
            lambda: self.link.life,
            lambda: self.rig_configurations.in_force.document.model,
            Moments(self.database, self.run_windows),
        )
        self.system = System(
            self.database, settings.data_dir, lambda: self.link.life, self.broadcaster.clients
        )
        looked_at = MetricSources(
            *(self.status.read, lambda: self.link.life, self.recorder.state),
            clients=self.broadcaster.clients,
            database=self.database,
        )
        self.metrics = Metrics(looked_at)
        self._live_responses = LiveResponses(
            self.link,
            KnownRuns(self.database, settings.runs_dir, self.histories),
            teller(self.broadcaster.tell_point),
            RIG.period_s,
        )
        self.responses = Responses(
            self.database, settings.runs_dir, self._live_responses, self.histories
        )
        self.command_threads = ThreadPoolExecutor(8, thread_name_prefix="commands")

    def open(self) -> None:
        """Migrate, attach to the loop or start one, go on with what was being recorded.

        Raises `BlockError` where a loop of another version runs.
        """
        self.settings.runs_dir.mkdir(parents=True, exist_ok=True)
        self.database.upgrade()
        self.access.open()
        self.audit.open()
        enter_shipped(self.database, self.catalogue.reader)
        for book in (self.interlocks, self.controllers, self.rig_configurations):
            book.open()
        self._plans.recall(self.database)
        self.link.start()
        self._lease_keeper.start()
        life = self.link.life
        self._clerk.start()
        sweep(self.settings.runs_dir, self._clerk)
        close_orphans(self.settings.runs_dir, self._clerk, life.name if life else None)
        self.recorder.start()
        self._live_responses.start()
        self._keeper.start()
        self.drills.open()
        self.identifications.open()
        self.predictions.warm_up()
        self.storage.retention.finish_removing()
        self.exports.open()
        self._watcher.start()

    def close(self) -> None:
        """Take the load off, depressurise, end the loop, write down what was recorded."""
        self.predictions.close()
        self.previews.close()
        self._reruns.close()
        self.analyses.close()
        self.identifications.close()
        self.comparisons.close()
        self.exports.close()
        self.reports.close()
        self._watcher.close()
        self.drills.close()
        self._lease_keeper.close()
        self._live_responses.close()
        self.responses.close()
        self.link.take_load_off()
        self.link.end_loop()
        self._keeper.stop()
        self.recorder.stop()
        self._clerk.stop()
        self.link.forget()
        self.command_threads.shutdown()
        self.audit.close()
        self.access.close()
        self.database.close()

    def _follow(self, life: Life) -> None:
        """A loop has come up, or was found: what it does is recorded, and what trips it is kept."""
        self.recorder.follow(life)
        self._keeper.follow(life)

    def _in_force(self) -> InForce:
        """What a first-out is kept with."""
        lease = self.authority.shown()
        return InForce(
            self.controllers.in_force.document,
            self.interlocks.in_force.document,
            self.rig_configurations.in_force.document.model,
            self.settings.seed,
            lease=None if lease is None else lease.model_dump(mode="json"),
        )

    def _frozen(self) -> Frozen:
        """What a run is made with besides its test."""
        return Frozen(
            controller=self.controllers.in_force.document.model_dump(mode="json"),
            interlocks=self.interlocks.in_force.document.model_dump(mode="json"),
            rig=frozen(self.rig_configurations.in_force),
        )

    def _turn_to(self, interlocks: Interlocks) -> None:
        """What looks at the table looks at this one from now on."""
        self.predictions.turn_to(interlocks=interlocks)
        self.live_interlocks.turn_to(interlocks)

    def _runs_changed(self) -> None:
        self.broadcaster.runs_changed()

    def _command_changed(self, change: Change) -> None:
        """Tell everybody at the rig, and the audit."""
        self.broadcaster.tell("lease", change.word, change.text)
        note(change.entry())

    def _configure(self, link: Link) -> bool:
        """Give a loop that has just started the epoch to obey, gains, interlocks and the model of the rig."""
        self.authority.look()
        controller, interlocks = self.controllers.in_force, self.interlocks.in_force
        model = self.rig_configurations.in_force.document.model
        banks = (
            (Opcode.ADOPT_GAINS, gains_record(controller.document)),
            (Opcode.ADOPT_INTERLOCKS, interlocks_record(interlocks.document, RIG.period_s)),
            (Opcode.ADOPT_MODEL, model_record(model)),
        )
        for opcode, record in banks:
            refusal = link.adopt(opcode, record)
            if refusal is not None:
                _log.warning("%s", refusal.detail)
                return False
        return True


def _preset(document: D, file: Path | None) -> Preset[D]:
    return Preset(document, None if file is None else str(file))
