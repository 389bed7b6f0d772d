"""What the path of its own says; what it takes is nothing but who asks."""

from pydantic import BaseModel

from app.rigs.schemas import ModeWord


class StopState(BaseModel):
    """The mode of the rig in this tick, as the loop has it; after a Stop, once the loop has seen that."""

    mode: ModeWord
    tick: int
