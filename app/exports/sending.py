"""Formats whose file goes back in itself: made as a whole, sent, and removed."""

import anyio
from fastapi.concurrency import run_in_threadpool
from fastapi.responses import FileResponse
from starlette.background import BackgroundTask

from app.errors import Code, Refusal
from app.exports.extract import Wanted
from app.exports.formats import FORMATS, FormatName
from app.exports.service import Exports
from app.jobs.jobs import JobState
from app.problems import Refused, granted

LOOK_S = 0.1
_UNDER_WAY = (JobState.WAITING, JobState.RUNNING)


async def whole_file(
    exports: Exports, run_id: int, ending: FormatName, wanted: Wanted, name: str
) -> FileResponse:
    """Have it made, without a thread that waits for it. Given up where whoever asked has gone."""
    export = granted(await run_in_threadpool(exports.start, run_id, ending, wanted))
    try:
        while export.state in _UNDER_WAY:
            await anyio.sleep(LOOK_S)
            export = granted(exports.get(run_id, export.id))
        if export.state is not JobState.DONE:
            detail = f"The file of run {run_id} was not made. {export.reason}"
            raise Refused(Refusal(Code.BUSY, detail))
    except BaseException:
        exports.remove(run_id, export.id)
        raise
    done = BackgroundTask(exports.remove, run_id, export.id)
    path = granted(exports.file(run_id, export.id))
    return FileResponse(path, media_type=FORMATS[ending].media_type, filename=name, background=done)
