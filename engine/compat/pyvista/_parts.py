"""What is drawn of an actor: triangles in view space with one look.

In: what surfaces, strokes and dots make. Out: nodes of a scene of engine3d, in view space.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from ...base import linalg
from ...model.geometry.mesh import Mesh
from ...model.materials.linear_colors import linear
from ...model.materials.material import Material
from ...model.materials.textures import Texture
from ...model.scene.instances import InstancedMesh
from ...model.scene.nodes import Node
from ...model.scene.scene import Scene
from ._properties import Property

#: So many faces are shaded where they show, instead of each.
MANY = 100_000


@dataclass
class Paint:
    """The colours of some points: one for each, or an image that is read at coordinates.

    Attributes
    ----------
    rgba : (N, 4) uint8 or None
    uvs : (N, 2) float32 or None
        From the image's left bottom.
    image : Texture or None
    is_clear : bool
        Whether an alpha is less than 1.
    is_color : bool
        Whether these are the colours, instead of multiplying the look's.
    """

    rgba: NDArray[np.uint8] | None = None
    uvs: NDArray[np.float32] | None = None
    image: Texture | None = None
    is_clear: bool = False
    is_color: bool = True

    @property
    def is_plain(self) -> bool:
        """Whether there are none."""
        return self.rgba is None and self.image is None

    def taken(self, rows: NDArray[np.integer]) -> Paint:
        """Return the colours of rows."""
        return replace(
            self,
            rgba=None if self.rgba is None else self.rgba[rows],
            uvs=None if self.uvs is None else self.uvs[rows],
        )

    def opaque(self) -> Paint:
        """Return the same colours with alphas of 1."""
        rgba, image = self.rgba, self.image
        if rgba is not None:
            rgba = rgba.copy()
            rgba[:, 3] = 255
        if image is not None and image.pixels.shape[2] == 4:
            image = Texture(
                image.pixels[..., :3],
                color_space=image.color_space,
                filter=image.filter,
                wrap=image.wrap,
            )
        return replace(self, rgba=rgba, image=image, is_clear=False)

    def baked(self) -> Paint:
        """Return the same with a colour for each point, that of the nearest pixel of the image."""
        if self.image is None or self.uvs is None:
            return self
        pixels = self.image.pixels
        height, width = pixels.shape[:2]
        x = np.clip((self.uvs[:, 0] * width).astype(np.int64), 0, width - 1)
        y = np.clip(((1.0 - self.uvs[:, 1]) * height).astype(np.int64), 0, height - 1)
        return replace(self, rgba=pixels[y, x], uvs=None, image=None)


@dataclass
class Maps:
    """What pictures say of a physical material.

    Attributes
    ----------
    uvs : (V, 2) float32
        From the pictures' left bottom.
    material : Texture or None
        Occlusion, roughness and metal, which multiply the look's.
    emissive : Texture or None
        Light of its own.
    """

    uvs: NDArray[np.float32]
    material: Texture | None
    emissive: Texture | None


@dataclass
class Part:
    """Triangles with one look.

    Attributes
    ----------
    places : (V, 3) float64
        In view space.
    faces : (F, 3) int32
    look : Property
    normals : (V, 3) float64 or None
        In view space, of any length; None for flat faces.
    paint : Paint
        The colours of the vertices.
    edges : (F, 3) bool or None
        Which edges of faces are edges of polygons; None: all.
    face_rgba : (F, 4) uint8 or None
        The colours of faces, of so many that vertices of their own would take long.
    spots : (N, 4) float64 or None
        Where the part stands, many times: offsets and sizes.
    spot_colors : (N, 4) uint8 or None
    maps : Maps or None
    is_points : bool
        Whether the places are points, which the core draws as squares or discs.
    is_face : bool
        Whether these are faces of a surface, which has two sides, instead of lines or points.
    """

    places: NDArray[np.float64]
    faces: NDArray[np.int32]
    look: Property
    normals: NDArray[np.float64] | None = None
    paint: Paint = field(default_factory=Paint)
    edges: NDArray[np.bool_] | None = None
    face_rgba: NDArray[np.uint8] | None = None
    spots: NDArray[np.float64] | None = None
    spot_colors: NDArray[np.uint8] | None = None
    maps: Maps | None = None
    is_points: bool = False
    is_face: bool = False

    @property
    def is_empty(self) -> bool:
        """Whether nothing is there to be drawn."""
        if self.is_points:
            return not len(self.places)
        return not len(self.faces) or (self.spots is not None and not len(self.spots))

    @property
    def is_clear(self) -> bool:
        """Whether something shows through."""
        return self.look.opacity < 1.0 or self.paint.is_clear

    def facing(self, front: bool, is_parallel: bool) -> Part:
        """Return the faces that show one side to the camera."""
        a, b, c = (self.places[self.faces[:, k]] for k in range(3))
        across = linalg.cross(b - a, c - a)
        towards = across[:, 2] if is_parallel else -(across * a).sum(1)
        return self.of_faces((towards >= 0.0) == front)

    def of_faces(self, kept: NDArray[np.bool_]) -> Part:
        """Return some of the faces; ``kept`` is (F,)."""
        edges = None if self.edges is None else self.edges[kept]
        rgba = None if self.face_rgba is None else self.face_rgba[kept]
        return replace(self, faces=self.faces[kept], edges=edges, face_rgba=rgba)

    def standing_apart(self) -> Part:
        """Return the same with faces of its own wherever it stands."""
        if self.spots is None:
            return self
        count, size = len(self.spots), len(self.places)
        offsets, sizes = self.spots[:, None, :3], self.spots[:, None, 3:]
        firsts = np.arange(count, dtype=np.int32) * np.int32(size)
        colors = None if self.spot_colors is None else np.repeat(self.spot_colors, size, 0)
        return replace(
            self,
            places=(offsets + sizes * self.places).reshape(-1, 3),
            faces=(firsts[:, None, None] + self.faces).reshape(-1, 3),
            normals=None if self.normals is None else np.tile(self.normals, (count, 1)),
            paint=self.paint if colors is None else replace(self.paint, rgba=colors),
            spots=None,
            spot_colors=None,
        )

    def opaque(self) -> Part:
        """Return the same where nothing shows through, without edges."""
        return replace(
            self,
            look=replace(self.look, opacity=1.0, edge_width=0.0),
            paint=self.paint.opaque(),
        )

    def with_own_corners(self) -> Part:
        """Return the same with the colours of faces at vertices that they do not share."""
        if self.face_rgba is None:
            return self
        corners = self.faces.reshape(-1)
        rgba = np.repeat(self.face_rgba, 3, 0)
        return replace(
            self,
            places=self.places[corners],
            faces=np.arange(len(corners), dtype=np.int32).reshape(-1, 3),
            normals=None if self.normals is None else self.normals[corners],
            paint=Paint(rgba, is_clear=bool((self.face_rgba[:, 3] != 255).any())),
            face_rgba=None,
            maps=self.maps and replace(self.maps, uvs=self.maps.uvs[corners]),
        )

    def showing(self, picture: Texture) -> Part:
        """Return the same with a picture as its only colours, at the coordinates of its maps."""
        assert self.maps is not None
        paint = Paint(uvs=self.maps.uvs, image=picture)
        return replace(self, paint=paint, face_rgba=None, maps=None)

    def added(self, scene: Scene, material: Material) -> Node:
        """Put the part into a scene."""
        mesh = Mesh(
            self.places.astype(np.float32),
            self.faces,
            points=np.arange(len(self.places), dtype=np.int32) if self.is_points else None,
            normals=None if self.normals is None else _unit(self.normals),
            colors=self.paint.rgba,
            uvs=self._uvs,
            materials=[material],
        )
        if self.spots is None:
            return scene.add(mesh)
        return scene.add(InstancedMesh(mesh, self.spots, colors=self.spot_colors))

    @property
    def _uvs(self) -> NDArray[np.float32] | None:
        if self.paint.uvs is not None or self.maps is None:
            return self.paint.uvs
        return self.maps.uvs

    def material(self, factor: float = 1.0, opacity: float | None = None) -> Material:
        """Return the material; ``factor`` multiplies its colour."""
        look = self.look
        alpha = look.opacity if opacity is None else opacity
        color = np.ones(3) if self.has_colors else look.color
        return Material(
            color=linear([*(color * factor), alpha]),
            texture=self.paint.image,
            alpha_mode="blend" if self.is_clear else "opaque",
            flat_shading=self.normals is None,
            two_sided=True,
            unlit=look.is_unlit,
        )

    @property
    def has_colors(self) -> bool:
        """Whether points have colours of their own, instead of the look's."""
        has_paint = self.paint.is_color and not self.paint.is_plain
        return has_paint or self.spot_colors is not None or self.face_rgba is not None


def _unit(vectors: NDArray[np.float64]) -> NDArray[np.float32]:
    length = np.sqrt((vectors * vectors).sum(1, keepdims=True))
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.where(length > 0.0, vectors / length, 0.0).astype(np.float32)
