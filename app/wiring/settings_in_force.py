"""What the rig is run with: controller, interlocks and rig configuration, each a book of revisions."""

import logging
from pathlib import Path
from threading import Lock
from typing import Any

from app.controller.loop_gains import LoopGains
from app.controller.record import to_record as gains_record
from app.controller.service import CONTROLLER, ControllerSettingsBook
from app.db import Database
from app.definitions.limits import RIG
from app.first_outs.box import InForce
from app.interlocks.live import LiveTable
from app.interlocks.loop_table import LoopTable
from app.interlocks.record import to_record as interlocks_record
from app.interlocks.service import INTERLOCKS, InterlockTables
from app.interlocks.table import Interlocks
from app.link.link import Link
from app.prediction.service import Predictions
from app.presets import Presets
from app.revisions.kind import D, Preset
from app.rig_configuration.loop_model import LoopModel, model_record
from app.rig_configuration.record import frozen
from app.rig_configuration.service import RIG_CONFIGURATION, RigConfigurations
from app.runs.entering import Frozen
from app.settings import Settings
from rtcore.codes import Opcode

_log = logging.getLogger(__name__)


class SettingsInForce:
    """The three books, and everything that has to know which revision of each is in force.

    `starting` is held while a run starts, so that none changes under it.
    """

    def __init__(
        self, database: Database, link: Link, settings: Settings, presets: Presets, starting: Lock
    ) -> None:
        self._seed = settings.seed
        self.predictions = Predictions(
            presets.controller, presets.interlocks, presets.configuration.model
        )
        self.live_interlocks = LiveTable(link, presets.interlocks)
        self.interlocks = InterlockTables(
            *(INTERLOCKS, database, LoopTable(link)),
            *(_preset(presets.interlocks, settings.interlocks_file), starting, self._turn_to),
        )
        self.controllers = ControllerSettingsBook(
            *(CONTROLLER, database, LoopGains(link)),
            *(_preset(presets.controller, settings.controller_file), starting),
            lambda controller: self.predictions.turn_to(controller=controller),
        )
        self.rig_configurations = RigConfigurations(
            *(RIG_CONFIGURATION, database, LoopModel(link)),
            *(_preset(presets.configuration, settings.rig_configuration_file), starting),
            lambda configuration: self.predictions.turn_to(rig=configuration.model),
        )

    def open(self) -> None:
        """Take up the newest revision of each."""
        for book in (self.interlocks, self.controllers, self.rig_configurations):
            book.open()

    def configure(self, link: Link) -> bool:
        """Give a loop that has just started gains, interlocks and the model of the rig."""
        model = self.rig_configurations.in_force.document.model
        interlocks = self.interlocks.in_force.document
        banks = (
            (Opcode.ADOPT_GAINS, gains_record(self.controllers.in_force.document)),
            (Opcode.ADOPT_INTERLOCKS, interlocks_record(interlocks, RIG.period_s)),
            (Opcode.ADOPT_MODEL, model_record(model)),
        )
        for opcode, record in banks:
            refusal = link.adopt(opcode, record)
            if refusal is not None:
                _log.warning("%s", refusal.detail)
                return False
        return True

    def of_a_run(self) -> Frozen:
        """What a run is made with besides its test."""
        return Frozen(
            controller=self.controllers.in_force.document.model_dump(mode="json"),
            interlocks=self.interlocks.in_force.document.model_dump(mode="json"),
            rig=frozen(self.rig_configurations.in_force),
        )

    def of_a_first_out(self, lease: dict[str, Any] | None) -> InForce:
        """What a first-out is kept with; `lease` is who was in command."""
        return InForce(
            self.controllers.in_force.document,
            self.interlocks.in_force.document,
            self.rig_configurations.in_force.document.model,
            self._seed,
            lease,
        )

    def _turn_to(self, interlocks: Interlocks) -> None:
        """What looks at the table looks at this one from now on."""
        self.predictions.turn_to(interlocks=interlocks)
        self.live_interlocks.turn_to(interlocks)


def _preset(document: D, file: Path | None) -> Preset[D]:
    return Preset(document, None if file is None else str(file))
