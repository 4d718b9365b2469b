"""What stands on the island: lighthouse, cottage, trees, rocks, jetty, boat, gulls.

Out: surfaces, built at the origin and moved into place, with the texture of `island_details`.
"""

import numpy as np
from island_details import tile
from island_land import COTTAGE, JETTY, TOWER, height
from noise import hash01, value_noise
from surfaces import Surface, box, grid, lathe

from engine3d import linalg


def at(x, y, z, turn=0.0, scale=1.0):
    """The pose of an object that stands at a place, turned about the vertical."""
    return linalg.multiply(
        linalg.translation((x, y, z)), linalg.rotation_y(turn), linalg.scaling(scale)
    )


def placed(parts, pose, name):
    return [part.moved(pose).labelled(part.material or "details", name) for part in parts]


def rod(start, end, radius, uv_box, sides=6):
    """A thin straight bar between two points."""
    start, end = np.asarray(start, np.float64), np.asarray(end, np.float64)
    axis = linalg.normalize(end - start)
    helper = np.eye(3)[np.argmin(np.abs(axis))]
    pose = np.eye(4)
    pose[:3, 0] = linalg.normalize(linalg.cross(axis, helper))
    pose[:3, 1] = axis
    pose[:3, 2] = linalg.cross(pose[:3, 0], axis)
    pose[:3, 3] = start
    long = float(linalg.length(end - start))
    profile = [(0.0, 0.0), (radius, 0.0), (radius, long), (0.0, long)]
    return lathe(profile, sides, uv_box).moved(pose)


# --- lighthouse ---------------------------------------------------------------------------------


def lighthouse():
    """A white tower with red bands, a gallery with a railing, a lantern room and a domed roof."""
    iron, roof, stone = tile("iron"), tile("roof"), tile("rock")
    parts = [
        lathe([(0.78, -0.30), (0.78, 0.14), (0.70, 0.18), (0.60, 0.18)], 32, stone),
        lathe(
            [(0.60, 0.16), (0.52, 0.9), (0.455, 1.7), (0.41, 2.4), (0.39, 2.9)], 32, tile("tower")
        ),
        lathe([(0.39, 2.84), (0.62, 2.98), (0.62, 3.05), (0.0, 3.05)], 32, iron).creased(),
        lathe([(0.33, 3.05), (0.33, 3.20), (0.30, 3.20)], 24, tile("plaster")),
        lathe([(0.27, 3.18), (0.27, 3.66)], 24, tile("iron")).labelled("lantern"),
        lathe(
            [(0.25, 3.62), (0.42, 3.64), (0.36, 3.76), (0.23, 3.90), (0.07, 3.98), (0.0, 3.98)],
            24,
            roof,
        ),
        lathe(
            [(0.0, 3.96), (0.05, 3.98), (0.075, 4.04), (0.05, 4.10), (0.012, 4.13), (0.0, 4.36)],
            12,
            iron,
        ),
    ]
    cosine, sine = linalg.unit_circle(16)
    for k in range(16):
        x, z, wide = cosine[k], sine[k], 0.59
        parts.append(rod((wide * x, 3.05, wide * z), (wide * x, 3.27, wide * z), 0.012, iron, 4))
        if k % 2 == 0:
            slim = 0.285
            parts.append(
                rod((slim * x, 3.18, slim * z), (slim * x, 3.66, slim * z), 0.014, iron, 4)
            )
    parts += [ring(0.59, y, 0.013, 32, iron) for y in (3.16, 3.27)]
    return placed(parts, at(TOWER[0], TOWER[2], TOWER[1], 0.6), "lighthouse")


def ring(radius, y, thickness, columns, uv_box):
    """A thin hoop round the Y axis."""
    cosine, sine = linalg.unit_circle(5)
    profile = [
        (radius + thickness * c, y + thickness * s) for c, s in zip(cosine, sine, strict=True)
    ]
    return lathe([*profile, profile[0]], columns, uv_box)


# --- cottage ------------------------------------------------------------------------------------


