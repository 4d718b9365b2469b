"""Explains why a picture is blank.

In: a scene, a camera, and a drawn frame. Out: a word for programs, and a sentence. Causes are tried
from the file's content to the camera. `may_be_blank` quickly rules out most pictures; only the
others are examined.
"""

from __future__ import annotations

import contextlib
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from ..base import linalg
from ..model.geometry.mesh import Mesh
from ..model.materials.material import Material
from ..model.scene.cameras import Camera
from ..model.scene.instances import InstancedMesh
from ..model.scene.lenses.lens_camera import LensCamera
from ..model.scene.nodes import Node
from ..model.scene.scene import Scene
from ..model.scene.shown import placing_pose, shown_object
from ..rendering.frame import Frame
from ..rendering.renderer import Renderer
from .visibility import DRAWABLE, mesh_of

if TYPE_CHECKING:
    from .staging import Staging

#: The options of `Renderer.render` by which a thing shows or not.
SHOWING = ("cull", "point_size", "size_unit")
_MANY = 1024
_SMALL = 240  # pixels of the longer side of a first test picture


class Reason(NamedTuple):
    """Why a picture is blank: a word from the list in docs/sheet.md, and a sentence."""

    word: str
    sentence: str


@dataclass
class Sight:
    """What a frame looks at: scene, camera, size and options.

    Attributes
    ----------
    scene : Scene
    camera, pose
    size : (int, int)
        Of the picture, in pixels.
    options : Mapping
        Those of `SHOWING` that have been chosen.
    drawing : Mapping
        ``backend`` and ``threads`` of `Renderer`.
    """

    scene: Scene
    camera: Camera
    pose: np.ndarray
    size: tuple[int, int]
    options: Mapping[str, Any]
    drawing: Mapping[str, Any] = field(default_factory=dict)

    def shows(self, size: tuple[int, int], **options: Any) -> bool:
        """Return whether any pixel of a picture of a given size shows a surface."""
        with Renderer(size, **self.drawing) as renderer:
            frame = renderer.render(
                self.scene,
                (self.camera, self.pose),
                outputs=("object_id",),
                transparent_outputs=True,
                **{**self.options, **options},
            )
        return bool((frame.object_id >= 0).any())


class BlankWatch:
    """Checks whether any frame so far has shown something of the scene."""

    def __init__(self) -> None:
        self._has_shown = False
        self._doubtful: Sight | None = None

    def look(self, frame: Frame, staging: Staging, sight: Callable[[], Sight]) -> None:
        """Note whether a frame certainly shows something; keep the first sight that may not.

        Parameters
        ----------
        frame : Frame
        staging : Staging
            The stage that it was drawn with.
        sight : callable
            Returns the frame's `Sight`.
        """
        if self._has_shown:
            return
        if not staging.shows_more:
            self._has_shown = not may_be_blank(frame.stats, staging.viewed.scene)
        elif staging.alone is not None and not staging.shows_grids:
            self._has_shown = bool(staging.alone[..., 3].any())
        staging.alone = None
        if not self._has_shown and self._doubtful is None:
            self._doubtful = sight()

    def reason(self) -> Reason | None:
        """Return why all frames so far were blank; None if one was not."""
        if self._has_shown or self._doubtful is None:
            return None
        return why_blank(self._doubtful)


def may_be_blank(stats: Mapping[str, Any], scene: Scene) -> bool:
    """Return whether a picture of only a scene's own nodes may be blank; usually not.

    Parameters
    ----------
    stats : Mapping
        The frame's statistics.
    scene : Scene
    """
    if not stats["pixels_shaded"]:
        return True
    opaque = False
    for number, node in enumerate(scene.nodes):
        if opaque and number >= _MANY:
            break  # among so many, transparent materials hardly hide that the rest is blank
        if isinstance(node.object, DRAWABLE):
            for material in mesh_of(node.object).materials:
                if material.alpha_mode == "opaque":
                    opaque = opaque or node.shown
                elif material.alpha == 0:
                    return True
    return not opaque


def why_blank(sight: Sight) -> Reason | None:
    """Return why a picture of a scene is blank; None if it is not."""
    width, height = sight.size
    scale = max(width, height) / _SMALL
    small = max(1, round(width / scale)), max(1, round(height / scale))
    if (scale > 1 and sight.shows(small)) or sight.shows(sight.size):
        return None
    return reason_of(sight)


def reason_of(sight: Sight) -> Reason:
    """Return why a picture shows nothing in any pixel."""
    nodes = _drawables(sight)
    return _of_content(sight, nodes) or _of_place(sight, nodes) or _of_surface(sight, nodes)


