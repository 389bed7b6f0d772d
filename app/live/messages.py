"""The JSON frames of the live stream."""

from typing import Annotated, Literal

from pydantic import BaseModel, ConfigDict, Field, TypeAdapter, ValidationError, field_validator

from app.authority.schemas import Epoch
from app.errors import Code, Refusal
from app.link.events import LoopEvent
from app.rigs.schemas import ChannelOut, RigStatus
from rtcore.channels import CHANNEL, CHANNELS

LONGEST_FRAME = 4096


class Subscribe(BaseModel):
    """From the browser: the channels it wants, instead of those before."""

    model_config = ConfigDict(extra="forbid", strict=True)

    type: Literal["subscribe"]
    subscription: Annotated[int, Field(ge=0, lt=2**32)]
    channels: Annotated[list[str], Field(max_length=len(CHANNELS))]

    @field_validator("channels")
    @classmethod
    def _known_and_once(cls, names: list[str]) -> list[str]:
        unknown = [name for name in names if name not in CHANNEL]
        if unknown:
            raise ValueError(f"unknown channels: {', '.join(unknown)[:200]}")
        if len(set(names)) != len(names):
            raise ValueError("a channel is named twice")
        return names


class Beat(BaseModel):
    """From the browser of whoever is in command: it is still there."""

    model_config = ConfigDict(extra="forbid", strict=True)

    type: Literal["beat"]
    epoch: Epoch


class Hello(BaseModel):
    """Once, first."""

    type: Literal["hello"] = "hello"
    period_s: float
    version: str
    channels: list[ChannelOut] = [ChannelOut(**channel._asdict()) for channel in CHANNELS]


class StatusFrame(BaseModel):
    """Each 100 ms."""

    type: Literal["status"] = "status"
    status: RigStatus


class EventOut(BaseModel):
    """What the loop reported."""

    tick: int
    time_s: float
    kind: str
    code: str
    text: str


class EventFrame(BaseModel):
    """Never dropped."""

    type: Literal["event"] = "event"
    event: EventOut

    @staticmethod
    def of(event: LoopEvent) -> "EventFrame":
        return EventFrame(
            event=EventOut(
                tick=event.tick,
                time_s=event.time_s,
                kind=event.kind,
                code=event.code,
                text=event.text,
            )
        )


class RunsChanged(BaseModel):
    """The list of runs has changed."""

    type: Literal["runs"] = "runs"


class ErrorFrame(BaseModel):
    """A frame of the browser's could not be understood."""

    type: Literal["error"] = "error"
    code: str
    detail: str


FromBrowser = Subscribe | Beat
_FROM_BROWSER: TypeAdapter[FromBrowser] = TypeAdapter(
    Annotated[FromBrowser, Field(discriminator="type")]
)


def parse(text: str | None) -> FromBrowser | Refusal:
    """A frame of the browser's; None for a binary one."""
    if text is None or len(text) > LONGEST_FRAME:
        return Refusal(
            Code.INVALID_REQUEST, f"Only text frames of up to {LONGEST_FRAME} characters are read"
        )
    try:
        return _FROM_BROWSER.validate_json(text)
    except ValidationError as error:
        first = error.errors(include_url=False)[0]
        place = ".".join(str(part) for part in first["loc"][1:])  # after the type
        return Refusal(Code.INVALID_REQUEST, f"{place}: {first['msg']}" if place else first["msg"])
