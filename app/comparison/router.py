"""`/api/v1/runs/compare` and `/api/v1/runs/trend`."""

from typing import Annotated

from fastapi import APIRouter, Query, Response

from app.access.dependencies import Viewer
from app.catalogue.schemas import LONGEST_ID
from app.comparison.order import Asked
from app.comparison.schemas import Align, RunComparison, Trend
from app.comparison.service import MOST_RUNS
from app.dependencies import ComparisonsService
from app.errors import Code, Fault, Refusal
from app.prediction.schemas import Computing
from app.problems import PROBLEMS, granted
from app.run_analysis.router import COMPUTING, WaitS

router = APIRouter(prefix="/api/v1/runs", tags=["runs"], responses=PROBLEMS)
Block = Annotated[int | None, Query(ge=0, le=10_000)]
Finite = Annotated[float | None, Query(ge=0, le=1e12, allow_inf_nan=False)]
LARGEST_ID = 2**53


@router.get(
    "/compare", operation_id="compareRuns", responses=COMPUTING, response_model=RunComparison
)
def compare_runs(
    who: Viewer,
    comparisons: ComparisonsService,
    ids: Annotated[
        str, Query(max_length=200, description=f"2 to {MOST_RUNS} runs, the baseline first")
    ],
    channels: Annotated[str, Query(max_length=200)] = "force_n",
    align: Align = Align.TIME,
    block: Block = None,
    from_s: Annotated[float, Query(ge=-1e9, le=1e9, allow_inf_nan=False)] = 0.0,
    to_s: Annotated[float | None, Query(ge=-1e9, le=1e9, allow_inf_nan=False)] = None,
    points: Annotated[int, Query(ge=200, le=5000)] = 2000,
    tolerance_abs: Finite = None,
    tolerance_rel: Finite = None,
    wait_s: WaitS = 2.0,
) -> Response:
    """Runs over each other with differences from the first, measurements and settings that differ.

    A difference is tolerated up to the larger of `tolerance_abs`, in the channel's unit, and
    `tolerance_rel` of the baseline's value; so are those of measurements, the former in the same unit.
    """
    numbers = granted(_numbers(ids))
    names = tuple(name.strip() for name in channels.split(",") if name.strip())
    window = (from_s, to_s, points, tolerance_abs, tolerance_rel)
    found = comparisons.of(Asked(numbers, names, align, block, *window), wait_s)
    status = 202 if isinstance(found, Computing) else 200
    body = granted(found).model_dump_json()
    return Response(body, status, media_type="application/json")


@router.get("/trend", operation_id="getRunTrend")
def get_run_trend(
    who: Viewer,
    comparisons: ComparisonsService,
    measurement: Annotated[str, Query(max_length=50)],
    test_id: Annotated[str, Query(max_length=LONGEST_ID)],
    block: Block = None,
    limit: Annotated[int, Query(ge=2, le=1000)] = 200,
) -> Trend:
    """A measurement over the runs of a test, with the line through it: what ages, what drifts."""
    return granted(comparisons.trend(measurement, test_id, block, limit))


def _numbers(text: str) -> tuple[int, ...] | Refusal:
    parts = [part.strip() for part in text.split(",") if part.strip()]
    if all(part.isascii() and part.isdecimal() and 1 <= int(part) <= LARGEST_ID for part in parts):
        return tuple(map(int, parts))
    expected = "numbers of runs with commas between, the baseline first"
    return Refusal(Code.INVALID_REQUEST, f"Give {expected}", (Fault("query.ids", text, expected),))
