"""Rules of section 29 in NumPy, written from their text: light of vertices, views, depths.

In: a scene of mujoco's. Out: numbers to compare pictures with.
"""

import numpy as np


def unit(v):
    """Return vectors of length 1."""
    return v / np.linalg.norm(v, axis=-1, keepdims=True)


def eye_of(scene):
    """Return the eye, and its axes to the right, up and ahead."""
    first, second = scene.camera
    eye = (np.array(first.pos, float) + second.pos) / 2
    ahead = unit(np.array(first.forward, float) + second.forward)
    up = np.array(first.up, float) + second.up
    up = unit(up - ahead * (up @ ahead))
    return eye, np.stack([np.cross(ahead, up), up, ahead])


def pixel_of(scene, points, width, height):
    """Return where points are in the picture, (N, 2) with y down, and how far ahead (R251)."""
    eye, axes = eye_of(scene)
    camera = scene.camera[0]
    local = (points - eye) @ axes.T
    half = 0.5 * width / height * (camera.frustum_top - camera.frustum_bottom)
    scale = camera.frustum_near / local[:, 2]
    x = (local[:, 0] * scale + half) / (2 * half) * width
    y = (camera.frustum_top - local[:, 1] * scale) / (camera.frustum_top - camera.frustum_bottom)
    return np.stack([x, y * height], axis=1), local[:, 2]


def light_of(scene, geom, places, normals):
    """Return the light of all lights on vertices, clamped, (N, 3) (R261)."""
    eye, _ = eye_of(scene)
    rgb = np.array(geom.rgba[:3], float)
    out = np.tile(geom.emission * rgb, (len(places), 1))
    to_eye = unit(eye - places)
    for light in scene.lights[: min(scene.nlight, 8)]:
        direction = unit(np.array(light.dir, float))
        strength = np.ones(len(places))
        if light.type == 1:
            to_light = np.tile(-direction, (len(places), 1))
        else:
            away = np.array(light.pos, float) - places
            distance = np.linalg.norm(away, axis=1)
            to_light = away / distance[:, None]
            inside = -to_light @ direction
            cone = np.maximum(inside, 0) ** light.exponent
            cone[inside < np.cos(np.radians(light.cutoff))] = 0
            a = light.attenuation
            strength = cone / (a[0] + a[1] * distance + a[2] * distance**2)
        facing = (normals * to_light).sum(1)
        near = np.maximum((normals * unit(to_light + to_eye)).sum(1), 0)
        shine = np.where(facing > 0, near ** (128 * geom.shininess), 0) * geom.specular
        one = np.array(light.ambient, float) * rgb
        one = one + np.maximum(facing, 0)[:, None] * np.array(light.diffuse, float) * rgb
        one = one + shine[:, None] * np.array(light.specular, float)
        out += strength[:, None] * one
    return np.clip(out, 0, 1)
