"""Small scenes in pyrender's manner, without trimesh, and a light's formula in NumPy."""

import numpy as np

import engine3d
import engine3d.compat.pyrender as pyrender


def pose(x=0.0, y=0.0, z=0.0):
    matrix = np.eye(4)
    matrix[:3, 3] = x, y, z
    return matrix


def square(side=1.0, material=None, colors=None, **more):
    """A square that looks along +Z."""
    corners = np.array([(-1, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0)], np.float32) * side
    primitive = pyrender.Primitive(
        corners,
        normals=np.tile([0.0, 0.0, 1.0], (4, 1)),
        indices=[(0, 1, 2), (0, 2, 3)],
        material=material,
        color_0=colors,
        **more,
    )
    return pyrender.Mesh([primitive])


def ball(radius=1.0, material=None):
    mesh = engine3d.icosphere(radius, subdivisions=3)
    primitive = pyrender.Primitive(
        mesh.positions, normals=mesh.positions, indices=mesh.faces, material=material
    )
    return pyrender.Mesh([primitive])


def matte(color=(1.0, 1.0, 1.0, 1.0), **more):
    return pyrender.MetallicRoughnessMaterial(
        baseColorFactor=color, metallicFactor=0.0, roughnessFactor=1.0, **more
    )


def seen(*things, ambient=1.0, background=(0.0, 0.0, 0.0, 0.0), camera=None):
    """A scene of things and their poses, seen from z = 3."""
    scene = pyrender.Scene(bg_color=background, ambient_light=[float(ambient)] * 3)
    for thing in things:
        mesh, where = thing if isinstance(thing, tuple) else (thing, None)
        scene.add(mesh, pose=where)
    camera = camera or pyrender.PerspectiveCamera(yfov=np.pi / 2)
    scene.add(camera, pose=pose(z=3.0))
    return scene


def drawn(scene, flags=0, size=(32, 24), **more):
    return pyrender.OffscreenRenderer(*size).render(scene, flags=flags, **more)


def middle(picture):
    return picture[picture.shape[0] // 2, picture.shape[1] // 2]


def code(light):
    """What light is written as."""
    return np.round(np.clip(light, 0, 1) ** (1 / 2.2) * 255)


def lit(base, roughness, metallic, n, v, light):
    """What pyrender's shader shows of white light from a direction, without ambient light."""
    n, v, light = (vector / np.linalg.norm(vector) for vector in (n, v, light))
    half = (light + v) / np.linalg.norm(light + v)
    nl, nv = np.clip(n @ light, 0.001, 1), np.clip(abs(n @ v), 0.001, 1)
    nh, vh = np.clip(n @ half, 0, 1), np.clip(v @ half, 0, 1)
    roughness = np.clip(roughness, 0.04, 1)
    f0 = 0.04 * (1 - metallic) + base * metallic
    fresnel = f0 + (1 - f0) * (1 - vh) ** 5
    k = (roughness + 1) ** 2 / 8
    masking = nv / (nv * (1 - k) + k) * (nl / (nl * (1 - k) + k))
    squared = roughness**4
    distribution = squared / (np.pi * (nh * nh * (squared - 1) + 1) ** 2)
    scattered = (1 - fresnel) * base * 0.96 * (1 - metallic) / np.pi
    return nl * (scattered + fresnel * masking * distribution / (4 * nl * nv + 0.001))
