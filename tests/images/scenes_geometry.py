"""Points, lines, instances, poses, colours, and triangles that are small, large, thin or broken."""

import math

import numpy as np
from images.objects import (
    camera_at,
    clip_camera,
    floor,
    one_object,
    still_life,
    wavy_sheet,
    with_material,
)
from images.picture import Picture, picture, variant

import engine3d as e3d
from engine3d import linalg

TOP_VIEW = camera_at((0.8, 1.6, 2.4), (0, 0, 0))


def spiral(count):
    """(count, 3) positions on a winding line, and colours along it."""
    t = np.arange(count) / (count - 1)
    turn = [(math.cos(12 * s), math.sin(12 * s)) for s in t]
    radius = 0.2 + 0.7 * t
    x, z = (radius * np.array([both[k] for both in turn]) for k in range(2))
    colors = e3d.linear(np.stack([t, 1 - t, 0.5 + 0 * t, 1 + 0 * t], axis=1))
    return np.stack([x, 0.8 * t - 0.4, z], axis=1), colors


def points(size, samples=1, **options):
    positions, colors = spiral(300)
    mesh = e3d.Mesh(positions, points=np.arange(300), colors=colors)
    options = {"point_size": size, **options}
    return Picture(one_object(mesh), TOP_VIEW, samples=samples, options=options)


variant("points", points, 1.0)
variant("points_large", points, 6.5)
variant("points_samples_4", points, 2.0, 4)
variant("points_random_colors", points, 5.0, mode="random")
variant("points_painter", points, 9.0, hidden_surfaces="painter")


def lines(width, samples=1, **options):
    positions, colors = spiral(120)
    segments = np.stack([np.arange(119), np.arange(1, 120)], axis=1)
    spokes = np.stack([np.zeros(20, int), np.arange(5, 120, 6)], axis=1)
    mesh = e3d.Mesh(positions, lines=np.concatenate([segments, spokes]), colors=colors)
    options = {"line_width": width, **options}
    return Picture(one_object(mesh), TOP_VIEW, samples=samples, options=options)


variant("lines", lines, 1.0)
variant("lines_wide", lines, 4.0)
variant("lines_hairline_samples_16", lines, 0.25, 16)
variant("lines_depth", lines, 3.0, mode="depth")


@picture
def lines_near_and_behind():
    """Lines that pass the eye: cut where they leave the view."""
    rng = np.random.default_rng(3)
    ends = rng.uniform(-4, 4, (60, 3))
    mesh = e3d.Mesh(
        ends, lines=np.arange(60).reshape(-1, 2), colors=e3d.linear(rng.random((60, 4)))
    )
    options = {"line_width": 2.0, "mode": "unlit"}
    return Picture(one_object(mesh), camera_at((0, 0, 0.5), (0, 0, -1)), options=options)


@picture
def faces_lines_and_points():
    """One mesh of all three: order and depth decide."""
    ball = e3d.icosphere(0.7, 2)
    count = len(ball.positions)
    mesh = e3d.Mesh(
        ball.positions,
        ball.faces,
        normals=ball.normals,
        lines=np.stack([np.arange(0, count - 9, 5), np.arange(9, count, 5)], axis=1),
        points=np.arange(0, count, 3),
        materials=[e3d.Material(color=e3d.linear(0.3, 0.5, 0.8))],
    )
    options = {"point_size": 4.0, "line_width": 1.5}
    return Picture(one_object(mesh), TOP_VIEW, options=options)


def vertex_colors(dtype, color_space):
    """A fan with a colour at every corner, of bytes or of floats."""
    angles = [2 * math.pi * k / 12 for k in range(12)]
    rim = [(math.cos(a), math.sin(a), 0) for a in angles]
    colors = np.array(
        [(1, 1, 1)] + [(k % 3 == 0, k % 3 == 1, k % 3 == 2) for k in range(12)], float
    )
    colors = (colors * 255).astype(np.uint8) if dtype == "bytes" else colors
    faces = [(0, k + 1, (k + 1) % 12 + 1) for k in range(12)]
    mesh = e3d.Mesh([(0, 0, 0), *rim], faces, colors=colors)
    camera = camera_at((0, 0, 2.6), (0, 0, 0))
    return Picture(one_object(mesh), camera, color_space=color_space, options={"mode": "unlit"})


