"""The console's files, and the page of the REST interface."""

from pathlib import Path

import pytest
from fastapi import FastAPI
from starlette.testclient import TestClient

from app.docs_page import docs_page
from app.gen import channels_ts, openapi
from app.problems import install_handlers
from app.static_files import serve_console
from rtcore.channels import CHANNELS


@pytest.fixture
def site(tmp_path: Path) -> TestClient:
    (tmp_path / "secret.txt").write_text("secret")
    folder = tmp_path / "static"
    (folder / "assets").mkdir(parents=True)
    (folder / "index.html").write_text("index")
    (folder / "icon.svg").write_text("icon")
    (folder / "assets" / "index-1a2b.js").write_text("script")
    (folder / "out").symlink_to(tmp_path / "secret.txt")
    app = FastAPI()
    install_handlers(app)
    serve_console(app, folder)
    return TestClient(app)


@pytest.mark.parametrize(
    ("path", "status", "text"),
    [
        ("/", 200, "index"),
        ("/runs/3", 200, "index"),
        ("/icon.svg", 200, "icon"),
        ("/assets/index-1a2b.js", 200, "script"),
        ("/assets/gone.js", 404, "not_found"),
        ("/api/v1/nothing", 404, "not_found"),
        ("/..%2fsecret.txt", 200, "index"),
        ("/out", 200, "index"),
        ("/%00", 200, "index"),
    ],
)
def test_what_is_at_a_path(site: TestClient, path: str, status: int, text: str) -> None:
    answer = site.get(path)
    assert answer.status_code == status
    assert text in answer.text
    assert "secret" not in answer.text


def test_where_it_was_not_built_it_says_how(tmp_path: Path) -> None:
    app = FastAPI()
    serve_console(app, tmp_path)
    answer = TestClient(app).get("/")
    assert answer.status_code == 503
    assert "make run" in answer.text


def test_the_interface_is_described_without_a_script() -> None:
    document = openapi()
    page = docs_page(document)
    assert "<script" not in page
    assert all(path in page for path in document["paths"])


def test_what_the_types_are_made_from_is_complete() -> None:
    document = openapi()
    assert {"Subscribe", "Hello", "StatusFrame", "EventFrame"} <= document["components"][
        "schemas"
    ].keys()
    operations = [o for path in document["paths"].values() for o in path.values()]
    for operation in operations:
        assert operation["operationId"][0].islower()
        assert operation["description"]
    assert all(f'"{channel.name}"' in channels_ts() for channel in CHANNELS)
