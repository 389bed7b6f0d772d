"""`/api/v1/tests/…`: texts that are not saved, and tests as files."""

import json
from typing import Annotated, Any, NamedTuple

from fastapi import APIRouter, Depends, Path, Query, Request, Response
from fastapi.exceptions import RequestValidationError
from fastapi.responses import JSONResponse
from pydantic import ValidationError

from app.access.dependencies import Operator, Viewer
from app.catalogue import texts
from app.catalogue.archive import unpack
from app.catalogue.schemas import (
    LONGEST_ID,
    Imported,
    PreviewAsk,
    PreviewOut,
    SpectrumOut,
    SpectrumText,
    TestChecked,
    TestFiles,
    TestText,
)
from app.dependencies import CatalogueService, LibraryService
from app.errors import Refusal
from app.problems import PROBLEMS, granted

router = APIRouter(prefix="/api/v1/tests", tags=["tests"], responses=PROBLEMS)
TestId = Annotated[str, Path(max_length=LONGEST_ID)]
LONGEST_IDS = 20_000  # thrice that with commas escaped: no more fits into the head of a request
IDS = r"^[a-z0-9,-]*$"  # nothing else: other letters are escaped to twelve times their length
_YAML = "application/yaml"
_ZIP = "application/zip"


@router.post("/check", operation_id="checkTest")
def check_test(who: Viewer, body: TestText, catalogue: CatalogueService) -> TestChecked:
    """Check a test and turn it from data into YAML or back; nothing is saved."""
    return texts.check(catalogue.reader, body)


@router.post("/preview", operation_id="previewTest")
def preview_test(who: Viewer, body: PreviewAsk, catalogue: CatalogueService) -> PreviewOut:
    """What a test will do, by the loop's own generator; nothing is saved."""
    return granted(texts.preview(catalogue.reader, body))


@router.post("/spectrum", operation_id="readSpectrum")
def read_spectrum(who: Viewer, body: SpectrumText) -> SpectrumOut:
    """The layers in rows pasted from a spreadsheet."""
    return texts.spectrum(body.text)


# ---- as files ----


class _Sent(NamedTuple):
    media_type: str
    content: bytes


async def _sent(request: Request) -> _Sent:
    """The body of a request as it came; `app.body_limit` keeps it short."""
    media_type = request.headers.get("content-type", "").partition(";")[0].strip().lower()
    return _Sent(media_type, await request.body())


_FILES: dict[str, Any] = {
    "requestBody": {
        "required": True,
        "content": {
            _ZIP: {"schema": {"type": "string", "format": "binary"}},
            _YAML: {"schema": {"type": "string"}},
            "application/json": {"schema": TestFiles.model_json_schema()},
        },
    }
}


@router.post("/import", operation_id="importTests", openapi_extra=_FILES)
def import_tests(
    who: Operator, sent: Annotated[_Sent, Depends(_sent)], library: LibraryService
) -> Imported:
    """Enter the tests of a library file, of one YAML, or of several files: all of them or none."""
    return granted(library.enter(granted(_files_in(sent))))


class _Zip(Response):
    media_type = _ZIP


@router.get("/library.zip", operation_id="exportTests", response_class=_Zip)
def export_tests(
    who: Viewer,
    library: LibraryService,
    ids: Annotated[
        str | None,
        Query(max_length=LONGEST_IDS, pattern=IDS, description="with commas between"),
    ] = None,
    tag: Annotated[str | None, Query(max_length=50)] = None,
) -> Response:
    """A zip of these tests, or of all that are not archived: a YAML each, and an index with tags."""
    asked = None if ids is None else [part for part in ids.split(",") if part]
    return _Zip(granted(library.export(asked, tag)), headers=_named("forcerig-tests.zip"))


@router.get(
    "/{test_id}/definition.yaml",
    operation_id="getYaml",
    response_class=Response,
    responses={200: {"content": {_YAML: {"schema": {"type": "object"}}}}},
)
def get_yaml(
    who: Viewer,
    test_id: TestId,
    catalogue: CatalogueService,
    revision: Annotated[int | None, Query(ge=1, le=2**31 - 1)] = None,
) -> Response:
    """The test as it was written, as a file."""
    found = granted(catalogue.texts(test_id, revision))
    return Response(found.yaml, headers=_named(f"{test_id}.yaml"), media_type=_YAML)


@router.get("/{test_id}/definition.json", operation_id="getJson", response_class=JSONResponse)
def get_json(
    who: Viewer,
    test_id: TestId,
    catalogue: CatalogueService,
    revision: Annotated[int | None, Query(ge=1, le=2**31 - 1)] = None,
) -> Response:
    """The test as plain data, as a file."""
    found = granted(catalogue.texts(test_id, revision))
    text = json.dumps(found.definition, indent=2, ensure_ascii=False)
    return Response(text, headers=_named(f"{test_id}.json"), media_type="application/json")


def _files_in(sent: _Sent) -> dict[str, str] | Refusal:
    if sent.media_type == _ZIP or sent.content[:4] == b"PK\x03\x04":
        return unpack(sent.content)
    try:
        if sent.media_type == "application/json":
            return TestFiles.model_validate_json(sent.content).files
        text = sent.content.decode("utf-8-sig")
    except ValidationError as error:
        raise RequestValidationError(
            [{**fault, "loc": ("body", *fault["loc"])} for fault in error.errors()]
        ) from None
    except UnicodeDecodeError as error:
        message = "is no text in UTF-8"
        fault = {"loc": ("body",), "msg": message, "type": "text", "input": str(error)[:100]}
        raise RequestValidationError([fault]) from None
    return {"": text}


def _named(name: str) -> dict[str, str]:
    return {"Content-Disposition": f'attachment; filename="{name}"'}