def _drawables(sight: Sight) -> list[Node]:
    """Return the nodes with drawable objects."""
    return [node for node in sight.scene.nodes if isinstance(node.object, DRAWABLE)]


def _of_content(sight: Sight, nodes: list[Node]) -> Reason | None:
    if not nodes:
        return Reason("no_geometry", "there is no mesh in the scene")
    meshes = [mesh_of(node.object) for node in nodes]
    if not any(len(m.faces) or len(m.lines) or len(m.points) for m in meshes):
        return Reason("no_faces", "the meshes have neither faces nor lines nor points")
    if not any(node.shown for node in nodes):
        return Reason("hidden_nodes", "all nodes with meshes are switched off")
    if not any(map(_has_finite, meshes)):
        return Reason("not_finite", "no vertex has finite coordinates, or no face, line or point")
    if any(len(mesh.faces) for mesh in meshes) and all(map(_is_one_point, meshes)):
        if _is_one_place(_points(sight, nodes)):
            return Reason("zero_size", "all vertices are at one point")
    return None


def _has_finite(mesh: Mesh) -> bool:
    """Return whether any face, line or point of a mesh has only finite corners."""
    finite = np.asarray(np.isfinite(mesh.positions).all(axis=1))
    if finite.all():
        return True
    elements = (mesh.faces, mesh.lines, mesh.points)
    return any(bool(finite[e.reshape(len(e), -1)].all(axis=1).any()) for e in elements if len(e))


def _is_one_point(mesh: Mesh) -> bool:
    """Return whether the finite vertices of a mesh all coincide."""
    return _is_one_place(mesh.positions[np.isfinite(mesh.positions).all(axis=1)])


def _is_one_place(points: np.ndarray) -> bool:
    return not len(points) or not np.ptp(points, axis=0).any()


def _of_place(sight: Sight, nodes: list[Node]) -> Reason | None:
    points, (width, height) = _points(sight, nodes), sight.size
    if isinstance(sight.camera, LensCamera):
        seen = linalg.transform_points(linalg.inverse(sight.pose), points)
        pixels = sight.camera.project(seen, sight.size)
        with np.errstate(invalid="ignore"):
            inside = (pixels >= 0.0) & (pixels <= (width, height))
        if not inside.all(axis=1).any():
            return Reason("outside", "all of it is outside of the picture")
        return None
    projection = np.array(sight.camera.projection((width, height)), np.float64)
    clip = linalg.multiply(projection, linalg.inverse(sight.pose))
    x, y, z, w = (linalg.dot(points, row[:3]) + row[3] for row in clip)
    if (z < -w).all():
        return Reason("behind_camera", "all of it is behind the camera or before its near plane")
    if (z > w).all():
        return Reason("beyond_far", "all of it is beyond the camera's far plane")
    if (x < -w).all() or (x > w).all() or (y < -w).all() or (y > w).all():
        return Reason("outside", "all of it is outside of the picture")
    with np.errstate(all="ignore"):
        columns, rows = x / w * (0.5 * width), y / w * (0.5 * height)
    if np.ptp(columns) < 1.0 and np.ptp(rows) < 1.0:
        return Reason("far_away", "it is smaller than a pixel")
    return None


def _points(sight: Sight, nodes: list[Node]) -> np.ndarray:
    """Return corners of the boxes of instances, and all finite vertices of other meshes.

    For very many nodes, return only the corners of their boxes.
    """
    found = [np.zeros((0, 3))]
    if len(nodes) > _MANY:
        bounds = sight.scene.select(nodes).bounds
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


def _of_surface(sight: Sight, nodes: list[Node]) -> Reason:
    if sight.shows(sight.size, cull="none", mode="object_id"):
        return Reason("all_culled", "all faces show their backs, which are left out")
    with _opaque([m for node in nodes for m in mesh_of(node.object).materials]):
        if sight.shows(sight.size, cull="none"):
            return Reason("transparent", "what is there is transparent or cut out")
    return Reason("edge_on", "its faces are seen edge on, or are thinner than a pixel")


@contextlib.contextmanager
def _opaque(materials: Iterable[Material]) -> Iterator[None]:
    """Make all materials opaque within the block."""
    modes = [(m, m.alpha_mode) for m in materials if m.alpha_mode != "opaque"]
    try:
        for material, _ in modes:
            material.alpha_mode = "opaque"
        yield
    finally:
        for material, mode in modes:
            material.alpha_mode = mode
