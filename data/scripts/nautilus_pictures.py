"""The textures of the nautilus: the shell's flames, and an atlas for the animal and the reef.

In: texture coordinates. Out: colours. On the shell u follows the growth (evenly in the radius) and
v goes round the section: 0 and 1 inside against the former turn, 1/2 on the outer side.
"""

import numpy as np
from images import bump, clamp, gradient, lerp, mix, paint, rgb, smoothstep
from noise import fractal_noise, ridged_noise

from engine3d import linalg

TILES = (
    ("nacre", "hood", "flesh", "tentacle", "eye"),
    ("rock", "sand", "coral", "weed", "starfish", "wood"),
)
COLUMNS, WIDTH, HEIGHT = 8, 1024, 256


def tile(name):
    """Return the part (u0, v0, u1, v1) of the atlas that shows a picture, within its borders."""
    for row, names in enumerate(TILES):
        if name in names:
            column, low = names.index(name), 0.5 - 0.5 * row
            inset_u, inset_v = 3.0 / WIDTH, 3.0 / HEIGHT
            return (
                column / COLUMNS + inset_u,
                low + inset_v,
                (column + 1) / COLUMNS - inset_u,
                low + 0.5 - inset_v,
            )
    raise KeyError(name)


def reef_texture():
    """Paint the atlas."""
    side = WIDTH // COLUMNS
    rows = []
    for names in TILES:
        row = [paint(PICTURES[name], side, side, 3) for name in names]
        row += [np.ones((side, side, 3)) * 0.5] * (COLUMNS - len(names))
        rows.append(np.hstack(row))
    return np.vstack(rows)


def shell_picture(u, v):
    """Cream with red-brown flames that start at the navel and fade towards the outer side."""
    turn = 2.0 * np.pi * v
    around = linalg.cos(turn), linalg.sin(turn)
    radius = lerp(0.049, 1.0, u)
    # Flames repeat with the angle, the logarithm of the radius: each octave of it has as many.
    phase = flame_phase(radius)
    outer = 0.5 - 0.5 * around[0]  # 0 inside, 1 on the outer side
    warp = fractal_noise(5.0 * u, 1.3 * around[0], 1.3 * around[1], 4, seed=41)
    wave = linalg.sin(2.0 * np.pi * (phase - 0.55 * outer * outer) + 2.6 * warp)
    reach = lerp(
        1.05, 0.38, smoothstep(0.45, 0.95, u)
    )  # how far outward flames come: less with age
    flame = smoothstep(0.05, 0.45, wave + 0.9 * (reach - outer) - 0.35)
    flame = flame * smoothstep(reach + 0.28, reach - 0.10, outer + 0.25 * warp)
    fine = fractal_noise(60.0 * u, 2.0 * around[0], 2.0 * around[1], 3, seed=42)
    cream = mix(rgb("#fbf3e2"), rgb("#e9d4b0"), clamp(0.35 + 0.5 * warp + 0.12 * fine))
    red = gradient(
        ((-0.5, rgb("#6f2413")), (0.1, rgb("#a5421f")), (0.7, rgb("#c9743b"))),
        warp + 0.7 * outer - 0.4,
    )
    color = mix(cream, red, flame)
    growth_lines = bump(np.abs(linalg.sin(2.0 * np.pi * (55.0 * u + 0.8 * outer))), 0.0, 0.25)
    color = mix(color, rgb("#9a7650"), 0.10 * growth_lines)
    color = mix(color, rgb("#4a2a1c"), 0.55 * smoothstep(0.16, 0.03, outer))
    return mix(color, rgb("#2f1d16"), 0.8 * smoothstep(0.975, 1.0, u) * smoothstep(0.5, 0.2, outer))


def flame_phase(radius):
    """Ten times the binary logarithm of the radius: piecewise quadratic, which is near enough."""
    phase, low = np.zeros(np.shape(radius)), 1.0 / 32.0
    for _ in range(5):
        t = clamp(radius / low - 1.0)
        phase = phase + t * (1.3465 - 0.3465 * t)
        low *= 2.0
    return 8.0 * phase


def nacre_picture(u, v):
    sheen = fractal_noise(3.0 * u, 3.0 * v, 1.0, 3, seed=43)
    tones = ((-0.5, rgb("#f3d9d6")), (0.0, rgb("#f7f0ea")), (0.5, rgb("#d3e6e2")))
    return mix(gradient(tones, sheen), rgb("#5a4038"), 0.75 * smoothstep(0.3, 1.0, u))


