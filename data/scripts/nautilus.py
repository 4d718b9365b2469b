"""A nautilus swimming over a reef: nautilus.obj, .mtl, two textures.

The shell is a logarithmic spiral swept by an ellipse that grows threefold with each turn, as the
animal's does (Thompson 1917, "On Growth and Form"). Tentacles and corals are tubes along curves.
"""

import numpy as np
from images import lerp, paint, smoothstep, webp
from model_files import mtl, obj
from nautilus_pictures import reef_texture, shell_picture, tile
from noise import hash01, ridged_noise, value_noise
from surfaces import Surface, arc_parameters, closed_circle, grid, lathe

from engine3d import linalg

STEPS = 32  # rows of quads a turn; growth needs a power of two
TURNS = 2.75
AROUND = 32
END_ANGLE = -70.0 * np.pi / 180.0  # where the spiral ends: below its centre, opening forward (+X)
CENTRE = (-0.10, 1.75, 0.0)

MATERIALS = {
    "shell": {"Kd": (1, 1, 1), "Ks": (0.35, 0.35, 0.35), "Ns": 50, "map_Kd": "nautilus_shell.webp"},
    "skin": {"Kd": (1, 1, 1), "Ks": (0.2, 0.2, 0.2), "Ns": 20, "map_Kd": "nautilus_reef.webp"},
    "reef": {"Kd": (1, 1, 1), "map_Kd": "nautilus_reef.webp"},
}


def build():
    """Return the model's files, by name, as functions that make them."""
    title = "A nautilus over a reef"
    return {
        "nautilus.obj": lambda: obj(title, [*shell(), *animal(), *reef()], "nautilus.mtl"),
        "nautilus.mtl": lambda: mtl(title, MATERIALS),
        "nautilus_shell.webp": lambda: webp(paint(shell_picture, 1024, 256, 3)),
        "nautilus_reef.webp": lambda: webp(reef_texture()),
    }


# --- shell --------------------------------------------------------------------------------------


def growth():
    """Radius of each row of the spiral; 1 at the last."""
    factor = 3.0
    for _ in range(5):
        factor = np.sqrt(factor)
    radii = [1.0]
    for _ in range(int(TURNS * STEPS)):
        radii.append(radii[-1] / factor)
    return np.array(radii[::-1])


def section(radius, angle, scale=1.0):
    """Points of the shell's cross-section, counter-clockwise seen from where it grows to."""
    cosine, sine = closed_circle(AROUND)
    # v = 0 lies inside, against the former turn; the outer side is at v = 1/2.
    out = radius * (0.63 - 0.37 * scale * cosine)
    side = radius * 0.43 * scale * sine * (1.0 + 0.10 * cosine)
    return np.stack((out * linalg.cos(angle), out * linalg.sin(angle), side), axis=-1)


def shell():
    """The outer wall, the lip, and the nacreous lining as far as one can look in."""
    radii = growth()
    count = len(radii) - 1
    angles = END_ANGLE - 2.0 * np.pi * (count - np.arange(count + 1)) / STEPS
    outer = np.array([section(r, a) for r, a in zip(radii, angles, strict=True)])
    lining = np.array([section(radii[k], angles[k], 0.95) for k in range(count, count - 13, -1)])
    u = np.repeat(((radii - radii[0]) / (1.0 - radii[0]))[:, np.newaxis], AROUND + 1, axis=1)
    v = np.broadcast_to(np.arange(AROUND + 1) / AROUND, u.shape)
    u0, v0, u1, v1 = tile("nacre")
    nacre_u = lerp(u0, u1, np.arange(len(lining)) / (len(lining) - 1))[:, np.newaxis] + 0.0 * v[:1]
    nacre_v = lerp(v0, v1, v[:1]) + 0.0 * nacre_u
    rim = np.stack((outer[-1], lining[0]))
    parts = [
        grid(outer, np.stack((u, v), axis=-1)).labelled("shell"),
        grid(rim, np.stack((nacre_u[:2], nacre_v[:2]), axis=-1)).labelled("skin"),
        grid(lining, np.stack((nacre_u, nacre_v), axis=-1)).labelled("skin"),
    ]
    return placed(parts, linalg.translation(CENTRE), "shell")


def placed(parts, pose, name):
    return [part.moved(pose).labelled(part.material, name) for part in parts]


# --- animal -------------------------------------------------------------------------------------


def mouth_pose():
    """Axes of the opening: x forward, y towards the coil, z sideways; origin in its middle."""
    c, s = linalg.cos(END_ANGLE), linalg.sin(END_ANGLE)
    pose = np.eye(4)
    pose[:3, 0] = (-s, c, 0.0)
    pose[:3, 1] = (-c, -s, 0.0)
    pose[:3, 3] = (0.63 * c + CENTRE[0], 0.63 * s + CENTRE[1], CENTRE[2])
    return pose


