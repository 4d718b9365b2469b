"""A globe of an invented world, drawn like an old map, on a turned stand: globe.obj, .mtl, .webp.

Continents are where a noise on the sphere is high; mountains stand out a little. The ball leans
as the Earth does and turns on pins in a brass half meridian.
"""

import numpy as np
from globe_map import MAP_HEIGHT, MAP_WIDTH, elevation, map_picture, stand_picture
from images import paint, webp
from model_files import mtl, obj
from surfaces import Surface, closed_circle, grid, lathe

from engine3d import linalg

TILT = 23.4 * np.pi / 180.0
CENTRE = (0.0, 2.05, 0.0)
RELIEF = 0.035
RING_RADIUS = 1.14

WOOD, BRASS = (0.03, 0.03, 0.47, 0.97), (0.53, 0.03, 0.97, 0.97)  # halves of the stand's texture


def build():
    """Return the model's files, by name, as functions that make them."""
    materials = {
        "map": {"Kd": (1, 1, 1), "Ks": (0.12, 0.12, 0.12), "Ns": 25, "map_Kd": "globe.webp"},
        "wood": {"Kd": (1, 1, 1), "Ks": (0.2, 0.2, 0.2), "Ns": 40, "map_Kd": "globe_stand.webp"},
        "brass": {"Kd": (1, 1, 1), "Ks": (0.8, 0.65, 0.35), "Ns": 60, "map_Kd": "globe_stand.webp"},
    }
    title = "A globe of an invented world"
    return {
        "globe.obj": lambda: obj(title, [ball(), *meridian(), *foot()], "globe.mtl"),
        "globe.mtl": lambda: mtl(title, materials),
        "globe.webp": lambda: webp(paint(map_picture, MAP_WIDTH, MAP_HEIGHT, 2)),
        "globe_stand.webp": lambda: webp(paint(stand_picture, 256, 128, 2)),
    }


def leaning():
    """The pose of the ball: its axis leans to the right."""
    return linalg.multiply(linalg.translation(CENTRE), linalg.rotation_z(-TILT))


def ball(around=96, bands=48):
    """The sphere with its mountains, u eastward from the date line at -Z."""
    cosine, sine = closed_circle(around)
    rise, reach = (values[: bands + 1] for values in closed_circle(2 * bands))
    reach, rise = reach[:, np.newaxis], -rise[:, np.newaxis]
    points = np.stack((-reach * sine, rise + 0.0 * sine, -reach * cosine), axis=-1)
    height = np.maximum(elevation(*np.moveaxis(points, -1, 0)), 0.0)
    points = points * (1.0 + RELIEF * height[..., np.newaxis])
    u, v = np.meshgrid(np.arange(around + 1) / around, np.arange(bands + 1) / bands)
    part = grid(points, np.stack((u, v), axis=-1))
    return part.moved(leaning()).labelled("map", "ball")


def meridian():
    """A brass ring from the north pole round to below the ball, and a knob at each pole."""
    steps, half_width = 48, 0.045
    section = [(-half_width, -0.03), (half_width, -0.03), (half_width, 0.03), (-half_width, 0.03)]
    # From a little past the lowest point, where the foot holds it, by -X to the north pole.
    turn = (np.pi + 1.35 * TILT) * np.arange(steps + 1) / steps - 1.35 * TILT
    out, up = linalg.sin(turn), -linalg.cos(turn)
    radii = [RING_RADIUS + thickness for _, thickness in section]
    rows = np.array(
        [(-r * out, r * up, z + 0.0 * out) for r, (z, _) in zip(radii, section, strict=True)]
    )
    rows = np.moveaxis(rows, 2, 0)
    u0, v0, u1, v1 = BRASS
    u, v = np.meshgrid((u0, u1), v0 + (v1 - v0) * np.arange(steps + 1) / steps)
    uvs = np.stack((u, v), axis=-1)
    parts = [grid(rows[:, [k, (k + 1) % 4]], uvs) for k in range(4)]
    corners = [(u0, v0), (u1, v0), (u1, v1), (u0, v1)]
    parts += [Surface(end, corners, [(0, 1, 2, 3)]) for end in (rows[0, ::-1], rows[-1])]
    pin = [(0.0, 0.98), (0.05, 0.98), (0.05, 1.15), (0.08, 1.17), (0.08, 1.20), (0.05, 1.21)]
    pin += [(0.07, 1.23), (0.085, 1.26), (0.08, 1.30), (0.05, 1.335), (0.0, 1.345)]
    knob = lathe(pin, 24, BRASS)
    parts += [knob, knob.moved(linalg.rotation_z(np.pi))]
    return [part.moved(leaning()).labelled("brass", "meridian") for part in parts]


def foot():
    """A turned foot of wood with brass rings, up to the lowest point of the meridian."""
    wood = [(0.0, 0.0), (0.86, 0.0), (0.90, 0.05), (0.90, 0.10), (0.84, 0.15), (0.70, 0.18)]
    wood += [(0.45, 0.24), (0.24, 0.32), (0.15, 0.40), (0.13, 0.46)]
    vase = [(0.11, 0.50), (0.16, 0.56), (0.19, 0.63), (0.17, 0.70), (0.11, 0.76), (0.09, 0.80)]
    collar = [(0.13, 0.44), (0.17, 0.46), (0.17, 0.50), (0.11, 0.52)]
    cup = [(0.08, 0.79), (0.12, 0.80), (0.13, 0.84), (0.10, 0.88), (0.07, 0.93), (0.0, 0.93)]
    parts = [
        lathe(wood, 40, WOOD).labelled("wood"),
        lathe(vase, 32, WOOD).labelled("wood"),
        lathe(collar, 32, BRASS).labelled("brass"),
        lathe(cup, 32, BRASS).labelled("brass"),
    ]
    return [part.labelled(part.material, "foot") for part in parts]
