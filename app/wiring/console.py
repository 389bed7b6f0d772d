"""The parts of a running console and how they hang together: made at the start, ended in order."""

from concurrent.futures import ThreadPoolExecutor
from threading import Lock

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
from app.controller.previews import Previews
from app.db import Database
from app.definitions.limits import RIG
from app.drills.scoring import Limits
from app.drills.service import Drills
from app.first_outs.box import InForce
from app.histories.store import Store
from app.identification.service import Identifications
from app.link.leasing import LoopLease
from app.link.life import Life
from app.link.link import Link
from app.link.paths import block_path
from app.link.process import LoopCommand
from app.live.broadcaster import Broadcaster
from app.metrics.facts import Sources as MetricSources
from app.metrics.service import Metrics
from app.presets import Presets
from app.rig_configuration.limits import why_not
from app.rigs.service import Rig
from app.rigs.status import StatusReader
from app.runs.plans import Plans
from app.runs.starting import Needs, Starter
from app.scene.moments import Moments
from app.scene.service import Scene
from app.settings import Settings
from app.stopping.service import Stops
from app.storage.service import Storage, StorageSettings
from app.storage.watcher import Watcher
from app.system.service import System
from app.wiring.first_outs import FirstOutRecords
from app.wiring.recordings import Recordings
from app.wiring.results import RunResults
from app.wiring.settings_in_force import SettingsInForce
from rtcore.codes import Opcode


class Console:
    """Everything that a request may need."""

    def __init__(self, settings: Settings, presets: Presets, stop_url: str | None = None) -> None:
        self.settings = settings
        self.database = Database(settings.database_address)
        self.audit = Audit(self.database, settings.data_dir)
        self.access = Access(self.database)
        self.histories = Store(settings.histories_dir)
        self._recordings = Recordings(
            *(self.database, settings, self.histories),
            changed=self._runs_changed,
            over=lambda run_id, ticks: self.results.run_over(run_id, ticks),
        )
        self.recorder = self._recordings.recorder
        block = block_path(settings.data_dir)
        self.link = Link(LoopCommand.of(settings, block), self._follow, self._configure)
        self.first_outs = FirstOutRecords(
            self.database, settings.first_outs_dir, self.histories, self._of_a_first_out
        )
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
        self._watcher = Watcher(
            self.storage,
            self.recorder.state,
            self.recorder.stopped_because,
            lambda: self.link.ask(Opcode.STOP),
        )
        starting = Lock()
        self.in_force = SettingsInForce(self.database, self.link, settings, presets, starting)
        needs = Needs(
            self.catalogue,
            self.in_force.predictions,
            self.storage,
            self.authority.check,
            self.rig.why_not_start,
            self._recordings.never_began,
            lambda plan: why_not(plan, self.in_force.rig_configurations.in_force),
        )
        self.starter = Starter(
            *(self.database, settings.runs_dir, self.link, self.recorder),
            *(self.in_force.of_a_run, plans, needs, starting),
        )
        rig_configurations = self.in_force.rig_configurations
        self.identifications = Identifications(
            *(self.database, settings.runs_dir, rig_configurations, self.authority.check)
        )
        self.previews = Previews(
            self.catalogue, self.in_force.controllers, self.in_force.interlocks, rig_configurations
        )
        self.drills = Drills(
            *(self.database, settings.drills_dir, self.link, self.authority.check),
            names=lambda: [d.name for d in self.in_force.interlocks.in_force.document.detectors],
            limits=Limits.of(presets.rig),
        )
        self.broadcaster = Broadcaster(lambda: self.link.life, self.status.read)
        self.results = RunResults(
            *(self.database, settings, self.histories),
            *(self.link, self.broadcaster, self.storage.reserved_bytes),
        )
        self.scene = Scene(
            settings.data_dir,
            lambda: self.link.life,
            lambda: rig_configurations.in_force.document.model,
            Moments(self.database, self.results.windows),
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
        self.in_force.open()
        self._plans.recall(self.database)
        self.link.start()
        self._lease_keeper.start()
        self._recordings.open(self.link.life)
        self.first_outs.keeper.start()
        self.drills.open()
        self.identifications.open()
        self.in_force.predictions.warm_up()
        self.storage.retention.finish_removing()
        self.results.open()
        self._watcher.start()

    def close(self) -> None:
        """Take the load off, depressurise, end the loop, write down what was recorded."""
        self.in_force.predictions.close()
        self.previews.close()
        self.first_outs.give_up()
        self.identifications.close()
        self._watcher.close()
        self.drills.close()
        self._lease_keeper.close()
        self.results.close()
        self.link.take_load_off()
        self.link.end_loop()
        self.first_outs.keeper.stop()
        self._recordings.close()
        self.link.forget()
        self.command_threads.shutdown()
        self.audit.close()
        self.access.close()
        self.database.close()

    def _follow(self, life: Life) -> None:
        """A loop has come up, or was found: what it does is recorded, and what trips it is kept."""
        self.recorder.follow(life)
        self.first_outs.keeper.follow(life)

    def _of_a_first_out(self) -> InForce:
        lease = self.authority.shown()
        return self.in_force.of_a_first_out(
            None if lease is None else lease.model_dump(mode="json")
        )

    def _runs_changed(self) -> None:
        self.broadcaster.runs_changed()

    def _command_changed(self, change: Change) -> None:
        """Tell everybody at the rig, and the audit."""
        self.broadcaster.tell("lease", change.word, change.text)
        note(change.entry())

    def _configure(self, link: Link) -> bool:
        """Give a loop that has just started the epoch to obey, and the settings in force."""
        self.authority.look()
        return self.in_force.configure(link)
