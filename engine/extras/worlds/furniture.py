"""Street furniture and landmarks: trees, street lamps, benches, cars, fountains, a church.

Out: templates around the origin, made once. An unrotated one faces +Z.
"""

from __future__ import annotations

import functools

import numpy as np

from ...base import linalg
from ...model.geometry.mesh import Mesh
from ...model.materials.material import Material
from ...model.primitives import icosphere
from .frames import box, frames, quads, top
from .hashing import unit_floats
from .patchwork import Patchwork, Template
from .surfaces import NUMBER

#: Height of a lamp's light above the ground, in metres.
LAMP_HEIGHT = 4.6
_TRUNK_SIDES, _POLE_SIDES = 6, 6
_HERE = frames(0.0, 0.0)


@functools.cache
def template(name: str, tolerance: float = 0.0) -> Template:
    """Return the template with a name, for a `Patchwork` of given tolerance."""
    patch = Patchwork(tolerance)
    _MAKERS[name](patch)
    return patch.template()


def car(name: str, materials: list[Material]) -> Mesh:
    """Return one of `CARS` as a mesh with the city's materials."""
    patch = Patchwork()
    patch.place(template(name), _ORIGIN)
    return patch.mesh(name, materials)


def _ring(
    patch: Patchwork, sides: int, low: tuple[float, float], high: tuple[float, float], material: str
) -> None:
    """Return the sides of a prism or cone: ``low`` and ``high`` are (radius, y)."""
    x, z = linalg.unit_circle(sides)
    x1, z1 = np.roll(x, -1), np.roll(z, -1)
    (r0, y0), (r1, y1) = low, high
    y = np.broadcast_to(np.array([y0, y0, y1, y1]), (sides, 4))
    # From +X towards -Z, so that the front is outside.
    xs = np.stack((x * r0, x1 * r0, x1 * r1, x * r1), axis=1)
    zs = np.stack((-z * r0, -z1 * r0, -z1 * r1, -z * r1), axis=1)
    patch.add(np.stack((xs, y, zs), axis=-1), NUMBER[material])


def _disc(patch: Patchwork, sides: int, radius: float, y: float, material: str) -> None:
    """Return a level polygon with an even number of sides, cut into quads like a fan."""
    x, z = (part * radius for part in linalg.unit_circle(sides))
    first = np.arange(0, sides, 2)
    corners = np.zeros((len(first), 4, 3))
    for k in range(3):
        corners[:, 1 + k, 0] = x[(first + k) % sides]
        corners[:, 1 + k, 2] = -z[(first + k) % sides]
    corners[..., 1] = y
    patch.add(corners, NUMBER[material])


def _box(
    patch: Patchwork,
    x: tuple[float, float],
    y: tuple[float, float],
    z: tuple[float, float],
    material: str,
    sides: str = "ftlrb",
) -> None:
    patch.add(box(_HERE, *x, *y, *z, sides), NUMBER[material])


def _crown(
    patch: Patchwork,
    middle: tuple[float, float, float],
    radii: tuple[float, float, float],
    material: str,
    channel: int,
) -> Template:
    """Return a crown of leaves: a sphere with slightly displaced points."""
    rough = patch.tolerance >= 1.0
    ball = icosphere(1.0, 0 if rough else 1)
    normals = ball.positions.astype(np.float64)
    stretch = 0.80 + 0.36 * unit_floats(0, channel, np.asarray(ball.position_ids)) + 0.16 * rough
    positions = normals * stretch[:, np.newaxis] * np.array(radii) + np.array(middle)
    normals = linalg.normalize(normals / np.array(radii))
    return Template(
        positions,
        normals,
        np.asarray(ball.uvs, np.float64) * np.array([4.0, 2.0]),
        ball.faces,
        np.ones((len(ball.faces), 3), bool),
        np.full(len(ball.faces), NUMBER[material], np.int32),
    )


def _trunk_sides(patch: Patchwork) -> int:
    return 3 if patch.tolerance >= 0.3 else _TRUNK_SIDES


