"""A toy steam locomotive with its tender on a piece of track: train.asc, a 3D Studio ASCII file.

z is up, the engine heads towards +X, the tracks lie in y = +-8. Made of boxes and turned profiles;
each part that moves or has a name of its own is an object.
"""

import numpy as np
from asc_files import asc
from noise import value_noise
from surfaces import box, grid
from train_shapes import (
    ACROSS,
    BACKWARD,
    BLACK,
    BRASS,
    COAL,
    COPPER,
    CREAM,
    CROSSWISE,
    DARK_GREEN,
    GLASS,
    GREEN,
    LENGTHWISE,
    RED,
    STEEL,
    UPRIGHT,
    bar,
    block,
    both_sides,
    prism,
    turned,
)
from train_track import GAUGE, RAIL_TOP, ballast, base, rails, sleepers, smoke

from engine3d import linalg

AXLE, WHEEL = 11.2, 7.0  # height and radius of the driving wheels
DRIVERS = (17.5, 2.5, -12.5)
CRANK = (0.6, -0.8)  # direction of the cranks

LIGHTS = [
    ("Light01", (90.0, -110.0, 130.0), (1.0, 0.96, 0.88)),
    ("Light02", (-120.0, -60.0, 60.0), (0.25, 0.30, 0.38)),
]
CAMERA = ("Camera01", (100.0, -142.0, 74.0), (-10.0, 0.0, 20.0), 50.0)


def build():
    """Return the model's files, by name, as functions that make them."""
    return {"train.asc": lambda: asc(objects(), LIGHTS, CAMERA)}


def objects():
    """Return the named parts, each a list of surfaces."""
    return {
        "Boiler": boiler(),
        "Smokebox": smokebox(),
        "Chimney": [turned(CHIMNEY, 24, (29.0, 0.0, 28.6), UPRIGHT, BLACK), chimney_cap()],
        "Domes": domes(),
        "Cab": cab(),
        "Frame": frame(),
        "Splashers": splashers(),
        "Buffers": buffers(),
        "Cylinders": cylinders(),
        "Rods": rods(),
        **wheels(),
        "Tender": tender(),
        "Coal": [coal()],
        "Rails": rails(),
        "Sleepers": sleepers(),
        "Ballast": [ballast()],
        "Base": base(),
        "Smoke": smoke(),
    }


# --- engine -------------------------------------------------------------------------------------

CHIMNEY = [(4.4, -1.2), (3.5, 1.2), (2.9, 3.0), (2.7, 9.0), (3.3, 10.6), (3.3, 10.8)]


def boiler():
    parts = [turned([(8.5, -8.0), (8.5, 26.0)], 32, (0.0, 0.0, 21.0), LENGTHWISE, GREEN)]
    band = [(8.5, -0.5), (8.75, -0.5), (8.75, 0.5), (8.5, 0.5)]
    parts += [turned(band, 32, (x, 0.0, 21.0), LENGTHWISE, BRASS) for x in (-3.0, 6.5, 16.0, 25.4)]
    handrail = turned(
        [(0.0, 0.0), (0.35, 0.0), (0.35, 30.0), (0.0, 30.0)],
        6,
        (-4.0, -9.3, 24.5),
        LENGTHWISE,
        STEEL,
    )
    return parts + both_sides(handrail)


def smokebox():
    body = [(8.9, 25.8), (8.9, 33.0), (8.3, 33.6), (7.4, 33.8)]
    door = [(7.4, 33.8), (6.6, 34.3), (3.5, 34.9), (0.0, 35.1)]
    hub = [(1.1, 34.8), (1.1, 35.7), (0.0, 35.9)]
    parts = [
        turned(profile, 32, (0.0, 0.0, 21.0), LENGTHWISE, material)
        for profile, material in ((body, BLACK), (door, BLACK), (hub, BRASS))
    ]
    hinge = block((34.0, -6.3, 20.6), (35.2, 6.3, 21.4), STEEL)
    saddle = block((26.5, -5.5, 11.0), (32.5, 5.5, 15.0), BLACK)
    return [*parts, hinge, saddle]


