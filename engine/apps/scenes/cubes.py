"""A spinning cube as its vertices, as its edges, as its faces, and the three in turn.

The cube is the colour cube: each corner has the colour of its coordinates.
"""

from __future__ import annotations

import math

import numpy as np

from ...base import linalg
from ...base.box_corners import CORNER_ENDS
from ...model.geometry.mesh import Mesh
from ...model.primitives import box
from ...model.scene.scene import Scene
from ...stage.viewed_scene import ViewedScene

BACKGROUND = (18, 20, 26)
SPIN_SECONDS = 8.0
#: Seconds for each of the three in ``cube``.
SHARE_SECONDS = 4.0
TILT = math.radians(20.0)
#: The box that the tilted cube sweeps as it spins.
SWEPT_SIZE = (1.42, 1.44, 1.42)
POINT_SIZE = 12.0
LINE_WIDTH = 3.0

_EDGES = [(a, a | bit) for a in range(8) for bit in (1, 2, 4) if not a & bit]


def vertices() -> ViewedScene:
    """Return the cube as eight points."""
    return _spinning("vertices", [_corners(points=np.arange(8))])


def edges() -> ViewedScene:
    """Return the cube as twelve lines."""
    return _spinning("edges", [_corners(lines=_EDGES)])


def faces() -> ViewedScene:
    """Return the cube as six faces."""
    return _spinning("faces", [_solid()])


def cycle() -> ViewedScene:
    """Return the cube as points, then lines, then faces, over and over."""
    meshes = [_corners(points=np.arange(8)), _corners(lines=_EDGES), _solid()]
    return _spinning("cube", meshes)


def _corners(**primitives) -> Mesh:
    """Return the eight corners with points or lines between them."""
    positions = CORNER_ENDS.astype(np.float32) - 0.5
    return Mesh(positions, colors=_corner_colors(positions), **primitives)


def _solid() -> Mesh:
    mesh = box()
    mesh.colors = _corner_colors(mesh.positions)
    return mesh


def _corner_colors(positions) -> np.ndarray:
    """Return red, green and blue by the sign of x, y and z, none completely dark."""
    colors = np.full((len(positions), 4), 255, dtype=np.uint8)
    colors[:, :3] = np.where(np.asarray(positions) > 0, 255, 60)
    return colors


def _spinning(name: str, meshes: list[Mesh]) -> ViewedScene:
    """Return a scene that spins the meshes and shows them in turn."""
    scene = Scene(BACKGROUND)
    nodes = [scene.add(mesh, name=name) for mesh in meshes]
    period = SPIN_SECONDS if len(nodes) == 1 else SHARE_SECONDS * len(nodes)
    tilt = linalg.quaternion_from_axis_angle((1, 0, 0), TILT)

    def update(time: float) -> None:
        shown = int(time / SHARE_SECONDS) % len(nodes)
        angle = 2 * math.pi * time / period
        spin = linalg.quaternion_from_axis_angle((0, 1, 0), angle)
        rotation = linalg.quaternion_multiply(tilt, spin)
        for index, node in enumerate(nodes):
            node.visible = len(nodes) == 1 or index == shown
            node.rotation = rotation

    return ViewedScene(
        scene,
        name,
        azimuth=0.0,
        elevation=0.0,
        update=update,
        period=period,
        plays=True,
        focus=box(SWEPT_SIZE).positions.astype(np.float64),
        appearance={"point_size": POINT_SIZE, "line_width": LINE_WIDTH},
    )
