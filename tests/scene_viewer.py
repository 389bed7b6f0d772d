"""A browser at the 3-D view, without a screen: what a page would be sent, by the name of each part."""

from types import TracebackType
from typing import Any, Self

import msgspec.msgpack
import pyarrow as pa
import viser
from viser._messages import ViewerCameraMessage
from websockets.sync.client import ClientConnection, connect
from websockets.typing import Subprotocol

PROTOCOL = f"viser-v{viser.__version__}"
PATIENCE_S = 30
_CAMERA = ViewerCameraMessage(
    wxyz=(1.0, 0.0, 0.0, 0.0),
    position=(0.0, 0.0, 1.0),
    fov=1.0,
    near=0.01,
    far=100.0,
    image_height=100,
    image_width=100,
    look_at=(0.0, 0.0, 0.0),
    up_direction=(0.0, 1.0, 0.0),
)


class SceneViewer:
    """Connected on entering; `parts` holds the newest position, scale, colour and text of each part."""

    def __init__(self, url: str, headers: dict[str, str], view: str = "") -> None:
        address = url.rstrip("/").replace("http", "ws", 1) + "/scene" + (f"/{view}" if view else "")
        self.stream: ClientConnection = connect(
            address,
            additional_headers=headers,
            subprotocols=[Subprotocol(PROTOCOL)],
            open_timeout=PATIENCE_S,
        )
        self.parts: dict[str, dict[str, Any]] = {}

    def __enter__(self) -> Self:
        document: dict[str, Any] = _CAMERA.as_serializable_dict([])
        self.stream.send(msgspec.msgpack.encode(document))
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self.stream.close()

    def until(self, part: str, what: str, wanted: Any) -> None:
        """Read until a part is as wanted, a value or what tells it. Raises TimeoutError where it never is."""
        holds = wanted if callable(wanted) else lambda found: found == wanted
        while not (
            part in self.parts and what in self.parts[part] and holds(self.parts[part][what])
        ):
            self._read()

    def read_on(self) -> None:
        """Read until the stream ends. Raises `ConnectionClosed`."""
        while True:
            self._read()

    def _read(self) -> None:
        frame = self.stream.recv(PATIENCE_S)
        assert isinstance(frame, bytes)
        size, packed = (int.from_bytes(frame[at : at + 8], "little") for at in (0, 8))
        text = pa.decompress(frame[16 : 16 + packed], size, codec="zstd", asbytes=True)
        for message in msgspec.msgpack.decode(text)["messages"]:
            name = message.get("name")
            if name is None:
                continue
            part = self.parts.setdefault(name, {})
            part.update(message.get("props") or {})
            part.update(message.get("updates") or {})
            if message["type"] == "SetPositionMessage":
                part["position"] = tuple(message["position"])
