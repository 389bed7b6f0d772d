"""`/api/v1/controller/check` and `/preview`: what a draft would do, before anybody puts it in force."""

from typing import Annotated

from fastapi import APIRouter, Path

from app.access.dependencies import Viewer
from app.controller.check import ControllerCheck, DraftAsked, checked
from app.controller.preview_schemas import ControllerPreview, PreviewAsked
from app.controller.record import controller_from
from app.dependencies import ControllerService, PreviewsService, RigConfigurationService
from app.problems import PROBLEMS, granted

router = APIRouter(prefix="/api/v1/controller", tags=["controller"], responses=PROBLEMS)
PreviewId = Annotated[str, Path(pattern="^[0-9a-f]{1,64}$")]


@router.post("/check", operation_id="checkController")
def check_controller(
    who: Viewer,
    body: DraftAsked,
    controllers: ControllerService,
    configurations: RigConfigurationService,
) -> ControllerCheck:
    """What is wrong with a draft, what it would change, and its loop and compensator. Nothing is adopted."""
    draft = controller_from(body.document, "body")
    model = configurations.in_force.document.model
    return granted(checked(draft, body, controllers.in_force, model))


@router.post("/preview", operation_id="previewController", status_code=202)
def preview_controller(
    who: Viewer, body: PreviewAsked, previews: PreviewsService
) -> ControllerPreview:
    """Try a draft on the virtual rig beside what is in force: ask again for what comes of it."""
    draft = granted(controller_from(body.document, "body"))
    return granted(previews.ask(draft, body.test_id, body.beside))


@router.get("/previews/{preview_id}", operation_id="getControllerPreview")
def get_preview(who: Viewer, preview_id: PreviewId, previews: PreviewsService) -> ControllerPreview:
    """How far a preview is, and what came of it."""
    return granted(previews.of(preview_id))


@router.delete("/previews/{preview_id}", operation_id="giveUpControllerPreview")
def give_up_preview(
    who: Viewer, preview_id: PreviewId, previews: PreviewsService
) -> ControllerPreview:
    """Give a preview up."""
    return granted(previews.give_up(preview_id))
