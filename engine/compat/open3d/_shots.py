"""Pictures of a `Visualizer`: what shows, by the engine; light, as Open3D's shaders have it.

In: a shot: parts, the view, the options of a moment. Out: colours and depths of one sample a pixel,
as Open3D's frame buffer holds them.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ...base import linalg
from ...model.materials.linear_colors import linear
from ...model.scene.cameras import Camera
from ...model.scene.scene import Scene
from ...rendering.frame import Frame
from ...rendering.options import MAX_LINE
from ...rendering.renderer import Renderer
from ._geometry_parts import WIRE, Cloud, Part, Surface
from ._phong import Lighting, phong, turned_to
from ._texels import texels

_LIT = ("face_id", "barycentric", "world_position")


@dataclass(frozen=True)
class Shot:
    """Everything that a picture depends on, as it was when the picture was ordered.

    Attributes
    ----------
    parts : sequence of Part
    size : (int, int)
    projection, view : (4, 4) float64
        clip_from_view and view_from_world.
    planes : (float, float)
        Distances of the near and far planes.
    background : (3,) float
    lighting : Lighting
    point_size, line_width : float
    shows_back_faces, shows_wires : bool
    """

    parts: Sequence[Part]
    size: tuple[int, int]
    projection: NDArray[np.float64]
    view: NDArray[np.float64]
    planes: tuple[float, float]
    background: NDArray[np.float64]
    lighting: Lighting
    point_size: float
    line_width: float
    shows_back_faces: bool
    shows_wires: bool


class Drawer:
    """Draws shots, and keeps the renderer from one to the next."""

    def __init__(self) -> None:
        self._renderer: Renderer | None = None

    def color(self, shot: Shot) -> NDArray[np.uint8]:
        """Return the colours of a shot, (H, W, 3) uint8."""
        surfaces = [part.surface for part in shot.parts if part.surface is not None]
        outputs = "color", "object_id", "ndc_depth", *(_LIT if surfaces else ())
        frame, owners = self._frame(shot, outputs)
        color = frame.color[..., :3].copy()
        for number, part in owners.items():
            if part.surface is not None:
                where = np.nonzero(frame.object_id == number)
                color[where] = _coded(_surface_colors(part.surface, frame, where, shot))
        if shot.shows_wires and any(part.has_wires for part in shot.parts):
            self._add_wires(shot, frame, color)
        return color

    def depth(self, shot: Shot) -> tuple[NDArray[np.float32], NDArray[np.float32]]:
        """Return the depths of a shot.

        Returns
        -------
        depth : (H, W) float32
            Along the view axis, as Open3D finds it from its depth buffer; 0 is the background.
        ndc_depth : (H, W) float32
            From -1 to 1; infinite is the background.
        """
        frame, _ = self._frame(shot, ("depth", "ndc_depth"))
        return _depth(shot, frame), frame.ndc_depth

    def _frame(
        self, shot: Shot, outputs: tuple[str, ...], *, wires: bool = False, **options
    ) -> tuple[Frame, dict[int, Part]]:
        """Draw what shows, unlit but for points; return it, and the parts by their numbers."""
        if self._renderer is None:
            self._renderer = Renderer(shot.size, color_space="linear")
        elif self._renderer.size != shot.size:
            self._renderer.resize(shot.size)
        scene = Scene(background=linear(*np.clip(shot.background, 0.0, 1.0).tolist()))
        owners = {}
        for part in shot.parts:
            if wires and not part.has_wires:
                continue
            if part.cloud is not None and "color" in outputs:
                part.mesh.colors = linear(_cloud_colors(part.cloud, shot))
            owners[scene.add(part.mesh).id] = part
        frame = self._renderer.render(
            scene,
            (Camera(shot.projection), linalg.inverse(shot.view)),
            mode="unlit",
            outputs=outputs,
            cull="none" if shot.shows_back_faces else "back",
            point_size=min(max(shot.point_size, 1.0), MAX_LINE),
            **{"line_width": min(max(shot.line_width, 1.0), MAX_LINE), **options},
        )
        return frame, owners

    def _add_wires(self, shot: Shot, frame: Frame, color: NDArray[np.uint8]) -> None:
        """Draw the edges of faces over a picture, where nothing is before them."""
        bare, _ = self._frame(shot, ("color",), wires=True)
        mark = _unused(bare.color)
        wires, _ = self._frame(
            shot,
            ("color", "ndc_depth"),
            wires=True,
            wireframe="overlay",
            line_color=tuple(mark.tolist()),
            line_width=1.0,
        )
        edges = (wires.color[..., :3] == mark).all(axis=2)
        color[edges & (wires.ndc_depth <= frame.ndc_depth)] = round(WIRE * 255.0)


def _unused(color: NDArray[np.uint8]) -> NDArray[np.uint8]:
    """Return a colour that no pixel has."""
    for red in range(256):
        mark = np.array([red, 1, 254], np.uint8)
        if not (color[..., :3] == mark).all(axis=2).any():
            return mark
    return np.zeros(3, np.uint8)  # a picture that has all of these has no edges to see


def _surface_colors(surface: Surface, frame: Frame, where, shot: Shot) -> NDArray[np.float64]:
    """Return the colours of the pixels of a surface, (N, 3)."""
    faces = frame.face_id[where]
    shares = frame.barycentric[where].astype(np.float64)
    corners = surface.faces[faces]
    if surface.uvs is not None:
        uvs = _mixed(surface.uvs[faces], shares)
        colors = texels(surface.textures, surface.texture_ids[faces], uvs)
    else:
        colors = _mixed(surface.colors[corners], shares)
    if surface.normals is None:
        return np.clip(colors, 0.0, 1.0)
    if surface.shows_normals:
        rows = corners if surface.is_smooth else np.repeat(faces[:, np.newaxis], 3, axis=1)
        return _normal_colors(_mixed(surface.normals[rows], shares), shot)
    normals = _normals(surface, faces, corners, shares, shot.lighting.eye)
    points = frame.world_position[where].astype(np.float64)
    return phong(shot.lighting, points, normals, colors)


def _normals(surface: Surface, faces, corners, shares, eye) -> NDArray[np.float64]:
    """Return normals of pixels: each vertex turns its own towards the viewer, as Open3D does."""
    normals = surface.normals
    if surface.is_smooth:
        turned = normals * turned_to(eye, surface.positions, normals)
        return _mixed(turned[corners], shares)
    seen, rows = np.unique(faces, return_inverse=True)
    own = normals[seen]
    signs = np.concatenate(
        [
            turned_to(eye, surface.positions[surface.faces[seen, corner]], own)
            for corner in range(3)
        ],
        axis=1,
    )
    weights = signs[rows] * shares
    return own[rows] * ((weights[:, :1] + weights[:, 1:2]) + weights[:, 2:])


def _mixed(corners: NDArray[np.float64], shares: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return values, (N, K), of pixels from those of their faces' corners, (N, 3, K)."""
    parts = corners * shares[:, :, np.newaxis]
    return (parts[:, 0] + parts[:, 1]) + parts[:, 2]


