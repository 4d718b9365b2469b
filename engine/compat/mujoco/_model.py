"""A MuJoCo model's shapes, planes and textures, as the core reads them.

In: an MjModel. Out: a native model, and what else pictures of the model need. As in MuJoCo, a
context copies them when it is made: later changes show after `mjr_uploadMesh` and its like.
"""

from __future__ import annotations

from decimal import Decimal
from functools import cache
from itertools import pairwise
from typing import Any

import numpy as np

from ..._native.mujoco import BUILTINS, NativeModel, halve
from ...errors import InvalidArgumentError, warn
from . import _unit_shapes
from ._quality import Quality
from ._unit_shapes import Triangles, grid_lines

_TEXTURE_2D, _SKYBOX = 0, 2  # of mjtTexture
_SRGB = 2  # of mjtColorSpace
_PLANE = 0  # of mjtGeom


@cache
def _meaning(srgb: bool) -> np.ndarray:
    """Return what the codes of colours mean, (256,) float32.

    `Decimal` has the same digits everywhere.
    """
    if not srgb:
        return (np.arange(256) / 255.0).astype(np.float32)
    values = []
    for code in range(256):
        v = Decimal(code) / 255
        small = v <= Decimal("0.04045")
        values.append(
            v / Decimal("12.92")
            if small
            else ((v + Decimal("0.055")) / Decimal("1.055")) ** Decimal("2.4")
        )
    return np.array(values, np.float32)


@cache
def _code_limits(srgb: bool) -> np.ndarray:
    """Return the values halfway between neighbouring codes' meanings."""
    meaning = _meaning(srgb).astype(np.float64)
    return (meaning[1:] + meaning[:-1]) / 2


