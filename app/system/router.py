"""`/api/v1/system`."""

from fastapi import APIRouter

from app.access.dependencies import Viewer
from app.dependencies import SystemService
from app.problems import PROBLEMS, granted
from app.system.schemas import About, Diagnosis, LoopTiming

router = APIRouter(prefix="/api/v1/system", tags=["system"], responses=PROBLEMS)


@router.get("/loop", operation_id="getLoopTiming")
def get_loop_timing(system: SystemService, reader: Viewer) -> LoopTiming:
    """How the loop keeps time: the histograms as they are in its memory."""
    return granted(system.loop())


@router.get("/doctor", operation_id="getDiagnosis")
def get_diagnosis(system: SystemService, reader: Viewer) -> Diagnosis:
    """What `forcerig doctor` finds, without its probe: that would disturb the running loop."""
    return system.doctor()


@router.get("/about", operation_id="getAbout")
def get_about(system: SystemService, reader: Viewer) -> About:
    """What runs here, since when, and what it takes up."""
    return system.about()
