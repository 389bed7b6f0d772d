"""`/api/v1/runs/{id}/report.pdf` and `.html`: made by a process apart, waited for without a thread."""

from typing import Annotated, Any

import anyio
from fastapi import APIRouter, Query, Response
from fastapi.concurrency import run_in_threadpool

from app.access.dependencies import Operator, Viewer
from app.comparison.order import Asked
from app.dependencies import ComparisonsService, ReportsService
from app.errors import Code, Refusal
from app.jobs.jobs import Job
from app.jobs.schemas import JobOut
from app.parameters import Number
from app.prediction.schemas import Computing
from app.problems import PROBLEMS, Refused, granted
from app.reports.orders import Extent, Format
from app.reports.service import LONGEST_S, Reports, Wanted

router = APIRouter(prefix="/api/v1/runs", tags=["reports"], responses=PROBLEMS)
HowMuch = Annotated[Extent, Query(description="two pages or so, or all that there is to say")]
LOOK_S = 0.05
RUN_IDS = r"^[1-9][0-9]{0,14}(,[1-9][0-9]{0,14}){1,7}$"
CHANNELS, POINTS = ("force_n", "displacement_m"), 700
WAIT_S = 1.0
TOO_LONG = Refusal(
    Code.BUSY, "The comparison was not made in time: ask again when the machine has less to do"
)


class _Pdf(Response):
    media_type = "application/pdf"


class _Html(Response):
    media_type = "text/html"


@router.get(
    "/compare/report.pdf",
    operation_id="getComparisonReportPdf",
    response_class=_Pdf,
)
async def get_comparison_report_pdf(
    who: Viewer,
    ids: Annotated[str, Query(pattern=RUN_IDS, description="2 to 8 runs, the baseline first")],
    comparisons: ComparisonsService,
    reports: ReportsService,
) -> Response:
    """Several runs beside one another, as PDF."""
    numbers = tuple(int(number) for number in ids.split(","))
    asked = Asked(numbers, CHANNELS, points=POINTS)
    with anyio.move_on_after(LONGEST_S):
        found = await run_in_threadpool(comparisons.of, asked, WAIT_S)
        while isinstance(found, Computing):
            found = await run_in_threadpool(comparisons.of, asked, WAIT_S)
    if isinstance(found, Computing):
        raise Refused(TOO_LONG)
    job = granted(reports.compare(granted(found)))
    if not await _ended(job):
        raise Refused(TOO_LONG)
    if job.result is None:
        raise Refused(job.why_not("The comparison was not made", Code.BUSY))
    name = f"forcerig-runs-{'-'.join(map(str, numbers))}.pdf"
    head = {"Content-Disposition": f'inline; filename="{name}"'}
    return _Pdf(granted(job.result), headers=head)


@router.get("/{run_id}/report.pdf", operation_id="getRunReportPdf", response_class=_Pdf)
async def get_run_report_pdf(
    who: Viewer, run_id: Number, reports: ReportsService, extent: HowMuch = Extent.FULL
) -> Response:
    """The report of a run that is over, as PDF; made where there is none yet, which takes seconds."""
    return await _made(reports, Wanted(run_id, extent, Format.PDF), _Pdf)


@router.get("/{run_id}/report.html", operation_id="getRunReportHtml", response_class=_Html)
async def get_run_report_html(
    who: Viewer, run_id: Number, reports: ReportsService, extent: HowMuch = Extent.FULL
) -> Response:
    """The same as one page of HTML that needs nothing besides itself."""
    return await _made(reports, Wanted(run_id, extent, Format.HTML), _Html)


@router.get("/{run_id}/report", operation_id="getRunReportProgress")
def get_run_report_progress(
    who: Viewer,
    run_id: Number,
    reports: ReportsService,
    extent: HowMuch = Extent.FULL,
    form: Annotated[Format, Query(alias="format")] = Format.PDF,
) -> JobOut:
    """How far a report is that is being made."""
    return JobOut.of(granted(reports.known(Wanted(run_id, extent, form))))


@router.delete("/{run_id}/report", operation_id="giveUpRunReport")
def give_up_run_report(
    who: Operator,
    run_id: Number,
    reports: ReportsService,
    extent: HowMuch = Extent.FULL,
    form: Annotated[Format, Query(alias="format")] = Format.PDF,
) -> JobOut:
    """Make a report no further; whoever waits for it is told so."""
    return JobOut.of(granted(reports.give_up(Wanted(run_id, extent, form))))


async def _made(reports: Reports, wanted: Wanted, response: type[Response]) -> Response:
    found = await run_in_threadpool(reports.begin, wanted)
    if isinstance(found, Job):
        if not await _ended(found):
            raise Refused(reports.too_long(wanted))
        found = await run_in_threadpool(reports.outcome, wanted, found)
    ready = granted(found)
    shown = "inline" if wanted.format is Format.PDF else "attachment"
    name = f"forcerig-run-{wanted.run_id}.{wanted.format}"
    head = {"Content-Disposition": f'{shown}; filename="{name}"'}
    return response(ready.content, headers=head)


async def _ended(job: Job[Any]) -> bool:
    """Whether it has ended within the time that a report may take."""
    with anyio.move_on_after(LONGEST_S):
        while not job.ended.is_set():  # noqa: ASYNC110  # it is set by a thread
            await anyio.sleep(LOOK_S)
    return job.ended.is_set()