def chimney_cap():
    profile = [
        (2.9, 10.4),
        (3.9, 10.8),
        (4.1, 11.8),
        (3.6, 12.2),
        (2.6, 12.2),
        (2.4, 9.5),
        (0.0, 9.5),
    ]
    return turned(profile, 24, (29.0, 0.0, 28.6), UPRIGHT, COPPER)


def domes():
    steam = [(4.6, -2.0), (3.9, 0.2), (3.7, 3.2), (3.2, 4.8), (2.0, 5.9), (0.0, 6.3)]
    sand = [(3.9, -2.0), (3.4, 0.2), (3.3, 1.8), (2.5, 3.0), (0.0, 3.5)]
    whistle = [(0.5, -1.0), (0.5, 2.6), (1.1, 2.8), (1.1, 5.2), (0.5, 5.6), (0.0, 5.6)]
    return [
        turned(steam, 24, (11.0, 0.0, 29.3), UPRIGHT, BRASS),
        turned(sand, 24, (20.5, 0.0, 29.3), UPRIGHT, GREEN),
        turned(whistle, 12, (-4.8, 1.8, 29.3), UPRIGHT, COPPER),
        turned(whistle, 12, (-4.8, -1.8, 29.3), UPRIGHT, BRASS),
    ]


def cab():
    """Walls with windows let in, a curved roof."""
    parts = [block((-10.0, -11.0, 14.0), (-8.0, 11.0, 33.0), GREEN)]
    side = [
        (-25.0, 14.0),
        (-9.9, 14.0),
        (-9.9, 33.0),
        (-25.0, 33.0),
        (-25.0, 27.5),
        (-21.5, 24.5),
        (-21.5, 21.0),
        (-25.0, 21.0),
    ]
    parts += both_sides(prism(side, -11.0, -10.0, GREEN))
    for width, height, depth, material in ((7.6, 8.4, 0.25, CREAM), (6.4, 7.2, 0.45, GLASS)):
        x, z = -15.4, 27.0
        window = block(
            (x - width / 2, -11.0 - depth, z - height / 2),
            (x + width / 2, -10.5, z + height / 2),
            material,
        )
        parts += both_sides(window)
    for material, inset, z0, z1 in ((BRASS, 0.0, 15.4, 20.6), (GREEN, 0.5, 15.9, 20.1)):
        low, high = (-24.0 + inset, -11.2 - 0.2 * inset, z0), (-11.0 - inset, -10.5, z1)
        parts += both_sides(block(low, high, material))
    for y in (-5.6, 5.6):
        parts.append(block((-8.4, y - 2.4, 28.2), (-7.8, y + 2.4, 31.8), CREAM))
        parts.append(block((-8.2, y - 1.9, 28.7), (-7.6, y + 1.9, 31.3), GLASS))
    parts.append(
        turned([(6.6, 0.0), (6.6, 0.3), (0.0, 0.3)], 24, (-10.1, 0.0, 21.0), BACKWARD, BLACK)
    )
    parts.append(
        turned([(1.5, 0.0), (1.5, 0.8), (0.0, 0.8)], 12, (-10.3, 0.0, 18.5), BACKWARD, BRASS)
    )
    return [*parts, roof()]


def roof():
    """A vault over the cab, as a closed shell."""
    t = np.arange(13) / 12.0
    y = 25.0 * t - 12.5
    top = 33.0 + 4.2 * (1.0 - (2.0 * t - 1.0) ** 2)
    outline = [*zip(y, top, strict=True), *zip(y[::-1], top[::-1] - 0.9, strict=True)]
    # The outline lies in (y, z); turn it so that the prism runs along x.
    shell = prism(outline[::-1], 6.5, 27.5, BLACK)
    return shell.moved(ACROSS)


def frame():
    parts = [
        block((-26.0, -11.6, 12.6), (34.0, 11.6, 14.0), BLACK),
        block((-24.0, -5.4, 7.6), (33.0, 5.4, 12.6), BLACK),
        block((-9.0, -5.0, 9.0), (-1.0, 5.0, 16.0), BLACK),
        block((34.0, -11.6, 8.8), (35.4, 11.6, 14.4), RED),
        block((-30.0, -1.0, 9.6), (-23.0, 1.0, 11.0), BLACK),
    ]
    for side in (-1.0, 1.0):
        low, high = sorted((side * 11.65, side * 11.85))
        parts.append(block((-26.0, low, 12.5), (34.0, high, 14.1), RED))
        low, high = sorted((side * 8.0, side * 11.0))
        parts.append(block((-24.0, low, 5.2), (-20.0, high, 6.2), BLACK))
        parts.append(block((-22.6, min(0.85 * low, low), 6.2), (-21.6, high, 12.6), BLACK))
    return parts


