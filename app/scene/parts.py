"""Parts of the drawing along x: blocks, bars, coils and labels, put somewhere or spanned between two places."""

import numpy as np
import numpy.typing as npt
from viser import BoxHandle, CylinderHandle, LabelHandle, MeshHandle, SceneApi

from app.scene.colours import Colour
from app.scene.shapes import coil

Stretched = CylinderHandle | MeshHandle
Part = BoxHandle | CylinderHandle | MeshHandle | LabelHandle
FINEST_PLACES = 4  # of a metre: what noise moves by less is not sent
_X_FROM_Z = (0.5**0.5, 0.0, 0.5**0.5, 0.0)  # wxyz: lays what stands along x


class Parts:
    """Adds parts to a scene, by name."""

    def __init__(self, scene: SceneApi) -> None:
        self._scene = scene

    def block(
        self, name: str, size_m: tuple[float, float, float], colour: Colour, opacity: float = 1.0
    ) -> BoxHandle:
        """A box of so much along x, y and z."""
        return self._scene.add_box(name, colour, size_m, opacity=_opacity(opacity))

    def bar(
        self, name: str, radius_m: float, colour: Colour, opacity: float = 1.0
    ) -> CylinderHandle:
        """A round bar along x, to be spanned."""
        return self._scene.add_cylinder(
            name,
            radius_m,
            1.0,
            colour,
            wxyz=_X_FROM_Z,
            opacity=_opacity(opacity),
            cast_shadow=opacity == 1.0,
        )

    def spring(self, name: str, radius_m: float, colour: Colour) -> MeshHandle:
        """A coil along x, to be spanned."""
        mesh = coil(radius_m, 0.09 * radius_m)
        return self._scene.add_mesh_simple(
            name, mesh.vertices, mesh.faces, color=colour, side="double"
        )

    def label(self, name: str, text: str = "", scale: float = 1.0) -> LabelHandle:
        """A label with its middle where it is put."""
        return self._scene.add_label(name, text, anchor="center-center", font_screen_scale=scale)

    def lines(self, name: str, points_m: npt.NDArray[np.float64], colour: Colour) -> None:
        """Thin lines, (n, 2, 3): from where to where."""
        self._scene.add_line_segments(name, points_m, colour, thickness=1.5)


def put(part: Part, x_m: float, y_m: float = 0.0, z_m: float = 0.0) -> None:
    """With its middle there."""
    part.position = (round(x_m, FINEST_PLACES), y_m, z_m)


def span(part: Stretched, from_m: float, to_m: float) -> None:
    """Stretched from one place to another; what would have no length is as thin as a line."""
    long_m = max(round(to_m - from_m, FINEST_PLACES), 1e-3)
    if isinstance(part, CylinderHandle):
        put(part, 0.5 * (from_m + to_m))
        part.scale = (1.0, 1.0, long_m)
    else:
        put(part, from_m)
        part.scale = (long_m, 1.0, 1.0)


def _opacity(opacity: float) -> float | None:
    """As viser has it: only what is given as None is drawn as solid."""
    return None if opacity == 1.0 else opacity
