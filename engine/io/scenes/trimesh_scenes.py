"""Converts trimesh scenes for drawing.

In: a trimesh.Scene, or one of its geometries. Out: a `Scene` with the meshes at their poses, and
with the camera if the trimesh scene was given one.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from ...errors import warn
from ...model.scene.cameras import PerspectiveCamera
from ...model.scene.scene import Scene

#: Intensity, radius and colour of the two lights that trimesh makes.
_MADE_LIGHT = 1.0, None, (60, 60, 60, 255)


def scene_from_trimesh(thing: Any) -> Scene | None:
    """Return a scene converted from a trimesh object; None for those that hold no geometry.

    Parameters
    ----------
    thing : trimesh.Scene, Trimesh, PointCloud, Path or VoxelGrid
    """
    if not any(hasattr(thing, name) for name in ("graph", "vertices", "as_boxes")):
        return None
    from ..trimesh_conversion import mesh_from_trimesh, scene_parts

    scene = Scene()
    if not hasattr(thing, "graph"):
        scene.add(mesh_from_trimesh(thing))
        return scene
    for name, mesh, pose in scene_parts(thing):
        scene.add(mesh, name=name, pose=pose)
    if thing.has_camera:
        _add_camera(scene, thing)
    if _has_own_lights(thing):
        warn(
            "the lights of a trimesh.Scene are left out: the look lights it, unless its save_image "
            "draws it by engine3d.compat.trimesh"
        )
    return scene


def _has_own_lights(other: Any) -> bool:
    """Return whether a trimesh scene was given lights, unlike those that trimesh makes by itself.

    Asking for its lights would make some.
    """
    lights = vars(other).get("_lights") or ()
    made = [
        light
        for light in lights
        if type(light).__name__ == "PointLight"
        and (light.intensity, light.radius, tuple(light.color)) == _MADE_LIGHT
    ]
    return len(made) < len(lights) or len(lights) > 2


def _add_camera(scene: Scene, other: Any) -> None:
    """Add the camera of a trimesh scene, far enough away to see everything."""
    pose = np.asarray(other.camera_transform, np.float64)
    bounds = scene.bounds
    radius = 0.5 * float(np.linalg.norm(bounds[1] - bounds[0])) or 1.0
    distance = float(np.linalg.norm(pose[:3, 3] - (bounds[0] + bounds[1]) * 0.5))
    zfar = 1.1 * (distance + radius)
    znear = max(0.9 * (distance - radius), 1e-3 * zfar)
    yfov = math.radians(float(other.camera.fov[1]))
    scene.add(PerspectiveCamera(yfov, znear=znear, zfar=zfar), name="camera", pose=pose)