def splashers():
    """Covers over the driving wheels, where these reach above the footplate."""
    parts = []
    for x in DRIVERS[:2]:
        edge, plate = (8.7, -11.2, -10.4, BRASS), (8.0, -11.4, -10.8, DARK_GREEN)
        for radius, low, high, material in ((8.4, -10.6, -6.2, GREEN), edge, plate):
            cosine, sine = linalg.unit_circle(32)
            arc = [(x + radius * c, AXLE + radius * s) for c, s in zip(cosine, sine, strict=True)]
            outline = [(px, pz) for px, pz in arc if pz > 14.0]
            parts += both_sides(prism(outline, low, high, material))
    return parts


def buffers():
    buffer = [(1.5, 35.2), (1.2, 37.6), (2.8, 37.8), (2.8, 38.4), (0.0, 38.9)]
    lamp = [(0.0, 0.0), (1.3, 0.0), (1.3, 2.6), (0.7, 3.3), (0.7, 3.9), (0.0, 3.9)]
    lens = [(1.0, 0.0), (1.0, 0.6), (0.0, 0.9)]
    parts = []
    parts += both_sides(turned(buffer, 16, (0.0, -8.0, 11.6), LENGTHWISE, STEEL))
    parts += both_sides(turned(lamp, 12, (34.0, -8.0, 14.0), UPRIGHT, BRASS))
    parts += both_sides(turned(lens, 12, (35.0, -8.0, 15.4), LENGTHWISE, CREAM))
    parts.append(block((35.3, -0.7, 10.2), (38.6, 0.7, 11.4), STEEL))
    return parts


def cylinders():
    """The two steam cylinders before the driving wheels, with their guides."""
    body = [(0.0, 22.4), (2.2, 22.4), (3.7, 22.6), (3.7, 32.4), (2.2, 32.6), (0.0, 32.8)]
    parts = []
    parts += both_sides(turned(body, 20, (0.0, -11.2, 9.8), LENGTHWISE, GREEN))
    for x in (23.2, 31.2):
        ring = [(3.7, x), (3.95, x), (3.95, x + 0.8), (3.7, x + 0.8)]
        parts += both_sides(turned(ring, 20, (0.0, -11.2, 9.8), LENGTHWISE, BRASS))
    parts += both_sides(block((23.5, -11.4, 12.0), (31.0, -6.0, 12.8), BLACK))
    return parts


def pin(x, axle=AXLE, arm=3.0):
    """Where the rods hold a wheel."""
    return x + arm * CRANK[0], axle + arm * CRANK[1]


def rods():
    crosshead = (20.4, 9.8)
    parts = [
        bar(pin(DRIVERS[2]), pin(DRIVERS[0]), 0.8, -11.2, STEEL),
        bar(pin(DRIVERS[1]), crosshead, 0.7, -12.0, STEEL),
        block((18.9, -12.3, 8.6), (21.9, -10.2, 11.0), STEEL),
        turned([(0.45, 20.0), (0.45, 23.0)], 8, (0.0, -11.2, 9.8), LENGTHWISE, STEEL),
    ]
    boss = [(0.0, -1.9), (1.25, -1.9), (1.25, 0.0), (0.0, 0.0)]
    for x in DRIVERS:
        px, pz = pin(x)
        parts.append(turned(boss, 12, (px, -10.3, pz), CROSSWISE, BRASS))
    return [copy for part in parts for copy in both_sides(part)]


# --- wheels -------------------------------------------------------------------------------------


