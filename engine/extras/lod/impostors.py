"""Impostors: flat cards that show a mesh as seen from many directions.

In: a mesh. Out: for each of some directions all around it a card, cut out along the mesh's outline,
with its surface colours from an atlas and its normals at the corners, so that a card is lit as the
mesh is. The engine draws the pictures itself. A card is a normal mesh, in the space of the mesh it
replaces: it needs no transparency, and has depths, IDs and lighting.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from ..._native.loaders import frozen
from ...base import linalg
from ...base.linalg.vectors import as_vectors
from ...base.numbers import as_array
from ...base.validation import Closed
from ...errors import InvalidArgumentError
from ...model.geometry.mesh import Mesh
from ...model.materials.colors import srgb_bytes
from ...model.materials.material import Material
from ...model.materials.textures import Texture
from ...model.scene.cameras import OrthographicCamera
from ...model.scene.scene import Scene
from ...rendering.frame import Output
from ...rendering.renderer import Renderer

_CELLS = 4  # per side of a card: their corners hold normals
_PIXELS = 4  # per side of a texel
_BORDER = 1  # texels around a picture, for the filter
_OVERLAP = 1 / 32  # texels by which adjacent rectangles overlap, to close gaps
_SEARCH = 96  # directions per side of the octahedral map that are searched for the worst one


class Impostor(Closed):
    """A picture that replaces a mesh that is small on the screen.

    Parameters
    ----------
    mesh : Mesh
        Faces; lines and points are left out.
    views : int
        Directions along each side of an octahedral map: there are its square, from 2 to 16.
    texels : int
        Along each side of a picture, a multiple of 4 from 8 to 128.

    Attributes
    ----------
    cards : tuple of Mesh
        One a direction, in the space of the mesh. Empty where nothing shows from there.
    directions : (V, 3) float64
        From the mesh to who looks at it.
    texture : Texture
        The atlas: a picture a direction, row by row.
    error : float
        The largest apparent displacement of a point of the mesh, in its units: due to flatness, to
        directions between two pictures, and to the texel size.

    Raises
    ------
    InvalidArgumentError
    """

    directions: NDArray[np.float64]
    texture: Texture
    cards: tuple[Mesh, ...]
    error: float

    def __init__(self, mesh: Mesh, *, views: int = 6, texels: int = 16) -> None:
        if not isinstance(mesh, Mesh):
            raise InvalidArgumentError(f"mesh must be a Mesh, not {type(mesh).__name__}")
        if not (isinstance(views, int) and 2 <= views <= 16):
            raise InvalidArgumentError(f"views must be a whole number from 2 to 16, not {views!r}")
        if not (isinstance(texels, int) and 8 <= texels <= 128 and texels % _CELLS == 0):
            raise InvalidArgumentError(f"texels must be 8, 12, 16 … 128, not {texels!r}")
        if not len(mesh.faces):
            raise InvalidArgumentError("a mesh without faces has no impostor")
        self._views = views
        self._center, self._radius = bounding_ball(mesh)
        self.directions = frozen(octahedral_directions(views))
        pictures = _pictures(mesh, self.directions, self._center, self._radius, texels)
        side = texels + 2 * _BORDER
        atlas = np.zeros((views * side, views * side, 4), np.uint8)
        for number, (color, _, mask) in enumerate(pictures):
            row, column = divmod(number, views)
            block = atlas[row * side : (row + 1) * side, column * side : (column + 1) * side]
            block[...] = _filled(color, mask)
        self.texture = Texture(atlas, filter="bilinear", wrap="clamp", name="impostor")
        materials = [Material(texture=self.texture, name="impostor")]
        self.cards = tuple(
            self._card(number, normals, mask, materials)
            for number, (_, normals, mask) in enumerate(pictures)
        )
        turn = _widest_turn(self.directions)
        self.error = self._radius * (math.sin(turn) + 2.0 / texels)

    def nearest(self, towards: NDArray[np.float64], last: NDArray[np.intp]) -> NDArray[np.intp]:
        """Return the nearest of the impostor's directions for each given one, (N,) int.

        Parameters
        ----------
        towards : (N, 3) float64
            From the mesh to who looks at it; of any length but 0.
        last : (N,) int
            What it was, or -1: it is kept until another one is clearly nearer.
        """
        unit = linalg.normalize(as_vectors("towards", towards))
        last = as_array(last, "last")
        if unit.ndim != 2 or last.shape != unit.shape[:1] or last.dtype.kind not in "iu":
            raise InvalidArgumentError(
                f"last must be ({len(unit)},) whole numbers, not {last.shape} {last.dtype}"
            )
        if not ((last >= -1) & (last < len(self.directions))).all():
            raise InvalidArgumentError(f"last must be in -1..{len(self.directions) - 1}")
        likeness = np.stack([linalg.dot(unit, d) for d in self.directions], axis=1)
        best = likeness.argmax(axis=1)
        rows = np.arange(len(unit))
        keep = (last >= 0) & (likeness[rows, last] > likeness[rows, best] - 0.01)
        return np.where(keep, last, best)

    def _card(
        self, number: int, normals: np.ndarray, mask: np.ndarray, materials: list[Material]
    ) -> Mesh:
        """Return the mesh of one picture."""
        texels = len(mask)
        rectangles = np.array(_rectangles(mask), np.float64).reshape(-1, 4)
        left, top, right, bottom = (rectangles + _OVERLAP * np.array([-1, -1, 1, 1])).T
        x = np.stack([left, left, right, right], axis=1).ravel()
        y = np.stack([top, bottom, bottom, top], axis=1).ravel()
        across, up, _ = _axes(self.directions[number])
        unit = 2.0 * self._radius / texels
        positions = (
            self._center
            + (x * unit - self._radius)[:, np.newaxis] * across
            + (self._radius - y * unit)[:, np.newaxis] * up
        )
        row, column = divmod(number, self._views)
        side, whole = texels + 2 * _BORDER, self._views * (texels + 2 * _BORDER)
        u = (x + (column * side + _BORDER)) / whole
        v = 1.0 - (y + (row * side + _BORDER)) / whole
        corner = np.arange(0, len(x), 4)[:, np.newaxis]
        faces = np.concatenate([corner + (0, 1, 2), corner + (0, 2, 3)], axis=1).reshape(-1, 3)
        return Mesh(
            positions.astype(np.float32),
            faces.astype(np.int32),
            normals=_corner_normals(normals, mask, x, y).astype(np.float32),
            uvs=np.stack([u, v], axis=1).astype(np.float32),
            materials=materials,
            name="impostor",
        )

    def __repr__(self) -> str:
        return f"Impostor({len(self.cards)} cards, error={self.error:.3g})"


def bounding_ball(mesh: Mesh) -> tuple[np.ndarray, float]:
    """Return the centre of a mesh's box, (3,) float64, and the vertices' distance from it."""
    center = (mesh.bounds[0] + mesh.bounds[1]) * 0.5
    lengths = linalg.length(mesh.positions - center)
    return center, float(lengths[np.isfinite(lengths)].max(initial=0.0))


def octahedral_directions(side: int) -> np.ndarray:
    """Return side² unit vectors, from a regular grid on an octahedral map."""
    middle = (2.0 * np.arange(side) + 1.0) / side - 1.0
    y, x = (part.ravel() for part in np.meshgrid(middle, middle, indexing="ij"))
    z = 1.0 - np.abs(x) - np.abs(y)
    folded = np.where(z < 0.0, (1.0 - np.abs(y)) * np.copysign(1.0, x), x)
    y = np.where(z < 0.0, (1.0 - np.abs(x)) * np.copysign(1.0, y), y)
    return linalg.normalize(np.stack([folded, z, y], axis=1))


def _widest_turn(directions: np.ndarray) -> float:
    """Return the largest angle between any direction and the nearest of the given ones."""
    nearest = np.full(_SEARCH * _SEARCH, -1.0)
    tried = octahedral_directions(_SEARCH)
    for direction in directions:
        nearest = np.maximum(nearest, linalg.dot(tried, direction))
    return math.acos(float(nearest.min()))


def _axes(direction: np.ndarray) -> np.ndarray:
    """Return right, up and back of a viewer in a direction, as rows."""
    up = (0.0, 1.0, 0.0) if abs(direction[1]) < 0.99 else (0.0, 0.0, 1.0)
    return linalg.look_at(direction, (0.0, 0.0, 0.0), up)[:3, :3].T


def _pictures(
    mesh: Mesh, directions: np.ndarray, center: np.ndarray, radius: float, texels: int
) -> list[tuple[np.ndarray, np.ndarray, np.ndarray]]:
    """Return, for each direction, colours (N, N, 3) linear, normals (N, N, 3), mask (N, N) bool."""
    scene = Scene()
    scene.add(mesh)
    radius = max(radius, 1e-12)
    camera = OrthographicCamera(radius, znear=0.5 * radius, zfar=3.5 * radius)
    outputs: tuple[Output, ...] = ("albedo", "world_normal", "object_id")
    size = texels * _PIXELS
    pictures = []
    with Renderer((size, size)) as renderer:
        for direction in directions:
            pose = np.eye(4)
            pose[:3, :3] = _axes(direction).T
            pose[:3, 3] = center + direction * (2.0 * radius)
            frame = renderer.render(
                scene, (camera, pose), mode="unlit", cull="back", outputs=outputs
            )
            covered = (frame.object_id >= 0).astype(np.float64)
            count = _summed(covered)
            share = np.where(count > 0, count, 1.0)[..., np.newaxis]
            color = _summed(frame.albedo.astype(np.float64)) / share
            normals = _summed(frame.world_normal.astype(np.float64))
            pictures.append((color, normals, count >= _PIXELS * _PIXELS / 2))
    return pictures


def _summed(pixels: np.ndarray) -> np.ndarray:
    """Return sums over the pixels of each texel, in a fixed order; uncovered pixels count 0."""
    parts = [pixels[y::_PIXELS, x::_PIXELS] for y in range(_PIXELS) for x in range(_PIXELS)]
    return sum(parts[1:], parts[0].copy())


def _filled(color: np.ndarray, mask: np.ndarray) -> np.ndarray:
    """Return a picture as texels with a border; colours at the mask's edge are extended outward."""
    side = len(mask) + 2 * _BORDER
    known = np.zeros((side, side), bool)
    known[_BORDER:-_BORDER, _BORDER:-_BORDER] = mask
    colors = np.zeros((side, side, 3))
    colors[_BORDER:-_BORDER, _BORDER:-_BORDER] = np.where(mask[..., np.newaxis], color, 0.0)
    while known.any() and not known.all():
        total, count = np.zeros_like(colors), np.zeros((side, side))
        for axis, step in ((0, 1), (0, -1), (1, 1), (1, -1)):  # wraps around the edges, harmlessly
            near = np.roll(known, step, axis)
            total += np.where(near[..., np.newaxis], np.roll(colors, step, axis), 0.0)
            count += near
        new = ~known & (count > 0)
        colors[new] = total[new] / count[new][:, np.newaxis]
        known |= new
    opaque = np.ones((side, side, 1))
    rows = np.concatenate([colors, opaque], axis=2).reshape(-1, 4).astype(np.float32)
    return srgb_bytes(rows).reshape(side, side, 4)