def _cloud_colors(cloud: Cloud, shot: Shot) -> NDArray[np.float64]:
    if cloud.shows_normals:
        return _normal_colors(cloud.normals, shot)
    normals = cloud.normals * turned_to(shot.lighting.eye, cloud.positions, cloud.normals)
    return phong(shot.lighting, cloud.positions, normals, cloud.colors)


def _normal_colors(normals: NDArray[np.float64], shot: Shot) -> NDArray[np.float64]:
    seen = linalg.transform_directions(shot.view, normals)
    return np.clip(seen * 0.5 + 0.5, 0.0, 1.0)


def _coded(colors: NDArray[np.float64]) -> NDArray[np.uint8]:
    return (np.nan_to_num(colors) * 255.0 + 0.5).astype(np.uint8)


def _depth(shot: Shot, frame: Frame) -> NDArray[np.float32]:
    """Return depths as Open3D finds them: by the formula of a perspective, whatever the view."""
    if shot.projection[3, 3] == 0.0:
        return frame.depth
    near, far = shot.planes
    seen = np.isfinite(frame.ndc_depth)
    if not seen.any():
        return frame.depth
    z = np.where(seen, frame.ndc_depth, 0.0).astype(np.float64)
    depth = 2.0 * near * far / (far + near - z * (far - near))
    return np.where(seen, depth, 0.0).astype(np.float32)
