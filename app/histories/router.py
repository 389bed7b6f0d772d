"""`/api/v1/histories`: the time histories that tests may name as their `file`."""

from collections.abc import Iterator
from typing import Annotated

from anyio import from_thread
from fastapi import APIRouter, Query, Request

from app.access.dependencies import Operator, Viewer
from app.dependencies import HistoryStore
from app.histories.importing import HistoryInfo
from app.histories.store import import_history
from app.problems import PROBLEMS, granted

router = APIRouter(prefix="/api/v1/histories", tags=["tests"], responses=PROBLEMS)


@router.get("", operation_id="listHistories")
def list_histories(who: Viewer, store: HistoryStore) -> list[HistoryInfo]:
    """The time histories in the store."""
    return store.all()


@router.post("", operation_id="addHistory", status_code=201)
def add_history(
    who: Operator,
    request: Request,
    store: HistoryStore,
    name: Annotated[str, Query(max_length=100)],
    column: Annotated[str | None, Query(max_length=100)] = None,
    rate_hz: Annotated[float | None, Query(gt=0, le=1e6)] = None,
) -> HistoryInfo:
    """Keep a CSV file, sent as the body, as a time history. A name stands for its content for ever.

    `column` chooses by heading or number where there are several; `rate_hz` is needed where the file
    has no times, and resamples where it has.
    """
    return granted(import_history(_parts(request), name, store.folder, column, rate_hz))


def _parts(request: Request) -> Iterator[bytes]:
    """The body as it arrives, for a thread that waits for it."""
    stream = aiter(request.stream())

    async def following() -> bytes | None:
        return await anext(stream, None)

    while (part := from_thread.run(following)) is not None:
        yield part
