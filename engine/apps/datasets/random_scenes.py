"""Random cameras, lights, poses, textures and materials.

In: a `Generator` and limits. Out: objects of the scene API. All arithmetic is on integers, single
IEEE operations and `engine3d.linalg`: the same bits, and so the same pictures, on every machine.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ...base import linalg
from ...base.angles import finite_angle
from ...base.calls import checks_types
from ...base.numbers import shown
from ...base.validation import choose, finite, fraction, positive, vector3
from ...choices import LightShadow
from ...errors import InvalidArgumentError
from ...model.materials.linear_colors import LinearColor
from ...model.materials.material import Material
from ...model.materials.textures import Texture
from ...model.scene.cameras import PerspectiveCamera
from ...model.scene.lights import DirectionalLight
from ...model.scene.orbiting import orbit
from ...model.scene.scene import Scene
from .generator import Generator

Limits = tuple[float, float]
PATTERNS = ("checker", "stripes", "dots", "noise")
_TURN = 2.0 * math.pi
_TRIES = 64  # attempts to place a thing before it is left out


@checks_types
def random_camera(
    generator: Generator,
    scene: Scene,
    *,
    azimuth: Limits = (0.0, _TURN),
    elevation: Limits = (0.1, 1.2),
    distance: Limits = (1.0, 1.5),
    yfov: Limits = (0.6, 0.9),
    up: ArrayLike = (0.0, 1.0, 0.0),
) -> tuple[PerspectiveCamera, NDArray[np.float64]]:
    """Return a camera that looks at the middle of a scene, and its pose.

    Parameters
    ----------
    generator : Generator
    scene : Scene
        As it stands: what it shows is the box that is looked at.
    azimuth, elevation : (low, high)
        Radians, as of `orbit`.
    distance : (low, high)
        In distances from which the ball around the scene's box just fits a square picture.
    yfov : (low, high)
        Vertical field of view, radians.
    up : (3,) float

    Returns
    -------
    camera : PerspectiveCamera
        Its planes enclose the ball.
    pose : (4, 4) float64
        world-from-camera.
    """
    azimuth, elevation = _angles(azimuth, "azimuth"), _angles(elevation, "elevation")
    distance, yfov = _limits(distance, "distance"), _limits(yfov, "yfov")
    low, high = scene.bounds
    center = (low + high) * 0.5
    radius = float(linalg.length((high - low) * 0.5)) or 1.0
    view = generator.uniform(*yfov)
    away = generator.uniform(*distance) * radius / linalg.sin(0.5 * view)
    angles = generator.uniform(*azimuth), generator.uniform(*elevation)
    pose = orbit(center, away, *angles, up=up)
    near = max(away - 1.01 * radius, 0.01 * away)
    return PerspectiveCamera(view, znear=near, zfar=away + 1.01 * radius), pose


@checks_types
def random_light(
    generator: Generator,
    *,
    elevation: Limits = (0.4, 1.4),
    intensity: Limits = (1.5, 4.0),
    tint: float = 0.15,
    shadow: LightShadow = "map",
) -> DirectionalLight:
    """Return a directional light from above.

    Parameters
    ----------
    generator : Generator
    elevation : (low, high)
        Of where the light comes from, in radians above the horizon.
    intensity : (low, high)
        In lux: a white matt surface that faces the light shows white at pi, whatever its material.
    tint : float
        By how much channels of its colour are less than 1 at most.
    shadow : {"none", "map", "exact"}
    """
    elevation, intensity = _angles(elevation, "elevation"), _limits(intensity, "intensity")
    azimuth, height = generator.uniform(0.0, _TURN), generator.uniform(*elevation)
    across = linalg.cos(height)
    towards = linalg.cos(azimuth) * across, linalg.sin(height), linalg.sin(azimuth) * across
    color = LinearColor(1.0 - generator.uniform(0.0, tint) for _ in range(3))
    strength = generator.uniform(*intensity)
    return DirectionalLight(np.negative(towards), color, strength, shadow=shadow)


@checks_types
def random_pose(
    generator: Generator,
    low: ArrayLike = (0.0, 0.0, 0.0),
    high: ArrayLike = (0.0, 0.0, 0.0),
    *,
    upright: bool = False,
) -> NDArray[np.float64]:
    """Return a random pose: any rotation, at a position in a box.

    Parameters
    ----------
    generator : Generator
    low, high : (3,) float
        Corners of the box.
    upright : bool
        Turn about +Y alone.

    Returns
    -------
    (4, 4) float64
    """
    low, high = vector3(low, "low"), vector3(high, "high")
    if upright:
        turn = linalg.quaternion_from_axis_angle((0, 1, 0), generator.uniform(0.0, _TURN))
    else:
        turn = generator.rotation()
    pose = linalg.quaternion_to_matrix(turn)
    pose[:3, 3] = low + (high - low) * generator.uniform(0.0, 1.0, 3)
    return pose


@checks_types
def scatter(
    generator: Generator, radii: Sequence[float], half_size: float
) -> list[tuple[float, float] | None]:
    """Return positions on a square for discs that do not overlap.

    Parameters
    ----------
    generator : Generator
    radii : sequence of float
    half_size : float
        The square is from ``-half_size`` to ``half_size``; discs lie within.

    Returns
    -------
    list of (x, z) or None
        None for a disc for which no place was found.
    """
    reach = positive(half_size, "half_size")
    placed: list[tuple[float, float, float]] = []
    places: list[tuple[float, float] | None] = []
    for radius in radii:
        room, found = reach - positive(radius, "radii"), None
        for _ in range(_TRIES if room > 0.0 else 0):
            x, z = generator.uniform(-room, room), generator.uniform(-room, room)
            if not any(_overlap((x, z, radius), other) for other in placed):
                found = x, z
                placed.append((x, z, radius))
                break
        places.append(found)
    return places


def _overlap(one: tuple[float, float, float], other: tuple[float, float, float]) -> bool:
    x, z, reach = one[0] - other[0], one[1] - other[1], one[2] + other[2]
    return x * x + z * z < reach * reach


@checks_types
def random_texture(generator: Generator, side: int = 64, pattern: str | None = None) -> Texture:
    """Return a random texture of two colours in a pattern.

    Parameters
    ----------
    generator : Generator
    side : int
        Pixels, a power of two from 8 to 1024.
    pattern : {"checker", "stripes", "dots", "noise"}, optional
        Any of them if left out.

    Raises
    ------
    InvalidArgumentError
    """
    if side not in (2**k for k in range(3, 11)):
        raise InvalidArgumentError(f"side must be a power of two from 8 to 1024, not {shown(side)}")
    if pattern is None:
        pattern = generator.choice(PATTERNS)
    choose(pattern, PATTERNS, "pattern")
    colors = generator.integers(0, 256, (2, 3)).astype(np.int32)
    share = _shares(generator, side, pattern)[..., np.newaxis]  # of the first colour, in 256ths
    pixels = (colors[0] * share + colors[1] * (256 - share)) >> 8
    return Texture(pixels.astype(np.uint8), name=pattern)


def _shares(generator: Generator, side: int, pattern: str) -> NDArray[np.int32]:
    """Return the share of the first colour for each pixel, (side, side), 0 to 256."""
    cell = side >> generator.integer(1, 4)
    y, x = np.indices((side, side), np.int32)
    if pattern == "checker":
        return ((x // cell + y // cell) & 1) * 256
    if pattern == "stripes":
        return ((x // cell) & 1) * 256
    if pattern == "dots":
        across, down = 2 * (x % cell) + 1 - cell, 2 * (y % cell) + 1 - cell
        return (9 * (across * across + down * down) < 4 * cell * cell) * 256
    return _noise(generator, x, y, cell)


def _noise(
    generator: Generator, x: NDArray[np.int32], y: NDArray[np.int32], cell: int
) -> NDArray[np.int32]:
    """Return random values at the corners of cells, linearly interpolated in between."""
    cells = len(x) // cell
    corners = generator.integers(0, 257, (cells, cells)).astype(np.int32)
    left, top, right, low = x // cell, y // cell, x % cell, y % cell
    beside, below = (left + 1) % cells, (top + 1) % cells
    above = corners[top, left] * (cell - right) + corners[top, beside] * right
    under = corners[below, left] * (cell - right) + corners[below, beside] * right
    return (above * (cell - low) + under * low) // (cell * cell)


@checks_types
def random_material(generator: Generator, *, textured: float = 0.5) -> Material:
    """Return a random physically based material.

    Parameters
    ----------
    generator : Generator
    textured : float
        How often it has a `random_texture`, from 0 to 1; else it has one colour.
    """
    textured = fraction(textured, "textured")
    metallic = 1.0 if generator.chance(0.25) else 0.0
    roughness = generator.uniform(0.2, 1.0)
    if generator.chance(textured):
        texture = random_texture(generator)
        return Material(texture=texture, metallic=metallic, roughness=roughness)
    color = generator.integers(32, 256, 3).astype(np.uint8)
    return Material(color=color, metallic=metallic, roughness=roughness)


def _limits(value: Limits, what: str) -> tuple[float, float]:
    """Return two limits, checked."""
    try:
        low, high = value
    except (TypeError, ValueError):
        raise InvalidArgumentError(f"{what} must be (low, high), not {shown(value)}") from None
    return finite(low, what), finite(high, what)


def _angles(value: Limits, what: str) -> tuple[float, float]:
    """Return two angles in radians, checked."""
    low, high = _limits(value, what)
    return finite_angle(low, what), finite_angle(high, what)
