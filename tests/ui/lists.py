"""Random lists of triangles: rectangles and glyphs as of user interfaces, and what none draws."""

import numpy as np

from engine3d.apps.imgui_painter.triangles import COMMAND, VERTEX, Texture

HOSTILE = np.float32([np.nan, np.inf, -np.inf, 1e30, -1e30, 3e6, 1 << 20, 1e-40])
VERTICES, SIDE = 60, 180


def random_textures(rng):
    """RGBA, alpha, opaque RGBA; of both filters; the last one narrow."""
    texels = rng.integers(0, 256, (16, 32, 4), np.uint8)
    texels[rng.random((16, 32)) < 0.3, 3] = 255
    return [
        Texture(texels),
        Texture(np.ascontiguousarray(texels[..., 3])),
        Texture(texels[3:14, 5:30], opaque=True),
        Texture(texels, "nearest"),
        Texture(texels[:5, :7, 3].copy(), "nearest"),
        Texture(texels[:1, :1], "bilinear"),
    ]


def random_list(rng):
    """Vertices, indices and commands."""
    vertices = np.zeros(VERTICES, VERTEX)
    vertices["position"] = rng.uniform(-20, SIDE + 20, (VERTICES, 2))
    grid = rng.choice([0, 1, 2, 256])
    if grid:
        vertices["position"] = np.round(vertices["position"] * grid) / grid
    vertices["uv"] = rng.uniform(-0.2, 1.2, (VERTICES, 2))
    vertices["color"] = rng.integers(0, 256, (VERTICES, 4))
    chosen = rng.random(VERTICES)
    vertices["color"][chosen < 0.4, 3] = 255
    vertices["color"][chosen > 0.9, 3] = 0
    if rng.random() < 0.4:
        vertices["uv"] = vertices["uv"][0]
    if rng.random() < 0.4:
        vertices["color"] = vertices["color"][0]
    quads = [rectangle(rng, vertices, first) for first in range(0, 40, 4)]
    loose = rng.integers(0, VERTICES, 45)
    indices = np.concatenate([*quads, loose]).reshape(-1, 3)
    if rng.random() < 0.5:
        indices = rng.permutation(indices)
    spoil(rng, vertices)
    return vertices, indices.ravel().astype(rng.choice([np.uint16, np.uint32])), commands(rng)


def rectangle(rng, vertices, first):
    """Make four vertices a rectangle, often of a texel a pixel; return its indices."""
    a, b, c, d = vertices[first : first + 4]
    kind = rng.integers(4)
    if kind == 0:
        a["uv"] = rng.integers(0, 8, 2) / np.float32([32, 16])
        c["uv"] = a["uv"] + (c["position"] - a["position"]) / np.float32([32, 16])
    if kind == 1:
        c["uv"] = a["uv"]
    for corner, (x, y) in ((b, (c, a)), (d, (a, c))):
        for name in ("position", "uv"):
            corner[name] = x[name][0], y[name][1]
    vertices["color"][first : first + 4] = a["color"]
    return first + np.array([0, 1, 2, 0, 2, 3])


def spoil(rng, vertices):
    for name in ("position", "uv"):
        if rng.random() < 0.2:
            vertices[name][rng.integers(VERTICES), rng.integers(2)] = rng.choice(HOSTILE)


def commands(rng):
    made = np.zeros(5, COMMAND)
    made["left"], made["top"] = rng.integers(-9, 60, (2, 5))
    made["right"], made["bottom"] = rng.integers(40, SIDE + 9, (2, 5))
    if rng.random() < 0.5:
        for side, value in zip(("left", "top", "right", "bottom"), (-1, -1, 1, 1), strict=True):
            made[side] = value * (1 << 31) - (value > 0)
    made["first_index"], made["index_count"] = np.arange(5) * 21, 21
    made["texture"] = rng.integers(0, 6, 5)
    return made
