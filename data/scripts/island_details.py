"""The texture of the island's objects: an atlas of small pictures.

Out: where each picture lies, as (u0, v0, u1, v1), and the painted atlas. The upper half is the
tower's wall; below are square tiles, four a row.
"""

import numpy as np
from images import bump, clamp, gradient, mix, paint, rgb, smoothstep
from noise import fractal_noise, ridged_noise

from engine3d import linalg

SIZE = 512
TILES = (("roof", "planks", "cottage", "gable"), ("foliage", "rock", "iron", "hull"))
EXTRA = ("plaster", "water", "sail", "base")
TILE = 1.0 / 4.0


def tile(name):
    """Return the part of the texture, a little inside its borders."""
    margin = 3.0 / SIZE
    if name == "tower":
        return (0.0, 0.5 + margin, 1.0, 0.75 - margin)
    for row, names in enumerate((EXTRA, *TILES)):
        if name in names:
            column = names.index(name)
            low = (0.75, 0.25, 0.0)[row]
            return (
                column * TILE + margin,
                low + margin,
                (column + 1) * TILE - margin,
                low + TILE - margin,
            )
    raise KeyError(name)


def details_texture():
    """Paint the atlas."""
    side, tower = SIZE // 4, paint(tower_picture, SIZE, SIZE // 4, 3)
    rows = [
        np.hstack([paint(PICTURES[name], side, side, 3) for name in names])
        for names in (EXTRA, *TILES)
    ]
    return np.vstack((rows[0], tower, rows[1], rows[2]))


def rectangle(u, v, u0, v0, u1, v1, soft=0.008):
    """Cover 1 inside a rectangle."""
    across = smoothstep(u0 - soft, u0 + soft, u) * smoothstep(u1 + soft, u1 - soft, u)
    return across * smoothstep(v0 - soft, v0 + soft, v) * smoothstep(v1 + soft, v1 - soft, v)


def panel(u, v, x, y, width, height, soft=0.008):
    """Cover 1 inside a rectangle that is given by its centre and size."""
    half_width, half_height = 0.5 * width, 0.5 * height
    return rectangle(u, v, x - half_width, y - half_height, x + half_width, y + half_height, soft)


def weathering(u, v, seed):
    """Rain streaks and stains that go round without a seam, in about [-1, 1]."""
    angle = 2.0 * np.pi * u
    return fractal_noise(6.0 * linalg.cos(angle), 6.0 * linalg.sin(angle), 2.2 * v, 4, seed)


def tower_picture(u, v):
    """Red and white bands, three windows one above the other on two sides, a door."""
    stain = weathering(u, v, 80)
    white = mix(rgb("#f7f3e8"), rgb("#d8d0bf"), clamp(0.25 + 0.8 * stain))
    red = mix(rgb("#c63a2e"), rgb("#9c2a24"), clamp(0.35 + 0.8 * stain))
    bands = smoothstep(-0.02, 0.02, linalg.sin(2.0 * np.pi * (2.5 * v + 0.5)) * 0.12)
    color = mix(white, red, bands)
    for centre, places in ((0.12, (0.42, 0.70)), (0.62, (0.30, 0.56, 0.84))):
        for place in places:
            frame = panel(u, v, centre, place, 0.044, 0.11, 0.006)
            pane = panel(u, v, centre, place, 0.028, 0.08, 0.006)
            color = mix(color, rgb("#efe7d6"), frame)
            color = mix(color, mix(rgb("#2a3440"), rgb("#6d8796"), clamp((v - place) * 12.0)), pane)
    color = mix(color, rgb("#5a4a3a"), rectangle(u, v, 0.335, -0.1, 0.405, 0.24, 0.006))
    color = mix(color, rgb("#2f6a5c"), rectangle(u, v, 0.345, -0.1, 0.395, 0.22, 0.006))
    return mix(color, rgb("#8a7f6e"), 0.6 * smoothstep(0.05, -0.03, v + 0.03 * stain))


def roof_picture(u, v):
    rows = 7.0
    row = np.floor(v * rows)
    shift = 0.5 * (row - 2.0 * np.floor(row / 2.0))
    column = u * 8.0 + shift
    x, y = column - np.floor(column) - 0.5, v * rows - row
    tone = fractal_noise(np.floor(column) * 3.7, row * 2.9, 0.5, 2, seed=90)
    color = mix(rgb("#b5482f"), rgb("#8c3322"), clamp(0.5 + 1.2 * tone))
    lower = smoothstep(0.25, 0.0, y - 0.45 * (0.5 - np.abs(x)))
    return mix(color, rgb("#54211a"), 0.75 * np.maximum(lower, bump(np.abs(x), 0.5, 0.08)))


def planks_picture(u, v):
    board = np.floor(v * 5.0)
    y = v * 5.0 - board
    grain = fractal_noise(u * 3.0 + 9.0 * board, v * 34.0, board, 3, seed=91)
    color = mix(rgb("#a67c4f"), rgb("#7a5634"), clamp(0.45 + 0.7 * grain))
    return mix(color, rgb("#3f2b1a"), 0.8 * bump(np.abs(y - 0.5), 0.5, 0.07))


def plaster_picture(u, v):
    return mix(rgb("#f6f1e4"), rgb("#d9d1bf"), clamp(0.3 + weathering(u, v, 92)))


