"""Joins several meshes into one, in their order.

In: meshes, optionally with poses. Out: one mesh with their arrays concatenated and the indices
shifted. Attributes that only some meshes have are filled in for the others.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

import numpy as np

from ...base.linalg import compose
from ...base.validation import matrix4
from ...errors import InvalidArgumentError
from ..materials.colors import linear_rows
from ..materials.linear_colors import floats_are_linear
from ..materials.material import Material
from .creases import mesh_with_creases
from .groups import put_groups
from .posing import posed_mesh
from .values import joined_values, put_values
from .vertex_attributes import VertexAttribute, attributes_of, vertex_attributes


def placed(mesh_type: type, meshes: list[Any], poses: Any) -> list[Any]:
    """Return meshes with their poses applied; see `Mesh.concatenate`."""
    _check_types(mesh_type, meshes)
    if not isinstance(poses, Iterable):
        raise InvalidArgumentError(f"poses must be several poses, not {poses!r}")
    poses = list(poses)
    if len(poses) != len(meshes):
        raise InvalidArgumentError(f"{len(poses)} poses for {len(meshes)} meshes")
    matrices = [_pose_matrix(pose, number) for number, pose in enumerate(poses)]
    return [posed_mesh(mesh, matrix) for mesh, matrix in zip(meshes, matrices, strict=True)]


def _pose_matrix(pose: Any, number: int) -> np.ndarray:
    """Return a pose as a matrix, from a matrix or from translation, rotation and scale."""
    what = f"poses[{number}]"
    if isinstance(pose, (list, tuple)) and len(pose) == 3:
        pose = compose(*pose)
    matrix = matrix4(pose, what)
    if matrix[3].tolist() != [0.0, 0.0, 0.0, 1.0]:
        raise InvalidArgumentError(f"{what} must be affine: its last row is 0 0 0 1")
    return matrix


def _check_types(mesh_type: type, meshes: list[Any]) -> None:
    for mesh in meshes:
        if not isinstance(mesh, mesh_type):
            raise InvalidArgumentError(f"meshes must be Mesh, not {type(mesh).__name__}")


def concatenate(mesh_type: type, meshes: list[Any], name: str) -> Any:
    """Return a ``mesh_type`` that holds all of ``meshes``; see `Mesh.concatenate`."""
    _check_types(mesh_type, meshes)
    meshes = _alike(meshes)
    if not meshes:
        return mesh_type(np.zeros((0, 3), np.float32), name=name)
    starts = np.cumsum([0] + [len(mesh.positions) for mesh in meshes])[:-1]
    materials, material_ids = _joined_materials(meshes)
    with floats_are_linear():
        joined = mesh_type(
            np.concatenate([mesh.positions for mesh in meshes]),
            _moved(meshes, starts, "faces"),
            normals=_joined_normals(meshes),
            materials=materials,
            material_ids=material_ids,
            lines=_moved(meshes, starts, "lines"),
            points=_moved(meshes, starts, "points"),
            edge_visible=_joined_edge_flags(meshes),
            position_ids=_joined_position_ids(meshes),
            crease_angle=meshes[0].crease_angle,
            name=name,
            **_joined_attributes(meshes),
        )
    put_groups(joined, _joined_groups(meshes))
    put_values(joined, joined_values(meshes))
    joined.warnings = [warning for mesh in meshes for warning in mesh.warnings]
    return joined


def _alike(meshes: list[Any]) -> list[Any]:
    """Return the meshes, with computed normals if one has normals or crease angles differ."""
    angles = {mesh.crease_angle for mesh in meshes}
    if len(angles) <= 1 and not any(mesh.has_normals for mesh in meshes):
        return meshes
    return [mesh_with_creases(mesh) for mesh in meshes]


def _moved(meshes: Any, starts: Any, what: str) -> np.ndarray:
    """Return the index arrays concatenated, each raised by the vertex count before its mesh."""
    parts = zip(meshes, starts, strict=True)
    return np.concatenate([getattr(mesh, what) + np.int32(start) for mesh, start in parts])


def _joined_materials(meshes: Any) -> tuple[list[Material], np.ndarray]:
    materials: list[Material] = []
    number: dict[int, int] = {}
    ids = []
    for mesh in meshes:
        for material in mesh.materials:
            if number.setdefault(id(material), len(materials)) == len(materials):
                materials.append(material)
        own = np.array([number[id(material)] for material in mesh.materials], np.int32)
        ids.append(own[mesh.material_ids])
    return materials, np.concatenate(ids)


def _joined_normals(meshes: Any) -> Any:
    if not any(mesh.has_normals for mesh in meshes):
        return None
    return np.concatenate([mesh.normals for mesh in meshes])


def _joined_attributes(meshes: Any) -> dict[str, np.ndarray]:
    """Return the joined vertex attributes that some of the meshes have."""
    held = [attributes_of(mesh) for mesh in meshes]
    kind: type = type(meshes[0])
    counts = [len(mesh.positions) for mesh in meshes]
    return {
        name: _joined_attribute(attribute, [arrays.get(name) for arrays in held], counts)
        for name, attribute in vertex_attributes(kind).items()
        if any(name in arrays for arrays in held)
    }


def _joined_attribute(
    attribute: VertexAttribute[Any, Any], arrays: list[Any], counts: list[int]
) -> np.ndarray:
    """Return one attribute of all meshes joined; bytes mixed with floats become linear light."""
    given = [array for array in arrays if array is not None]
    if len({array.dtype for array in given}) > 1:
        arrays = [
            linear_rows(array) if array is not None and array.dtype == np.uint8 else array
            for array in arrays
        ]
        given = [array for array in arrays if array is not None]
    return np.concatenate(
        [
            attribute.filler(count, given[0]) if array is None else array
            for array, count in zip(arrays, counts, strict=True)
        ]
    )


def _joined_edge_flags(meshes: Any) -> Any:
    if all(mesh.edge_visible is None for mesh in meshes):
        return None
    return np.concatenate(
        [
            np.ones((len(m.faces), 3), bool) if m.edge_visible is None else m.edge_visible
            for m in meshes
        ]
    )


def _joined_position_ids(meshes: Any) -> Any:
    if all(mesh.position_ids is None for mesh in meshes):
        return None
    parts = []
    start = 0
    for mesh in meshes:
        ids = mesh.position_ids
        ids = np.arange(len(mesh.positions), dtype=np.int32) if ids is None else ids
        parts.append(ids + np.int32(start))
        start += int(ids.max(initial=-1)) + 1
    return np.concatenate(parts)


def _joined_groups(meshes: Any) -> dict[str, np.ndarray]:
    """Return the groups of all meshes; groups with the same name are merged."""
    parts: dict[str, list[np.ndarray]] = {}
    start = 0
    for mesh in meshes:
        for name, faces in mesh.groups.items():
            parts.setdefault(name, []).append(np.asarray(faces, np.int32) + np.int32(start))
        start += len(mesh.faces)
    return {name: np.concatenate(faces) for name, faces in parts.items()}