def cottage():
    """The keeper's cottage: whitewashed, with a tiled gable roof and a chimney."""
    wide, deep, wall, ridge = 0.64, 0.42, 0.64, 1.10
    front, side = tile("cottage"), tile("gable")
    quads = [
        (((-wide, deep), (wide, deep)), front),
        (((wide, -deep), (-wide, -deep)), front),
    ]
    parts = [
        upright([(ax, 0, az), (bx, 0, bz), (bx, wall, bz), (ax, wall, az)], uv_box)
        for ((ax, az), (bx, bz)), uv_box in quads
    ]
    for sign in (1.0, -1.0):
        x, z = sign * wide, sign * deep
        corners = [(x, 0, z), (x, 0, -z), (x, wall, -z), (x, ridge, 0), (x, wall, z)]
        u0, v0, u1, v1 = side
        flat_uv = [(0, 0), (1, 0), (1, wall / ridge), (0.5, 1), (0, wall / ridge)]
        uvs = [(u0 + (u1 - u0) * u, v0 + (v1 - v0) * v) for u, v in flat_uv]
        parts.append(Surface(corners, uvs, [tuple(range(5))]))
    for sign in (1.0, -1.0):
        parts.extend(roof_slab(sign, wide + 0.09, deep, wall, ridge))
    parts.append(box((0.16, 0.5, 0.16), (0.33, 1.14, -0.12), tile("rock")))
    parts.append(box((0.20, 0.05, 0.20), (0.33, 1.40, -0.12), tile("iron")))
    parts.append(box((0.30, 0.08, 0.16), (-0.06, 0.0, deep + 0.06), tile("rock")))
    return placed(parts, at(COTTAGE[0], COTTAGE[2], COTTAGE[1], 0.35), "cottage")


def upright(corners, uv_box):
    u0, v0, u1, v1 = uv_box
    return Surface(corners, [(u0, v0), (u1, v0), (u1, v1), (u0, v1)], [(0, 1, 2, 3)])


def roof_slab(sign, half_length, deep, wall, ridge):
    """One side of the roof, a slab with eaves."""
    slope = (ridge - wall) / deep
    eave, thick = 0.13, 0.05
    z0, y0 = sign * (deep + eave), wall - slope * eave
    x = sign * half_length
    top = [(-x, y0 + thick, z0), (x, y0 + thick, z0), (x, ridge + thick, 0), (-x, ridge + thick, 0)]
    under = [(px, py - thick, pz) for px, py, pz in top]
    parts = [upright(top, tile("roof")), upright(under[::-1], tile("planks"))]
    for k in (0, 1, 3):
        a, b = k, (k + 1) % 4
        parts.append(upright([under[a], under[b], top[b], top[a]], tile("planks")))
    return parts


# --- plants and rocks ---------------------------------------------------------------------------


def tree(kind, seed):
    """A pine of three skirts, or a round crown, on a trunk; about one unit tall."""
    trunk = lathe([(0.05, -0.15), (0.035, 0.5)], 6, tile("planks"))
    if kind == "pine":
        skirts = [
            lathe([(0.06, low + 0.04), (wide, low), (0.0, high)], 9, tile("foliage"))
            for low, high, wide in ((0.16, 0.62, 0.30), (0.40, 0.82, 0.235), (0.62, 1.0, 0.165))
        ]
        return [trunk, *(skirt.flat() for skirt in skirts)]
    profile = [(0.0, 0.30), (0.20, 0.36), (0.33, 0.55), (0.30, 0.78), (0.16, 0.95), (0.0, 1.0)]
    crown = lathe(profile, 8, tile("foliage"))
    return [trunk, crumpled(crown, 0.09, 3.0, seed).flat()]


def crumpled(part, amount, frequency, seed):
    """Push vertices in and out with noise; vertices at one position move together."""
    p = part.positions
    push = 1.0 + amount * value_noise(*(p.T * frequency + 11.7 * seed), seed=seed) * 2.0
    return Surface(p * push[:, np.newaxis], part.uvs, part.polygons, None, part.material)


def boulder(seed):
    profile = [(0.0, -0.4), (0.75, -0.3), (1.0, 0.1), (0.7, 0.55), (0.0, 0.75)]
    return [crumpled(lathe(profile, 7, tile("rock")), 0.22, 1.3, seed).flat()]