def hood_picture(u, v):
    """Leather, rust-red with white blotches and warts."""
    blotch = fractal_noise(7.0 * u, 7.0 * v, 2.0, 4, seed=44)
    wart = ridged_noise(14.0 * u, 14.0 * v, 3.0, 2, seed=45)
    color = mix(rgb("#a8502c"), rgb("#6e2e1a"), clamp(0.5 + 0.8 * blotch))
    color = mix(color, rgb("#f0dcc0"), 0.85 * smoothstep(0.18, 0.30, blotch))
    return mix(color, rgb("#4d1f12"), 0.4 * smoothstep(0.75, 0.92, wart))


def flesh_picture(u, v):
    tone = fractal_noise(6.0 * u, 6.0 * v, 4.0, 3, seed=46)
    return mix(rgb("#f2d8bb"), rgb("#d09a78"), clamp(0.45 + 0.8 * tone))


def tentacle_picture(u, v):
    """Pale sheaths, rings towards the tips."""
    rings = np.abs(linalg.sin(2.0 * np.pi * 9.0 * v))
    color = mix(rgb("#f4e0c4"), rgb("#d79a6a"), smoothstep(0.0, 1.0, v))
    return mix(color, rgb("#a8603c"), 0.35 * smoothstep(0.5, 0.0, rings) * smoothstep(0.25, 0.5, v))


def eye_picture(u, v):
    """From the stalk (v = 0) to the pupil (v = 1)."""
    tones = (
        (0.0, rgb("#b06a44")),
        (0.45, rgb("#8a4526")),
        (0.60, rgb("#f3e3bf")),
        (0.78, rgb("#e8cf97")),
    )
    color = gradient(tones, v)
    rays = linalg.sin(2.0 * np.pi * 12.0 * u)
    color = mix(color, rgb("#9a6a35"), 0.35 * smoothstep(0.2, 0.8, rays) * smoothstep(0.6, 0.75, v))
    return mix(color, rgb("#120c0a"), smoothstep(0.84, 0.86, v))


def rock_picture(u, v):
    """Grey rock overgrown with algae, violet and green."""
    crack = ridged_noise(6.0 * u, 1.0, 6.0 * v, 4, seed=47)
    algae = fractal_noise(5.0 * u, 2.0, 5.0 * v, 4, seed=48)
    color = gradient(((0.4, rgb("#9a948c")), (0.7, rgb("#706b6a")), (0.95, rgb("#403d44"))), crack)
    color = mix(color, rgb("#8b5f92"), 0.65 * smoothstep(0.12, 0.35, algae))
    return mix(color, rgb("#6f8c4c"), 0.65 * smoothstep(-0.12, -0.35, algae))


def sand_picture(u, v):
    ripple = linalg.sin(60.0 * v + 5.0 * fractal_noise(3.0 * u, 3.0 * v, 5.0, 3, seed=49))
    grain = fractal_noise(40.0 * u, 40.0 * v, 6.0, 2, seed=50)
    return mix(rgb("#ecdcb4"), rgb("#cdb486"), clamp(0.45 + 0.25 * ripple + 0.5 * grain))


def coral_picture(u, v):
    pores = ridged_noise(9.0 * u, 14.0 * v, 7.0, 2, seed=51)
    color = mix(rgb("#d8413f"), rgb("#f58a6b"), smoothstep(0.2, 1.0, v))
    return mix(color, rgb("#ffd9c4"), 0.6 * smoothstep(0.86, 0.97, pores))


def weed_picture(u, v):
    streak = fractal_noise(9.0 * u, 2.0 * v, 8.0, 3, seed=52)
    return mix(rgb("#2c6b3c"), rgb("#8fbf55"), clamp(0.15 + 0.7 * v + 0.6 * streak))


def starfish_picture(u, v):
    x, y = u - 0.5, v - 0.5
    knobs = fractal_noise(22.0 * u, 22.0 * v, 9.0, 2, seed=53)
    color = mix(rgb("#f2a23a"), rgb("#d9661f"), smoothstep(0.0, 0.2, x * x + y * y))
    return mix(color, rgb("#fff0c9"), 0.7 * smoothstep(0.3, 0.45, knobs))


def wood_picture(u, v):
    angle = 2.0 * np.pi * u
    grain = fractal_noise(2.5 * linalg.cos(angle), 2.5 * linalg.sin(angle), 16.0 * v, 4, seed=54)
    return mix(rgb("#5d3a22"), rgb("#33200f"), clamp(0.5 + 0.9 * grain))


PICTURES = {
    "nacre": nacre_picture,
    "hood": hood_picture,
    "flesh": flesh_picture,
    "tentacle": tentacle_picture,
    "eye": eye_picture,
    "rock": rock_picture,
    "sand": sand_picture,
    "coral": coral_picture,
    "weed": weed_picture,
    "starfish": starfish_picture,
    "wood": wood_picture,
}
