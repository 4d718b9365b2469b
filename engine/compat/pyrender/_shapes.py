"""The core's handles of pyrender's primitives and textures, created once for each.

In: primitives and textures of programs. Out: handles that are cached until their arrays change.
"""

from __future__ import annotations

import numpy as np

from ..._native import pyrender as _native
from ..._native.pyrender import NativeShape, NativeTexture
from ...model.geometry.mesh import Mesh
from ...model.materials.material import Material
from .constants import GLTF
from .primitive import Primitive
from .texture import Texture

_WRAPS = {
    GLTF.REPEAT: _native.REPEAT,
    GLTF.CLAMP_TO_EDGE: _native.CLAMP,
    GLTF.MIRRORED_REPEAT: _native.MIRROR,
}
_KINDS = {GLTF.POINTS: _native.POINTS}
_KINDS |= dict.fromkeys((GLTF.LINES, GLTF.LINE_LOOP, GLTF.LINE_STRIP), _native.LINES)


def is_triangles(primitive: Primitive) -> bool:
    """Return whether a primitive consists of triangles."""
    return primitive.mode >= GLTF.TRIANGLES


def corners_of(primitive: Primitive) -> np.ndarray:
    """Return the vertices of a primitive's triangles, lines or points, in order."""
    count = len(primitive.positions)
    numbers = np.arange(count, dtype=np.int32)
    if primitive.indices is not None:
        numbers = primitive.indices.ravel()
        if len(numbers) and not (numbers.min() >= 0 and numbers.max() < count):
            raise ValueError(f"indices must be in 0..{count - 1}")
    return np.ascontiguousarray(_joined(numbers, primitive.mode), np.int32)


def _joined(numbers: np.ndarray, mode: int) -> np.ndarray:
    if mode == GLTF.TRIANGLES:
        return numbers[: len(numbers) // 3 * 3]
    if mode == GLTF.LINES:
        return numbers[: len(numbers) // 2 * 2]
    if mode == GLTF.POINTS:
        return numbers
    if mode == GLTF.TRIANGLE_FAN:
        first = np.broadcast_to(numbers[:1], max(len(numbers) - 2, 0))
        return np.stack([first, numbers[1:-1], numbers[2:]], axis=1).ravel()
    if mode == GLTF.TRIANGLE_STRIP:
        rows = np.stack([numbers[:-2], numbers[1:-1], numbers[2:]], axis=1)
        rows[1::2, :2] = rows[1::2, 1::-1]  # every second one has the opposite winding
        return rows.ravel()
    ends = np.roll(numbers, -1) if mode == GLTF.LINE_LOOP else numbers[1:]
    return np.stack([numbers[: len(ends)], ends], axis=1).ravel()


def shape_of(primitive: Primitive) -> NativeShape:
    """Return the core's handle of a primitive."""
    shape = primitive._drawn.get("shape")
    if shape is None:
        shape = primitive._drawn["shape"] = NativeShape(
            _KINDS.get(primitive.mode, _native.TRIANGLES),
            corners_of(primitive),
            primitive.positions,
            primitive.normals,
            primitive.texcoord_0,
            primitive.color_0,
        )
    return shape


def mesh_of(primitive: Primitive, *, two_sided: bool, turned: bool) -> Mesh:
    """Return the triangles of a primitive in the renderer's format.

    Parameters
    ----------
    primitive : Primitive
    two_sided : bool
        Backs show, too.
    turned : bool
        Backs are fronts: the renderer, unlike OpenGL, knows that mirrors turn triangles over.
    """
    key = "mesh", two_sided, turned
    mesh = primitive._drawn.get(key)
    if mesh is None:
        faces = corners_of(primitive).reshape(-1, 3)
        faces = faces[:, ::-1] if turned else faces
        mesh = primitive._drawn[key] = Mesh(
            primitive.positions, faces, materials=[Material(two_sided=two_sided)]
        )
    return mesh


def texture_of(texture: Texture | None) -> NativeTexture | None:
    """Return the core's handle of a texture; None for none, or for one without an image."""
    if texture is None or texture.source is None:
        return None
    sampler = texture.sampler
    smallest = GLTF.LINEAR_MIPMAP_LINEAR if sampler.minFilter is None else sampler.minFilter
    largest = GLTF.LINEAR if sampler.magFilter is None else sampler.magFilter
    key = texture.source, sampler.wrapS, sampler.wrapT, smallest, largest
    if texture._native is None or not _same(texture._native[0], key):
        texture._native = key, _native_texture(*key)
    return texture._native[1]


def _same(some: tuple, others: tuple) -> bool:
    return some[0] is others[0] and some[1:] == others[1:]


def _native_texture(source, wrap_s, wrap_t, smallest, largest) -> NativeTexture:
    levels = _levels(source) if smallest >= GLTF.NEAREST_MIPMAP_NEAREST else [_upright(source)]
    linear = (GLTF.LINEAR, GLTF.LINEAR_MIPMAP_NEAREST, GLTF.LINEAR_MIPMAP_LINEAR)
    blends = smallest in (GLTF.NEAREST_MIPMAP_LINEAR, GLTF.LINEAR_MIPMAP_LINEAR)
    wraps = (_WRAPS.get(wrap, _native.REPEAT) for wrap in (wrap_s, wrap_t))
    return NativeTexture(levels, *wraps, largest in linear, smallest in linear, blends)


def _upright(source: np.ndarray) -> np.ndarray:
    """Return an image with its bottom row first, (H, W, C)."""
    texels = source[:, :, np.newaxis] if source.ndim == 2 else source
    return np.ascontiguousarray(texels[::-1])


def _levels(source: np.ndarray) -> list[np.ndarray]:
    """Return an image and its mip levels, each computed from the previous one."""
    levels = [_upright(source)]
    while max(levels[-1].shape[:2]) > 1 and len(levels) < _native.LEVELS:
        halves = _halved(_halved(levels[-1].astype(np.float32), 0), 1)
        levels.append((halves + 0.5).astype(np.uint8))
    return levels


def _halved(texels: np.ndarray, axis: int) -> np.ndarray:
    """Return texels averaged to half the resolution."""
    size = texels.shape[axis]
    fewer = max(size >> 1, 1)
    places = (np.arange(fewer) + 0.5) * (size / fewer) - 0.5
    low = np.floor(places).astype(int)
    share = (places - low).astype(np.float32).reshape((-1, 1, 1) if axis == 0 else (1, -1, 1))
    before = np.take(texels, np.clip(low, 0, size - 1), axis)
    behind = np.take(texels, np.clip(low + 1, 0, size - 1), axis)
    return before + (behind - before) * share