def _levels(texels: np.ndarray, srgb: bool) -> list[np.ndarray]:
    """Return levels, each half as large, (faces, H, W, 4) uint8, close together in memory."""
    faces, height, width, _ = texels.shape
    sizes = [(height, width)]
    while max(sizes[-1]) > 1:
        sizes.append((max(sizes[-1][0] // 2, 1), max(sizes[-1][1] // 2, 1)))
    memory = np.empty(sum(faces * h * w * 4 for h, w in sizes), np.uint8)
    levels, end = [], 0
    for h, w in sizes:
        begin, end = end, end + faces * h * w * 4
        levels.append(memory[begin:end].reshape(faces, h, w, 4))
    levels[0][...] = texels
    meaning, limits = _meaning(srgb).astype(np.float64), _code_limits(srgb)
    for level, smaller in pairwise(levels):
        halve(level, meaning, limits, smaller)
    return levels


def _index(at: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return the different positions of corners, and their numbers."""
    flat = np.ascontiguousarray(at.reshape(-1, 3), np.float32) + np.float32(0)
    _, first, numbers = np.unique(
        flat.view(np.dtype((np.void, 12))).ravel(), return_index=True, return_inverse=True
    )
    return flat[first], numbers.reshape(-1, 3).astype(np.int32)


class Model:
    """What a context holds of a model.

    Parameters
    ----------
    model : mujoco.MjModel
    version : (int, int)
        Of MuJoCo: before 3.12, built-in shapes have no coordinates of textures.
    """

    def __init__(self, model: Any, version: tuple[int, int]) -> None:
        self._model = model
        quality = model.vis.quality
        self.first_mesh = BUILTINS
        self.first_hfield = self.first_mesh + 2 * model.nmesh
        self.first_skin = self.first_hfield + model.nhfield
        self.first_flex = self.first_skin + model.nskin
        self._flex_parts = _flex_parts(model)
        shapes = self.first_flex + 2 * int(self._flex_parts[-1])
        plane_geoms = np.flatnonzero(model.geom_type == _PLANE)
        self.native = NativeModel(shapes, 1 + len(plane_geoms), model.ntex)
        skies = np.flatnonzero(model.tex_type == _SKYBOX)
        sky = int(skies[0]) if len(skies) else -1
        self.native.set_numbers(
            self.first_mesh,
            self.first_hfield,
            self.first_skin,
            self.first_flex,
            sky,
            version >= (3, 12),
        )
        extent, maps = float(model.stat.extent), model.vis.map
        self._haze = np.array(model.vis.rgba.haze[:3], np.float32)
        self.quality: Quality | None = None
        self._set_builtins(quality, float(maps.haze))
        self._set_planes(plane_geoms, extent * float(maps.zfar))
        self.skins = [self._skin_faces(i) for i in range(model.nskin)]
        for i in range(model.nmesh):
            self.upload_mesh(i)
        for i in range(model.nhfield):
            self.upload_hfield(i)
        for i in range(model.ntex):
            self.upload_texture(i)
        self._set_material_textures()

    def set_quality(self, quality: Quality) -> None:
        """Say how the next pictures are drawn."""
        self.quality = quality
        self.native.set_quality(
            quality.shadow_size,
            quality.line_width,
            quality.fog_start,
            quality.fog_end,
            np.array(quality.fog, np.float32),
            self._haze,
        )

    def _set_shape(self, number: int, shape: Triangles) -> None:
        positions, corners = _index(shape.at)
        self.native.set_shape(
            number,
            positions,
            corners,
            np.ascontiguousarray(shape.normals, np.float32),
            np.ascontiguousarray(shape.uvs, np.float32),
            np.ascontiguousarray(shape.edges, np.uint8),
        )

    def _set_builtins(self, quality: Any, haze: float) -> None:
        slices, stacks = max(int(quality.numslices), 3), max(int(quality.numstacks), 2)
        quads = max(int(quality.numquads), 1)
        self.unit_sphere = _unit_shapes.sphere(slices, stacks)
        self.open_cylinder = _unit_shapes.cylinder(slices, stacks, closed=False)
        shapes = (
            self.unit_sphere,
            _unit_shapes.cap(slices, stacks, 1),
            _unit_shapes.cap(slices, stacks, -1),
            _unit_shapes.cylinder(slices, stacks, closed=True),
            self.open_cylinder,
            _unit_shapes.cone(slices, stacks),
            _unit_shapes.box(quads),
            _unit_shapes.triangle(),
            _unit_shapes.haze(slices, haze),
            _unit_shapes.cylinder(slices, 1, closed=True),
            _unit_shapes.cylinder(slices, 1, closed=False),
            _unit_shapes.cone(slices, 1),
            _unit_shapes.box(1),
        )
        for number, shape in enumerate(shapes):
            self._set_shape(number, shape)
        lines = np.arange(quads + 1) * (2.0 / quads) - 1
        self.native.set_plane(0, lines, lines.copy(), (0.5, -0.5), (0.5, 0.5))

    def _set_planes(self, geoms: np.ndarray, far: float) -> None:
        model = self._model
        for number, geom in enumerate(geoms):
            size, material = model.geom_size[geom], int(model.geom_matid[geom])
            repeat = model.mat_texrepeat[material] if material >= 0 else (0.0, 0.0)
            lines = [
                grid_lines(float(size[k]), float(size[2]), far, float(repeat[k])) for k in (0, 1)
            ]
            scale = [(0.5 / float(size[k]) if size[k] > 0 else 0.5) * (1, -1)[k] for k in (0, 1)]
            offset = [0.5 if size[k] > 0 else 0.0 for k in (0, 1)]
            self.native.set_plane(1 + number, *lines, scale, offset)

    def read_from(self, model: Any) -> None:
        """Let uploads read a model, which has as much of all as the one that this was made of."""
        for name in ("nmesh", "nhfield", "ntex"):
            wanted, count = getattr(self._model, name), getattr(model, name)
            if count != wanted:
                raise InvalidArgumentError(
                    f"the context was made of a model with {name} {wanted}, not {count}"
                )
        self._model = model

    # ---- meshes ----

    def upload_mesh(self, number: int) -> None:
        """Read a mesh again, and its convex hull (R255)."""
        model = self._model
        begin, count = int(model.mesh_faceadr[number]), int(model.mesh_facenum[number])
        first = int(model.mesh_vertadr[number])
        positions = np.array(
            model.mesh_vert[first : first + model.mesh_vertnum[number]], np.float32
        )
        corners = np.array(model.mesh_face[begin : begin + count], np.int32)
        flat = _face_normals(positions[corners])
        of = model.mesh_facenormal[begin : begin + count] + model.mesh_normaladr[number]
        normals = np.array(model.mesh_normal[of], np.float32)
        uvs = None
        if model.mesh_texcoordadr[number] >= 0:
            where = model.mesh_facetexcoord[begin : begin + count] + model.mesh_texcoordadr[number]
            uvs = np.array(model.mesh_texcoord[where], np.float32)
        else:
            product = normals * flat[:, None]
            away = (product[..., 0] + product[..., 1]) + product[..., 2] < 0.8
            normals = np.where(away[..., None], flat[:, None], normals)
        self._set_mesh(self.first_mesh + 2 * number, positions, corners, normals, uvs)
        self._upload_hull(number, positions)

    def _set_mesh(self, number: int, positions, corners, normals, uvs) -> None:
        edges = np.full(len(corners), 0b111, np.uint8)
        self.native.set_shape(
            number,
            positions,
            np.ascontiguousarray(corners),
            np.ascontiguousarray(normals),
            uvs,
            edges,
        )

    def _upload_hull(self, number: int, positions: np.ndarray) -> None:
        model = self._model
        begin = int(model.mesh_graphadr[number])
        if begin < 0:
            return
        vertices, faces = int(model.mesh_graph[begin]), int(model.mesh_graph[begin + 1])
        first = begin + 2 + 3 * vertices + 3 * faces
        corners = np.array(model.mesh_graph[first : first + 3 * faces], np.int32).reshape(-1, 3)
        normals = np.repeat(_face_normals(positions[corners])[:, None], 3, axis=1)
        uvs = None
        if model.mesh_texcoordadr[number] >= 0:
            where = np.minimum(
                corners + model.mesh_texcoordadr[number], len(model.mesh_texcoord) - 1
            )
            uvs = np.array(model.mesh_texcoord[where], np.float32)
        self._set_mesh(self.first_mesh + 2 * number + 1, positions, corners, normals, uvs)

    # ---- height fields ----

    def upload_hfield(self, number: int) -> None:
        """Read a height field again."""
        model = self._model
        rows, columns = int(model.hfield_nrow[number]), int(model.hfield_ncol[number])
        begin = int(model.hfield_adr[number])
        size = np.array(model.hfield_size[number], np.float32).astype(np.float64)
        heights = model.hfield_data[begin : begin + rows * columns].reshape(rows, columns) * size[2]
        quads = max(int(model.vis.quality.numquads), 1)
        x = size[0] * (np.arange(columns) / (0.5 * (columns - 1)) - 1)
        y = size[1] * (np.arange(rows) / (0.5 * (rows - 1)) - 1)
        parts = [_terrain(x, y, heights), *_walls(x, y, heights, -size[3])]
        parts.append(_floor(size, quads))
        self._set_shape(self.first_hfield + number, _unit_shapes.join(parts))

    # ---- skins ----

    def _skin_faces(self, number: int) -> tuple[np.ndarray, np.ndarray | None]:
        """Return a skin's corners, and its coordinates of textures."""
        model = self._model
        begin = int(model.skin_faceadr[number])
        faces = np.array(model.skin_face[begin : begin + model.skin_facenum[number]], np.int32)
        first = int(model.skin_texcoordadr[number])
        if first < 0:
            return faces, None
        uvs = np.array(model.skin_texcoord[first : first + model.skin_vertnum[number]], np.float32)
        return faces, np.ascontiguousarray(uvs[faces])

    # ---- flexes ----

    def flex_part(self, flex: int, material: int) -> int:
        """Return the number of what has one material of a flex, among those of all; -1 if none."""
        material = max(material, 0)  # -1: the flex has one alone
        if not 0 <= flex < len(self._flex_parts) - 1:
            return -1
        part = int(self._flex_parts[flex]) + material
        return part if part < self._flex_parts[flex + 1] else -1

    # ---- textures ----

    def upload_texture(self, number: int) -> None:
        """Read a texture again."""
        model = self._model
        height, width = int(model.tex_height[number]), int(model.tex_width[number])
        channels, begin = int(model.tex_nchannel[number]), int(model.tex_adr[number])
        is_2d = int(model.tex_type[number]) == _TEXTURE_2D
        if channels not in (3, 4):
            warn(f"texture {number} has {channels} channels: only 3 or 4 are drawn")
            return
        srgb = (
            is_2d and int(getattr(model, "tex_colorspace", np.zeros(model.ntex))[number]) == _SRGB
        )
        if is_2d:
            data = model.tex_data[begin : begin + height * width * channels]
            texels = data.reshape(1, height, width, channels)
        else:  # cubes are read as rows of three channels, whatever they have
            faces = 1 if width == height else 6
            data = model.tex_data[begin : begin + faces * width * width * 3]
            texels = np.broadcast_to(data.reshape(faces, width, width, 3), (6, width, width, 3))
        full = np.full((*texels.shape[:3], 4), 255, np.uint8)
        full[..., : texels.shape[3]] = texels
        self.native.set_texture(number, _levels(full, srgb), _meaning(srgb) if srgb else None)

    def _set_material_textures(self) -> None:
        """Keep what materials say of textures, as it was when the context was made."""
        model = self._model
        ids = np.array(model.mat_texid, np.int32).reshape(model.nmat, -1) if model.nmat else None
        # The second role is the colour's; before roles there was one texture
        self.texids = np.zeros(0, np.int32) if ids is None else ids[:, min(1, ids.shape[1] - 1)]
        self.texuniforms = np.array(model.mat_texuniform, np.int32)
        self.texrepeats = np.array(model.mat_texrepeat, np.float32).reshape(-1, 2)


def _flex_parts(model: Any) -> np.ndarray:
    """Return where the parts of each flex begin, and how many there are: a part has one material.

    What the faces' materials are may change from picture to picture, so that this is the most.
    """
    counts = [max(min(int(count), model.nmat + 1), 1) for count in model.flex_elemnum]
    return np.concatenate([[0], np.cumsum(counts, dtype=np.int64)])


def _face_normals(at: np.ndarray) -> np.ndarray:
    """Return the normals of triangles, (T, 3, 3) float32 to (T, 3)."""
    a, b = at[:, 1] - at[:, 0], at[:, 2] - at[:, 0]
    normal = np.stack(
        [
            a[:, (k + 1) % 3] * b[:, (k + 2) % 3] - a[:, (k + 2) % 3] * b[:, (k + 1) % 3]
            for k in range(3)
        ],
        axis=1,
    )
    length = np.sqrt((normal[:, 0] ** 2 + normal[:, 1] ** 2) + normal[:, 2] ** 2)
    return normal / np.maximum(length, np.float32(1e-10))[:, None]


def _terrain(x: np.ndarray, y: np.ndarray, heights: np.ndarray) -> Triangles:
    """Return the upper side: strips along the rows, flat triangles."""
    at = np.stack([*np.broadcast_arrays(x[None, :], y[:, None]), heights], axis=-1)
    near, far = at[:-1], at[1:]
    first = np.stack([far[:, :-1], near[:, :-1], far[:, 1:]], axis=2)
    second = np.stack([near[:, :-1], near[:, 1:], far[:, 1:]], axis=2)
    corners = np.stack([first, second], axis=2).reshape(-1, 3, 3)
    normals = np.repeat(_face_normals(corners)[:, None], 3, axis=1)
    return Triangles(
        corners, normals, np.zeros((len(corners), 3, 2)), np.full(len(corners), 0b111, np.uint8)
    )


def _walls(x: np.ndarray, y: np.ndarray, heights: np.ndarray, base: float) -> list[Triangles]:
    parts = []
    for axis, sign, line, along, top in (
        (0, -1, x[0], y[::-1], heights[::-1, 0]),
        (0, 1, x[-1], y, heights[:, -1]),
        (1, -1, y[0], x, heights[0]),
        (1, 1, y[-1], x[::-1], heights[-1, ::-1]),
    ):
        low, high = (np.zeros((len(along), 3)) for _ in range(2))
        for side, z in ((low, base), (high, top)):
            side[:, axis], side[:, 1 - axis], side[:, 2] = line, along, z
        quads = np.stack([low[:-1], low[1:], high[1:], high[:-1]], axis=1)
        normals = np.zeros_like(quads)
        normals[..., axis] = sign
        parts.append(_unit_shapes.of_quads(quads, normals, np.zeros((len(quads), 4, 2))))
    return parts


def _floor(size: np.ndarray, quads: int) -> Triangles:
    at = np.arange(quads + 1) / (0.5 * quads) - 1
    grid = np.stack(
        [
            *np.meshgrid(size[0] * at, size[1] * at, indexing="ij"),
            np.full((quads + 1,) * 2, -size[3]),
        ],
        -1,
    )
    corners = np.stack([grid[:-1, :-1], grid[:-1, 1:], grid[1:, 1:], grid[1:, :-1]], axis=2)
    corners = corners.reshape(-1, 4, 3)
    normals = np.zeros_like(corners)
    normals[..., 2] = -1
    return _unit_shapes.of_quads(corners, normals, np.zeros((len(corners), 4, 2)))
