"""Ten scenes of ambient occlusion: corners, balls, stairs, leaves, streets.

In:  nothing but engine3d itself.
Out: SCENES, name -> function that makes the `Lit` scene.
"""

from typing import NamedTuple

import numpy as np

import engine3d as e3d


class Lit(NamedTuple):
    """A scene under white ambient light alone, its camera with pose, and the occlusion radius."""

    scene: e3d.Scene
    view: tuple
    radius: float


def _scene():
    scene = e3d.Scene(ambient=(1.0, 1.0, 1.0))
    scene.add(e3d.DirectionalLight(intensity=0.0))  # so that there is no headlight
    return scene


def _view(angle, eye, target):
    return e3d.PerspectiveCamera(angle), e3d.look_at(eye, target)


def _add_room(scene):
    scene.add(e3d.box((6, 0.02, 6)), translation=(0, -0.01, 0))
    scene.add(e3d.box((6, 3, 0.02)), translation=(0, 1.5, -3))
    scene.add(e3d.box((0.02, 3, 6)), translation=(-3, 1.5, 0))


def room():
    """A corner of a room with boxes, of which one nearly touches the wall."""
    scene = _scene()
    _add_room(scene)
    turned = (0, 0.149, 0, 0.989)
    scene.add(e3d.box((0.5, 0.8, 0.5)), translation=(0.6, 0.4, -2.2), rotation=turned)
    scene.add(e3d.box((0.5, 1.1, 0.4)), translation=(2.0, 0.55, -2.3))
    scene.add(e3d.box((0.4, 0.25, 0.4)), translation=(-1.6, 0.125, -2.2))
    scene.add(e3d.uv_sphere(0.5, (64, 32)), translation=(-0.6, 0.5, -0.4))
    scene.add(e3d.cylinder(0.25, 1.2), translation=(0.9, 0.6, -0.4))
    scene.add(e3d.torus(0.5, 0.18, (64, 32)), translation=(-1.9, 0.18, -0.2))
    return Lit(scene, _view(0.75, (1.2, 2.2, 4.6), (-0.2, 0.9, -1)), 0.6)


def balls():
    """Five balls in a row, with a radius as wide as they are."""
    scene = _scene()
    scene.add(e3d.plane(12.0))
    for k in range(5):
        scene.add(e3d.uv_sphere(0.5, (96, 48)), translation=(-2.2 + 1.1 * k, 0.5, 0.15 * (k % 2)))
    return Lit(scene, _view(0.45, (0, 1.6, 6), (0, 0.4, 0)), 1.0)


def vase():
    """A thing of revolution with a neck, on the ground."""
    scene = _scene()
    rings, around = 64, 96
    t = np.linspace(0.0, 1.0, rings)
    radius = 0.35 + 0.3 * np.sin(np.pi * (1.6 * t - 0.1)) + 0.12 * (t > 0.92) * (t - 0.92) / 0.08
    turn = np.linspace(0.0, 2 * np.pi, around, endpoint=False)
    places = [np.outer(radius, np.cos(turn)), np.outer(2 * t, np.ones(around))]
    places.append(np.outer(radius, np.sin(turn)))
    corner = np.arange(rings * around).reshape(rings, around)
    here, up = corner[:-1], corner[1:]
    beside, over = np.roll(here, -1, 1), np.roll(up, -1, 1)
    faces = np.stack([here, up, over, here, over, beside], axis=-1).reshape(-1, 3)
    mesh = e3d.Mesh(np.stack(places, axis=-1).reshape(-1, 3), faces)
    scene.add(mesh)
    scene.add(e3d.plane(10.0))
    return Lit(scene, _view(0.6, (1.5, 2.4, 4.2), (0, 0.9, 0)), 0.5)


def street():
    """A street between houses with windows, cars and lamp posts."""
    scene, random = _scene(), np.random.default_rng(9)
    scene.add(e3d.plane(120.0))
    for side in (-1, 1):
        z = -50.0
        while z < 50.0:
            deep, high, wide = random.uniform(6, 12), random.uniform(6, 25), random.uniform(8, 12)
            house = (side * (7 + wide / 2), high / 2, z + deep / 2)
            scene.add(e3d.box((wide, high, deep)), translation=house)
            for y in np.arange(2.0, high - 1, 3):
                for along in np.arange(1.5, deep - 1, 2.5):
                    scene.add(e3d.box((0.5, 1.4, 1.2)), translation=(side * 7, y, z + along))
            z += deep + (random.uniform(1, 4) if random.random() < 0.4 else 0.0)
        scene.add(e3d.box((2.5, 0.15, 110)), translation=(side * 5.8, 0.075, 0))
        for z in np.arange(-40.0, 40.0, 12):
            scene.add(e3d.cylinder(0.12, 5.0), translation=(side * 5.0, 2.5, z))
    for k in range(8):
        x, z = 2.4 if k % 2 else -2.4, -30.0 + 8 * k
        scene.add(e3d.box((1.7, 0.9, 4)), translation=(x, 0.75, z))
        scene.add(e3d.box((1.5, 0.6, 2)), translation=(x, 1.5, z))
    return Lit(scene, _view(0.9, (1.2, 1.85, 40.0), (0, 4, -20)), 2.0)