def spots(count, seed, accept):
    """Scatter places over the island, from a fixed sequence, where `accept(x, y, z)` holds."""
    found, k = [], 0
    while len(found) < count:
        x, z, size, turn = (float(hash01(k, j, 0, seed)) for j in range(4))
        x, z, k = 7.6 * x - 3.8, 7.0 * z - 3.5, k + 1
        y = float(height(np.array(x), np.array(z)))
        if accept(x, y, z) and apart(x, z, *((a, b, 0.42) for a, _, b, _, _ in found)):
            found.append((x, y, z, size, 6.28 * turn))
    return found


def apart(x, z, *places):
    """Whether a point keeps its distance from places (x, z, distance)."""
    return all((x - a) ** 2 + (z - b) ** 2 > gap * gap for a, b, gap in places)


def tree_spots():
    def accept(x, y, z):
        free = apart(
            x, z, (*TOWER[:2], 1.15), (*COTTAGE[:2], 1.15), (0.2, 0.8, 0.55), (1.4, 1.6, 0.9)
        )
        return 0.5 < y < 1.5 and free and not (-1.4 < x < 0.4 and -0.7 < z < 0.9)

    return spots(17, 5, accept)


def rock_spots():
    def accept(x, y, z):
        return -0.25 < y < 0.12 and apart(x, z, (*JETTY[0], 0.9), (*JETTY[1], 1.0), (2.2, 2.7, 0.9))

    return spots(16, 9, accept)


def plants():
    parts = []
    for k, (x, y, z, size, turn) in enumerate(tree_spots()):
        kind = "round" if k % 3 == 1 else "pine"
        scale = (0.75 if kind == "round" else 0.85) + 0.45 * size
        parts += placed(tree(kind, k), at(x, y, z, turn, scale), "trees")
    return parts


def rocks():
    parts = []
    for k, (x, y, z, size, turn) in enumerate(rock_spots()):
        pose = at(x, y + 0.02, z, turn, 0.10 + 0.16 * size * size)
        parts += placed(boulder(k), pose, "rocks")
    return parts


# --- by the water -------------------------------------------------------------------------------


def jetty():
    """A landing stage of planks on posts."""
    (ax, az), (bx, bz) = JETTY
    long = float(np.sqrt((bx - ax) ** 2 + (bz - az) ** 2))
    planks, count = tile("planks"), 13
    parts = []
    for k in range(count):
        z = long * (k + 0.5) / count
        parts.append(box((0.46, 0.035, 0.85 * long / count), (0.0, 0.30, z), planks))
    for k in range(4):
        for side in (-0.2, 0.2):
            z = long * (0.3 + 0.68 * k / 3)
            parts.append(rod((side, -0.5, z), (side, 0.44, z), 0.035, planks))
    turn = linalg.atan2(bx - ax, bz - az)
    return placed(parts, at(ax, 0.0, az, turn), "jetty")


def boat():
    """A small sailing boat, its bow towards +X."""
    stations = np.arange(11) / 10.0
    ribs = np.arange(-5, 6) / 5.0
    s, t = np.meshgrid(stations, ribs, indexing="ij")
    beam = 0.24 * (1.0 - s * s * s) * (0.72 + 0.28 * (1.0 - (1.0 - s) ** 2))
    keel = -0.17 + 0.12 * s * s * s * s
    sheer = 0.10 + 0.10 * (s - 0.35) ** 2 * 2.0
    bend = t * t
    points = np.stack(
        (1.25 * s - 0.6, keel + (sheer - keel) * bend, beam * t * (1.4 - 0.4 * bend)), -1
    )
    u0, v0, u1, v1 = tile("hull")
    uvs = np.stack((u0 + (u1 - u0) * s, v0 + (v1 - v0) * bend), axis=-1)
    hull = grid(points, uvs)
    deck = np.stack((points[..., 0], sheer - 0.03, points[..., 2]), axis=-1)
    pu0, pv0, pu1, pv1 = tile("planks")
    deck_uvs = np.stack((pu0 + (pu1 - pu0) * s, pv0 + (pv1 - pv0) * (t + 1.0) / 2.0), axis=-1)
    transom = Surface(points[0], uvs[0], [tuple(range(11))])
    parts = [
        hull,
        grid(deck[::-1], deck_uvs[::-1]),
        transom,
        rod((0.05, -0.05, 0.0), (0.05, 1.35, 0.0), 0.018, tile("planks")),
        rod((0.05, 0.22, 0.0), (-0.55, 0.22, 0.03), 0.013, tile("planks")),
        *sail((0.02, 1.30, 0.0), (0.02, 0.26, 0.0), (-0.54, 0.26, 0.03), 0.10),
        *sail((0.60, 0.24, 0.0), (0.10, 0.24, 0.04), (0.07, 1.15, 0.0), 0.09),
    ]
    parts = [facing_out(part) for part in parts[:3]] + parts[3:]
    pose = linalg.multiply(at(3.35, 0.03, 1.55, 0.75), linalg.rotation_x(0.07))
    return placed(parts, pose, "boat")


