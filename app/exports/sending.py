"""Formats whose file goes back in itself: made as a whole, sent, and removed."""

import anyio
from fastapi import Request, Response
from fastapi.concurrency import run_in_threadpool
from fastapi.responses import FileResponse
from starlette.background import BackgroundTask

from app.access.principal import Principal
from app.errors import Code, Refusal
from app.exports.extract import Wanted
from app.exports.formats import FORMATS, FormatName
from app.exports.service import Exports
from app.problems import Refused, granted

LOOK_S = 0.1


async def whole_file(
    request: Request,
    exports: Exports,
    who: Principal,
    asked: tuple[int, FormatName, Wanted],
    name: str,
) -> Response:
    """Have it made, without a thread that waits for it. Given up where whoever asked has gone."""
    run_id, ending, _ = asked
    export_id = granted(await run_in_threadpool(exports.start, who, *asked)).id
    try:
        while not granted(exports.has_ended(run_id, export_id)):
            await anyio.sleep(LOOK_S)
            if await request.is_disconnected():
                raise Refused(Refusal(Code.BUSY, "Whoever asked has gone"))
        path = granted(exports.made(run_id, export_id))
    except BaseException:
        exports.remove(who, run_id, export_id)
        raise
    done = BackgroundTask(exports.remove, who, run_id, export_id)
    return FileResponse(path, media_type=FORMATS[ending].media_type, filename=name, background=done)
