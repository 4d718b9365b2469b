"""Objects that many pictures share: meshes, textures, cameras, lights, and a still life of them."""

import math

import numpy as np

import engine3d as e3d
from engine3d import linalg

SUN = (-0.4, -0.8, -0.45)
CORAL = e3d.linear(0.85, 0.33, 0.24)
SAND = e3d.linear(0.76, 0.66, 0.47)
TEAL = e3d.linear(0.12, 0.52, 0.55)


def checkerboard(side=32, squares=4, **options):
    """A texture of coloured squares; every one differs, so that flips and wraps can be seen."""
    rows, columns = np.mgrid[0:side, 0:side]
    cell = rows * squares // side * squares + columns * squares // side
    pixels = np.empty((side, side, 3), np.uint8)
    pixels[..., 0] = 40 + 200 * ((rows * squares // side + columns * squares // side) % 2)
    pixels[..., 1] = 230 - cell * 170 // (squares * squares)
    pixels[..., 2] = columns * 255 // side
    pixels[0] = pixels[:, 0] = 255  # a frame on the top and left
    return e3d.Texture(pixels, **options)


def camera_at(eye=(1.6, 1.4, 2.8), target=(0, 0.35, 0), **options):
    """A perspective camera and its pose."""
    options = {"yfov": 0.8, "znear": 0.1, "zfar": 50.0, **options}
    return e3d.PerspectiveCamera(options.pop("yfov"), **options), e3d.look_at(eye, target)


def with_material(mesh, **options):
    mesh.materials = [e3d.Material(**options)]
    return mesh


def floor(size=3.0, **options):
    mesh = e3d.plane((size, size), 2)
    return with_material(mesh, **(options or {"texture": checkerboard()}))


def still_life(scene=None, lights=True):
    """A floor, a shiny sphere, a box and a torus, under the sun and a warm lamp."""
    scene = scene or e3d.Scene(background=(30, 38, 54), ambient=e3d.linear(0.12, 0.12, 0.14))
    scene.add(floor(), name="floor")
    ball = with_material(
        e3d.uv_sphere(0.4, (24, 12)),
        color=CORAL,
        specular=e3d.linear(0.5, 0.5, 0.5),
        shininess=40.0,
    )
    scene.add(ball, name="ball", translation=(-0.55, 0.4, 0.1))
    box = with_material(e3d.box(0.6), color=SAND)
    turn = linalg.quaternion_from_axis_angle((0, 1, 0), math.radians(30))
    scene.add(box, name="box", translation=(0.45, 0.3, -0.35), rotation=turn)
    ring = with_material(e3d.torus(0.3, 0.1, (24, 12)), color=TEAL)
    scene.add(ring, name="ring", translation=(0.45, 0.12, 0.6))
    if lights:
        scene.add(e3d.DirectionalLight(SUN, intensity=0.7 * math.pi))
        lamp = e3d.PointLight(color=e3d.linear(1, 0.8, 0.5), intensity=0.5 * math.pi, range=4.0)
        scene.add(lamp, translation=(-1.0, 1.2, 1.0))
    return scene


def one_object(mesh, pose=None, **scene_options):
    """A scene of one mesh under the sun."""
    scene = e3d.Scene(
        **{"background": (24, 28, 36), "ambient": e3d.linear(0.15, 0.15, 0.15), **scene_options}
    )
    scene.add(mesh, pose=pose)
    scene.add(e3d.DirectionalLight(SUN, intensity=0.8 * math.pi))
    return scene


def clip_camera():
    """A camera for which world space is clip space, with w = 1."""
    return e3d.Camera(np.eye(4)), np.eye(4)


def wavy_sheet(columns, rows, height=0.15):
    """A grid of triangles over a hilly square, with uvs and without normals."""
    u, v = np.meshgrid(np.arange(columns + 1) / columns, np.arange(rows + 1) / rows)
    bump = (4 * u * (1 - u) - 0.5) * (8 * v * (1 - v) - 1) * height
    positions = np.stack([2 * u - 1, bump, 1 - 2 * v], axis=-1).reshape(-1, 3)
    corner = np.arange(columns) + (columns + 1) * np.arange(rows)[:, None]
    quads = np.stack([corner, corner + 1, corner + columns + 2, corner + columns + 1], axis=-1)
    quads = quads.reshape(-1, 4)
    faces = np.concatenate([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]], axis=1).reshape(-1, 3)
    return e3d.Mesh(positions, faces, uvs=np.stack([u, v], axis=-1).reshape(-1, 2))