def facing_out(part):
    """Turn a part round whose polygons look to the boat's inside (below its deck)."""
    inside = np.array((0.0, 0.02, 0.0))
    total = 0.0
    for polygon in part.polygons:
        a, b, c = part.positions[list(polygon[:3])]
        total += linalg.dot(linalg.cross(b - a, c - a), a - inside)
    if total > 0.0:
        return part
    return Surface(part.positions, part.uvs, [p[::-1] for p in part.polygons], None, part.material)


def sail(a, b, c, belly, steps=6):
    """A triangle of cloth filled by the wind, seen from both sides."""
    a, b, c = (np.asarray(point, np.float64) for point in (a, b, c))
    s, t = np.meshgrid(np.arange(steps + 1) / steps, np.arange(steps + 1) / steps, indexing="ij")
    s, t = s[..., np.newaxis], t[..., np.newaxis]
    points = a + (b - a) * s + (c - b) * s * t
    fill = belly * 4.0 * s * (1.0 - s) * (0.4 + 2.4 * t * (1.0 - t))
    points = points + fill * (0.0, 0.0, 1.0)
    u0, v0, u1, v1 = tile("sail")
    uvs = np.concatenate((u0 + (u1 - u0) * t * s, v1 + (v0 - v1) * s), axis=-1)
    front = grid(points, uvs)
    back = Surface(front.positions, front.uvs, [p[::-1] for p in front.polygons])
    return [front, back]


def gulls():
    """Birds over the tower: two wings of two panels each, seen from both sides."""
    span = [(-0.30, 0.02), (-0.13, 0.09), (0.0, 0.0), (0.13, 0.09), (0.30, 0.02)]
    u0, v0, u1, v1 = tile("sail")
    middle = 0.5 * (u0 + u1), 0.5 * (v0 + v1)
    points = [(x, y, 0.07 - 0.5 * x * x) for x, y in span]
    points += [(x, y, -0.07 - 0.1 * abs(x)) for x, y in span]
    quads = [(k, k + 1, k + 6, k + 5) for k in range(4)]
    above = Surface(points, np.tile(middle, (10, 1)), quads)
    below = Surface(points, np.tile(middle, (10, 1)), [q[::-1] for q in quads])
    parts = []
    for x, y, z, turn in ((1.5, 4.6, 1.0, 0.5), (2.3, 5.2, -0.1, 0.9), (-2.8, 4.6, 0.4, -0.5)):
        parts += placed([above, below], at(x, y, z, turn, 1.3), "gulls")
    return parts


# --- stand --------------------------------------------------------------------------------------


def stand(radius):
    """The cut edge of the sea on a turned wooden foot."""
    profile = [(0.0, -1.35), (radius + 0.10, -1.35), (radius + 0.22, -1.27), (radius + 0.22, -1.02)]
    profile += [(radius + 0.14, -0.95), (radius, -0.95)]
    return [
        lathe(profile, 72, tile("base")).creased().labelled("details", "stand"),
        lathe([(radius, -0.95), (radius, 0.0)], 72, tile("water")).labelled("details", "stand"),
    ]