def animal():
    """Hood, body, eyes, tentacles, funnel."""
    parts = [
        ellipsoid((0.02, -0.02, 0.0), (0.26, 0.33, 0.37), "flesh"),
        ellipsoid((-0.06, 0.16, 0.0), (0.40, 0.24, 0.36), "hood"),
        tube(
            [(0.10, -0.24, 0), (0.26, -0.28, 0), (0.38, -0.25, 0)], (0.10, 0.08, 0.075), "flesh", 12
        ),
        *eye(1.0),
        *eye(-1.0),
        *tentacles(),
    ]
    parts = [part.labelled("skin") for part in parts]
    return placed(parts, mouth_pose(), "animal")


def ellipsoid(centre, radii, picture, columns=28, bands=16):
    """A ball stretched along the axes, its poles on the y axis."""
    x, y = linalg.unit_circle(2 * bands)
    profile = np.stack((y[: bands + 1], -x[: bands + 1]), axis=1)
    ball = lathe(profile, columns, tile(picture))
    return ball.moved(linalg.multiply(linalg.translation(centre), linalg.scaling(radii)))


def eye(side):
    """A round eye whose pupil is a hole without a lens, on a short stalk."""
    profile = [
        (0.0, 0.11),
        (0.02, 0.108),
        (0.045, 0.098),
        (0.075, 0.072),
        (0.095, 0.03),
        (0.1, -0.03),
        (0.08, -0.1),
    ]
    ball = lathe(profile[::-1], 20, tile("eye"))
    turn = linalg.rotation_x(side * np.pi / 2.0)
    place = linalg.translation((0.17, 0.0, side * 0.315))
    return [ball.moved(linalg.multiply(place, turn))]


def tube(points, radii, picture, columns=6):
    """A tapering tube through points, round at its end."""
    points = np.asarray(points, np.float64)
    ways = linalg.normalize(
        np.vstack((points[1:2] - points[:1], points[2:] - points[:-2], points[-1:] - points[-2:-1]))
    )
    helper = np.eye(3)[np.argmin(np.abs(ways[0]))]
    first = linalg.normalize(linalg.cross(ways, helper))
    second = linalg.cross(ways, first)
    cosine, sine = (values[np.newaxis, :, np.newaxis] for values in closed_circle(columns))
    reach = np.asarray(radii, np.float64)[:, np.newaxis, np.newaxis]
    rings = points[:, np.newaxis] + reach * (
        first[:, np.newaxis] * cosine + second[:, np.newaxis] * sine
    )
    tip = points[-1] + ways[-1] * radii[-1]
    rings = np.concatenate((rings, np.broadcast_to(tip, (1, columns + 1, 3))))
    u0, v0, u1, v1 = tile(picture)
    along = arc_parameters(np.vstack((points, [tip])))
    u, v = np.meshgrid(lerp(u0, u1, np.arange(columns + 1) / columns), lerp(v0, v1, along))
    return grid(rings, np.stack((u, v), axis=-1))


def bezier(a, b, c, d, count):
    t = (np.arange(count + 1) / count)[:, np.newaxis]
    s = 1.0 - t
    a, b, c, d = (np.asarray(point, np.float64) for point in (a, b, c, d))
    return s * s * s * a + 3.0 * s * s * t * b + 3.0 * s * t * t * c + t * t * t * d


def tentacles():
    """Three crowns of tentacles round the mouth, none quite like another."""
    parts = []
    for crown, (count, reach, length) in enumerate(
        ((6, 0.07, 0.62), (11, 0.15, 0.55), (16, 0.22, 0.44))
    ):
        x, y = linalg.unit_circle(count)
        for k in range(count):
            chance = [2.0 * float(hash01(k, j, crown, 77)) - 1.0 for j in range(6)]
            out, up = y[k] * reach * 1.15, x[k] * reach * 0.85 - 0.07
            long = length * (1.0 + 0.25 * chance[0])
            start = (0.16, up, out)
            near = (0.30, up * 1.25, out * 1.2)
            far = (
                0.22 + 0.6 * long,
                up * 2.0 - 0.04 + 0.12 * chance[1],
                out * 1.9 + 0.12 * chance[2],
            )
            end = (0.25 + long, up * 2.2 - 0.14 + 0.22 * chance[3], out * 2.2 + 0.2 * chance[4])
            radii = lerp(0.034, 0.012, np.arange(10) / 9.0)
            parts.append(tube(bezier(start, near, far, end, 9), radii, "tentacle"))
    return parts


# --- reef ---------------------------------------------------------------------------------------


def reef():
    """A rock with corals, weed and a starfish on a disc of sand."""
    edge = [(0.0, -0.16), (1.34, -0.16), (1.40, -0.11), (1.40, -0.02), (1.36, 0.03)]
    parts = [
        lathe(edge, 48, tile("wood")).creased(),
        disc(1.36, 10, 48, sand_height, "sand"),
        disc(1.18, 16, 56, rock_height, "rock"),
        starfish().moved(linalg.translation((0.70, 0.05, 0.80))),
    ]
    for k, (x, z, size) in enumerate(
        ((-0.42, 0.36, 0.55), (0.28, -0.30, 0.42), (-0.72, -0.40, 0.42))
    ):
        root = np.array((x, float(rock_height(np.array(x), np.array(z))) - 0.02, z))
        parts += coral(root, np.array((0.15 * x, 1.0, 0.15 * z)), size, 4, 10 * k)
    for k in range(9):
        parts.append(weed(k))
    return [part.labelled("reef", "reef") for part in parts]


