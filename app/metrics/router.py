"""`GET /metrics`."""

from fastapi import APIRouter, Response
from prometheus_client import CONTENT_TYPE_LATEST

from app.access.dependencies import Viewer
from app.dependencies import MetricsService
from app.problems import PROBLEMS

router = APIRouter(tags=["health"], responses=PROBLEMS)


class _Text(Response):
    media_type = CONTENT_TYPE_LATEST
    charset = ""  # it says its own


@router.get("/metrics", operation_id="getMetrics", response_class=_Text)
def get_metrics(who: Viewer, metrics: MetricsService) -> Response:
    """For Prometheus, with a token that may read: rig, loop, recorder, disk, runs, memory."""
    return _Text(metrics.text())