variant("vertex_colors_bytes", vertex_colors, "bytes", "srgb")
variant("vertex_colors_floats", vertex_colors, "floats", "srgb")
variant("vertex_colors_linear", vertex_colors, "bytes", "linear")


def instances(kind, mode="lit"):
    """A hundred small tori; matrices turn and mirror them, offsets only scale."""
    rng = np.random.default_rng(4)
    offsets = np.stack([np.repeat(np.arange(10), 10), np.zeros(100), np.tile(np.arange(10), 10)], 1)
    offsets = (offsets - (4.5, 0, 4.5)) * 0.28
    if kind == "offsets":
        poses = np.concatenate([offsets, rng.uniform(0.2, 0.4, (100, 1))], axis=1)
        colors = e3d.linear(rng.uniform(0.2, 1, (100, 3)))
    else:
        poses = np.array([pose_of(offset, k) for k, offset in enumerate(offsets)])
        colors = rng.integers(50, 256, (100, 4), np.uint8)
    scene = one_object(e3d.InstancedMesh(e3d.torus(0.35, 0.15, (12, 8)), poses, colors=colors))
    return Picture(scene, camera_at((0.9, 2.0, 2.2), (0, 0, 0.1)), options={"mode": mode})


def pose_of(offset, k):
    turn = linalg.quaternion_from_axis_angle((1, 2, 0.5), 0.4 * k)
    scale = (0.35, 0.2, -0.3) if k % 4 == 0 else (0.3, 0.3, 0.3)
    return linalg.compose(offset, turn, scale)


variant("instances_matrices", instances, "matrices")
variant("instances_offsets", instances, "offsets")
variant("instances_object_id", instances, "matrices", "object_id")
variant("instances_random", instances, "offsets", "random")


@picture
def mirrored_poses():
    """Negative scales turn facing round: each copy looks whole, and is lit from the same side."""
    scene = e3d.Scene(background=(24, 28, 36))
    for k, scale in enumerate([(1, 1, 1), (-1, 1, 1), (1, -1, 1), (-1, -1, -1)]):
        mesh = with_material(
            e3d.cylinder(0.3, 0.7, 16), color=e3d.linear(0.3 + 0.2 * k, 0.5, 0.8 - 0.2 * k)
        )
        turn = linalg.quaternion_from_axis_angle((1, 0, 0.4), 0.9)
        scene.add(mesh, translation=(0.8 * k - 1.2, 0, 0), rotation=turn, scale=scale)
    scene.add(e3d.DirectionalLight((-0.5, -0.8, -0.4)))
    return Picture(scene, camera_at((0, 0.6, 3.4), (0, 0, 0)))


@picture
def stretched_normals():
    """Flattened spheres: normals go by the inverse transpose, so that light is right."""
    scene = e3d.Scene(background=(24, 28, 36))
    for k, scale in enumerate([(1.5, 0.3, 1), (0.3, 1.5, 0.3), (1, 1, 0.05)]):
        scene.add(e3d.icosphere(0.5, 3), translation=(1.3 * k - 1.3, 0, 0), scale=scale)
    scene.add(e3d.DirectionalLight((-0.3, -1, -0.3)))
    return Picture(scene, camera_at((0.5, 1.5, 4), (0, 0, 0)))


