"""Who looks at what, and the drawing of it: in the scene's own process."""

import logging
from collections import OrderedDict
from dataclasses import dataclass
from typing import Any

import viser

from app.scene.chain import Chain, Reading
from app.scene.model import Model
from app.scene.private import looking
from app.scene.telling import LiveTold, RigTold, Told, View, ViewTold

_log = logging.getLogger(__name__)
MOST_VIEWS = 64  # that are remembered: the oldest goes
AMBIENT = 1.5
LABELS_EACH = 8  # frames: figures that change faster cannot be read
CAMERA_M, LOOKS_AT_M, FIELD_RAD = (0.86, -1.9, 0.75), (0.94, 0.0, -0.03), 0.7


@dataclass
class _Seen:
    """One browser: its view, what is in its scene, and what was drawn and said there last."""

    view: str
    client: viser.ClientHandle
    model: Model
    drawn: Any = None
    said: Any = None


class Stage:
    """The rig as every browser sees it. Told by one thread, drawn by another, joined by viser's own."""

    def __init__(self, chain: Chain) -> None:
        self._chain = chain
        self._live = Reading()
        self._views: OrderedDict[str, View] = OrderedDict()
        self._seen: dict[int, _Seen] = {}
        self._frame = 0

    def open(self, server: viser.ViserServer) -> None:
        """Let browsers in."""
        server.initial_camera.position = CAMERA_M
        server.initial_camera.look_at = LOOKS_AT_M
        server.initial_camera.fov = FIELD_RAD
        server.scene.world_axes.visible = False
        # Shadows and reflections are too dear without a graphics card: seconds a picture.
        server.scene.configure_default_lights(cast_shadow=False)
        server.scene.configure_environment_map(hdri=None)
        server.scene.add_light_ambient("/light", intensity=AMBIENT)

        @server.on_client_connect
        async def _(client: viser.ClientHandle) -> None:  # async: where `looking` is known
            name = looking.get()
            chain, _, _ = self._shown(name)
            self._seen[client.client_id] = _Seen(name, client, Model(client.scene, chain))

        @server.on_client_disconnect
        async def _(client: viser.ClientHandle) -> None:
            self._seen.pop(client.client_id, None)

    def take(self, told: Told) -> None:
        """Take in what the console tells."""
        if isinstance(told, RigTold):
            self._chain = told.chain
        elif isinstance(told, LiveTold):
            self._live = told.reading
        elif isinstance(told, ViewTold):
            self._views[told.name] = told.view
            self._views.move_to_end(told.name)
            if len(self._views) > MOST_VIEWS:
                self._views.popitem(last=False)

    def draw(self) -> None:
        """Bring every scene up to what is known now."""
        self._frame += 1
        for number, seen in list(self._seen.items()):
            try:
                self._draw(seen)
            except Exception:  # a browser that has just gone, most likely
                _log.exception("the scene of a browser is given up")
                self._seen.pop(number, None)

    def _draw(self, seen: _Seen) -> None:
        chain, reading, view = self._shown(seen.view)
        if seen.model.chain != chain:
            seen.client.scene.reset()
            seen.model = Model(seen.client.scene, chain)
            seen.drawn = seen.said = None
        wanted = reading, view.deformation, view.travel
        with seen.client.atomic():
            if wanted != seen.drawn:
                seen.model.show(*wanted)
                seen.drawn = wanted
            if wanted != seen.said and (seen.said is None or self._frame % LABELS_EACH == 0):
                seen.model.say(*wanted)
                seen.said = wanted

    def _shown(self, name: str) -> tuple[Chain, Reading, View]:
        view = self._views.get(name, View())
        if view.moment is None:
            return self._chain, self._live, view
        return view.moment.chain, view.moment.reading, view
