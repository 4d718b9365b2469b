"""The Utah teapot in blue and white porcelain: teapot.obj, .mtl, .tga.

Newell's patches, closed where his teapot is open (under the lid, in the spout), on an atlas:
the body below, the lid in the middle, spout and handle at the top.
"""

import numpy as np
from images import clamp, mix, paint, rgb, smoothstep, stroke, tga
from model_files import mtl, obj
from noise import fractal_noise
from surfaces import Surface, arc_parameters, grid, lathe
from teapot_patches import BODY, HANDLE, LID, SPOUT, evaluate, revolved, swept

from engine3d import linalg

WIDTH, HEIGHT = 1024, 512
PORCELAIN, INK, WASH, GOLD = rgb("#f7f4ec"), rgb("#1b3a8c"), rgb("#8fb0e2"), rgb("#c79a3e")

# Parts of the texture: (u0, v0, u1, v1). Pictures go on into the margins between them.
MARGIN = 6.0 / HEIGHT
FOOT_BOX = (0.0, 0.0 + MARGIN, 1.0, 0.05)
WALL_BOX = (0.0, 0.05, 1.0, 0.5 - MARGIN)
LID_BOX = (0.0, 0.5 + MARGIN, 1.0, 0.75 - MARGIN)
SPOUT_BOX = (0.0 + MARGIN, 0.75 + MARGIN, 0.5 - MARGIN, 1.0 - MARGIN)
HANDLE_BOX = (0.5 + MARGIN, 0.75 + MARGIN, 1.0 - MARGIN, 1.0 - MARGIN)

# Length of the pictures' units: one unit of the model at the belly.
GIRTH, WALL_LENGTH = 12.6, 3.2


def build():
    """Return the model's files, by name, as functions that make them."""
    materials = {
        "porcelain": {"Kd": (1, 1, 1), "Ks": (0.45, 0.45, 0.45), "Ns": 90, "map_Kd": "teapot.tga"},
        "tea": {"Kd": (0.18, 0.07, 0.02), "Ks": (0.3, 0.3, 0.3), "Ns": 60},
    }
    title = "The Utah teapot (Martin Newell, 1975)"
    return {
        "teapot.obj": lambda: obj(title, surfaces(), "teapot.mtl"),
        "teapot.mtl": lambda: mtl(title, materials),
        "teapot.tga": lambda: tga(texture()),
    }


# --- geometry -----------------------------------------------------------------------------------


def surfaces():
    """Return the parts of the teapot, standing on y = 0, spout towards +X."""
    # The gap between rim and lid, and the mouth of the spout, get a floor.
    v = 0.5 - 0.5 * MARGIN
    gap = lathe([(1.4, 2.4), (1.3, 2.4)], 48, (0.0, v, 1.0, v))
    parts = [
        revolved_part(BODY, 7, 12, wall_v).labelled("porcelain", "body"),
        gap.labelled("porcelain", "body"),
        revolved_part(LID, 8, 12, lid_v).labelled("porcelain", "lid"),
        tube(HANDLE, 12, 8, HANDLE_BOX).labelled("porcelain", "handle"),
        tube(SPOUT, 12, 10, SPOUT_BOX).labelled("porcelain", "spout"),
        spout_mouth().labelled("tea", "tea"),
    ]
    return parts


def unit_normals(along, across):
    """Normals of a grid whose rows go up and columns right; at a pole they are the axis."""
    areas = linalg.cross(across, along)
    normals = linalg.normalize(areas)
    for pole, inner in ((0, 1), (-1, -2)):
        if linalg.length(areas[pole, 0]) < 1e-9:
            normals[pole] = (0.0, np.sign(normals[inner, 0, 1]), 0.0)
    return normals


def revolved_part(strips, rows, columns, texture_v):
    points, along, across = evaluate(revolved(strips), rows, columns)
    u = np.arange(points.shape[1]) / (points.shape[1] - 1)
    profile = np.stack((-points[:, 0, 0], points[:, 0, 1]), axis=1)
    v = texture_v(profile, rows)
    uvs = np.stack(np.broadcast_arrays(u, v[:, np.newaxis]), axis=-1)
    return grid(points, uvs, unit_normals(along, across))


