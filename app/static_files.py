"""The built console: its files, its index for every page of it, and a hint where it was not built."""

from pathlib import Path

from fastapi import FastAPI
from fastapi.responses import FileResponse, HTMLResponse, Response
from starlette.exceptions import HTTPException
from starlette.staticfiles import StaticFiles

FOLDER = Path(__file__).parent / "static"
_NOT_BUILT = """<!doctype html>
<html lang="en"><meta charset="utf-8"><title>forcerig</title>
<h1>The console has not been built</h1>
<p>The backend runs. To build the page that belongs here, stop it and start it with
<code>make run</code>; or build only the page with <code>npm --prefix web run build</code>.</p>
<p>Meanwhile: <a href="/docs">the REST interface</a>, <a href="/healthz">health</a>.</p>
"""


def serve_console(app: FastAPI, folder: Path = FOLDER) -> None:
    """Serve the console at `/`. Paths of the interface that do not exist stay 404."""
    assets = folder / "assets"
    if assets.is_dir():
        app.mount("/assets", StaticFiles(directory=assets), name="assets")

    @app.get("/{path:path}", include_in_schema=False)
    def console_page(path: str) -> Response:
        """A file of the console, or its index: which page it is, the browser finds out."""
        if path.startswith("api/"):
            raise HTTPException(404, f"There is nothing at /{path}")
        if path and (file := _file(folder, path)) is not None:
            return FileResponse(file)
        index = folder / "index.html"
        if not index.is_file():
            return HTMLResponse(_NOT_BUILT, status_code=503)
        return FileResponse(index, headers={"Cache-Control": "no-cache"})


def _file(folder: Path, path: str) -> Path | None:
    """The file of that name inside the folder, links and `..` resolved."""
    try:
        file = (folder / path).resolve()
        inside = file.is_relative_to(folder.resolve()) and file.is_file()
    except (OSError, ValueError):
        return None
    return file if inside else None
