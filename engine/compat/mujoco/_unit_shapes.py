"""The triangles of MuJoCo's shapes: unit shapes that geoms scale, and the grids of planes.

In: how many slices, stacks and quads a model asks for. Out: arrays of corners. Quads (v0, v1, v2,
v3) become the triangles (v0, v1, v3) and (v1, v2, v3), as Mesa splits them (R253).
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from ...base.linalg.trigonometry import atan2, cos, sin, unit_circle

_SPLIT = np.array([[0, 1, 3], [1, 2, 3]])
_OF_QUADS = (0b101, 0b011)  # the edges of both triangles that wireframes show


class Triangles(NamedTuple):
    """Triangles, corner by corner.

    Attributes
    ----------
    at, normals : (T, 3, 3) float64
    uvs : (T, 3, 2) float64
    edges : (T,) uint8
        Bit k is set if wireframes show the edge from corner k to the next.
    """

    at: np.ndarray
    normals: np.ndarray
    uvs: np.ndarray
    edges: np.ndarray


class _Ring(NamedTuple):
    """Points around the z axis, the first one repeated at the end."""

    at: np.ndarray  # (n + 1, 3)
    normals: np.ndarray
    uvs: np.ndarray  # (n + 1, 2)


def join(parts: list[Triangles]) -> Triangles:
    return Triangles(*(np.concatenate(each) for each in zip(*parts, strict=True)))


def of_quads(at: np.ndarray, normals: np.ndarray, uvs: np.ndarray) -> Triangles:
    """Split quads; arrays (Q, 4, ...)."""
    edges = np.tile(np.array(_OF_QUADS, np.uint8), len(at))
    split = [each[:, _SPLIT].reshape(-1, 3, each.shape[-1]) for each in (at, normals, uvs)]
    return Triangles(*split, edges)


def _band(first: _Ring, second: _Ring) -> Triangles:
    """Return the quads between two rings: along the first, back along the second."""
    quads = [
        np.stack([a[:-1], a[1:], b[1:], b[:-1]], axis=1) for a, b in zip(first, second, strict=True)
    ]
    return of_quads(*quads)


def _fan(ring: _Ring, pole: _Ring, *, turned: bool) -> Triangles:
    """Return the triangles from a ring to its pole, which has a point for each of them."""
    triangles = [
        np.stack([p, a[1:], a[:-1]] if turned else [a[:-1], a[1:], p], axis=1)
        for a, p in zip(ring, pole, strict=True)
    ]
    return Triangles(*triangles, np.full(len(pole.at), 0b111, np.uint8))


def _around(slices: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return cosines, sines and shares of a turn, the last of them the first again."""
    x, y = unit_circle(slices)
    return np.append(x, x[0]), np.append(y, y[0]), np.arange(slices + 1) / slices


def _flat(slices: int, radius: float, z: float, normal) -> _Ring:
    """Return a ring of a disk."""
    x, y, _ = _around(slices)
    at = np.stack([x * radius, y * radius, np.full(slices + 1, z)], axis=1)
    return _Ring(at, np.tile(np.array(normal, float), (slices + 1, 1)), 0.5 + 0.5 * at[:, :2])


def _poles(slices: int, z: float, sign: float, v: float) -> _Ring:
    at = np.tile([0.0, 0.0, z], (slices, 1))
    normals = np.tile([0.0, 0.0, sign], (slices, 1))
    return _Ring(at, normals, np.stack([(np.arange(slices) + 0.5) / slices, np.full(slices, v)], 1))


def _latitude(slices: int, share: float, shift: float, v: float) -> _Ring:
    """Return a ring of a sphere at a share of the way from its equator to a pole."""
    x, y, u = _around(slices)
    high, wide = sin(math.pi / 2 * share), cos(math.pi / 2 * share)
    normals = np.stack([x * wide, y * wide, np.full(slices + 1, high)], axis=1)
    return _Ring(normals + [0.0, 0.0, shift], normals, np.stack([u, np.full(slices + 1, v)], 1))


def _half_sphere(slices: int, stacks: int, sign: int, shift: float, v_of) -> Triangles:
    rings = [_latitude(slices, sign * i / stacks, shift, v_of(i / stacks)) for i in range(stacks)]
    parts = [
        _fan(rings[-1], _poles(slices, shift + sign, sign, v_of(1.0)), turned=sign < 0),
        *(
            _band(*(pair if sign > 0 else pair[::-1]))
            for pair in zip(rings[:-1], rings[1:], strict=True)
        ),
    ]
    return join(parts)


