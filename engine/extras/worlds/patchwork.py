"""Collects geometry piece by piece: thousands of quads, and repeated small shapes.

In: corners of quads (N, 4, 3) float64, counter-clockwise from their front, each with a material;
templates with the places where they stand. Out: one `Mesh`, flat where quads are. All arithmetic is
float64, element by element, and is rounded once to float32, so that the bytes are the same
everywhere.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..._native.loaders import frozen
from ...base import linalg
from ...model.geometry.mesh import Mesh
from ...model.materials.material import Material
from ...model.primitives.faces import split_quads
from .surfaces import FITTED, TEXTURE_METRES

_UNIT_SQUARE = np.array([(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)])


@dataclass(frozen=True)
class Template:
    """A small shape that is placed many times.

    Attributes
    ----------
    positions, normals : (V, 3) float64
    uvs : (V, 2) float64
    faces : (F, 3) int32
    edge_visible : (F, 3) bool
    material_ids : (F,) int32
    """

    positions: np.ndarray
    normals: np.ndarray
    uvs: np.ndarray
    faces: np.ndarray
    edge_visible: np.ndarray
    material_ids: np.ndarray


class Patchwork:
    """Collects quads and templates; `template` and `mesh` return all of them.

    Parameters
    ----------
    tolerance : float
        Metres: details up to this size may be omitted or moved.
    """

    def __init__(self, tolerance: float = 0.0) -> None:
        self.tolerance = tolerance
        self._corners: list[np.ndarray] = []
        self._materials: list[np.ndarray] = []
        self._parts: list[Template] = []

    def add(self, corners: np.ndarray, material: int | np.ndarray) -> None:
        """Add quads: corners (N, 4, 3), and a material number for all, for each or for each box."""
        if len(corners):
            given = np.atleast_1d(np.int32(material))
            self._corners.append(corners)
            self._materials.append(np.tile(given, len(corners) // len(given)))

    def place(self, template: Template, places: np.ndarray) -> None:
        """Place a template at places (N, 6): x, y, z, scale, and the cosine and sine of a rotation.

        The rotation is about +Y, from +Z towards +X.
        """
        if not len(places):
            return
        x, y, z, scale, cosine, sine = (places[:, k : k + 1] for k in range(6))
        moved = _turned(template.positions, cosine * scale, sine * scale)
        moved[..., 1] = template.positions[:, 1] * scale
        moved += np.stack((x, y, z), axis=-1)
        normals = _turned(template.normals, cosine, sine)
        count, vertices = len(places), len(template.positions)
        starts = np.arange(count, dtype=np.int32)[:, np.newaxis, np.newaxis] * np.int32(vertices)
        self._parts.append(
            Template(
                moved.reshape(-1, 3),
                normals.reshape(-1, 3),
                np.tile(template.uvs, (count, 1)),
                (template.faces + starts).reshape(-1, 3),
                np.tile(template.edge_visible, (count, 1)),
                np.tile(template.material_ids, count),
            )
        )

    @property
    def triangles(self) -> int:
        """Number of triangles so far."""
        quads = sum(len(corners) for corners in self._corners)
        return 2 * quads + sum(len(part.faces) for part in self._parts)

    def template(self) -> Template:
        """Return everything as one template."""
        parts = [*self._quads(), *self._parts]
        starts = np.cumsum([0, *(len(part.positions) for part in parts)])
        return Template(
            np.concatenate([part.positions for part in parts]),
            np.concatenate([part.normals for part in parts]),
            np.concatenate([part.uvs for part in parts]),
            np.concatenate(
                [part.faces + np.int32(k) for part, k in zip(parts, starts[:-1], strict=True)]
            ),
            np.concatenate([part.edge_visible for part in parts]),
            np.concatenate([part.material_ids for part in parts]),
        )

    def mesh(self, name: str, materials: list[Material]) -> Mesh:
        """Return everything as a mesh; ``materials`` are those of `surfaces`."""
        whole = self.template()
        return Mesh(
            _single(whole.positions),
            _kept(whole.faces),
            normals=_single(whole.normals),
            uvs=_single(whole.uvs),
            materials=materials,
            material_ids=_kept(whole.material_ids),
            edge_visible=_kept(whole.edge_visible),
            name=name,
        )

    def _quads(self) -> list[Template]:
        if not self._corners:
            return []
        corners = np.concatenate(self._corners)
        material = np.concatenate(self._materials)
        normals = _normals(corners)
        numbers = np.arange(4 * len(corners), dtype=np.int32).reshape(-1, 4)
        faces, edge_visible = split_quads(numbers)
        return [
            Template(
                corners.reshape(-1, 3),
                np.repeat(normals, 4, axis=0),
                _uvs(corners, normals, material).reshape(-1, 2),
                faces,
                edge_visible,
                np.repeat(material, 2),
            )
        ]


def _normals(corners: np.ndarray) -> np.ndarray:
    """Return unit normals from the diagonals; adding zero turns -0 into 0."""
    diagonals = corners[:, 2] - corners[:, 0], corners[:, 3] - corners[:, 1]
    return linalg.normalize(linalg.cross(*diagonals)) + 0.0


def _uvs(corners: np.ndarray, normals: np.ndarray, material: np.ndarray) -> np.ndarray:
    """Return texture coordinates: world coordinates at each texture's size, or the whole image.

    Level quads are seen from above with -Z at the top; upright ones are seen upright.
    """
    across, along = np.abs(normals[:, 0]), np.abs(normals[:, 2])
    flat = np.abs(normals[:, 1]) > np.maximum(across, along)
    aside = (across > along) & ~flat
    x, y, z = (corners[..., axis] for axis in range(3))
    u = np.where(aside[:, np.newaxis], z, x)
    v = np.where(flat[:, np.newaxis], -z, y)
    metres = TEXTURE_METRES[material][:, np.newaxis]
    uvs = np.stack((u / metres, v / metres), axis=-1)
    fitted = FITTED[material]
    uvs[fitted] = _UNIT_SQUARE
    return uvs


def _turned(vectors: np.ndarray, cosine: np.ndarray, sine: np.ndarray) -> np.ndarray:
    """Return vectors (V, 3) rotated about +Y by N angles (N, 1): (N, V, 3)."""
    x, y, z = vectors.T
    turned = np.empty((len(cosine), len(vectors), 3))
    turned[..., 0] = x * cosine + z * sine
    turned[..., 1] = y
    turned[..., 2] = z * cosine - x * sine
    return turned


def _single(array: np.ndarray) -> np.ndarray:
    return _kept(array.astype(np.float32))


def _kept(array: np.ndarray) -> np.ndarray:
    """Make an array read-only, so that `Mesh` keeps it without copying."""
    return frozen(array)
