"""The light that VTK knows and the core does not: highlights of Phong, physical materials, cones.

In: what shows at samples: colours, normals, places, in view space. Out: their colours. The formulas
are those of VTK's shaders (vtkOpenGLPolyDataMapper.cxx); colours are those that the screen shows.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from ._lights import Lamp
from ._properties import Property

_LEAST = 1e-5
_GAMMA = 2.2

Floats = NDArray[np.float64]


def shade(
    look: Property,
    albedo: Floats,
    ambient: Floats,
    normals: Floats,
    places: Floats,
    lamps: list[Lamp],
) -> Floats:
    """Return the colours of samples, (N, 3) float64, 0 to 1 and above.

    Parameters
    ----------
    albedo, ambient : (N, 3) float64
        The colours for scattered light and for light from everywhere.
    normals, places : (N, 3) float64
        In view space; normals have unit length and face the camera.
    """
    if look.is_unlit:
        return (look.ambient + look.diffuse) * albedo
    to_viewer = _unit(-places)
    if look.is_physical:
        return _physical(look, albedo, normals, places, to_viewer, lamps)
    scattered, mirrored = np.zeros_like(albedo), np.zeros_like(albedo)
    for lamp in lamps:
        to_light, strength = _arriving(lamp, places)
        facing = _dot(normals, to_light)
        lit = facing > 0.0
        share = np.where(lit, facing, 0.0) * strength
        scattered += share[:, None] * lamp.color
        if look.specular:
            back = 2.0 * facing[:, None] * normals - to_light
            glance = np.maximum(_dot(back, to_viewer), _LEAST) ** look.power
            mirrored += np.where(lit, glance * strength, 0.0)[:, None] * lamp.color
    return (
        look.ambient * ambient
        + look.diffuse * albedo * scattered
        + look.specular * look.specular_color * mirrored
    )


def _physical(
    look: Property,
    albedo: Floats,
    normals: Floats,
    places: Floats,
    to_viewer: Floats,
    lamps: list[Lamp],
) -> Floats:
    """Return the light that a physical material reflects, as the screen shows it."""
    f0 = look.base_reflectance * (1.0 - look.metallic) + albedo * look.metallic
    f90 = np.clip(f0.sum(1, keepdims=True) * 16.5, 0.0, 1.0)
    f90 = f90 * (1.0 - look.metallic) + look.metallic
    n_v = np.clip(_dot(normals, to_viewer), _LEAST, 1.0)[:, None]
    a2 = look.roughness**2
    total = np.zeros_like(albedo)
    for lamp in lamps:
        to_light, strength = _arriving(lamp, places)
        half = _unit(to_viewer + to_light)
        h_l = np.clip(_dot(half, to_light), _LEAST, 1.0)[:, None]
        n_l = np.clip(_dot(normals, to_light), _LEAST, 1.0)[:, None]
        n_h = np.clip(_dot(normals, half), _LEAST, 1.0)[:, None]
        d = (n_h * a2 * a2 - n_h) * n_h + 1.0
        spread = a2 * a2 / np.maximum(math.pi * d * d, 1e-8)
        shadowed = 0.5 / (
            n_l * np.sqrt(a2 + n_v * (n_v - a2 * n_v)) + n_v * np.sqrt(a2 + n_l * (n_l - a2 * n_l))
        )
        fresnel = f0 + (f90 - f0) * _fifth(1.0 - h_l)
        scattered = (1.0 - look.metallic) * (1.0 - fresnel) * albedo / math.pi
        arriving = strength[:, None] * lamp.color
        total += arriving * (scattered + spread * shadowed * fresnel) * n_l
    return np.maximum(total, 0.0) ** (1.0 / _GAMMA)


def _arriving(lamp: Lamp, places: Floats) -> tuple[Floats, Floats]:
    """Return the directions to a light, (N, 3), and how much of it arrives, (N,)."""
    if lamp.position is None:
        return np.broadcast_to(-lamp.direction, places.shape), np.ones(len(places))
    away = lamp.position - places
    distance = np.sqrt(_dot(away, away))
    to_light = away / np.maximum(distance, 1e-300)[:, None]
    constant, linear, square = lamp.fading
    strength = 1.0 / np.maximum(constant + linear * distance + square * distance * distance, 1e-300)
    if lamp.cone < 90.0:
        axis = -_dot(to_light, np.broadcast_to(lamp.direction, places.shape))
        inside = axis >= math.cos(math.radians(lamp.cone))
        strength = strength * np.where(inside, np.maximum(axis, 0.0) ** lamp.exponent, 0.0)
    return to_light, strength


def _fifth(value: Floats) -> Floats:
    square = value * value
    return square * square * value


def _dot(a: Floats, b: Floats) -> Floats:
    return a[:, 0] * b[:, 0] + a[:, 1] * b[:, 1] + a[:, 2] * b[:, 2]


def _unit(vectors: Floats) -> Floats:
    return vectors / np.maximum(np.sqrt(_dot(vectors, vectors)), 1e-300)[:, None]
