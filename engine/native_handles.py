"""The core's side of meshes and textures, made when a picture first needs it and kept.

In: `Mesh` and `Texture`. Out: their native handles, one for each version of the object (and each
way to decode a texture), forgotten with the object. The arrays that only some pictures need
(normals, edges) are added to a mesh's handle when one does.
"""

from __future__ import annotations

import operator
from typing import NamedTuple
from weakref import WeakKeyDictionary

import numpy as np

from ._native.rasterizer import FILTERS, WRAPS, NativeMesh, NativeTexture
from .mesh import Mesh
from .textures import Texture


class MeshNeeds(NamedTuple):
    """Which of a mesh's derived arrays a picture reads."""

    vertex_normals: bool = False
    face_normals: bool = False
    edges: bool = False


_meshes: WeakKeyDictionary[Mesh, tuple[int, list, NativeMesh]] = WeakKeyDictionary()
_textures: WeakKeyDictionary[Texture, tuple[int, dict[bool, NativeTexture]]] = WeakKeyDictionary()


def native_mesh(mesh: Mesh, needs: MeshNeeds, threads: int) -> NativeMesh:
    """Return the handle of a mesh as it is now, with what is needed; 0 threads are all."""
    version, made_of, native = _meshes.get(mesh, (None, [], None))
    if version != mesh.version:
        arrays = list(mesh._arrays.values())
        if native is None or not all(map(operator.is_, arrays, made_of)):
            native = _make_mesh(mesh, threads)  # else only materials are others
        _meshes[mesh] = (mesh.version, arrays, native)
    if needs.vertex_normals and not native.has_normals:
        native.set_normals(mesh.normals)
    if needs.face_normals and not native.has_face_normals:
        native.set_face_normals(mesh.face_normals)
    if needs.edges and not native.has_edges:
        native.set_edges(mesh.edges())
    return native


def _make_mesh(mesh: Mesh, threads: int) -> NativeMesh:
    colors = mesh.colors
    eight_bit = colors is not None and colors.dtype == np.uint8
    return NativeMesh(
        mesh.positions,
        mesh.faces,
        uvs=mesh.uvs,
        colors_u8=colors if eight_bit else None,
        colors_f32=None if eight_bit else colors,
        material_ids=mesh.material_ids,
        lines=mesh.lines,
        points=mesh.points,
        threads=threads,
    )


def native_texture(texture: Texture, color_space: str) -> NativeTexture:
    """Return the handle of a texture as it is now, for renderers of one colour space."""
    decode = color_space == "srgb" and texture.color_space == "srgb"
    version, natives = _textures.get(texture, (None, None))
    if version != texture.version:
        version, natives = texture.version, {}
        _textures[texture] = (version, natives)
    native = natives.get(decode)
    if native is None:
        native = NativeTexture(texture.pixels, decode, FILTERS[texture.filter], WRAPS[texture.wrap])
        natives[decode] = native
    return native