@picture
def hierarchy():
    """An arm of boxes, each in the space of the one before; one is invisible, with its children."""
    scene = e3d.Scene(background=(24, 28, 36))
    turn = linalg.quaternion_from_axis_angle((0, 0, 1), 0.45)
    parent = None
    for k in range(6):
        offset = (-1.2, -0.5, 0) if parent is None else (0.55, 0, 0)
        box = with_material(
            e3d.box((0.5, 0.2, 0.2)), color=e3d.linear(0.9 - 0.12 * k, 0.3, 0.2 + 0.12 * k)
        )
        node = scene.add(box, parent=parent, translation=offset, rotation=turn, scale=0.95)
        parent = node
    node.visible = False
    scene.add(e3d.DirectionalLight((-0.4, -0.6, -0.7)))
    return Picture(scene, camera_at((0, 0.3, 3.5), (0, 0.2, 0)))


@picture
def many_small_triangles():
    """Forty thousand triangles of a pixel or less: many clusters, several threads of geometry."""
    scene = one_object(e3d.uv_sphere(0.9, (200, 100)))
    return Picture(scene, camera_at((0, 0.5, 2.4), (0, 0, 0)))


@picture
def hills():
    """A sheet without normals: they are computed from its faces."""
    return Picture(one_object(wavy_sheet(60, 60)), TOP_VIEW)


@picture
def hills_painter():
    """Neighbours that do not intersect: the painter shows what the depth buffer shows."""
    sheet = wavy_sheet(40, 40, 0.4)
    return Picture(one_object(sheet), TOP_VIEW, options={"hidden_surfaces": "painter"})


@picture
def intersecting():
    """Three planes through one another: the depth buffer finds their lines."""
    scene = e3d.Scene(background=(24, 28, 36))
    for k, axis in enumerate([(1, 0, 0), (0, 1, 0), (1, 1, 0)]):
        plane = with_material(
            floor(1.6), color=tuple(float(k == c) for c in range(3)), two_sided=True
        )
        turn = linalg.quaternion_from_axis_angle(axis, 0.9 + 0.4 * k)
        scene.add(plane, rotation=turn)
    return Picture(scene, camera_at((1, 1.2, 2), (0, 0, 0)))


@picture
def coplanar():
    """The same square four times: the first in order shows, whatever draws it."""
    scene = e3d.Scene(background=(24, 28, 36))
    for k in range(4):
        scene.add(with_material(floor(1.5), color=e3d.linear(0.2 + 0.2 * k, 0.8 - 0.2 * k, 0.3)))
    return Picture(scene, TOP_VIEW)


def layers(key):
    """Squares over the whole picture or a part of it, level or tilted, some of them as deep."""
    rng = np.random.default_rng(9)
    centre, half = rng.uniform(-1, 1, (90, 1, 2)), rng.uniform(0.1, 0.4, (90, 1, 2))
    centre[::3], half[::3] = 0, 1.25
    x, y = np.moveaxis(centre + half * [(-1, -1), (1, -1), (1, 1), (-1, 1)], 2, 0)
    level = rng.choice(np.linspace(0.0, 0.6, 6), (90, 1))
    level[::3] += 0.24
    tilt = rng.uniform(-0.15, 0.15, (90, 2)) * (rng.random((90, 1)) < 0.4)
    corners = np.stack([x, y, level + tilt[:, :1] * x + tilt[:, 1:] * y], axis=2)
    corners = corners[key(rng, level[:, 0])].reshape(-1, 3)
    faces = 4 * np.arange(90)[:, None, None] + [(0, 1, 2), (0, 2, 3)]
    scene = one_object(e3d.Mesh(corners, faces.reshape(-1, 3)))
    return Picture(scene, clip_camera(), options={"mode": "random", "cull": "none"})


variant("layers", layers, lambda rng, level: rng.permutation(len(level)))
variant("layers_back_to_front", layers, lambda rng, level: np.argsort(-level, kind="stable"))


