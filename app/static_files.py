"""The built console: its files, its index for every page of it, or a hint where it was not built."""

from pathlib import Path

from fastapi import FastAPI
from fastapi.responses import FileResponse, HTMLResponse, Response
from starlette.exceptions import HTTPException

FOLDER = Path(__file__).parent / "static"
_FOR_EVER = {"Cache-Control": "public, max-age=31536000, immutable"}  # names bear a hash
_ASK_AGAIN = {"Cache-Control": "no-cache"}
_NOT_BUILT = """<!doctype html>
<html lang="en"><meta charset="utf-8"><title>forcerig</title>
<h1>The console has not been built</h1>
<p>The backend runs. To build the page that belongs here, stop it and start it with
<code>make run</code>; or build only the page with <code>npm --prefix web run build</code>.</p>
<p>Meanwhile: <a href="/docs">the REST interface</a>, <a href="/healthz">health</a>.</p>
"""


def serve_console(app: FastAPI, folder: Path = FOLDER) -> None:
    """Serve the console at `/`. Paths of the interface that do not exist stay 404."""

    @app.get("/{path:path}", include_in_schema=False)
    def console_page(path: str) -> Response:
        """A file of the console, or its index: which page it is, the browser finds out."""
        is_asset = path.startswith("assets/")
        file = _file(folder, path)
        if file is not None:
            return FileResponse(file, headers=_FOR_EVER if is_asset else _ASK_AGAIN)
        if is_asset or path.startswith(("api/", "scene")):
            raise HTTPException(404, f"There is nothing at /{path}")
        index = folder / "index.html"
        if not index.is_file():
            return HTMLResponse(_NOT_BUILT, status_code=503)
        return FileResponse(index, headers=_ASK_AGAIN)


def _file(folder: Path, path: str) -> Path | None:
    """The file of that name inside the folder, links and `..` resolved."""
    try:
        file = (folder / path).resolve()
        inside = file.is_relative_to(folder.resolve()) and file.is_file()
    except (OSError, ValueError):
        return None
    return file if inside else None
