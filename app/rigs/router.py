"""`/api/v1/rig` and `/api/v1/channels`."""

import asyncio
from contextvars import copy_context

from fastapi import APIRouter

from app.access.dependencies import Viewer
from app.dependencies import CommandThreads, RigService, Status
from app.problems import PROBLEMS, granted
from app.rigs.schemas import (
    ChannelOut,
    CommandDone,
    CommandRequest,
    ResumePreview,
    RigStatus,
)
from rtcore.channels import CHANNELS

router = APIRouter(prefix="/api/v1", tags=["rig"], responses=PROBLEMS)


@router.get("/rig", operation_id="getRig")
def get_rig(who: Viewer, status: Status) -> RigStatus:
    """The status, as it is on the live stream."""
    return status.read()


@router.post("/rig/commands", operation_id="commandRig")
async def command_rig(
    who: Viewer, body: CommandRequest, rig: RigService, threads: CommandThreads
) -> CommandDone:
    """Give a command. Answers once the loop has taken it.

    It has threads of its own: however many slow requests there are, Stop does not queue behind them.
    """
    as_who_asks = copy_context().run
    answer = await asyncio.get_running_loop().run_in_executor(
        threads, as_who_asks, rig.command, who, body
    )
    return granted(answer)


@router.get("/rig/resume", operation_id="previewResume")
def preview_resume(who: Viewer, rig: RigService) -> ResumePreview:
    """The setpoints that Resume would lead through, played by the loop's own generator."""
    return granted(rig.resume_preview())


@router.get("/channels", operation_id="listChannels")
def list_channels(who: Viewer) -> list[ChannelOut]:
    """The channels of the telemetry: columns of every recording."""
    return [ChannelOut(**channel._asdict()) for channel in CHANNELS]
