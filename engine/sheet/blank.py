"""Why a panel shows nothing, or nothing that could be seen.

In: a scene, a camera, and what was drawn. Out: a word that a program can test, and a sentence.
Reasons are tried from what the file holds to how it is looked at.
"""

from __future__ import annotations

import contextlib
from collections.abc import Iterable, Iterator
from typing import NamedTuple

import numpy as np

from .. import linalg
from ..geometry.mesh import Mesh
from ..materials.material import Material
from ..motion.shown import placing_pose, shown_object
from ..rendering.frame import Frame
from ..scene.cameras import Camera
from ..scene.instances import InstancedMesh
from ..viewer.visibility import DRAWABLE, mesh_of
from .layout import Rectangle
from .studio import Studio
from .visible import covered

#: Colours that differ by no more codes of 255 cannot be told from the ground.
SAME_COLOUR = 6
_MANY = 1024


class Reason(NamedTuple):
    """Why nothing is seen: a word of the list in docs/sheet.md, and a sentence."""

    word: str
    sentence: str


def why_blank(studio: Studio, camera: Camera, pose: np.ndarray, rectangle: Rectangle) -> Reason:
    """Return why a camera shows nothing of a scene."""
    reason = _of_content(studio)
    if reason is None:
        reason = _of_place(studio, camera, pose, rectangle)
    if reason is None:
        reason = _of_surface(studio, camera, pose, rectangle)
    return reason


def contrast(frame: Frame, shown: np.ndarray, ground: tuple[int, int, int]) -> int:
    """Return by how many codes of 255 what shows differs from the ground, at most."""
    most = 0
    for channel, code in enumerate(ground):
        codes = frame.color[..., channel][shown]
        if len(codes):
            most = max(most, int(codes.max()) - code, code - int(codes.min()))
    return most


def _drawables(studio: Studio):
    """The nodes of the scene's own that hold something to draw."""
    wanted = set(studio.own_ids.tolist())
    return [n for n in studio.scene.nodes if n.id in wanted and isinstance(n.object, DRAWABLE)]


def _of_content(studio: Studio) -> Reason | None:
    nodes = _drawables(studio)
    if not nodes:
        return Reason("no_geometry", "there is no mesh in the scene")
    meshes = [mesh_of(node.object) for node in nodes]
    if not any(len(m.faces) or len(m.lines) or len(m.points) for m in meshes):
        return Reason("no_faces", "the meshes have neither faces nor lines nor points")
    if not any(node.shown for node in nodes):
        return Reason("hidden_nodes", "all nodes with meshes are switched off")
    if not any(np.isfinite(mesh.positions).all(axis=1).any() for mesh in meshes):
        return Reason("not_finite", "no vertex has finite coordinates")
    low, high = studio.bounds
    if not (high > low).any() and any(len(mesh.faces) for mesh in meshes):
        return Reason("zero_size", "all vertices are at one point")
    return None


def _of_place(
    studio: Studio, camera: Camera, pose: np.ndarray, rectangle: Rectangle
) -> Reason | None:
    points = _points(studio)
    projection = np.array(camera.projection(rectangle.width, rectangle.height), np.float64)
    clip = linalg.multiply(projection, linalg.inverse(pose))
    x, y, z, w = (linalg.dot(points, row[:3]) + row[3] for row in clip)
    if (z < -w).all():
        return Reason("behind_camera", "all of it is behind the camera or before its near plane")
    if (z > w).all():
        return Reason("beyond_far", "all of it is beyond the camera's far plane")
    if (x < -w).all() or (x > w).all() or (y < -w).all() or (y > w).all():
        return Reason("outside", "all of it is outside of the picture")
    with np.errstate(all="ignore"):
        columns, rows = x / w * (0.5 * rectangle.width), y / w * (0.5 * rectangle.height)
    if np.ptp(columns) < 1.0 and np.ptp(rows) < 1.0:
        return Reason("far_away", "it is smaller than a pixel")
    return None


def _points(studio: Studio) -> np.ndarray:
    """Corners of the boxes of instances, and all finite vertices of other meshes.

    Of very many nodes, their boxes must do.
    """
    found, nodes = [np.zeros((0, 3))], _drawables(studio)
    if len(nodes) > _MANY:
        bounds = studio.scene.select(nodes).bounds
        bounds = bounds[np.isfinite(bounds).all(axis=(1, 2))]
        return bounds[:, [[i & 1, i >> 1 & 1, i >> 2] for i in range(8)], [0, 1, 2]].reshape(-1, 3)
    for node in nodes:
        thing = shown_object(node)
        if isinstance(thing, InstancedMesh):
            box = thing.bounds_in_node()
            if box is None:
                continue
            points = np.array([[box[i >> k & 1][k] for k in range(3)] for i in range(8)])
        else:
            points = thing.positions if isinstance(thing, Mesh) else np.zeros((0, 3))
        with np.errstate(all="ignore"):
            points = linalg.transform_points(placing_pose(node), points)
        found.append(points[np.isfinite(points).all(axis=1)])
    return np.concatenate(found)


def _of_surface(studio: Studio, camera: Camera, pose: np.ndarray, rectangle: Rectangle) -> Reason:
    materials = [m for node in _drawables(studio) for m in mesh_of(node.object).materials]
    both = studio.render(
        camera, pose, rectangle, outputs=("object_id",), cull="none", mode="object_id"
    )
    if covered(both, studio.own_ids).any():
        return Reason("all_culled", "all faces show their backs, which are left out")
    with _opaque(materials):
        solid = studio.render(camera, pose, rectangle, outputs=("object_id",), cull="none")
    if covered(solid, studio.own_ids).any():
        return Reason("transparent", "what is there is transparent or cut out")
    return Reason("edge_on", "its faces are seen edge on, or are thinner than a pixel")


@contextlib.contextmanager
def _opaque(materials: Iterable[Material]) -> Iterator[None]:
    """Let no material have holes or let anything through, for a while."""
    modes = [(m, m.alpha_mode) for m in materials if m.alpha_mode != "opaque"]
    try:
        for material, _ in modes:
            material.alpha_mode = "opaque"
        yield
    finally:
        for material, mode in modes:
            material.alpha_mode = mode
