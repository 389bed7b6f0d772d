"""Exports of several people: nobody takes all places, or what is another's; whoever has gone frees theirs."""

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import anyio
import pytest
from fastapi import Request

from app.access.principal import Principal, Role
from app.errors import Code, Refusal
from app.exports.download import Download
from app.exports.extract import Wanted
from app.exports.formats import FormatName
from app.exports.schemas import ExportOut
from app.exports.sending import whole_file
from app.exports.service import MOST_EACH, MOST_STREAMS_EACH, Exports
from app.problems import Refused
from tests.unit.app.exports.reading import recorded, records

pytestmark = pytest.mark.process
ALL = Wanted()
ANNA, BEN = (
    Principal(f"session:{i}", name, Role.VIEWER, "session", i) for i, name in enumerate("ab")
)
OPERATOR = Principal("session:9", "o", Role.OPERATOR, "session", 9)


@pytest.fixture
def exports(tmp_path: Path) -> Iterator[Exports]:
    path = recorded(tmp_path / "run.parquet", records(1000))
    exports = Exports(lambda run_id: path, tmp_path / "exports", lambda: 0)
    exports.open()
    yield exports
    exports.close()


def started(exports: Exports, who: Principal) -> ExportOut:
    found = exports.start(who, 1, FormatName.CSV, ALL)
    assert isinstance(found, ExportOut)
    return found


def busy(found: Any) -> bool:
    return isinstance(found, Refusal) and found.code is Code.BUSY and "You have" in found.detail


def test_nobody_takes_all_downloads(exports: Exports) -> None:
    def stream(who: Principal) -> Any:
        return exports.stream(who, 1, FormatName.CSV, ALL)

    ends = [stream(ANNA)[1] for _ in range(MOST_STREAMS_EACH)]
    assert busy(stream(ANNA))
    stream(BEN)[1]()
    ends[0]()
    ends[0] = stream(ANNA)[1]
    for end in ends:
        end()


def test_nobody_takes_all_exports(exports: Exports) -> None:
    made = [started(exports, ANNA) for _ in range(MOST_EACH)]
    assert busy(exports.start(ANNA, 1, FormatName.CSV, ALL))
    started(exports, BEN)
    exports.remove(ANNA, 1, made[-1].id)
    started(exports, ANNA)


def test_an_export_is_removed_by_who_made_it_or_an_operator(exports: Exports) -> None:
    first, second = started(exports, ANNA), started(exports, ANNA)
    refused = exports.remove(BEN, 1, first.id)
    assert isinstance(refused, Refusal)
    assert refused.code is Code.NOT_ALLOWED
    assert isinstance(exports.get(1, first.id), ExportOut)
    assert isinstance(exports.remove(ANNA, 1, first.id), ExportOut)
    assert isinstance(exports.remove(OPERATOR, 1, second.id), ExportOut)


def test_a_file_is_made_no_further_for_who_has_gone(exports: Exports) -> None:
    async def gone() -> dict[str, str]:
        return {"type": "http.disconnect"}

    async def ask() -> None:
        request = Request({"type": "http"}, gone)
        await whole_file(request, exports, ANNA, (1, FormatName.HDF5, ALL), "run.h5")

    with pytest.raises(Refused):
        anyio.run(ask)
    assert exports.all(1) == []


def test_a_download_that_never_began_gives_its_place_back(exports: Exports) -> None:
    async def receive() -> dict[str, str]:
        await anyio.sleep_forever()
        raise AssertionError

    async def send(message: Any) -> None:
        raise ConnectionError(message["type"])

    found = [exports.stream(ANNA, 1, FormatName.CSV, ALL) for _ in range(MOST_STREAMS_EACH)]
    for one in found:
        assert not isinstance(one, Refusal)
        with pytest.raises((ConnectionError, BaseExceptionGroup)):
            anyio.run(Download(*one), {"type": "http", "asgi": {}}, receive, send)
    again = exports.stream(ANNA, 1, FormatName.CSV, ALL)
    assert not isinstance(again, Refusal)
    again[1]()