@picture
def slivers():
    """A fan of a thousand triangles around one corner, all thinner than a pixel."""
    angles = [2 * math.pi * k / 1000 for k in range(1000)]
    rim = [(math.cos(a), math.sin(a), 0) for a in angles]
    faces = [(0, k + 1, (k + 1) % 1000 + 1) for k in range(1000)]
    mesh = e3d.Mesh([(0, 0, 0.2), *rim], faces)
    return Picture(
        one_object(mesh), camera_at((0.3, 0, 2.6), (0, 0, 0)), options={"mode": "random"}
    )


@picture
def giant_triangles():
    """Corners up to 10^12 away, whose edges still end where they should."""
    rng = np.random.default_rng(6)
    corners = np.empty((60, 3, 3))
    corners[:, 0, :2] = rng.uniform(-1, 1, (60, 2))
    angles = rng.uniform(-3, 3, 60)
    scales = 10.0 ** rng.integers(0, 13, (60, 2))
    for k in (1, 2):  # wedges from a corner in the picture to two far away
        far = angles + 0.15 * k
        away = np.array([(math.cos(angle), math.sin(angle)) for angle in far])
        corners[:, k, :2] = corners[:, 0, :2] + away * scales[:, k - 1, None]
    corners[..., 2] = rng.uniform(-1, 1, (60, 1))
    mesh = e3d.Mesh(corners.reshape(-1, 3), np.arange(180).reshape(-1, 3))
    scene = e3d.Scene()
    scene.add(mesh)
    return Picture(scene, clip_camera(), options={"mode": "random", "cull": "none"})


@picture
def broken_vertices():
    """NaN, infinities and numbers near the limits of float32 drop their own triangles only."""
    rng = np.random.default_rng(7)
    sheet = wavy_sheet(24, 24)
    positions = sheet.positions.copy()
    bad = rng.choice(len(positions), 30, replace=False)
    values = [np.nan, np.inf, -np.inf, 3e38, -3e38, 1e-45]
    positions[bad, rng.integers(0, 3, 30)] = rng.choice(values, 30)
    mesh = e3d.Mesh(positions, sheet.faces, normals=sheet.normals, uvs=sheet.uvs)
    camera = camera_at((0.8, 1.6, 2.4), (0, 0, 0))
    return Picture(one_object(mesh), camera)


@picture
def broken_normals_and_uvs():
    """Normals of no length or of too much, uvs that are not numbers: still a picture."""
    rng = np.random.default_rng(8)
    sheet = wavy_sheet(20, 20)
    normals, uvs = sheet.normals.copy(), sheet.uvs.copy()
    rows = rng.choice(len(normals), (3, 40), replace=False)
    normals[rows[0]], normals[rows[1]] = 0, 3e38
    uvs[rows[2]] = rng.choice([np.nan, np.inf, -np.inf, 1e30], (40, 2))
    mesh = e3d.Mesh(sheet.positions, sheet.faces, normals=normals, uvs=uvs)
    mesh.materials = floor().materials
    return Picture(one_object(mesh), TOP_VIEW)


@picture
def tiny_world():
    """Denormal sizes: a model of 1e-38 units, brought back by its pose."""
    mesh = e3d.box(1e-38)
    return Picture(one_object(mesh, linalg.scaling((1e38, 1e38, 1e38))), TOP_VIEW)


@picture
def degenerate_faces():
    """Faces of no area among good ones."""
    ball = e3d.icosphere(0.8, 2)
    faces = ball.faces.copy()
    faces[::3, 2] = faces[::3, 1]
    return Picture(one_object(e3d.Mesh(ball.positions, faces)), TOP_VIEW)


@picture
def empty():
    return Picture(e3d.Scene(background=(200, 120, 40)), camera_at())


@picture
def no_faces():
    """A mesh without anything to draw beside one with."""
    scene = still_life()
    scene.add(e3d.Mesh(np.zeros((3, 3))))
    scene.add(e3d.InstancedMesh(e3d.box(), np.zeros((0, 4))))
    return Picture(scene, camera_at())
