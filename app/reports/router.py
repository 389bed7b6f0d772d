"""`/api/v1/runs/{id}/report.pdf` and `.html`: made by a process apart, waited for without a thread."""

from typing import Annotated

import anyio
from fastapi import APIRouter, Path, Query
from fastapi.concurrency import run_in_threadpool
from fastapi.responses import FileResponse

from app.access.dependencies import Operator, Viewer
from app.dependencies import ReportsService
from app.jobs.jobs import Job
from app.jobs.schemas import JobOut
from app.problems import PROBLEMS, Refused, granted
from app.reports.orders import Extent, Format
from app.reports.service import LONGEST_S, Reports, Wanted

router = APIRouter(prefix="/api/v1/runs", tags=["reports"], responses=PROBLEMS)
RunId = Annotated[int, Path(ge=1, le=2**53)]
HowMuch = Annotated[Extent, Query(description="two pages or so, or all that there is to say")]
LOOK_S = 0.05


class _Pdf(FileResponse):
    media_type = "application/pdf"


class _Html(FileResponse):
    media_type = "text/html"


@router.get("/{run_id}/report.pdf", operation_id="getRunReportPdf", response_class=_Pdf)
async def get_run_report_pdf(
    who: Viewer, run_id: RunId, reports: ReportsService, extent: HowMuch = Extent.FULL
) -> FileResponse:
    """The report of a run that is over, as PDF; made where there is none yet, which takes seconds."""
    return await _made(reports, Wanted(run_id, extent, Format.PDF), _Pdf)


@router.get("/{run_id}/report.html", operation_id="getRunReportHtml", response_class=_Html)
async def get_run_report_html(
    who: Viewer, run_id: RunId, reports: ReportsService, extent: HowMuch = Extent.FULL
) -> FileResponse:
    """The same as one page of HTML that needs nothing besides itself."""
    return await _made(reports, Wanted(run_id, extent, Format.HTML), _Html)


@router.get("/{run_id}/report", operation_id="getRunReportProgress")
def get_run_report_progress(
    who: Viewer,
    run_id: RunId,
    reports: ReportsService,
    extent: HowMuch = Extent.FULL,
    form: Annotated[Format, Query(alias="format")] = Format.PDF,
) -> JobOut:
    """How far a report is that is being made."""
    return JobOut.of(granted(reports.known(Wanted(run_id, extent, form))))


@router.delete("/{run_id}/report", operation_id="giveUpRunReport")
def give_up_run_report(
    who: Operator,
    run_id: RunId,
    reports: ReportsService,
    extent: HowMuch = Extent.FULL,
    form: Annotated[Format, Query(alias="format")] = Format.PDF,
) -> JobOut:
    """Make a report no further; whoever waits for it is told so."""
    return JobOut.of(granted(reports.give_up(Wanted(run_id, extent, form))))


async def _made(reports: Reports, wanted: Wanted, response: type[FileResponse]) -> FileResponse:
    found = await run_in_threadpool(reports.begin, wanted)
    if isinstance(found, Job):
        with anyio.move_on_after(LONGEST_S):
            while not found.ended.is_set():  # noqa: ASYNC110  # it is set by a thread
                await anyio.sleep(LOOK_S)
        if not found.ended.is_set():
            raise Refused(reports.too_long(wanted))
        found = await run_in_threadpool(reports.outcome, wanted, found)
    ready = granted(found)
    name = f"forcerig-run-{wanted.run_id}.{wanted.format}"
    shown = "inline" if wanted.format is Format.PDF else "attachment"
    kind = response.media_type
    return response(ready.path, filename=name, media_type=kind, content_disposition_type=shown)