def wall_v(profile, rows):
    """The bottom takes a narrow stripe of the texture, the wall the rest, by its length."""
    foot = FOOT_BOX[1] + (FOOT_BOX[3] - FOOT_BOX[1]) * arc_parameters(profile[: rows + 1])
    wall = WALL_BOX[1] + (WALL_BOX[3] - WALL_BOX[1]) * arc_parameters(profile[rows:])
    return np.concatenate((foot, wall[1:]))


def lid_v(profile, rows):
    return LID_BOX[1] + (LID_BOX[3] - LID_BOX[1]) * arc_parameters(profile)


def tube(strips, rows, columns, uv_box):
    """A tube of sections: u along it, v around it from its inner side."""
    points, along, across = evaluate(swept(strips), rows, columns)
    centre_line = 0.5 * (points[:, 0] + points[:, columns])
    u0, v0, u1, v1 = uv_box
    u = u0 + (u1 - u0) * arc_parameters(centre_line)
    v = v0 + (v1 - v0) * np.arange(points.shape[1]) / (points.shape[1] - 1)
    uvs = np.stack(np.broadcast_arrays(u[:, np.newaxis], v), axis=-1)
    normals = linalg.normalize(linalg.cross(along, across))
    if linalg.dot(normals[0, 0], centre_line[0] - points[0, 0]) > 0.0:
        normals = -normals
    return outward(grid(points, uvs, normals))


def outward(part):
    """Turn polygons round that disagree with the normals of their vertices."""
    first = list(part.polygons[0])
    a, b, c = part.positions[first[:3]]
    if linalg.dot(linalg.cross(b - a, c - a), part.normals[first[0]]) < 0.0:
        part.polygons = [polygon[::-1] for polygon in part.polygons]
    return part


def spout_mouth():
    """Tea stands a little below the end of the spout."""
    points, _, _ = evaluate(swept(SPOUT), 12, 10)
    ring = points[-1, :-1]
    positions = np.vstack((ring, [(3.0, 2.4, 0.0)]))
    count = len(ring)
    fan = [((k + 1) % count, k, count) for k in range(count)]
    normals = np.tile((0.0, 1.0, 0.0), (count + 1, 1))
    part = Surface(positions, np.zeros((count + 1, 2)), fan, normals)
    return outward(part)


# --- painting -----------------------------------------------------------------------------------


