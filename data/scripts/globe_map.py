"""The map on the globe: continents, tints, coast lines, graticule, compass roses.

In: texture coordinates, an equirectangular map whose middle is the meridian at +Z. Out: colours,
and the elevation that also shapes the ball. Noise is taken in space, so that the map has no seam.
"""

import numpy as np
from images import clamp, gradient, mix, rgb, smoothstep, stroke
from noise import fractal_noise, ridged_noise

from engine3d import linalg

MAP_WIDTH, MAP_HEIGHT = 1024, 512
INK = rgb("#5b3f27")
ROSES = ((-0.45, -0.62), (-2.07, 0.40))  # longitude, latitude of the compass roses


def elevation(x, y, z):
    """Height at points of the unit sphere: 0 at the coast, about 1 on the highest mountains."""
    bend = 0.45 * fractal_noise(1.7 * x + 5.0, 1.7 * y, 1.7 * z, 3, seed=606)
    broad = fractal_noise(1.5 * x + bend, 1.5 * y + 2.0 - bend, 1.5 * z + bend, 6, 106, 0.55)
    ridges = ridged_noise(2.1 * x, 2.1 * y, 2.1 * z + 3.0, 4, seed=37)
    mountains = smoothstep(0.70, 0.95, ridges) * smoothstep(0.06, 0.26, broad)
    return 1.3 * (broad - 0.04) + 0.75 * mountains


def coast_distance(height, latitude):
    """Distance from the coast in radians, about, negative at sea, from a whole map of heights."""
    rows, columns = height.shape
    eastward = (np.roll(height, -1, axis=1) - np.roll(height, 1, axis=1)) * columns / (4.0 * np.pi)
    eastward = eastward / np.maximum(linalg.cos(latitude), 0.02)
    padded = np.vstack((height[:1], height, height[-1:]))
    northward = (padded[:-2] - padded[2:]) * rows / (2.0 * np.pi)
    steepness = np.sqrt(eastward * eastward + northward * northward)
    return height / np.maximum(steepness, 0.35)


def on_sphere(u, v):
    """Points, longitude and latitude of texture coordinates."""
    longitude, latitude = 2.0 * np.pi * (u - 0.5), np.pi * (v - 0.5)
    level = linalg.cos(latitude)
    point = level * linalg.sin(longitude), linalg.sin(latitude), level * linalg.cos(longitude)
    return point, longitude, latitude


def map_picture(u, v):
    """The whole map at once: `coast_distance` compares neighbours."""
    (x, y, z), longitude, latitude = on_sphere(u, v)
    height = elevation(x, y, z)
    coast = coast_distance(height, latitude)
    grain = fractal_noise(14.0 * x, 14.0 * y, 14.0 * z, 3, seed=33)
    stain = fractal_noise(2.0 * x, 2.0 * y + 4.0, 2.0 * z, 3, seed=34)
    sea = graticule(sea_color(height, coast, grain), longitude, latitude, 0.30)
    for place in ROSES:
        sea = compass_rose(sea, (x, y, z), place)
    land = land_color(height, coast, stain, grain, (x, y, z))
    land = graticule(land, longitude, latitude, 0.16)
    color = mix(sea, land, smoothstep(-0.003, 0.003, coast))
    color = mix(color, INK, 0.9 * stroke(np.abs(coast), 0.0035, 0.004))
    color = mix(color, rgb("#f6f3ea"), smoothstep(0.955, 0.97, np.abs(y) + 0.02 * stain))
    aged = clamp(0.5 + 0.6 * stain + 0.25 * grain)
    return color * (0.90 + 0.10 * aged)[..., np.newaxis]


def sea_color(height, coast, grain):
    """Sea-green paper, with lines along the coasts as engravers drew them."""
    tones = ((0.0, rgb("#bcd6c3")), (0.10, rgb("#9cc4bd")), (0.5, rgb("#7bacb2")))
    color = gradient(tones, -height + 0.03 * grain)
    for k in range(4):
        line = stroke(np.abs(coast + 0.014 + 0.012 * k), 0.0018, 0.004)
        color = mix(color, rgb("#3f6f78"), (0.70 - 0.15 * k) * line)
    return color


