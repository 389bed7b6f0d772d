"""The model as the loop's twin has it: given whole or not at all, and compared with the one it should have."""

from functools import lru_cache
from typing import Any

from app.errors import Code, Refusal
from app.link.link import Link
from app.rig_configuration.configuration import RigConfiguration
from rtcore.codes import Opcode
from rtcore.rig.model import make_model
from rtcore.rig.parameters import RigParameters

_PRESSURISED = Refusal(
    Code.WRONG_MODE,
    "Cannot change the model of the rig while there is pressure: depressurise first. The rest of the"
    " configuration may be changed at any time",
)


class LoopModel:
    """The bank of models of the loop that runs now."""

    def __init__(self, link: Link) -> None:
        self._link = link

    def adopt(self, document: RigConfiguration, lease: int | None = None) -> Refusal | None:
        """Have the loop's twin be of this model; None where it is. Without a lease the console keeps house."""
        if self.has(document):
            return None
        refusal = self._link.adopt(Opcode.ADOPT_MODEL, model_record(document.model), lease)
        if refusal is not None and refusal.code is Code.WRONG_MODE:
            return _PRESSURISED
        return refusal

    def has(self, document: RigConfiguration) -> bool:
        """Whether a loop runs whose twin is of this model, to the bit."""
        life = self._link.life
        if life is None or not life.alive:
            return False
        return bool(life.model().tobytes() == model_record(document.model).tobytes())

    def give_later(self) -> None:
        """Have the loop given the model in force as soon as its supply is off."""
        if self._link.life is not None:
            self._link.life.configured = False


@lru_cache(maxsize=4)
def model_record(model: RigParameters) -> Any:
    """A MODEL record, () of its dtype."""
    return make_model(model)
