"""`GET /healthz`: whether the console does its work, for whatever watches over it."""

from fastapi import APIRouter, Response
from pydantic import BaseModel

from app.dependencies import ThisConsole
from app.problems import PROBLEMS
from app.settings import VERSION

router = APIRouter(tags=["health"], responses=PROBLEMS)


class Health(BaseModel):
    """`ok` is false where the loop is lost or the recorder cannot write."""

    ok: bool
    loop_alive: bool
    recorder_trouble: str | None
    version: str


@router.get(
    "/healthz",
    operation_id="getHealth",
    responses={503: {"model": Health, "description": "Something is not well"}},
)
def get_health(this: ThisConsole, response: Response) -> Health:
    """200 where all is well, 503 otherwise."""
    life, trouble = this.link.life, this.recorder.state().trouble
    alive = life is not None and life.alive
    ok = alive and trouble is None
    response.status_code = 200 if ok else 503
    return Health(ok=ok, loop_alive=alive, recorder_trouble=trouble, version=VERSION)
