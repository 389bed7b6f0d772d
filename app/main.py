"""The application, and `serve`: bind, print the address, run, and end with the load off."""

import signal
import sys
from collections.abc import AsyncIterator
from contextlib import asynccontextmanager
from pathlib import Path
from typing import Any

import uvicorn
from anyio.to_thread import run_sync
from fastapi import FastAPI
from fastapi.responses import HTMLResponse

from app.access.door import Door
from app.access.pace import Paced
from app.access.refused import note_refused
from app.body_limit import BodyLimit
from app.connections import BoundedProtocol
from app.described import Described
from app.docs_page import docs_page
from app.errors import Refusal
from app.logs import begin_log
from app.no_nul import NoNul
from app.presets import Presets, load_presets
from app.problems import install_handlers
from app.routers import ROUTERS
from app.security import Guard, known_hosts
from app.serving import (
    CannotServe,
    bind,
    check,
    check_exposure,
    go_before_other_work,
    hold_data_folder,
    hold_database,
    url_of,
)
from app.settings import VERSION, Settings
from app.static_files import serve_console
from app.stopping.door import StopDoor, open_door
from app.stopping.listening import listening_for_stop
from app.wiring.console import Console

_LONGEST_FRAME = 16_384  # of a browser's WebSocket message
_STOPS = frozenset({"/api/v1/rig/commands"})
_BODY_LIMITS = {
    "/api/v1/tests/import": 100_000_000,
    "/api/v1/histories": None,  # goes to the disk as it comes
}


def create_app(
    settings: Settings,
    presets: Presets | None = None,
    url: str = "/",
    stop_door: StopDoor | None = None,
) -> FastAPI:
    """The application. Its life is that of the console: it starts the loop and ends it.

    Without presets it can be described, not run. `url` is where browsers find it, and `stop_door` where
    Stop has a path of its own.
    """
    hosts = known_hosts(settings.allowed_hosts)

    @asynccontextmanager
    async def life(app: FastAPI) -> AsyncIterator[None]:
        assert presets is not None
        console = app.state.console = Console(
            settings, presets, None if stop_door is None else stop_door.url
        )
        await run_sync(console.open)
        with listening_for_stop(stop_door, hosts, console.access.book, console.stops):
            await run_sync(_invite, console, url)
            console.broadcaster.start()
            console.scene.keeper.start()
            yield
            await console.scene.keeper.stop()
            await console.broadcaster.stop()
            await run_sync(console.close)

    app = Described(
        title="forcerig",
        version=VERSION,
        description="Operator console of a servo-hydraulic force-control test rig. All values SI.",
        lifespan=life,
        docs_url=None,
        redoc_url=None,
    )
    app.add_middleware(NoNul)
    app.add_middleware(BodyLimit, limits=_BODY_LIMITS)
    app.add_middleware(Door)
    app.add_middleware(Paced, never=_STOPS)
    stop_port = None if stop_door is None else stop_door.port
    app.add_middleware(Guard, hosts=hosts, stop_port=stop_port)
    install_handlers(app, note_refused)
    for router in ROUTERS:
        app.include_router(router)

    @app.get("/docs", include_in_schema=False)
    def docs() -> HTMLResponse:
        """The REST interface, for people."""
        return HTMLResponse(docs_page(app.openapi()))

    serve_console(app)
    return app


def _invite(console: Console, url: str) -> None:
    """Say how to come in, as long as no admin has a password."""
    link = console.access.users.first_link()
    if link is not None:
        print(f"Sign in once with: {url.rstrip('/')}{link.path}", flush=True)


def serve(
    host: str | None = None,
    port: int | None = None,
    data_dir: Path | None = None,
    **more: Path | bool | None,
) -> None:
    """Run the console until SIGTERM or SIGINT. Raises `SystemExit` with 2 where it cannot start.

    What is not given comes from the environment, or is as shipped; `more` are other settings by their
    names. Port 0 takes any free port; the address is printed either way.
    """
    given: dict[str, Any] = {"host": host, "port": port, "data_dir": data_dir, **more}
    settings = Settings(**{name: value for name, value in given.items() if value is not None})
    begin_log()
    for number in (signal.SIGTERM, signal.SIGINT):
        # Uvicorn has its own handlers while it runs, and raises what it caught again afterwards.
        signal.signal(number, lambda *_: None)
    try:
        check_exposure(settings)
        with (
            hold_data_folder(settings.data_dir),
            hold_database(settings.database_address),
            bind(settings.host, settings.port) as listener,
            open_door(settings, listener) as stop_door,
        ):
            check(settings)
            go_before_other_work()
            presets = load_presets(settings)
            if isinstance(presets, Refusal):
                raise CannotServe(presets.detail)
            url = url_of(listener, tls=settings.tls_cert is not None)
            print(f"forcerig console: {url}", flush=True)
            app = create_app(settings, presets, url, stop_door)
            uvicorn.Server(_uvicorn_config(app, settings)).run(sockets=[listener])
    except CannotServe as error:
        print(f"forcerig: {error}", file=sys.stderr, flush=True)
        raise SystemExit(2) from None


def _uvicorn_config(app: FastAPI, settings: Settings) -> uvicorn.Config:
    return uvicorn.Config(
        app,
        ssl_certfile=settings.tls_cert,
        ssl_keyfile=settings.tls_key,
        http=BoundedProtocol,  # h11 bounds the head of a request; httptools would read one without end
        log_config=None,
        access_log=False,
        ws_per_message_deflate=False,  # noisy float32 shrinks to 93 % for 260 µs a frame
        ws_max_size=_LONGEST_FRAME,
        timeout_graceful_shutdown=2,
        server_header=False,
        proxy_headers=False,
    )
