"""The scene: who may look, what each view shows, and what to say of it."""

from collections import OrderedDict
from collections.abc import AsyncIterator, Callable
from contextlib import asynccontextmanager
from dataclasses import replace
from pathlib import Path

from anyio.to_thread import run_sync
from websockets.asyncio.client import ClientConnection, unix_connect
from websockets.exceptions import WebSocketException

from app.errors import Code, Refusal
from app.link.life import Life
from app.scene.chain import Chain
from app.scene.colours import FORCE, PRESSURE, Colour
from app.scene.keeper import Keeper
from app.scene.moments import Moments, reading_now
from app.scene.private import address_of
from app.scene.schemas import Scale, SceneCursor, SceneOut, SceneState
from app.scene.telling import View, ViewTold
from rtcore.rig.parameters import RigParameters

MOST_VIEWERS = 16
MOST_VIEWS = 64  # whose cursors are remembered
PATIENCE_S = 4.0  # viser's page gives up after five
RETRY_S = 2  # after which somebody who was refused may ask again
MOST_FRAME_BYTES = 4_000_000
PROTOCOL = "viser-v"

_SAYS = {
    SceneState.IDLE: "The 3-D view is not running: it starts when somebody looks",
    SceneState.STARTING: "The 3-D view is starting",
    SceneState.READY: "",
    SceneState.WAITING: "The 3-D view has failed and starts again in a moment",
}


class Scene:
    """The 3-D view, as the app gives it to who is signed in."""

    def __init__(
        self,
        data_dir: Path,
        life: Callable[[], Life | None],
        rig: Callable[[], RigParameters],
        moments: Moments,
    ) -> None:
        self._rig = rig
        self.keeper = Keeper(data_dir, self._chain, lambda: reading_now(life()))
        self._moments = moments
        self._views: OrderedDict[str, View] = OrderedDict()

    def _chain(self) -> Chain:
        return Chain.of(self._rig())

    def shown(self) -> SceneOut:
        """The state of the scene, and the colours that it is drawn in."""
        keeper, chain = self.keeper, self._chain()
        trouble = f": {keeper.trouble}" if keeper.state is SceneState.WAITING else ""
        return SceneOut(
            state=keeper.state,
            life=keeper.life,
            detail=_SAYS[keeper.state] + trouble,
            viewers=keeper.viewers,
            pressure=_scale(0.0, chain.pressure_pa, "Pa", PRESSURE),
            force=_scale(-chain.force_n, chain.force_n, "N", FORCE),
        )

    async def point(self, who_id: str, cursor: SceneCursor) -> SceneOut | Refusal:
        """Have a view of theirs show a moment of a run, or the rig now."""
        view = View(cursor.deformation, cursor.travel)
        if cursor.run_id is not None and cursor.time_s is not None:
            moment = await run_sync(self._moments.at, cursor.run_id, cursor.time_s)
            if isinstance(moment, Refusal):
                return moment
            view = replace(view, moment=moment)
        name = _name(who_id, cursor.view)
        self._views[name] = view
        self._views.move_to_end(name)
        if len(self._views) > MOST_VIEWS:
            self._views.popitem(last=False)
        self.keeper.want()
        self.keeper.tell(ViewTold(name, view))
        return self.shown()

    @asynccontextmanager
    async def looking(
        self, who_id: str, view: str, protocols: list[str]
    ) -> AsyncIterator[ClientConnection | Refusal]:
        """A connection to the scene for one browser, counted while it lasts."""
        keeper = self.keeper
        if keeper.viewers >= MOST_VIEWERS:
            yield Refusal(Code.BUSY, f"{MOST_VIEWERS} views are open: close one")
            return
        keeper.viewers += 1
        try:
            yield await self._connect(_name(who_id, view), protocols)
        finally:
            keeper.viewers -= 1

    async def _connect(self, name: str, protocols: list[str]) -> ClientConnection | Refusal:
        process = await self.keeper.until_ready(PATIENCE_S)
        if process is None:
            return _later(self.shown().detail)
        self.keeper.tell(ViewTold(name, self._views.get(name, View())))
        try:
            return await unix_connect(
                process.socket,
                address_of(name),
                subprotocols=[p for p in protocols if p.startswith(PROTOCOL)][:1],
                compression=None,
                max_size=MOST_FRAME_BYTES,
                max_queue=8,
                open_timeout=PATIENCE_S,
            )
        except (OSError, TimeoutError, WebSocketException) as error:
            return _later(f"The 3-D view does not answer: {error}")


def _later(why: str) -> Refusal:
    return Refusal(Code.BUSY, f"{why}: try again in a moment", about={"retry_after_s": RETRY_S})


def _name(who_id: str, view: str) -> str:
    """Of a view, among those of everybody: nobody steers another's."""
    return f"{who_id}/{view}"


def _scale(low: float, high: float, unit: str, colours: tuple[Colour, ...]) -> Scale:
    return Scale(from_value=low, to_value=high, unit=unit, colours=[c.hexadecimal for c in colours])
