"""The island's ground and the sea around it: their shape, and the texture of both.

Out: height of the land anywhere, surfaces for land and sea, and the ground texture, which shows
the land from above on its left half and the sea on its right half. y is up, the sea at y = 0.
"""

import numpy as np
from images import bump, clamp, gradient, lerp, mix, paint, rgb, smoothstep
from noise import fractal_noise, ridged_noise
from surfaces import closed_circle, grid

SIZE = 512  # pixels of each half of the texture
LAND_EXTENT = 4.1  # half the side of the square that the left half shows
SEA_RADIUS = 5.0

TOWER = (-1.45, -0.95, 1.62)  # x, z and height of levelled ground
COTTAGE = (0.55, -0.15, 0.72)
JETTY = ((1.75, 2.15), (2.75, 3.35))  # on land, and in the water
PATH = (
    (1.75, 2.15),
    (1.5, 1.3),
    (0.95, 0.75),
    (0.1, 0.7),
    (-0.55, 0.25),
    (-0.8, -0.35),
    (-1.3, -0.5),
)


def distance_to(place, x, z):
    dx, dz = x - place[0], z - place[1]
    return np.sqrt(dx * dx + dz * dz)


def distance_to_path(points, x, z):
    """Distance from a polyline in the plan."""
    nearest = np.full(np.shape(x), 1e9)
    for (ax, az, *_), (bx, bz, *_) in zip(points[:-1], points[1:], strict=True):
        ux, uz = bx - ax, bz - az
        t = clamp(((x - ax) * ux + (z - az) * uz) / (ux * ux + uz * uz))
        nearest = np.minimum(nearest, distance_to((ax + t * ux, az + t * uz), x, z))
    return nearest


def height(x, z):
    """Height of the ground over the sea at points of the plan."""
    bays = 0.85 * fractal_noise(x * 0.42, 0.3, z * 0.42, 3, seed=3)
    inland = 3.35 + bays - np.sqrt(x * x + 1.2 * z * z)
    ground = lerp(-0.9, 0.42, smoothstep(-1.3, 0.9, inland))
    rough = fractal_noise(x * 1.3, 4.0, z * 1.3, 4, seed=21)
    hill = 1.55 * smoothstep(2.35, 0.75, distance_to(TOWER, x, z) + 0.45 * rough)
    knoll = 0.85 * smoothstep(1.7, 0.2, distance_to((1.7, -1.25), x, z) + 0.3 * rough)
    ground = ground + (hill + knoll) * smoothstep(-0.7, 0.35, inland)
    ground = ground + 0.16 * rough * smoothstep(-0.8, 0.6, inland)
    for px, pz, level, radius in ((*TOWER, 0.95), (*COTTAGE, 1.15)):
        flat = smoothstep(radius, 0.6 * radius, distance_to((px, pz), x, z))
        ground = lerp(ground, level, flat)
    return ground


def slope(x, z):
    """Steepness of the ground, rise over run."""
    step = 0.03
    across = height(x + step, z) - height(x - step, z)
    along = height(x, z + step) - height(x, z - step)
    return np.sqrt(across * across + along * along) / (2.0 * step)


# --- surfaces -----------------------------------------------------------------------------------


def land_surface(cells=72):
    """The land down to a little below the sea, as a grid of quads."""
    t = np.arange(cells + 1) / cells
    u, v = np.meshgrid(t, t)
    x, z = (2.0 * u - 1.0) * LAND_EXTENT, (1.0 - 2.0 * v) * LAND_EXTENT
    part = grid(np.stack((x, height(x, z), z), axis=-1), np.stack((0.5 * u, v), axis=-1))
    low = part.positions[:, 1] < -0.22
    return part.without(low).labelled("ground", "land")


def sea_surface(rings=22, columns=72):
    """The sea, a disc with low waves."""
    cosine, sine = closed_circle(columns)
    r = SEA_RADIUS * np.arange(rings + 1)[:, np.newaxis] / rings
    x, z = -r * sine, -r * cosine
    swell = 0.05 * fractal_noise(0.8 * x + 3.0, 0.0, 1.1 * z, 2, seed=40)
    y = swell * smoothstep(SEA_RADIUS, 0.93 * SEA_RADIUS, r)
    # Rows go up when seen from outside: from the rim to the centre.
    points = np.stack((x, y, z), axis=-1)[::-1]
    uvs = sea_uvs(x, z)[::-1]
    return grid(points, uvs).labelled("sea", "sea")


