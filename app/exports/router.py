"""`/api/v1/runs/{id}/data.{format}` and `/api/v1/runs/{id}/exports`."""

from typing import Annotated, Any

from fastapi import APIRouter, Path, Query, Request, Response
from fastapi.concurrency import run_in_threadpool
from fastapi.responses import FileResponse

from app.access.dependencies import Viewer
from app.db import NO_NUL
from app.dependencies import ExportsService, RunsService
from app.exports.download import Download
from app.exports.extract import Wanted
from app.exports.formats import FORMATS, FormatName
from app.exports.schemas import ExportAsked, ExportOut, Seconds
from app.exports.sending import whole_file
from app.parameters import Channels, Number
from app.problems import PROBLEMS, granted

router = APIRouter(prefix="/api/v1/runs", tags=["exports"], responses=PROBLEMS)
ExportId = Annotated[str, Path(pattern=NO_NUL, max_length=40)]
_BINARY = {"schema": {"type": "string", "format": "binary"}}
_MEDIA: dict[int | str, dict[str, Any]] = {
    200: {
        "description": "The file",
        "content": {form.media_type: _BINARY for form in FORMATS.values()},
    }
}


@router.get(
    "/{run_id}/data.{ending}",
    operation_id="getRunData",
    response_class=Response,
    responses=_MEDIA,
)
async def get_run_data(
    request: Request,
    who: Viewer,
    run_id: Number,
    ending: FormatName,
    runs: RunsService,
    exports: ExportsService,
    channels: Channels = "",
    from_s: Annotated[Seconds, Query()] = 0.0,
    to_s: Annotated[Seconds | None, Query()] = None,
) -> Response:
    """Every tick of all or some channels. Parquet of the whole run is its file; the rest is made now."""
    names = tuple(name.strip() for name in channels.split(",") if name.strip())
    wanted = Wanted(names, from_s, to_s)
    media_type, name = FORMATS[ending].media_type, f"forcerig-run-{run_id}.{ending}"
    if ending is FormatName.PARQUET and wanted == Wanted():
        path = granted(await run_in_threadpool(runs.parquet, run_id))
        return FileResponse(path, media_type=media_type, filename=name)
    if FORMATS[ending].stream is None:
        return await whole_file(request, exports, who, (run_id, ending, wanted), name)
    found = granted(await run_in_threadpool(exports.stream, who, run_id, ending, wanted))
    head = {"Content-Disposition": f'attachment; filename="{name}"'}
    return Download(*found, media_type=media_type, headers=head)


@router.post("/{run_id}/exports", status_code=202, operation_id="exportRun")
def export_run(
    who: Viewer, run_id: Number, body: ExportAsked, exports: ExportsService
) -> ExportOut:
    """Have a file made: ask for its progress, then for the file. It is kept for an hour."""
    return granted(exports.start(who, run_id, body.format, body.wanted))


@router.get("/{run_id}/exports", operation_id="listExports")
def list_exports(who: Viewer, run_id: Number, exports: ExportsService) -> list[ExportOut]:
    """What is being made of a run, or was within the hour; the newest first."""
    return exports.all(run_id)


@router.get("/{run_id}/exports/{export_id}", operation_id="getExport")
def get_export(
    who: Viewer, run_id: Number, export_id: ExportId, exports: ExportsService
) -> ExportOut:
    """How far it is."""
    return granted(exports.get(run_id, export_id))


@router.get(
    "/{run_id}/exports/{export_id}/file",
    operation_id="getExportFile",
    response_class=Response,
    responses=_MEDIA,
)
def get_export_file(
    who: Viewer, run_id: Number, export_id: ExportId, exports: ExportsService
) -> FileResponse:
    """The file, once it is made."""
    path = granted(exports.file(run_id, export_id))
    ending = FormatName(path.suffix[1:])
    name = f"forcerig-run-{run_id}.{ending}"
    return FileResponse(path, media_type=FORMATS[ending].media_type, filename=name)


@router.delete("/{run_id}/exports/{export_id}", operation_id="removeExport")
def remove_export(
    who: Viewer, run_id: Number, export_id: ExportId, exports: ExportsService
) -> ExportOut:
    """Give it up, or remove its file: one's own, and an operator anybody's."""
    return granted(exports.remove(who, run_id, export_id))