_ORIGIN = np.array([[0.0, 0.0, 0.0, 1.0, 1.0, 0.0]])


def _round_tree(patch: Patchwork) -> None:
    _ring(patch, _trunk_sides(patch), (0.20, 0.0), (0.13, 3.0), "bark")
    patch.place(_crown(patch, (0.0, 4.3, 0.0), (2.0, 1.9, 2.0), "leaves", 400), _ORIGIN)


def _wide_tree(patch: Patchwork) -> None:
    _ring(patch, _trunk_sides(patch), (0.26, 0.0), (0.16, 3.2), "bark")
    patch.place(_crown(patch, (0.7, 4.0, 0.3), (1.9, 1.5, 1.8), "leaves dark", 401), _ORIGIN)
    patch.place(_crown(patch, (-0.6, 5.0, -0.4), (2.1, 1.7, 2.0), "leaves", 402), _ORIGIN)


def _poplar(patch: Patchwork) -> None:
    _ring(patch, _trunk_sides(patch), (0.18, 0.0), (0.12, 1.6), "bark")
    patch.place(_crown(patch, (0.0, 5.2, 0.0), (1.15, 4.2, 1.15), "leaves light", 403), _ORIGIN)


def _fir(patch: Patchwork) -> None:
    _ring(patch, _trunk_sides(patch), (0.18, 0.0), (0.14, 1.2), "bark")
    for y, radius, high in ((0.9, 1.9, 3.4), (2.6, 1.5, 5.2), (4.3, 1.0, 7.0)):
        _ring(patch, 8, (radius, y), (0.02, high), "leaves dark")
        _disc_under(patch, radius, y)


def _disc_under(patch: Patchwork, radius: float, y: float) -> None:
    below = Patchwork()
    _disc(below, 8, radius, y, "leaves dark")
    flipped = below.template().positions.reshape(-1, 4, 3)[:, ::-1]
    patch.add(flipped, NUMBER["leaves dark"])


def _lamp(patch: Patchwork) -> None:
    sides = 3 if patch.tolerance >= 0.3 else _POLE_SIDES
    _ring(patch, sides, (0.16, 0.0), (0.13, 0.6), "metal")
    _ring(patch, sides, (0.07, 0.6), (0.05, 4.3), "metal")
    _ring(patch, 4, (0.16, 4.3), (0.26, 4.8), "lamp glass")
    _ring(patch, 4, (0.30, 4.8), (0.02, 5.1), "metal")


def _bench(patch: Patchwork) -> None:
    _box(patch, (-0.9, 0.9), (0.42, 0.50), (-0.22, 0.24), "wood", "ftulrb")
    _box(patch, (-0.9, 0.9), (0.60, 0.92), (-0.28, -0.22), "wood")
    if patch.tolerance >= 0.5:
        return
    for x in (-0.75, 0.67):
        _box(patch, (x, x + 0.08), (0.0, 0.90), (-0.26, 0.18), "metal", "flrb")


def _car(patch: Patchwork, paint: str) -> None:
    """Return a car 4.2 m long that faces +Z."""
    s, o = (-0.85, 0.85), (-2.1, 2.1)
    rough = patch.tolerance >= 0.7
    patch.add(box(_HERE, *s, 0.0 if rough else 0.28, 0.85, *o, "flrbu"), NUMBER[paint])
    patch.add(top(_HERE, *s, 0.85, *o), NUMBER[paint])
    low, high, glass = 0.85, 1.42, NUMBER["tower glass dark"]
    a, b, c, d = -1.75, -1.25, 0.35, 1.0
    y = (low, low, high, high)
    patch.add(quads(_HERE, (-0.8, 0.8, 0.62, -0.62), y, (d, d, c, c)), glass)
    patch.add(quads(_HERE, (0.8, -0.8, -0.62, 0.62), y, (a, a, b, b)), glass)
    patch.add(quads(_HERE, (-0.8, -0.8, -0.62, -0.62), y, (a, d, c, b)), glass)
    patch.add(quads(_HERE, (0.8, 0.8, 0.62, 0.62), y, (d, a, b, c)), glass)
    patch.add(top(_HERE, -0.62, 0.62, high, b, c), NUMBER[paint])
    if rough:
        return
    for x in (-0.88, 0.64):
        for z in (-1.65, 0.95):
            _box(patch, (x, x + 0.24), (0.0, 0.62), (z, z + 0.66), "rubber", "flrb")
    for x in (-0.75, 0.40):
        _box(patch, (x, x + 0.35), (0.55, 0.72), (2.0, 2.12), "trim", "f")
        _box(patch, (x, x + 0.35), (0.55, 0.72), (-2.12, -2.0), "paint red", "b")


