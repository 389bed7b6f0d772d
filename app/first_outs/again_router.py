"""`/api/v1/first-outs/{number}/replay` and `/rerun`."""

from typing import Any

from fastapi import APIRouter, Response

from app.access.dependencies import Viewer
from app.dependencies import FirstOutsAgain
from app.first_outs.replay_schemas import ReplayAsked, ReplayOut
from app.first_outs.rerun_schemas import RerunAsked, RerunOut
from app.parameters import Number
from app.prediction.schemas import Computing
from app.problems import PROBLEMS, granted

router = APIRouter(prefix="/api/v1/first-outs", tags=["first-outs"], responses=PROBLEMS)
_COMPUTING: dict[int | str, dict[str, Any]] = {
    202: {"model": Computing, "description": "Still being computed: ask the same again"}
}


@router.post("/{number}/replay", operation_id="replayFirstOut")
def replay_first_out(
    who: Viewer, number: Number, again: FirstOutsAgain, body: ReplayAsked | None = None
) -> ReplayOut:
    """The detectors over the recorded ticks, by the loop's own check, with values of them changed."""
    return granted(again.replay(number, (body or ReplayAsked()).interlocks))


@router.post("/{number}/rerun", operation_id="rerunFirstOut", responses=_COMPUTING)
def rerun_first_out(
    who: Viewer, number: Number, body: RerunAsked, again: FirstOutsAgain, response: Response
) -> RerunOut | Computing:
    """The same once more on the virtual rig, without and with one value changed."""
    found = again.rerun(number, body)
    if isinstance(found, Computing):
        response.status_code = 202
        return found
    return granted(found)