def window(color, u, v, x, y, width, height):
    """A window with white bars and blue shutters."""
    for side in (-1.0, 1.0):
        shutter = panel(u, v, x + side * 0.78 * width, y, 0.5 * width, height)
        color = mix(color, rgb("#3d6f94"), shutter)
    color = mix(color, rgb("#fbf8f0"), panel(u, v, x, y, width, height))
    pane = panel(u, v, x, y, 0.8 * width, 0.82 * height)
    glass = mix(rgb("#33424f"), rgb("#8fb3c4"), clamp(0.5 + (v - y) / height + (u - x)))
    color = mix(color, glass, pane)
    bars = np.maximum(bump(u, x, 0.012), bump(v, y, 0.016)) * pane
    return mix(color, rgb("#fbf8f0"), clamp(2.0 * bars))


def cottage_picture(u, v):
    """The long wall: a green door between two windows, a stone foot."""
    color = plaster_picture(u, v)
    color = window(color, u, v, 0.21, 0.56, 0.17, 0.36)
    color = window(color, u, v, 0.79, 0.56, 0.17, 0.36)
    color = mix(color, rgb("#fbf8f0"), rectangle(u, v, 0.36, -0.1, 0.56, 0.80))
    color = mix(color, rgb("#2f6a5c"), rectangle(u, v, 0.38, -0.1, 0.54, 0.76))
    groove = np.maximum(
        bump(u, 0.42, 0.008), np.maximum(bump(u, 0.46, 0.008), bump(u, 0.50, 0.008))
    )
    color = mix(color, rgb("#1f4a41"), groove * (v < 0.76))
    color = mix(color, rgb("#e0b64a"), bump(np.sqrt((u - 0.515) ** 2 + (v - 0.38) ** 2), 0.0, 0.02))
    return mix(color, rock_picture(u, v), smoothstep(0.10, 0.08, v) * (np.abs(u - 0.46) > 0.1))


def gable_picture(u, v):
    """The short wall: one window, a round one under the gable."""
    color = window(plaster_picture(u, v), u, v, 0.5, 0.32, 0.26, 0.24)
    r = np.sqrt((u - 0.5) ** 2 + (v - 0.68) ** 2)
    color = mix(color, rgb("#fbf8f0"), smoothstep(0.095, 0.085, r))
    color = mix(color, rgb("#41525f"), smoothstep(0.07, 0.06, r))
    return mix(color, rock_picture(u, v), smoothstep(0.06, 0.05, v))


def foliage_picture(u, v):
    clump = fractal_noise(u * 7.0, v * 7.0, 3.0, 4, seed=93)
    tones = ((0.0, rgb("#24502a")), (0.5, rgb("#3f7d36")), (1.0, rgb("#7fae4b")))
    return gradient(tones, 0.25 + 0.5 * v + 0.7 * clump)


def rock_picture(u, v):
    crack = ridged_noise(u * 5.0, v * 7.0, 2.0, 4, seed=94)
    tones = ((0.4, rgb("#a59a8a")), (0.7, rgb("#857a6e")), (0.95, rgb("#4f4842")))
    return gradient(tones, crack)


def iron_picture(u, v):
    rust = fractal_noise(u * 6.0, v * 6.0, 1.0, 3, seed=95)
    return mix(rgb("#39434a"), rgb("#5a4038"), clamp(0.2 + 0.9 * rust))


def hull_picture(u, v):
    """Planks painted blue, a white strake and a red bottom; v from the keel to the edge."""
    color = mix(rgb("#2d6ea3"), rgb("#f5f1e6"), rectangle(u, v, -1.0, 0.82, 2.0, 0.93))
    color = mix(color, rgb("#b13b2e"), smoothstep(0.42, 0.38, v))
    seams = np.abs(v * 9.0 - np.floor(v * 9.0) - 0.5)
    return mix(color, rgb("#1b2b3a"), 0.35 * bump(seams, 0.5, 0.10))


def water_picture(u, v):
    """The cut through the sea: clear above, dark below, rays of light."""
    rays = weathering(4.0 * u + 0.12 * v, 0.2 * v, 96)
    tones = ((0.0, rgb("#0f3f63")), (0.6, rgb("#1d6f98")), (1.0, rgb("#4fb4c4")))
    return gradient(tones, clamp(v + 0.22 * rays * v))


def sail_picture(u, v):
    """Cloth with seams and a red stripe."""
    fold = fractal_noise(u * 2.0, v * 5.0, 7.0, 3, seed=97)
    color = mix(rgb("#faf5e9"), rgb("#e2d8c3"), clamp(0.3 + 0.6 * fold))
    seam = np.abs(v * 6.0 - np.floor(v * 6.0) - 0.5)
    color = mix(color, rgb("#c8bda6"), 0.7 * bump(seam, 0.5, 0.05))
    return mix(color, rgb("#c2453a"), rectangle(u, v, -1.0, 0.10, 2.0, 0.18))


def base_picture(u, v):
    """Turned walnut: grain that runs round."""
    angle = 2.0 * np.pi * u
    grain = fractal_noise(2.5 * linalg.cos(angle), 2.5 * linalg.sin(angle), 26.0 * v, 4, seed=98)
    return mix(rgb("#6b4426"), rgb("#3d2413"), clamp(0.5 + 0.9 * grain))


PICTURES = {
    "roof": roof_picture,
    "planks": planks_picture,
    "cottage": cottage_picture,
    "gable": gable_picture,
    "foliage": foliage_picture,
    "rock": rock_picture,
    "iron": iron_picture,
    "hull": hull_picture,
    "plaster": plaster_picture,
    "water": water_picture,
    "sail": sail_picture,
    "base": base_picture,
}