def sand_height(x, z):
    r = np.sqrt(x * x + z * z)
    return 0.03 + 0.05 * value_noise(2.2 * x, 0.5 + 0.0 * x, 3.4 * z, seed=12) * (1.0 - r / 1.36)


def rock_height(x, z):
    """A craggy mound; at its foot it goes under the sand."""
    bays = 0.30 * value_noise(2.3 * x, 3.0 + 0.0 * x, 2.3 * z, seed=14)
    r = np.sqrt((x + 0.08) ** 2 + z * z) + bays
    crags = ridged_noise(2.6 * x, 1.0 + 0.0 * x, 2.6 * z, 4, seed=15)
    mound = 0.42 * smoothstep(0.98, 0.15, r) + 0.50 * (crags - 0.62) * smoothstep(1.0, 0.6, r)
    return mound - 0.10 * smoothstep(0.7, 1.0, r)


def disc(radius, rings, columns, height, picture):
    """A round piece of ground, its texture seen from above."""
    cosine, sine = closed_circle(columns)
    r = radius * (1.0 - np.arange(rings + 1) / rings)[:, np.newaxis]
    x, z = -r * sine, -r * cosine
    u0, v0, u1, v1 = tile(picture)
    across = lerp(u0, u1, 0.5 + 0.5 * x / radius)
    along = lerp(v0, v1, 0.5 - 0.5 * z / radius)
    points = np.stack((x, height(x, z), z), axis=-1)
    return grid(points, np.stack((across, along), axis=-1))


def coral(root, way, size, generations, seed):
    """A branch that forks, and forks again."""
    way = linalg.normalize(way)
    bend = np.array([2.0 * float(hash01(seed, j, generations, 51)) - 1.0 for j in range(3)])
    tip = root + size * 0.5 * linalg.normalize(way + 0.30 * bend)
    thick = 0.036 * generations / 4.0 + 0.012
    middle = 0.5 * (root + tip) + 0.04 * size * bend[::-1]
    parts = [
        tube([root - 0.03 * way, middle, tip], (thick, 0.85 * thick, 0.75 * thick), "coral", 7)
    ]
    if generations > 1:
        side = linalg.normalize(linalg.cross(way, bend + (0.3, 0.1, 0.7)))
        for sign in (1.0, -1.0):
            parts += coral(
                tip,
                way + 0.62 * sign * side,
                0.78 * size,
                generations - 1,
                2 * seed + int(sign > 0) + 1,
            )
    return parts


def weed(k):
    """A leaf of sea grass, seen from both sides."""
    chance = [float(hash01(k, j, 3, 91)) for j in range(4)]
    x, z = -0.95 + 0.42 * chance[0], -0.15 + 0.95 * chance[1]
    tall = 0.45 + 0.45 * chance[2]
    lean = 0.5 * chance[3] - 0.15
    t = np.arange(9) / 8.0
    wave = 0.06 * linalg.sin(6.0 * t + 2.0 * k)
    width = 0.035 * (1.0 - t * t) + 0.002
    middle = np.stack((x + lean * t * t + wave, 0.02 + tall * t, z + 0.5 * wave), axis=-1)
    rows = np.stack(
        (
            middle - width[:, np.newaxis] * (0.6, 0, 0.8),
            middle + width[:, np.newaxis] * (0.6, 0, 0.8),
        ),
        axis=1,
    )
    u0, v0, u1, v1 = tile("weed")
    u, v = np.meshgrid((u0, u1), lerp(v0, v1, t))
    front = grid(rows, np.stack((u, v), axis=-1))
    back = [polygon[::-1] for polygon in front.polygons]
    count = len(front.positions)
    polygons = front.polygons + [tuple(v + count for v in polygon) for polygon in back]
    return Surface(
        np.vstack((front.positions, front.positions)),
        np.vstack((front.uvs, front.uvs)),
        polygons,
        np.vstack((front.normals, -front.normals)),
    )


def starfish():
    """Five arms, high along their middles; lies in the plane y = 0."""
    x, y = linalg.unit_circle(20)
    reach = np.array((0.22, 0.115, 0.075, 0.115) * 5)
    angle_x, angle_z = np.append(x * reach, x[0] * reach[0]), np.append(y * reach, y[0] * reach[0])
    rings = []
    for t, height in ((1.0, 0.0), (0.95, 0.022), (0.62, 0.05), (0.3, 0.065), (0.0, 0.07)):
        ridge = np.append(np.array((1.0, 0.6, 0.45, 0.6) * 5), 1.0) if 0.0 < t < 1.0 else 1.0
        rings.append(
            np.stack((-angle_z * t, height * ridge + 0.0 * angle_x, -angle_x * t), axis=-1)
        )
    rings = np.array(rings)
    u0, v0, u1, v1 = tile("starfish")
    uvs = np.stack(
        (lerp(u0, u1, 0.5 + rings[..., 0] / 0.5), lerp(v0, v1, 0.5 - rings[..., 2] / 0.5)), axis=-1
    )
    return grid(rings, uvs)
