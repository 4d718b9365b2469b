"""Scenes to measure, each of which stresses another stage of the frame.

In:  nothing but engine3d itself: no files, so that they are the same wherever they run.
Out: WORKLOADS, name -> (what it stresses, function that makes the Scene).
"""

import numpy as np

import engine3d as e3d


def _texture(side=512):
    """Smooth noise with fine lines over it, the same every time."""
    y, x = np.mgrid[0:side, 0:side] * (2 * np.pi / side)
    waves = [np.sin(3 * x + 2 * y), np.sin(5 * y - x), np.sin(7 * x + 11 * y)]
    pixels = np.stack([128 + 80 * wave for wave in waves], axis=-1)
    pixels[::16] *= 0.5
    pixels[:, ::16] *= 0.5
    return e3d.Texture(pixels.astype(np.uint8))


def _scene(eye, target=(0, 0, 0)):
    scene = e3d.Scene(background=(10, 12, 20), ambient=e3d.linear(0.1, 0.1, 0.1))
    camera = e3d.PerspectiveCamera(yfov=0.9, znear=0.05, zfar=100.0)
    scene.add(camera, pose=e3d.look_at(eye, target, (0, 1, 0)))
    scene.add(e3d.DirectionalLight(direction=(-0.4, -0.7, -0.6)))
    return scene


def small_triangles():
    """A sphere of 262,000 triangles of about a pixel."""
    scene = _scene((0, 0.3, 1.4))
    scene.add(e3d.uv_sphere(0.5, (512, 256)))
    return scene


def instances():
    """2,000 tori of 384 triangles, a third of them outside the frustum."""
    scene = _scene((0, 2, 9))
    rng = np.random.default_rng(5)
    poses = np.empty((2000, 4))
    poses[:, :3] = rng.uniform(-8, 8, (2000, 3))
    poses[:, 3] = rng.uniform(0.3, 1.0, 2000)
    mesh = e3d.torus(0.35, 0.15, (16, 12))
    scene.add(e3d.InstancedMesh(mesh, poses, colors=rng.integers(60, 255, (2000, 3), np.uint8)))
    return scene


def texture():
    """A textured floor up to the horizon, and a box: few triangles, trilinear samples."""
    scene = _scene((0, 0.6, 3), (0, 0, 0))
    floor = e3d.plane((40, 40), 4)
    floor.uvs = floor.uvs * 20
    floor.materials = [e3d.Material(texture=_texture())]
    box = e3d.box(1.2)
    box.materials = floor.materials
    scene.add(floor, translation=(0, -0.6, 0))
    scene.add(box, rotation=(0, 0.38, 0, 0.92))
    return scene


def lights():
    """A shiny sphere under eight point lights."""
    scene = _scene((0, 0, 1.15))
    sphere = e3d.icosphere(0.5, 5)
    sphere.materials = [e3d.Material(specular=e3d.linear(0.6, 0.6, 0.6), shininess=60.0)]
    scene.add(sphere)
    rng = np.random.default_rng(6)
    for position in rng.uniform(-1.5, 1.5, (8, 3)):
        light = e3d.PointLight(color=e3d.linear(rng.uniform(0.2, 1, 3)), intensity=0.1 * np.pi)
        scene.add(light, translation=tuple(position + (0, 0, 1)))
    return scene


def overdraw():
    """Forty layers that fill the frame, from back to front: each hides the last."""
    scene = _scene((0, 0, 3))
    for k in range(40):
        wall = e3d.primitives.quad((-9, -9, 0), (9, -9, 0), (9, 9, 0), (-9, 9, 0))
        scene.add(wall, translation=(0, 0, -4 + 0.1 * k))
    return scene


WORKLOADS = {
    "small_triangles": ("transform, setup, bin", small_triangles),
    "instances": ("cull, transform, raster", instances),
    "texture": ("clip, texture", texture),
    "lights": ("shade", lights),
    "overdraw": ("raster", overdraw),
}
