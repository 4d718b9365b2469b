"""Meshes: lists of primitives, made of trimesh's geometry or of points."""

from __future__ import annotations

import copy

import numpy as np
from numpy.typing import NDArray

from ._bounded import Bounded
from ._held import Named
from .constants import GLTF
from .material import Material, MetallicRoughnessMaterial
from .primitive import Primitive


class Mesh(Bounded, Named):
    """A mesh that a node shows: a list of primitives.

    Parameters
    ----------
    primitives : list of Primitive
    name : str, optional
    weights : array, optional
        Kept, not read.
    is_visible : bool
    """

    def __init__(self, primitives, name=None, weights=None, is_visible=True):
        self.primitives = primitives
        self.name = name
        self.weights = weights
        self.is_visible = is_visible

    @property
    def bounds(self) -> NDArray:
        """Lowest and highest corner, (2, 3); infinite if the mesh is empty."""
        bounds = np.array([[np.inf] * 3, [-np.inf] * 3])
        for primitive in self.primitives:
            bounds[0] = np.minimum(bounds[0], primitive.bounds[0])
            bounds[1] = np.maximum(bounds[1], primitive.bounds[1])
        return bounds

    @property
    def is_transparent(self) -> bool:
        """Whether any primitive is transparent."""
        return any(primitive.is_transparent for primitive in self.primitives)

    @staticmethod
    def from_points(points, colors=None, normals=None, is_visible=True, poses=None) -> Mesh:
        """Return a mesh of points.

        Parameters
        ----------
        points : (N, 3) float
        colors : (N, 3) or (N, 4), optional
        normals : (N, 3) float, optional
        is_visible : bool
        poses : (K, 4, 4) float, optional
        """
        primitive = Primitive(
            points, normals=normals, color_0=colors, mode=GLTF.POINTS, poses=poses
        )
        return Mesh([primitive], is_visible=is_visible)

    @staticmethod
    def from_trimesh(
        mesh, material=None, is_visible=True, poses=None, wireframe=False, smooth=True
    ) -> Mesh:
        """Return a mesh converted from one or several trimesh meshes.

        Parameters
        ----------
        mesh : trimesh.Trimesh, or a list of these
        material : Material, optional
            Instead of what the mesh says; copied.
        is_visible : bool
        poses : (K, 4, 4) float, optional
        wireframe : bool
        smooth : bool
            Normals of vertices, or of faces.

        Raises
        ------
        TypeError
            It is something else, such as a trimesh.Scene.
        ValueError
            The mesh has colours of faces, and ``smooth`` is true.
        """
        if isinstance(mesh, list | tuple | set | np.ndarray):
            meshes = list(mesh)
        elif _is_trimesh(mesh):
            meshes = [mesh]
        else:
            raise TypeError(f"Expected a Trimesh or a list, got a {type(mesh)}")
        primitives = [_primitive(one, material, poses, wireframe, smooth) for one in meshes]
        return Mesh(primitives, is_visible=is_visible)


def _is_trimesh(thing) -> bool:
    return all(hasattr(thing, name) for name in ("vertices", "faces", "face_normals", "visual"))


def _primitive(mesh, material, poses, wireframe, smooth) -> Primitive:
    faces = np.asarray(mesh.faces)
    colors, uvs, own = _look_of(mesh, smooth, material)
    if own is None:
        own = _default_material(0.3)
    own.wireframe = bool(wireframe)
    arrays = {"texcoord_0": uvs, "color_0": colors, "material": own, "poses": poses}
    if smooth:
        positions, normals = np.array(mesh.vertices), np.array(mesh.vertex_normals)
        return Primitive(positions, normals=normals, indices=faces.copy(), **arrays)
    positions = np.asarray(mesh.vertices)[faces].reshape(-1, 3)
    return Primitive(positions, normals=np.repeat(mesh.face_normals, 3, axis=0), **arrays)


def _default_material(shade: float) -> MetallicRoughnessMaterial:
    return MetallicRoughnessMaterial(
        alphaMode="BLEND",
        baseColorFactor=[shade, shade, shade, 1.0],
        metallicFactor=0.2,
        roughnessFactor=0.8,
    )


def _look_of(mesh, smooth: bool, material: Material | None):
    """Return colours and texture coordinates of vertices, and the material; None if missing."""
    visual = mesh.visual
    given = None if material is None else copy.deepcopy(material)
    if not visual.defined:
        return None, None, given
    faces = np.asarray(mesh.faces)
    if visual.kind == "texture":
        uvs = None
        if visual.uv is not None and len(visual.uv):
            uvs = np.array(visual.uv)
            uvs = uvs if smooth else uvs[faces].reshape(-1, uvs.shape[1])
        return None, uvs, _material_of(visual.material) if given is None else given
    if given is not None:
        return None, None, given
    if visual.kind == "face":
        if smooth:
            raise ValueError("Cannot use face colors with a smooth mesh")
        return np.repeat(visual.face_colors, 3, axis=0), None, _default_material(1.0)
    if visual.kind == "vertex":
        colors = np.array(visual.vertex_colors)
        colors = colors if smooth else colors[faces].reshape(-1, colors.shape[1])
        return colors, None, _default_material(1.0)
    return None, None, None


def _material_of(material) -> MetallicRoughnessMaterial | None:
    """Return the material for a trimesh one; None for unknown kinds."""
    if isinstance(material, MetallicRoughnessMaterial):
        return material
    if hasattr(material, "baseColorFactor"):
        same = ("normalTexture", "occlusionTexture", "emissiveTexture", "emissiveFactor")
        same += ("baseColorFactor", "baseColorTexture", "metallicFactor", "roughnessFactor")
        same += ("metallicRoughnessTexture", "alphaCutoff")
        values = {name: getattr(material, name) for name in same}
        sides = bool(getattr(material, "doubleSided", False))
        return MetallicRoughnessMaterial(alphaMode="BLEND", doubleSided=sides, **values)
    if hasattr(material, "diffuse"):
        shininess = material.kwargs.get("Ns", 1.0)
        shininess = float(shininess[0]) if isinstance(shininess, list) else shininess
        return MetallicRoughnessMaterial(
            alphaMode="BLEND",
            roughnessFactor=(2.0 / (shininess + 2.0)) ** 0.25,
            baseColorFactor=material.diffuse,
            baseColorTexture=material.image,
        )
    return None


__all__ = ["Mesh"]