def wheel(x, radius, spokes):
    """A spoked wheel with tyre and flange at y = -GAUGE, its outer face towards -Y."""
    place = (x, -GAUGE, RAIL_TOP + radius)
    inner, columns = radius - 1.5, 2 * spokes
    tyre = [(inner, -0.9), (radius, -0.9), (radius, 0.6), (radius + 0.7, 0.9), (radius + 0.7, 1.4)]
    tyre += [(inner, 1.4), (inner, -0.9)]
    hub = [(0.0, 1.2), (1.7, 1.2), (1.7, -1.0), (0.9, -1.5), (0.0, -1.5)][::-1]
    parts = [
        turned(tyre, columns, place, CROSSWISE, STEEL),
        turned(hub, 14, place, CROSSWISE, RED),
    ]
    rim = [
        (inner - 0.8, -0.7),
        (inner + 0.05, -0.7),
        (inner + 0.05, 1.2),
        (inner - 0.8, 1.2),
        (inner - 0.8, -0.7),
    ]
    parts.append(turned(rim, columns, place, CROSSWISE, RED))
    cosine, sine = linalg.unit_circle(spokes)
    for c, s in zip(cosine, sine, strict=True):
        reach = inner - 0.5
        spoke = box((reach, 0.8, 0.8), (0.5 * reach, 0.1, 0.0)).labelled(RED)
        turn = np.array([(c, 0, -s, 0), (0, 1, 0, 0), (s, 0, c, 0), (0, 0, 0, 1)], np.float64)
        parts.append(spoke.moved(linalg.multiply(linalg.translation(place), turn)))
    return parts


def wheels():
    """Objects for all axles: drivers, the leading axle, two axles of the tender."""
    axles = [(x, WHEEL, 12) for x in DRIVERS] + [(28.5, 4.0, 8), (-36.0, 4.6, 8), (-51.0, 4.6, 8)]
    objects = {}
    for k, (x, radius, spokes) in enumerate(axles):
        axle = [(0.8, -GAUGE), (0.8, GAUGE)]
        parts = [copy for part in wheel(x, radius, spokes) for copy in both_sides(part)]
        parts.append(turned(axle, 10, (x, 0.0, RAIL_TOP + radius), CROSSWISE, STEEL))
        objects[f"Wheels{k + 1:02d}"] = parts
    return objects


# --- tender -------------------------------------------------------------------------------------


def tender():
    parts = [
        block((-57.0, -11.0, 11.6), (-29.0, 11.0, 13.4), BLACK),
        block((-56.0, -6.0, 7.6), (-30.0, 6.0, 11.6), BLACK),
        block((-58.2, -11.0, 8.8), (-57.0, 11.0, 13.8), RED),
        block((-56.0, -10.4, 13.4), (-31.0, 10.4, 20.0), GREEN),
    ]
    for low, high in (
        ((-56.0, -10.4, 20.0), (-31.0, -9.4, 24.5)),
        ((-56.0, 9.4, 20.0), (-31.0, 10.4, 24.5)),
        ((-56.0, -10.4, 20.0), (-55.0, 10.4, 24.5)),
        ((-32.0, -10.4, 20.0), (-31.0, 10.4, 22.5)),
    ):
        parts.append(block(low, high, GREEN))
    for inset, z0, z1, material in ((0.0, 15.0, 22.6, BRASS), (0.5, 15.5, 22.1, DARK_GREEN)):
        y = -10.6 - 0.2 * inset
        parts += both_sides(block((-54.5 + inset, y, z0), (-32.5 - inset, -10.0, z1), material))
    buffer = [(1.5, 0.0), (1.2, 2.2), (2.8, 2.4), (2.8, 3.0), (0.0, 3.5)]
    parts += both_sides(turned(buffer, 16, (-58.2, -8.0, 11.6), BACKWARD, STEEL))
    return parts


def coal():
    """A heap with lumps, one face each."""
    t = np.arange(15) / 14.0
    u, v = np.meshgrid(t, np.arange(11) / 10.0)
    x, y = -55.2 + 23.4 * u, -9.6 + 19.2 * v
    heap = 16.0 * u * (1.0 - u) * v * (1.0 - v)
    z = 20.6 + 4.6 * heap + 1.3 * value_noise(0.7 * x, 0.7 * y, 0.5 * x, seed=3)
    part = grid(np.stack((x, y, z), axis=-1), np.stack((u, v), axis=-1))
    return part.labelled(COAL)