def _rectangles(mask: np.ndarray) -> list[tuple[int, int, int, int]]:
    """Return the mask as rectangles (left, top, right, bottom), each within one cell."""
    side = len(mask) // _CELLS
    found = []
    for top in range(0, len(mask), side):
        for left in range(0, len(mask), side):
            found += _in_cell(mask[top : top + side, left : left + side], left, top)
    return found


def _in_cell(mask: np.ndarray, left: int, top: int) -> list[tuple[int, int, int, int]]:
    """Return runs of texels, each extended over equal runs in the rows below."""
    open_runs: dict[tuple[int, int], int] = {}
    found = []
    for row in range(len(mask) + 1):
        edges = [False, *(mask[row].tolist() if row < len(mask) else [False] * len(mask)), False]
        steps = [k for k in range(len(edges) - 1) if edges[k] != edges[k + 1]]
        runs = set(zip(steps[::2], steps[1::2], strict=True))
        for first, end in [run for run in open_runs if run not in runs]:
            start = open_runs.pop((first, end))
            found.append((left + first, top + start, left + end, top + row))
        for run in sorted(runs):
            open_runs.setdefault(run, row)
    return found


def _corner_normals(
    normals: np.ndarray, mask: np.ndarray, x: np.ndarray, y: np.ndarray
) -> np.ndarray:
    """Return the mean normal of the covered texels around each corner, (N, 3)."""
    padded = np.zeros((len(mask) + 2, len(mask) + 2, 3))
    padded[1:-1, 1:-1] = np.where(mask[..., np.newaxis], normals, 0.0)
    at_corners = padded[:-1, :-1] + padded[:-1, 1:] + padded[1:, :-1] + padded[1:, 1:]
    return linalg.normalize(at_corners[np.rint(y).astype(int), np.rint(x).astype(int)])
