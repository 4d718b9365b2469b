"""Primitives: vertices, their topology, and a material."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ._bounded import Bounded
from ._held import held, optional
from .constants import GLTF, BufFlags
from .material import Material, MetallicRoughnessMaterial
from .utils import format_color_array

#: Vertex attributes: name, columns, and the name in errors.
_ATTRIBUTES = {
    "normals": (3, "Incorrect normals shape"),
    "tangents": (4, "Incorrect tangent shape"),
    "texcoord_0": (2, "Incorrect texture coordinate shape"),
    "texcoord_1": (2, "Incorrect texture coordinate shape"),
}
_FLAGS = {
    "normals": BufFlags.NORMAL,
    "tangents": BufFlags.TANGENT,
    "texcoord_0": BufFlags.TEXCOORD_0,
    "texcoord_1": BufFlags.TEXCOORD_1,
    "color_0": BufFlags.COLOR_0,
    "joints_0": BufFlags.JOINTS_0,
    "weights_0": BufFlags.WEIGHTS_0,
}


def _rows(name: str, doc: str) -> property:
    """Return a property that holds a row for each vertex, float32, or None."""
    hidden = f"_{name}"
    columns, complaint = _ATTRIBUTES[name]
    may_have_more = name == "texcoord_0"

    def put(self, value) -> None:
        if value is not None:
            value = np.asarray(value, np.float32)
            fits = value.ndim == 2 and len(value) == len(self.positions)
            enough = fits and (value.shape[1] >= columns if may_have_more else True)
            if not enough or (value.shape[1] != columns and not may_have_more):
                raise ValueError(complaint)
            value = np.ascontiguousarray(value[:, :columns])
        setattr(self, hidden, value)
        self._forget()

    return property(lambda self: getattr(self, hidden), put, doc=doc)


def _drawn_from(name: str, made, doc: str) -> property:
    """Return a converting property whose values drawing caches data of."""
    return held(name, made, doc, lambda primitive: primitive._forget())


def _checked_mode(value) -> int:
    number = int(value)
    if not GLTF.POINTS <= number <= GLTF.TRIANGLE_FAN:
        raise ValueError("Invalid mode")
    return number


def _checked_poses(value) -> NDArray[np.float32]:
    poses = np.ascontiguousarray(value, np.float32)
    poses = poses[np.newaxis] if poses.ndim == 2 else poses
    if poses.shape[1:] != (4, 4):
        raise ValueError(f"Pose matrices must be of shape (n,4,4), got {poses.shape}")
    return poses


def _checked_material(value) -> Material:
    if value is not None and not isinstance(value, Material):
        raise TypeError("Object material must be of type Material")
    return MetallicRoughnessMaterial() if value is None else value


class Primitive(Bounded):
    """Triangles, lines or points of one material.

    Parameters
    ----------
    positions : (N, 3) float
    normals : (N, 3) float, optional
        Without any, a surface is lit as if it looked towards the camera.
    tangents : (N, 4) float, optional
        Kept, not read, as in pyrender.
    texcoord_0, texcoord_1 : (N, 2) float, optional
        Origin at the bottom left; all textures are read at the first.
    color_0 : (N, 3) or (N, 4) float or int, optional
        Multiplies what light has made of the surface.
    joints_0, weights_0, targets
        Kept, not read.
    indices : (M, 3), (M, 2) or (M,) int, optional
    material : Material, optional
    mode : int
        A mode of `GLTF`: POINTS, LINES, LINE_LOOP, LINE_STRIP, TRIANGLES, TRIANGLE_STRIP or
        TRIANGLE_FAN.
    poses : (K, 4, 4) float, optional
        Where instances of it are, in the mesh's space.
    """

    def __init__(
        self,
        positions,
        normals=None,
        tangents=None,
        texcoord_0=None,
        texcoord_1=None,
        color_0=None,
        joints_0=None,
        weights_0=None,
        indices=None,
        material=None,
        mode=None,
        targets=None,
        poses=None,
    ):
        self.positions = positions
        self.normals = normals
        self.tangents = tangents
        self.texcoord_0, self.texcoord_1 = texcoord_0, texcoord_1
        self.color_0 = color_0
        self.joints_0, self.weights_0 = joints_0, weights_0
        self.indices = indices
        self.material = material
        self.mode = GLTF.TRIANGLES if mode is None else mode
        self.targets = targets
        self.poses = poses

    positions = _drawn_from(
        "positions", lambda value: np.ascontiguousarray(value, np.float32), "(N, 3) float32."
    )
    indices = _drawn_from(
        "indices",
        optional(lambda value: np.ascontiguousarray(value).astype(np.int32)),
        "Whole numbers, as they were shaped, or None.",
    )
    mode = _drawn_from("mode", _checked_mode, "A mode of `GLTF`.")
    poses = _drawn_from("poses", optional(_checked_poses), "(K, 4, 4) float32, or None.")
    normals = _rows("normals", "(N, 3) float32, or None.")
    tangents = _rows("tangents", "(N, 4) float32, or None.")
    texcoord_0 = _rows("texcoord_0", "(N, 2) float32, or None.")
    texcoord_1 = _rows("texcoord_1", "(N, 2) float32, or None.")

    def _forget(self) -> None:
        """Forget cached drawing data of the arrays."""
        self._bounds = None
        self._drawn: dict = {}

    @property
    def color_0(self) -> NDArray[np.float32] | None:
        """(N, 4) float32, or None."""
        return self._color_0

    @color_0.setter
    def color_0(self, value) -> None:
        if value is not None:
            value = format_color_array(value, (len(self.positions), 4))
        self._color_0 = value
        self._has_alpha = value is not None and bool(np.any(value[:, 3] != 1.0))
        self._forget()

    material = held("material", _checked_material, "What it is made of.")

    @property
    def bounds(self) -> NDArray:
        """Lowest and highest corner, (2, 3); for instances, only their positions count."""
        if self._bounds is None:
            bounds = np.array([self.positions.min(axis=0), self.positions.max(axis=0)])
            if self.poses is not None:
                places = self.poses[:, :3, 3]
                bounds = bounds + np.array([places.min(axis=0), places.max(axis=0)])
            self._bounds = bounds
        return self._bounds

    @property
    def buf_flags(self) -> int:
        """Flags of the vertex attributes, as `BufFlags`."""
        return sum(flag for name, flag in _FLAGS.items() if getattr(self, name) is not None)

    @property
    def is_transparent(self) -> bool:
        """Whether it is drawn after opaque primitives."""
        return self.material.is_transparent or self._has_alpha

    def delete(self) -> None:
        """Free the cached drawing data of the primitive."""
        self._forget()

    def __getstate__(self) -> dict:
        return {**self.__dict__, "_drawn": {}}


__all__ = ["Primitive"]