def sphere(slices: int, stacks: int) -> Triangles:
    """Return a sphere of radius 1."""
    half = max(stacks // 2, 1)
    return join(
        [
            _half_sphere(slices, half, sign, 0.0, lambda share, s=sign: 0.5 - s * share / 2)
            for sign in (-1, 1)
        ]
    )


def cap(slices: int, stacks: int, sign: int) -> Triangles:
    """Return half a sphere, of which the pole is at z = 2 * sign."""
    return _half_sphere(
        slices,
        max(stacks // 2, 1),
        sign,
        float(sign),
        lambda share: 1.0 - share if sign > 0 else share,
    )


def _disk(slices: int, rings: int, z: float, sign: int) -> Triangles:
    circles = [_flat(slices, (i + 1) / rings, z, (0, 0, sign)) for i in range(rings)]
    middle = _Ring(
        np.tile([0.0, 0.0, z], (slices, 1)),
        np.tile([0.0, 0.0, float(sign)], (slices, 1)),
        np.full((slices, 2), 0.5),
    )
    return join(
        [
            _fan(circles[0], middle, turned=sign < 0),
            *(
                _band(outer, inner) if sign > 0 else _band(inner, outer)
                for inner, outer in zip(circles[:-1], circles[1:], strict=True)
            ),
        ]
    )


def cylinder(slices: int, stacks: int, *, closed: bool) -> Triangles:
    """Return a cylinder of radius 1 from z = -1 to 1; with one stack it has no inner lines."""
    x, y, u = _around(slices)
    normals = np.stack([x, y, np.zeros(slices + 1)], axis=1)
    rings = []
    for i in range(stacks + 1):
        z = 2 * i / stacks - 1
        rings.append(
            _Ring(
                normals + [0.0, 0.0, z],
                normals,
                np.stack([u, np.full(slices + 1, (1 - z) / 2)], axis=1),
            )
        )
    side = [_band(*pair) for pair in zip(rings[:-1], rings[1:], strict=True)]
    if not closed:
        return join(side)
    half = max(stacks // 2, 1)
    return join([_disk(slices, half, -1.0, -1), *side, _disk(slices, half, 1.0, 1)])


def cone(slices: int, stacks: int) -> Triangles:
    """Return a cone of radius 1 from z = 0 to its tip at 1, with its base."""
    x, y, u = _around(slices)
    normals = np.stack([x, y, np.ones(slices + 1)], axis=1) * math.sqrt(0.5)
    rings = []
    for i in range(stacks):
        r = (i + 1) / stacks
        at = np.stack([x * r, y * r, np.full(slices + 1, 1 - r)], axis=1)
        rings.append(_Ring(at, normals, np.stack([u, np.full(slices + 1, r)], axis=1)))
    between = normals[:-1] + normals[1:]
    between /= np.sqrt((between * between).sum(1, keepdims=True))
    tip = _Ring(
        np.tile([0.0, 0.0, 1.0], (slices, 1)),
        between,
        np.stack([(u[:-1] + u[1:]) / 2, np.zeros(slices)], 1),
    )
    side = [_band(outer, inner) for inner, outer in zip(rings[:-1], rings[1:], strict=True)]
    return join([_fan(rings[0], tip, turned=False), *side, _disk(slices, stacks, 0.0, -1)])


def box(quads: int) -> Triangles:
    """Return a box from -1 to 1, each side of quads x quads."""
    i, j = (each.ravel() for each in np.meshgrid(*[np.arange(quads)] * 2, indexing="ij"))
    parts = []
    for axis, sign, across, up in ((2, 1, 0, 1), (2, -1, 0, 1), (0, 1, 1, 2), (0, -1, 1, 2),
                                   (1, -1, 0, 2), (1, 1, 0, 2)):  # fmt: skip
        order = ((0, 0), (1, 0), (1, 1), (0, 1))
        if (sign < 0) != (axis == 1):
            order = ((0, 1), (1, 1), (1, 0), (0, 0))
        at = np.zeros((len(i), 4, 3))
        at[..., axis] = sign
        uvs = np.zeros((len(i), 4, 2))
        for k, (a, b) in enumerate(order):
            at[:, k, across], at[:, k, up] = 2 * (i + a) / quads - 1, 2 * (j + b) / quads - 1
            uvs[:, k, 0], uvs[:, k, 1] = (i + a) / quads, 1 - (j + b) / quads
        normals = np.zeros_like(at)
        normals[..., axis] = sign
        parts.append(of_quads(at, normals, uvs))
    return join(parts)


def triangle() -> Triangles:
    """Return the triangle (0, 0), (1, 0), (0, 1)."""
    at = np.array([[[0.0, 0, 0], [1, 0, 0], [0, 1, 0]]])
    normals = np.tile([0.0, 0.0, 1.0], (1, 3, 1))
    uvs = np.array([[[0.0, 1], [1, 1], [0, 0]]])
    return Triangles(at, normals, uvs, np.array([0b111], np.uint8))


def haze(slices: int, share: float) -> Triangles:
    """Return the haze's cone; the first of the uvs are alphas.

    ``share``: how much nearer it begins on the ground than at the height of the eye.
    """
    first = atan2(1.0, share)
    height = math.sqrt(0.5) * share * float(sin(first)) / float(sin(0.75 * math.pi - float(first)))
    x, y, _ = _around(slices)
    rings = []
    for z, alpha in ((0.0, 0.0), (height, 1.0), (1.0, 0.0)):
        r = 1 - share * (1 - z)
        at = np.stack([x * r, y * r, np.full(slices + 1, z)], axis=1)
        uvs = np.stack([np.full(slices + 1, alpha), np.zeros(slices + 1)], axis=1)
        rings.append(_Ring(at, np.zeros_like(at), uvs))
    return join([_band(*pair) for pair in zip(rings[:-1], rings[1:], strict=True)])


def grid_lines(size: float, spacing: float, far: float, repeat: float) -> np.ndarray:
    """Return where the lines of a plane's grid are, along one axis (R254).

    Parameters
    ----------
    size : float
        Half of the plane's; 0 without end.
    spacing : float
        Half the distance of lines.
    far : float
        The far plane.
    repeat : float
        How often the material's texture repeats, or 0.
    """
    cells = 200
    if size <= 0:
        step = 2 / repeat if repeat > 0 else 2.1 * far / (cells - 2)
        width = (2.1 * far + 2 * step) / cells
        return width * np.arange(cells + 1) - width * (cells // 2)
    half = max(spacing, size / (cells - 2))
    count = math.floor(size / max(1e-15, half))
    count -= count % 2
    pad = size - count * half
    left = -size + pad + np.arange(count + 1) * half * 2
    right = np.append(left[1:], left[-1] + pad)
    return np.concatenate([[-size], np.maximum(left, -size), [max(right[-1], left[-1])]])