def texture():
    """Paint the parts of the atlas, each with the margins around it."""
    half, quarter = HEIGHT // 2, HEIGHT // 4

    def part(picture, box, u_range, v_range, width, height):
        u0, v0, u1, v1 = box
        outer = [(u - u0) / (u1 - u0) for u in u_range], [(v - v0) / (v1 - v0) for v in v_range]
        (left, right), (low, high) = outer
        return paint(picture, width, height, 3, (left, low, right, high))

    wall = part(wall_picture, WALL_BOX, (0.0, 1.0), (0.0, 0.5), WIDTH, half)
    lid = part(lid_picture, LID_BOX, (0.0, 1.0), (0.5, 0.75), WIDTH, quarter)
    spout = part(spout_picture, SPOUT_BOX, (0.0, 0.5), (0.75, 1.0), WIDTH // 2, quarter)
    handle = part(handle_picture, HANDLE_BOX, (0.5, 1.0), (0.75, 1.0), WIDTH // 2, quarter)
    return np.vstack((np.hstack((spout, handle)), lid, wall))


def ink_tone(u, v):
    """Cobalt, denser here and there as a brush leaves it; goes round without a seam."""
    angle = 2.0 * np.pi * u
    density = fractal_noise(3.0 * linalg.cos(angle), 3.0 * linalg.sin(angle), 9.0 * v, 3, seed=5)
    return mix(INK, rgb("#3f66bd"), clamp(0.35 + 0.9 * density))


def fold(u, repeats, width):
    """Coordinate across one of `repeats` cells, 0 in its middle; cells are `width` wide in all."""
    cell = u * repeats
    return (cell - np.floor(cell) - 0.5) * width / repeats


def petals(x, y, count):
    """Distance from the centre and the cosine of `count` times the direction."""
    r = np.sqrt(x * x + y * y) + 1e-12
    return r, linalg.cos(count * linalg.atan2(y, x))


def flower(color, x, y, size, ink):
    """A blossom of eight petals round a rosette."""
    r, wave = petals(x / size, y / size, 8)
    edge = 0.86 + 0.14 * wave
    color = mix(color, mix(PORCELAIN, WASH, smoothstep(0.35, 0.9, r / edge)), stroke(r, edge, 0.02))
    line = stroke(np.abs(r - edge), 0.045, 0.03)
    vein = (
        stroke(np.abs(1.0 + wave), 0.06, 0.1)
        * smoothstep(0.95, 0.85, r / edge)
        * smoothstep(0.4, 0.5, r)
    )
    r, wave = petals(y / size, x / size, 5)
    rosette = 0.34 + 0.09 * wave
    color = mix(color, PORCELAIN, stroke(r, rosette, 0.03))
    line = np.maximum(line, stroke(np.abs(r - rosette), 0.035, 0.03))
    color = mix(color, ink, np.maximum(line, vein))
    return mix(color, GOLD, stroke(r, 0.15, 0.03))


def leaf(color, x, y, place, ink):
    """A pointed leaf: `place` is (x, y, direction x, direction y, half length, half width)."""
    px, py, dx, dy, length, width = place
    along = ((x - px) * dx + (y - py) * dy) / length
    across = (-(x - px) * dy + (y - py) * dx) / width
    edge = np.abs(across) - (1.0 - along * along)
    within = stroke(edge, 0.0, 0.12)
    color = mix(color, mix(PORCELAIN, WASH, clamp(0.55 + 0.45 * across)), within)
    line = stroke(np.abs(edge), 0.14, 0.16) * (np.abs(along) < 1.15)
    vein = stroke(np.abs(across), 0.10, 0.14) * (np.abs(along) < 0.9)
    return mix(color, ink, np.maximum(line, vein))


def band(color, y, centre, half_width, ink):
    return mix(color, ink, stroke(np.abs(y - centre), half_width, 0.012))


def arches(color, x, y, width, base, height, ink):
    """A row of upright lotus petals from `base` on; `x` is folded to one petal."""
    t = (y - base) / height
    half = 0.5 * width * np.sqrt(clamp(1.0 - t * t * t))
    edge = (np.abs(x) - half) / width
    inner = edge + 0.16
    above = (t > 0.0) * (t < 1.12)
    color = mix(
        color, mix(WASH, PORCELAIN, clamp(t)), stroke(inner, 0.0, 0.04) * above * (t < 0.94)
    )
    color = mix(color, ink, stroke(np.abs(inner), 0.035, 0.05) * above * (t < 0.95))
    color = mix(color, ink, stroke(np.abs(edge), 0.05, 0.05) * above * (t < 1.0))
    return mix(color, ink, stroke(np.abs(x) / width, 0.04, 0.04) * above * (t < 0.55))


def glaze(u, v):
    """The white ground, hardly uneven."""
    angle = 2.0 * np.pi * u
    cloud = fractal_noise(linalg.cos(angle), linalg.sin(angle), 3.0 * v, 3, seed=11)
    return mix(PORCELAIN, rgb("#e3ebf2"), clamp(0.4 + 0.6 * cloud))


# Half of the frieze's leaves; the other half follows by a half turn about the blossom.
LEAVES = (
    (0.70, 0.42, 0.86, 0.51, 0.20, 0.075),
    (0.62, 0.08, 0.60, -0.80, 0.17, 0.070),
    (0.98, 0.64, 0.25, 0.97, 0.17, 0.070),
    (0.96, 0.02, 0.45, -0.89, 0.22, 0.080),
    (0.36, 0.66, -0.35, 0.94, 0.15, 0.060),
)


def wall_picture(u, h):
    """The wall: lotus petals, a frieze of blossoms on a vine, a collar of dots, a gilt rim."""
    y = h * WALL_LENGTH
    color = glaze(u, h)
    ink = ink_tone(u, h)
    color = arches(color, fold(u, 28, GIRTH), y, GIRTH / 28, 0.12, 0.46, ink)
    for centre, half_width in (
        (0.07, 0.03),
        (0.70, 0.02),
        (0.77, 0.008),
        (2.27, 0.008),
        (2.33, 0.02),
    ):
        color = band(color, y, centre, half_width, ink)
    x, dy = fold(u, 6, GIRTH), y - 1.52
    slope = 2.0 * np.pi / 2.1
    vine = 0.40 * linalg.sin(slope * x)
    steep = 0.40 * slope * linalg.cos(slope * x)
    distance = np.abs(dy - vine) / np.sqrt(1.0 + steep * steep)
    color = mix(color, ink, stroke(distance, 0.022, 0.015))
    for px, py, dx, dy_, length, width in LEAVES:
        for sign in (1.0, -1.0):
            place = (sign * px, sign * py, sign * dx, sign * dy_, length, width)
            color = leaf(color, x, dy, place, ink)
    for px, py in ((0.88, -0.42), (0.74, -0.56), (0.60, -0.40), (1.05, -0.60), (0.50, 0.62)):
        for sign in (1.0, -1.0):
            r = np.sqrt((x - sign * px) ** 2 + (dy - sign * py) ** 2)
            color = mix(color, ink, stroke(r, 0.032, 0.015))
    color = flower(color, x, dy, 0.50, ink)
    color = mix(color, ink, stroke(np.abs(y - 2.53), 0.13, 0.012))
    r = np.sqrt(fold(u, 40, GIRTH * 0.78) ** 2 + (y - 2.53) ** 2)
    color = mix(color, PORCELAIN, stroke(r, 0.075, 0.015))
    color = mix(color, ink, stroke(r, 0.028, 0.012))
    return band(color, y, 2.98, 0.14, GOLD)


def lid_picture(u, h):
    """The lid: a gilt edge, petals that point to the knob, blossoms, a gilt tip."""
    y = h * 2.3
    color = glaze(u, h)
    ink = ink_tone(u, h)
    color = band(color, y, 0.05, 0.03, GOLD)
    color = band(color, y, 0.16, 0.018, ink)
    color = band(color, y, 0.21, 0.007, ink)
    x = fold(u, 8, 6.6)
    for sign in (1.0, -1.0):
        color = leaf(color, x, y - 0.50, (sign * 0.40, 0.0, 0.95, sign * 0.31, 0.14, 0.06), ink)
    color = flower(color, x, y - 0.50, 0.23, ink)
    color = band(color, y, 0.80, 0.007, ink)
    color = arches(color, fold(u, 16, 4.0), y, 4.0 / 16, 0.84, 0.36, ink)
    color = band(color, y, 1.30, 0.03, ink)
    color = arches(color, fold(u, 10, 3.0), y, 3.0 / 10, 1.52, 0.40, ink)
    return mix(color, GOLD, smoothstep(1.98, 2.0, y))


def spout_picture(s, t):
    """The spout, s along it: blossoming stripes from a collar of petals to a gilt lip."""
    color = glaze(s, t)
    ink = ink_tone(s, t)
    color = arches(color, fold(t, 8, 3.0), s * 3.2, 3.0 / 8, 0.55, 0.55, ink)
    for centre, half_width in ((0.46, 0.03), (1.20, 0.007), (2.35, 0.015)):
        color = band(color, s * 3.2, centre, half_width, ink)
    x, y = fold(t, 4, 1.8), s * 3.2
    for place in (1.45, 1.72, 1.99):
        for sign in (1.0, -1.0):
            spot = (sign * 0.10, place, sign * 0.55, 0.83, 0.13, 0.05)
            color = leaf(color, x, y, spot, ink)
    color = mix(color, ink, stroke(np.abs(x), 0.012, 0.015) * (y > 1.25) * (y < 2.2))
    return mix(color, GOLD, smoothstep(2.52, 2.54, y))


def handle_picture(s, t):
    """The handle, s along it: leaves in pairs, thinner bands at both ends."""
    y = s * 4.0
    color = glaze(s, t)
    ink = ink_tone(s, t)
    outer = np.abs(t - 0.5) * 1.2  # distance across from the middle of the outer side
    for k in range(7):
        place = 0.75 + 0.42 * k
        spot = (0.13, place, 0.60, 0.80, 0.17, 0.06)
        color = leaf(color, outer, y, spot, ink)
    color = mix(color, ink, stroke(outer, 0.014, 0.015) * (y > 0.6) * (y < 3.6))
    for centre in (0.42, 0.5, 3.62, 3.70):
        color = band(color, y, centre, 0.014, ink)
    return color
