"""Nodes: poses in a scene, with their objects."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ._held import Named, held
from ._rotations import matrix_of, quaternion_of
from .camera import Camera
from .light import Light
from .mesh import Mesh


def _holds(name: str, kind: type, what: str) -> property:
    """Return a property that holds an object of a type, or None."""

    def made(value):
        if value is not None and not isinstance(value, kind):
            raise TypeError(f"Value must be a {what}")
        return value

    return held(name, made, f"The {what}, or None.")


def _three(name: str, doc: str) -> property:
    """Return a property that holds three numbers, a part of the matrix."""

    def made(value) -> NDArray:
        vector = np.asarray(value)
        if vector.shape != (3,):
            raise ValueError(f"{name.capitalize()} must be a (3,) vector")
        return vector

    return held(name, made, doc, _forget_matrix)


def _forget_matrix(node: Node) -> None:
    node._matrix = None


class Node(Named):
    """A pose with a mesh, a camera or a light.

    Parameters
    ----------
    name : str, optional
    camera : Camera, optional
    children : list of Node, optional
    skin, weights
        Kept, not read.
    matrix : (4, 4) float, optional
        parent-from-node; or the parts instead:
    mesh : Mesh, optional
    rotation : (4,) float, optional
        Unit quaternion x, y, z, w.
    scale, translation : (3,) float, optional
    light : Light, optional
    """

    def __init__(
        self,
        name=None,
        camera=None,
        children=None,
        skin=None,
        matrix=None,
        mesh=None,
        rotation=None,
        scale=None,
        translation=None,
        weights=None,
        light=None,
    ):
        if matrix is None:
            self.rotation = np.array([0.0, 0.0, 0.0, 1.0]) if rotation is None else rotation
            self.translation = np.zeros(3) if translation is None else translation
            self.scale = np.ones(3) if scale is None else scale
        else:
            self.matrix = matrix
        self.name = name
        self.camera = camera
        self.children = [] if children is None else children
        self.skin, self.weights = skin, weights
        self.mesh = mesh
        self.light = light

    camera = _holds("camera", Camera, "camera")
    mesh = _holds("mesh", Mesh, "mesh")
    light = _holds("light", Light, "light")
    translation = _three("translation", "Where it is in its parent, (3,).")
    scale = _three("scale", "Factors along x, y and z, (3,).")

    @property
    def rotation(self) -> NDArray:
        """Quaternion x, y, z, w, (4,)."""
        return self._rotation

    @rotation.setter
    def rotation(self, value) -> None:
        quaternion = np.asarray(value)
        if quaternion.shape != (4,):
            raise ValueError("Quaternion must be a (4,) vector")
        if abs(np.linalg.norm(quaternion) - 1.0) > 1e-3:
            raise ValueError("Quaternion must have norm == 1.0")
        self._rotation, self._matrix = quaternion, None

    @property
    def matrix(self) -> NDArray:
        """parent-from-node, (4, 4), a copy."""
        return self._parent_from_node().copy()

    @matrix.setter
    def matrix(self, value) -> None:
        pose = np.asarray(value)
        if pose.shape != (4, 4):
            raise ValueError("Matrix must be a 4x4 numpy ndarray")
        if not np.allclose(pose[3], (0.0, 0.0, 0.0, 1.0)):
            raise ValueError("Bottom row of matrix must be [0,0,0,1]")
        lengths = np.linalg.norm(pose[:3, :3], axis=0)
        with np.errstate(all="ignore"):
            self._rotation = quaternion_of(pose[:3, :3] / lengths)
        self._scale, self._translation = lengths, pose[:3, 3]
        self._matrix = pose

    def _parent_from_node(self) -> NDArray:
        """Return the matrix itself, which must not be written to."""
        if self._matrix is None:
            pose = np.eye(4)
            pose[:3, :3] = matrix_of(self._rotation) * self._scale
            pose[:3, 3] = self._translation
            self._matrix = pose
        return self._matrix


__all__ = ["Node"]