def sea_uvs(x, z):
    u, v = 0.5 + 0.498 * x / SEA_RADIUS, 0.5 - 0.498 * z / SEA_RADIUS
    return np.stack((0.5 + 0.5 * u, v), axis=-1)


# --- texture ------------------------------------------------------------------------------------


def ground_texture(shaded):
    """Paint land and sea.

    `shaded` holds (x, z, radius) of what stands on the ground: it is darker around it.
    """

    def land(u, v):
        return land_picture((2.0 * u - 1.0) * LAND_EXTENT, (1.0 - 2.0 * v) * LAND_EXTENT, shaded)

    def sea(u, v):
        reach = SEA_RADIUS / 0.996
        return sea_picture((2.0 * u - 1.0) * reach, (1.0 - 2.0 * v) * reach)

    return np.hstack((paint(land, SIZE, SIZE, 2), paint(sea, SIZE, SIZE, 2)))


def land_picture(x, z, shaded):
    y, steep = height(x, z), slope(x, z)
    fine = fractal_noise(x * 9.0, 1.0, z * 9.0, 3, seed=60)
    broad = fractal_noise(x * 1.1, 2.0, z * 1.1, 3, seed=61)
    meadow = gradient(
        ((-0.5, rgb("#4f8434")), (0.0, rgb("#6f9f3f")), (0.5, rgb("#a3b255"))), broad + 0.45 * fine
    )
    flowers = smoothstep(0.55, 0.62, fractal_noise(x * 16.0, 7.0, z * 16.0, 2, seed=62))
    patch = smoothstep(0.05, 0.3, fractal_noise(x * 1.7, 9.0, z * 1.7, 2, seed=63))
    meadow = mix(meadow, rgb("#f4e9b0"), 0.8 * flowers * patch)
    sand = mix(rgb("#ead7a4"), rgb("#d5bb80"), clamp(0.5 + fine))
    sand = mix(rgb("#a98d5f"), sand, smoothstep(-0.02, 0.12, y))
    strata = ridged_noise(x * 1.3, y * 5.0, z * 1.3, 4, seed=64)
    rock = gradient(
        ((0.35, rgb("#5e564f")), (0.6, rgb("#8b8075")), (0.85, rgb("#b3a897"))), strata + 0.2 * fine
    )
    color = mix(sand, meadow, smoothstep(0.30, 0.42, y + 0.10 * fine + 0.08 * broad))
    color = mix(color, rock, smoothstep(0.75, 1.0, steep + 0.25 * fine))
    trail = smoothstep(0.15, 0.08, distance_to_path(PATH, x, z) + 0.04 * fine)
    yard = smoothstep(0.80, 0.70, distance_to(TOWER, x, z) + 0.05 * fine)
    color = mix(
        color, mix(rgb("#d9c59a"), rgb("#b79f74"), clamp(0.5 + fine)), np.maximum(trail, yard)
    )
    shade = np.ones(np.shape(x))
    for px, pz, radius in shaded:
        shade = shade * (1.0 - 0.5 * bump(distance_to((px, pz), x, z), 0.0, 1.7 * radius))
    return color * shade[..., np.newaxis]


def sea_picture(x, z):
    depth = -height(x, z)
    wave = fractal_noise(x * 1.5, 3.0, z * 2.6, 4, seed=70)
    water = gradient(
        (
            (0.0, rgb("#8fdccb")),
            (0.25, rgb("#4fbfc0")),
            (0.6, rgb("#2590b0")),
            (0.9, rgb("#17698f")),
        ),
        depth + 0.12 * wave,
    )
    crest = ridged_noise(x * 1.2 + 0.4 * wave, 6.0, z * 2.0, 3, seed=71)
    water = mix(water, rgb("#dff3f0"), 0.45 * smoothstep(0.87, 0.97, crest))
    ripple = fractal_noise(x * 4.0, 8.0, z * 4.0, 3, seed=72)
    for offset, width, strength in ((0.05, 0.07, 0.95), (0.24, 0.035, 0.6)):
        water = mix(water, rgb("#fbfdf8"), strength * bump(depth + 0.09 * ripple, offset, width))
    return water
