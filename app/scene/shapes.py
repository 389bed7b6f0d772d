"""Shapes that viser has not: a coil spring, one long along x, to be stretched."""

from typing import NamedTuple

import numpy as np
import numpy.typing as npt

TURNS, PER_TURN, SIDES = 6, 20, 8
WIRE_SHARE = 8.0  # a coil that is drawn an eighth of a metre long has a round wire


class Mesh(NamedTuple):
    """Corners (n, 3) float32 in m, and faces (m, 3) uint32."""

    vertices: npt.NDArray[np.float32]
    faces: npt.NDArray[np.uint32]


def coil(radius_m: float, wire_m: float) -> Mesh:
    """A coil from x = 0 to 1; `wire_m` is the wire's radius across x."""
    rings = TURNS * PER_TURN + 1
    along = np.linspace(0.0, 1.0, rings)
    turned = 2.0 * np.pi * TURNS * along
    around = np.linspace(0.0, 2.0 * np.pi, SIDES, endpoint=False)
    out = np.stack([np.zeros(rings), np.cos(turned), np.sin(turned)], axis=1)
    reach = radius_m + wire_m * np.cos(around)
    vertices = out[:, None, :] * reach[None, :, None]
    vertices[:, :, 0] = along[:, None] + WIRE_SHARE * wire_m * np.sin(around)[None, :]
    ring, side = np.meshgrid(np.arange(rings - 1), np.arange(SIDES), indexing="ij")
    a, b = ring * SIDES + side, ring * SIDES + (side + 1) % SIDES
    c, d = a + SIDES, b + SIDES
    faces = np.concatenate([np.stack([a, b, c], -1), np.stack([b, d, c], -1)]).reshape(-1, 3)
    return Mesh(vertices.reshape(-1, 3).astype(np.float32), faces.astype(np.uint32))