def gear():
    """A gear before a wall."""
    outline = []
    for tooth in range(18):
        for share, radius in ((0, 0.8), (0.25, 0.8), (0.32, 1.0), (0.68, 1.0), (0.75, 0.8)):
            angle = (tooth + share) * 2 * np.pi / 18
            outline.append((radius * np.cos(angle), radius * np.sin(angle)))
    outer = np.array(outline)
    count = len(outer)
    inner = 0.3 * outer / np.hypot(*outer.T)[:, None]
    corners = [np.c_[ring, np.full(count, z)] for ring in (outer, inner) for z in (0.175, -0.175)]
    front, back, hole, hole_back = (np.arange(count) + k * count for k in range(4))
    faces = []
    for a, b in ((front, back), (hole, front), (back, hole_back), (hole_back, hole)):
        a_next, b_next = np.roll(a, -1), np.roll(b, -1)
        faces += [np.stack([a, b, b_next], 1), np.stack([a, b_next, a_next], 1)]
    places = np.concatenate(corners)[np.concatenate(faces)].reshape(-1, 3)
    scene = _scene()
    flat = np.arange(len(places)).reshape(-1, 3)
    scene.add(e3d.Mesh(places, flat), translation=(0, 1.0, 0))
    scene.add(e3d.box((6, 0.02, 4)), translation=(0, -0.02, 0))
    scene.add(e3d.box((6, 4, 0.02)), translation=(0, 1, -0.3))
    return Lit(scene, _view(0.6, (1.2, 1.9, 3.6), (0, 0.9, 0)), 0.4)


def grass():
    """1,500 blades without thickness."""
    scene, random = _scene(), np.random.default_rng(3)
    scene.add(e3d.plane(8.0))
    blade = e3d.primitives.quad((-0.02, 0, 0), (0.02, 0, 0), (0.012, 0.35, 0), (-0.012, 0.35, 0))
    for _ in range(1500):
        turn, lean = random.uniform(0, 2 * np.pi), random.uniform(-0.3, 0.3)
        pose = e3d.linalg.rotation_y(turn) @ e3d.linalg.rotation_x(lean)
        pose[:3, 3] = random.uniform(-1.5, 1.5), 0, random.uniform(-1.5, 1.5)
        scene.add(blade, pose=pose)
    return Lit(scene, _view(0.5, (0, 1.4, 3.8), (0, 0.1, 0)), 0.3)


def stairs():
    """Six steps beside a wall."""
    scene = _scene()
    for k in range(6):
        scene.add(e3d.box((3.0, 0.3, 0.5)), translation=(0, 0.15 + 0.3 * k, -0.5 * k))
    scene.add(e3d.box((0.2, 3.0, 4.0)), translation=(-1.6, 1.2, -1.0))
    scene.add(e3d.plane(9.0))
    return Lit(scene, _view(0.6, (2.6, 3.6, 6.0), (-0.2, 0.7, -0.8)), 0.5)


def column():
    """A thin column, and a box in the air, before walls."""
    scene = _scene()
    _add_room(scene)
    scene.add(e3d.cylinder(0.15, 2.4), translation=(0, 1.2, -1.2))
    scene.add(e3d.box((0.5, 0.5, 0.5)), translation=(1.5, 1.3, -1.6))
    return Lit(scene, _view(0.75, (1.0, 1.6, 3.6), (-0.2, 1.1, -2)), 0.8)


def sphere():
    """A ball on the ground."""
    scene = _scene()
    scene.add(e3d.uv_sphere(1.0, (128, 64)), translation=(0, 1.0, 0))
    scene.add(e3d.plane(12.0))
    return Lit(scene, _view(0.5, (0, 2.0, 6), (0, 0.7, 0)), 1.0)


def cubes():
    """Cubes that touch each other."""
    scene = _scene()
    scene.add(e3d.plane(12.0))
    for x in range(-1, 2):
        for y in range(2):
            place = (x * 0.8 + 0.1 * y, 0.4 + 0.8 * y, 0.3 * x * (1 - y))
            scene.add(e3d.box(0.8), translation=place)
    return Lit(scene, _view(0.6, (1.6, 2.4, 4.4), (0, 0.6, 0)), 0.5)


SCENES = {
    make.__name__: make
    for make in (room, balls, vase, street, gear, grass, stairs, column, sphere, cubes)
}
