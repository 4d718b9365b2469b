"""Open3D's Phong shading, with its four lights.

In: places, normals and colours of samples. Out: their colours, as displayed. The formulas are those
of PhongVertexShader.glsl, PhongFragmentShader.glsl and PhongShader.cpp; in float64, by single
operations, so that a picture has the same bytes everywhere.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from .render_option import Lamp

_Floats = NDArray[np.float64]
_ROOTS = 12  # binary places of exponents
_FAINT = 1e-12  # powers below it do not show


class Lighting(NamedTuple):
    """The light of a picture.

    Attributes
    ----------
    eye : (3,) float64
        World space.
    places : (4, 3) float64
        The lights', world space.
    lamps : tuple of Lamp
    ambient : (3,) float64
    """

    eye: _Floats
    places: _Floats
    lamps: tuple[Lamp, ...]
    ambient: _Floats


def phong(
    lighting: Lighting, points: _Floats, normals: _Floats, colors: _Floats
) -> NDArray[np.float64]:
    """Return the colours of samples.

    Parameters
    ----------
    lighting : Lighting
    points, normals, colors : (N, 3) float64
        World space; normals of any length, on the viewer's side.

    Returns
    -------
    (N, 3) float64
        From 0 to 1.
    """
    normals = _units(normals)
    towards = _units(lighting.eye - points)
    facing = _dots(towards, normals)
    diffuse = np.broadcast_to(lighting.ambient, points.shape).copy()
    gloss = np.zeros(points.shape)
    for place, shininess, shares, glosses in _distinct(lighting):
        rays = _units(place - points)
        across = _dots(normals, rays)
        diffuse += np.clip(across, 0.0, 1.0)[:, np.newaxis] * shares
        mirrored = np.clip(2.0 * across * facing - _dots(towards, rays), 0.0, 1.0)
        gloss += power(mirrored, shininess)[:, np.newaxis] * glosses
    return np.clip(colors * diffuse + gloss, 0.0, 1.0)


def _distinct(lighting: Lighting):
    """Yield lights, those at one place added: place, shininess, diffuse and specular colours."""
    found: dict[tuple[object, ...], list[_Floats]] = {}
    for place, lamp in zip(lighting.places, lighting.lamps, strict=True):
        color = np.array(lamp.color)
        sums = found.setdefault((*place, lamp.shininess), [np.zeros(3), np.zeros(3)])
        sums[0] = sums[0] + color * lamp.diffuse
        sums[1] = sums[1] + color * lamp.specular
    for (x, y, z, shininess), (shares, glosses) in found.items():
        yield np.array([x, y, z]), shininess, shares, glosses


def turned_to(eye: _Floats, points: _Floats, normals: _Floats) -> _Floats:
    """Return 1 for each vertex whose normal is on the viewer's side, else -1: (N, 1)."""
    return np.where(_dots(eye - points, normals) < 0.0, -1.0, 1.0)[:, np.newaxis]


def _dots(a: _Floats, b: _Floats) -> _Floats:
    return (a[:, 0] * b[:, 0] + a[:, 1] * b[:, 1]) + a[:, 2] * b[:, 2]


def _units(vectors: _Floats) -> _Floats:
    lengths = np.sqrt(_dots(vectors, vectors))
    return vectors / np.where(lengths > 0, lengths, 1.0)[:, np.newaxis]


def power(base: _Floats, exponent: float) -> _Floats:
    """Return powers by products and square roots, which have the same bits everywhere."""
    if not exponent > 0:
        return np.ones_like(base)
    result = np.zeros_like(base)
    # What is too small to show is left out: most of a picture.
    shows = np.flatnonzero(base > _FAINT ** (1.0 / max(exponent, 1.0)))
    kept, total = base[shows], np.ones(len(shows))
    whole = math.floor(exponent)
    fraction = round((exponent - whole) * (1 << _ROOTS))
    root = kept
    for place in reversed(range(_ROOTS)):
        root = np.sqrt(root)
        if fraction >> place & 1:
            total = total * root
    while whole:
        if whole & 1:
            total = total * kept
        kept = kept * kept
        whole >>= 1
    result[shows] = total
    return result
