"""Native handles of meshes, textures and environments, created on demand and cached.

In: `Mesh`, `Texture`, `Environment`. Out: their native handles, recreated when arrays change (a
texture has one for each way to decode it, and for each to read it), and freed with the object.
Arrays that only some pictures need (normals, edges) are added to a mesh's handle on demand.
"""

from __future__ import annotations

import operator
from typing import Any, Literal, NamedTuple, TypeAlias
from weakref import WeakKeyDictionary

from ..._native.rasterizer import (
    FILTERS,
    WRAPS,
    NativeEnvironment,
    NativeMesh,
    NativeTexture,
)
from ...model.environments.environment import Environment
from ...model.geometry.creases import creased_arrays, has_creases
from ...model.geometry.derived import arrays_of, derived
from ...model.geometry.mesh import Mesh
from ...model.geometry.native_meshes import drawn_arrays, make_native_mesh
from ...model.geometry.vertex_attributes import vertex_attributes
from ...model.materials.textures import Reading, Texture, own_reading


class MeshNeeds(NamedTuple):
    """The derived arrays of a mesh that a picture reads."""

    vertex_normals: bool = False
    face_normals: bool = False
    edges: bool = False


_meshes: WeakKeyDictionary[Mesh, tuple[dict[str, Any], dict[str, Any], NativeMesh]] = (
    WeakKeyDictionary()
)
_environments: WeakKeyDictionary[Environment, NativeEnvironment] = WeakKeyDictionary()
Content: TypeAlias = Literal["srgb", "linear", "normals"]
_Handles: TypeAlias = dict[tuple[bool, bool, bool], tuple[tuple[Any, ...], NativeTexture]]
_textures: WeakKeyDictionary[Texture, _Handles] = WeakKeyDictionary()


def native_mesh(mesh: Mesh, needs: MeshNeeds, threads: int) -> NativeMesh:
    """Return a mesh's current handle with the needed arrays; 0 threads are all.

    Threads that ask at once for the first time may each create one; these are alike.
    """
    arrays: dict[str, Any] = arrays_of(mesh)  # from one moment: another may be assigned meanwhile
    angle = mesh.crease_angle
    state = {**arrays, "crease_angle": angle}
    known = _meshes.get(mesh)
    if known is None or not all(map(operator.is_, state.values(), known[0].values())):
        made = drawn_arrays(mesh, arrays)
        known = _meshes[mesh] = state, made, make_native_mesh(made, threads)
    _, drawn, native = known
    if needs.vertex_normals and "normals" not in native.attributes:
        if has_creases(arrays, angle):
            creased = creased_arrays(arrays, vertex_attributes(Mesh), angle)
            if creased["faces"] is not arrays["faces"]:
                native = make_native_mesh(creased, threads)
                _meshes[mesh] = state, drawn, native
            native.set_attribute("normals", creased["_given_normals"])
        else:
            native.set_attribute("normals", derived(mesh, "normals", drawn))
    if needs.face_normals and not native.has_face_normals:
        native.set_face_normals(derived(mesh, "face_normals", arrays))
    if needs.edges and not native.has_edges:
        native.set_edges(derived(mesh, "edges", arrays))
    return native


def is_new(texture: Texture) -> bool:
    """Return whether a texture has no handle yet."""
    return texture not in _textures


def native_texture(
    texture: Texture, content: Content, reading: Reading | None = None
) -> NativeTexture:
    """Return a texture's current handle, for what it holds.

    Parameters
    ----------
    texture : Texture
    content : {"srgb", "linear", "normals"}
        Colours, for renderers of either colour space; or numbers as they are; or directions.
    reading : callable, optional
        As in `SceneData`.
    """
    pixels = texture.pixels
    read = (reading or own_reading)(texture)
    sampling = texture.filter, texture.side_wraps, *read
    decode = content == "srgb" and texture.color_space == "srgb"
    holds_normals = content == "normals"
    key = decode, holds_normals, read != own_reading(texture)
    natives = _textures.setdefault(texture, {})
    known = natives.get(key)
    if known is None or known[0][0] is not pixels or known[0][1:] != sampling:
        wrap_u, wrap_v = (WRAPS[name] for name in texture.side_wraps)
        sides = FILTERS[texture.filter], wrap_u, wrap_v
        native = NativeTexture(pixels, decode, *sides, *read, holds_normals)
        known = natives[key] = (pixels, *sampling), native
    return known[1]


def native_environment(environment: Environment, threads: int) -> NativeEnvironment:
    """Return an environment's handle, prefiltered for each roughness; 0 threads are all."""
    native = _environments.get(environment)
    if native is None:
        native = _environments[environment] = NativeEnvironment(environment.pixels, threads)
    return native
