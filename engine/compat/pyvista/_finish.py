"""The light that VTK knows and the core does not: highlights of Phong, physical materials, cones.

In: what shows at samples: colours, normals, places, in view space. Out: their colours. The formulas
are those of VTK's shaders (vtkOpenGLPolyDataMapper.cxx); colours are those that the screen shows.
"""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ._lights import Lamp
from ._properties import Property

_LEAST = 1e-5
_GAMMA = 2.2

Floats = NDArray[np.float64]


class Surface(NamedTuple):
    """What shows at N samples.

    Attributes
    ----------
    albedo, ambient : (N, 3) float64
        The colours for scattered light and for light from everywhere.
    normals, places : (N, 3) float64
        In view space; normals have unit length and face the camera.
    shadows : list of (N,) float64 or None
        For each lamp how much of it arrives, where surfaces throw shadows in it.
    surroundings : (N, 3) float64 or None
        What a physical material reflects of an environment.
    material, emissive : (N, 3) float64 or None
        What the maps of a physical material say: occlusion, roughness, metal; light of its own.
    """

    albedo: Floats
    ambient: Floats
    normals: Floats
    places: Floats
    shadows: list[Floats | None]
    surroundings: Floats | None = None
    material: Floats | None = None
    emissive: Floats | None = None


def shade(look: Property, surface: Surface, lamps: list[Lamp]) -> Floats:
    """Return the colours of samples, (N, 3) float64, 0 to 1 and above."""
    albedo, ambient, normals, places = surface[:4]
    if look.is_unlit:
        return (look.ambient + look.diffuse) * albedo
    to_viewer = _unit(-places)
    if look.is_physical:
        return np.maximum(_physical(look, surface, to_viewer, lamps), 0.0) ** (1.0 / _GAMMA)
    scattered, mirrored = np.zeros_like(albedo), np.zeros_like(albedo)
    for lamp, shadow in zip(lamps, surface.shadows, strict=True):
        to_light, strength = _arriving(lamp, places, shadow)
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


def _physical(look: Property, surface: Surface, to_viewer: Floats, lamps: list[Lamp]) -> Floats:
    """Return the linear light of a physical material."""
    albedo, normals = surface.albedo, surface.normals
    occlusion, roughness, metallic = 1.0, np.array(look.roughness), np.array(look.metallic)
    if surface.material is not None:
        occlusion, roughness, metallic = np.split(surface.material, 3, axis=1)
        roughness, metallic = roughness * look.roughness, metallic * look.metallic
    f0 = look.base_reflectance * (1.0 - metallic) + albedo * metallic
    f90 = np.clip(f0.sum(1, keepdims=True) * 16.5, 0.0, 1.0)
    f90 = f90 * (1.0 - metallic) + look.edge_tint * metallic
    n_v = np.clip(_dot(normals, to_viewer), _LEAST, 1.0)[:, None]
    total = np.zeros_like(albedo)
    if surface.surroundings is not None:
        total += surface.surroundings
    for lamp, shadow in zip(lamps, surface.shadows, strict=True):
        to_light, strength = _arriving(lamp, surface.places, shadow)
        half = _unit(to_viewer + to_light)
        h_l, n_l, n_h = (
            np.clip(_dot(*pair), _LEAST, 1.0)[:, None]
            for pair in ((half, to_light), (normals, to_light), (normals, half))
        )
        mirrored, fresnel = _mirrored(n_h, n_v, n_l, h_l, roughness, f0, f90)
        scattered = (1.0 - metallic) * (1.0 - fresnel) * albedo / math.pi
        arriving = strength[:, None] * lamp.color * n_l
        if (coat := look.coat) is not None:
            layer, lost = _mirrored(n_h, n_v, n_l, h_l, coat.roughness, coat.reflectance, 1.0)
            total += arriving * layer * coat.strength
            kept = 1.0 - lost * coat.strength
            mirrored, scattered = mirrored * kept * kept, scattered * kept
            arriving = arriving * (1.0 - coat.strength + coat.strength * coat.color)
        total += arriving * (scattered + mirrored)
    total *= 1.0 - look.occlusion + look.occlusion * occlusion
    return total if surface.emissive is None else total + look.emissive * surface.emissive


def _mirrored(
    n_h: Floats, n_v: Floats, n_l: Floats, h_l: Floats, roughness: Any, f0: Any, f90: Any
) -> tuple[Floats, Floats]:
    """Return how much light a rough surface mirrors, by the cosines of its angles, and Fresnel's
    share of it."""
    a2 = roughness**2
    d = (n_h * a2 * a2 - n_h) * n_h + 1.0
    spread = a2 * a2 / np.maximum(math.pi * d * d, 1e-8)
    shadowed = 0.5 / (
        n_l * np.sqrt(a2 + n_v * (n_v - a2 * n_v)) + n_v * np.sqrt(a2 + n_l * (n_l - a2 * n_l))
    )
    fresnel = f0 + (f90 - f0) * _fifth(1.0 - h_l)
    return spread * shadowed * fresnel, fresnel


def _arriving(lamp: Lamp, places: Floats, shadow: Floats | None) -> tuple[Floats, Floats]:
    """Return the directions to a light, (N, 3), and how much of it arrives, (N,)."""
    whole = np.ones(len(places)) if shadow is None else shadow
    if lamp.position is None:
        return np.broadcast_to(-lamp.direction, places.shape), whole
    away = lamp.position - places
    distance = np.sqrt(_dot(away, away))
    to_light = away / np.maximum(distance, 1e-300)[:, None]
    constant, linear, square = lamp.fading
    strength = whole / np.maximum(
        constant + linear * distance + square * distance * distance, 1e-300
    )
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