def land_color(height, coast, stain, grain, point):
    """Tints by climate: ice, woods, steppe, desert, rain forest; hatched mountains."""
    x, y, z = point
    latitude = np.abs(y) + 0.10 * stain
    belts = (
        (0.08, rgb("#a9bf7a")),
        (0.28, rgb("#e3c98a")),
        (0.48, rgb("#e6d39c")),
        (0.62, rgb("#b7c288")),
        (0.80, rgb("#c6c9a4")),
        (0.90, rgb("#f3efe2")),
    )
    color = gradient(belts, latitude)
    color = mix(color, rgb("#efdcae"), 0.6 * smoothstep(0.06, 0.0, coast))
    peak = smoothstep(0.45, 0.95, height + 0.10 * grain)
    color = mix(color, rgb("#b98f5f"), peak)
    hatching = fractal_noise(26.0 * x, 26.0 * y, 26.0 * z, 2, seed=35)
    return mix(color, INK, 0.55 * peak * smoothstep(0.10, 0.35, hatching))


def graticule(color, longitude, latitude, strength):
    """Lines every 15 degrees; the equator doubled, tropics and polar circles dashed."""
    step = np.pi / 12.0
    level = linalg.cos(latitude)

    def nearest(angle):
        return np.abs(angle - step * np.rint(angle / step))

    lines = stroke(nearest(longitude) * level, 0.0022, 0.004) * (level > 0.08)
    lines = np.maximum(lines, stroke(nearest(latitude), 0.0022, 0.004))
    color = mix(color, INK, strength * lines)
    double = np.abs(np.abs(latitude) - 0.011)
    color = mix(color, rgb("#8c2f22"), 2.0 * strength * stroke(double, 0.003, 0.004))
    dashes = smoothstep(-0.1, 0.1, linalg.sin(72.0 * longitude))
    for degrees in (23.4, 66.6):
        circle = stroke(np.abs(np.abs(latitude) - degrees * np.pi / 180.0), 0.003, 0.004)
        color = mix(color, rgb("#8c2f22"), 2.0 * strength * circle * dashes)
    return color


def compass_rose(color, point, place):
    """A rose of sixteen points, drawn in the plane that touches the sphere at its place."""
    longitude, latitude = place
    east = np.array((linalg.cos(longitude), 0.0, -linalg.sin(longitude)))
    (px, py, pz), _, _ = on_sphere(0.5 + longitude / (2.0 * np.pi), 0.5 + latitude / np.pi)
    north = linalg.cross((px, py, pz), east)
    x, y, z = point
    a = (x * east[0] + y * east[1] + z * east[2]) / 0.26
    b = (x * north[0] + y * north[1] + z * north[2]) / 0.26
    front = x * px + y * py + z * pz > 0.0
    r = np.sqrt(a * a + b * b) + 1e-9
    bearing = linalg.atan2(a, b)
    for count, reach, dark in ((16, 0.62, "#8a6a43"), (8, 0.78, "#3f6f78"), (4, 1.0, "#8c2f22")):
        sector = 2.0 * np.pi / count
        off = bearing - sector * np.rint(bearing / sector)
        # A point is a kite: full width at a fifth of its length.
        along, across = r * linalg.cos(off) / reach, r * np.abs(linalg.sin(off)) / reach
        half = np.minimum(along * 0.55, (1.0 - along) * 0.14)
        inside = stroke(across - half, 0.0, 0.02) * front
        side = np.where(off > 0.0, 1.0, 0.0)
        color = mix(color, mix(rgb("#f3e6c4"), rgb(dark), side), inside)
        color = mix(
            color, INK, 0.8 * stroke(np.abs(across - half), 0.008, 0.016) * (along < 1.0) * front
        )
    for radius in (0.50, 0.54):
        color = mix(color, INK, 0.6 * stroke(np.abs(r - radius), 0.008, 0.016) * front)
    return color


def stand_picture(u, v):
    """Walnut on the left half, brass on the right."""
    angle = 4.0 * np.pi * u
    grain = fractal_noise(1.5 * linalg.cos(angle), 1.5 * linalg.sin(angle), 14.0 * v, 4, seed=36)
    wood = mix(rgb("#7a4a28"), rgb("#43260f"), clamp(0.5 + 0.9 * grain))
    tarnish = fractal_noise(3.0 * linalg.cos(angle), 3.0 * linalg.sin(angle), 6.0 * v, 3, seed=38)
    brass = mix(rgb("#d6a94f"), rgb("#a87c31"), clamp(0.4 + 0.7 * tarnish))
    return mix(wood, brass, (u > 0.5) * 1.0)