def _fountain(patch: Patchwork) -> None:
    _ring(patch, 16, (4.0, 0.0), (4.0, 0.6), "stone")
    _ring(patch, 16, (4.0, 0.6), (3.6, 0.6001), "trim")
    _ring(patch, 16, (3.6, 0.6), (3.6, 0.2), "stone")
    _disc(patch, 16, 3.6, 0.42, "water")
    _ring(patch, 8, (0.5, 0.3), (0.35, 2.0), "stone")
    _ring(patch, 12, (0.4, 1.9), (1.5, 2.3), "stone")
    _disc(patch, 12, 1.45, 2.28, "water")
    _ring(patch, 8, (0.25, 2.2), (0.02, 3.4), "stone")


def _church(patch: Patchwork) -> None:
    """Return a church: a nave along Z with its tower towards +Z, 30 m long."""
    wall, roof = "masonry", "roof slate"
    _box(patch, (-5.5, 5.5), (0.0, 9.0), (-17.0, 7.0), wall, "flrb")
    y, near, far = (9.0, 9.0, 15.0, 15.0), 7.2, -17.2
    patch.add(quads(_HERE, (6.0, 6.0, 0.0, 0.0), y, (near, far, far, near)), NUMBER[roof])
    patch.add(quads(_HERE, (-6.0, -6.0, 0.0, 0.0), y, (far, near, near, far)), NUMBER[roof])
    y = (9.0, 9.0, 15.0, 9.0)
    patch.add(quads(_HERE, (0.0, 5.5, 0.0, -5.5), y, (7.0,) * 4), NUMBER[wall])
    patch.add(quads(_HERE, (0.0, -5.5, 0.0, 5.5), y, (-17.0,) * 4), NUMBER[wall])
    _box(patch, (-3.2, 3.2), (0.0, 24.0), (6.0, 12.4), wall, "flrb")
    _box(patch, (-3.5, 3.5), (24.0, 24.6), (5.7, 12.7), "trim", "ftlrbu")
    spire = Patchwork()
    _ring(spire, 8, (3.4, 24.6), (0.02, 42.0), "roof copper")
    patch.place(spire.template(), np.array([[0.0, 0.0, 9.2, 1.0, 1.0, 0.0]]))
    _box(patch, (-1.3, 1.3), (0.0, 3.6), (12.3, 12.45), "door", "f")
    for z in (-14.0, -9.5, -5.0, -0.5):
        _box(patch, (-5.55, 5.55), (2.6, 7.4), (z, z + 1.8), "window", "lr")
    for low in (8.0, 17.5):
        _box(patch, (-1.0, 1.0), (low, low + 4.4), (5.94, 12.45), "window", "fb")
    _box(patch, (-3.25, 3.25), (17.5, 21.9), (8.2, 10.2), "window", "lr")


_MAKERS = {
    "round tree": _round_tree,
    "wide tree": _wide_tree,
    "poplar": _poplar,
    "fir": _fir,
    "lamp": _lamp,
    "bench": _bench,
    "car red": lambda patch: _car(patch, "paint red"),
    "car blue": lambda patch: _car(patch, "paint blue"),
    "car silver": lambda patch: _car(patch, "paint silver"),
    "car black": lambda patch: _car(patch, "paint black"),
    "fountain": _fountain,
    "church": _church,
}
TREES = ("round tree", "wide tree", "poplar", "fir")
CARS = ("car red", "car blue", "car silver", "car black")
