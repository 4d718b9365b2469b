"""The cameras of tasks.

In: a number, or an object of JSON with one of three sets of members; angles in degrees. Out: a
camera and its pose. Near and far planes enclose the scene where nothing else is said.

- framed: ``azimuth_degrees``, ``elevation_degrees``, ``up``, ``yfov_degrees``, ``margin``: all of
  the scene shows;
- placed: ``position``, ``target``, ``up``, and ``yfov_degrees`` or, without perspective,
  ``height``, or ``lens``;
- posed: ``pose``, and ``yfov_degrees``, ``height``, ``intrinsics`` or ``lens``, a record as
  `load_camera` reads it.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...base import linalg
from ...base.numbers import shown
from ...base.validation import finite, matrix4, positive, vector3
from ...errors import InvalidArgumentError
from ...io.camera_files import camera_of_record, stated_size
from ...model.scene.cameras import Camera, IntrinsicsCamera, OrthographicCamera, PerspectiveCamera
from ...model.scene.lenses.lens_camera import LensCamera
from ...model.scene.nodes import check_pose
from ...model.scene.orbiting import orbit_axes
from ...model.scene.scene import Scene
from ...rendering.framing import frame_scene
from .members import member

_FRAMED = ("azimuth_degrees", "elevation_degrees", "up", "yfov_degrees", "margin")
_PLACED = ("position", "target", "up", "yfov_degrees", "height", "lens", "near", "far")
_POSED = ("pose", "yfov_degrees", "height", "intrinsics", "lens", "near", "far")
_INTRINSICS = ("fx", "fy", "cx", "cy")
_YFOV = 50.0
_UP = (0.0, 1.0, 0.0)
_SLACK = 1.01
_NEAREST = 1e-3  # of the far plane's distance


def check_camera(value: Any) -> int | dict[str, Any] | None:
    """Return a task's camera description, checked.

    Raises
    ------
    InvalidArgumentError
    """
    if value is None:
        return None
    if isinstance(value, int) and not isinstance(value, bool) and value >= 0:
        return value
    if not isinstance(value, Mapping):
        raise InvalidArgumentError(f"camera must be a number or an object, not {shown(value)}")
    said = dict(value)
    known = _POSED if "pose" in said else _PLACED if "position" in said else _FRAMED
    for key, one in said.items():
        with member(key):
            if key not in (*known, "name"):
                raise InvalidArgumentError(
                    f"camera: {key} is none of {', '.join(known)}, which go together"
                )
            said[key] = _MEMBERS[key](one, f"camera: {key}")
    lenses = [key for key in ("yfov_degrees", "height", "intrinsics", "lens") if key in said]
    if len(lenses) > 1:
        raise InvalidArgumentError(f"camera: {' and '.join(lenses)} do not go together")
    return said


def _angle(value: Any, what: str) -> float:
    if not 0.0 < finite(value, what) < 180.0:
        raise InvalidArgumentError(f"{what} must be between 0 and 180 degrees, not {shown(value)}")
    return float(value)


def _elevation(value: Any, what: str) -> float:
    if not -90.0 <= finite(value, what) <= 90.0:
        raise InvalidArgumentError(f"{what} must be from -90 to 90 degrees, not {shown(value)}")
    return float(value)


def _vector(value: Any, what: str) -> list[float]:
    return vector3(value, what).tolist()


def _pose(value: Any, what: str) -> list[list[float]]:
    return check_pose(matrix4(value, what)).tolist()


def _intrinsics(value: Any, what: str) -> dict[str, float]:
    if not isinstance(value, Mapping) or set(value) != set(_INTRINSICS):
        raise InvalidArgumentError(f"{what} must be an object of fx, fy, cx and cy")
    numbers = {}
    for key in _INTRINSICS:
        with member(key):
            numbers[key] = finite(value[key], f"{what}: {key}")
    return numbers


def _lens_record(value: Any, what: str) -> dict[str, Any]:
    if not isinstance(camera_of_record(value, what), LensCamera | IntrinsicsCamera):
        raise InvalidArgumentError(f"{what} must be of a lens, not {shown(value)}")
    return dict(value)


def _name(value: Any, what: str) -> str:
    if not (isinstance(value, str) and value):
        raise InvalidArgumentError(f"{what} must be a text, not {shown(value)}")
    return value


_MEMBERS = {
    "name": _name,
    "azimuth_degrees": finite,
    "elevation_degrees": _elevation,
    "up": _vector,
    "yfov_degrees": _angle,
    "margin": positive,
    "position": _vector,
    "target": _vector,
    "height": positive,
    "near": positive,
    "far": positive,
    "pose": _pose,
    "intrinsics": _intrinsics,
    "lens": _lens_record,
}


def calibrated_size(said: Any) -> tuple[int, int] | None:
    """Return the size that the lens of a checked camera states; None for none."""
    return stated_size(said["lens"]) if isinstance(said, Mapping) and "lens" in said else None


def camera_of(
    said: int | Mapping[str, Any], scene: Scene, size: tuple[int, int]
) -> tuple[Camera, NDArray[np.float64]]:
    """Return the camera that a task describes, and its pose.

    Raises
    ------
    InvalidArgumentError
        The scene has no such camera, or the members go not together.
    """
    if isinstance(said, int):
        nodes = [node for node in scene.nodes if isinstance(node.object, Camera)]
        if said >= len(nodes):
            known = f"the last is {len(nodes) - 1}" if nodes else "there are none"
            raise InvalidArgumentError(f"the scene has no camera {said} ({known})")
        return nodes[said].object, nodes[said].world_pose
    if "pose" in said:
        pose = np.array(said["pose"])
    elif "position" in said:
        middle = scene.bounds.sum(axis=0) * 0.5
        pose = linalg.look_at(said["position"], said.get("target", middle), said.get("up", _UP))
    else:
        return _framed(said, scene, size)
    return _lens(said, scene, pose), pose


def _framed(
    said: Mapping[str, Any], scene: Scene, size: tuple[int, int]
) -> tuple[Camera, NDArray[np.float64]]:
    way = {}
    if any(key in said for key in ("azimuth_degrees", "elevation_degrees", "up")):
        angles = (
            math.radians(said.get(key, 0.0)) for key in ("azimuth_degrees", "elevation_degrees")
        )
        axes = orbit_axes(said.get("up", _UP), *angles)
        way = {"direction": -axes[:, 2], "up": axes[:, 1]}
    return frame_scene(
        scene,
        aspect=size[0] / size[1],
        yfov=math.radians(said["yfov_degrees"]) if "yfov_degrees" in said else None,
        margin=said.get("margin", 1.05),
        **way,
    )


def _lens(said: Mapping[str, Any], scene: Scene, pose: NDArray[np.float64]) -> Camera:
    """Return the projection, with near and far planes around the scene."""
    low, high = scene.bounds
    radius = _SLACK * float(linalg.length((high - low) * 0.5)) or 1.0
    if "lens" in said:
        away = float(linalg.length(pose[:3, 3] - (low + high) * 0.5))
        far = said.get("far", away + radius)
        lens: Any = camera_of_record(said["lens"], "camera: lens")
        lens.znear, lens.zfar = said.get("near", _NEAREST * far), far
        return lens
    away = float(linalg.dot(pose[:3, 3] - (low + high) * 0.5, pose[:3, 2]))
    far = said.get("far", max(away + radius, radius))
    near = said.get("near", max(away - radius, _NEAREST * far))
    if "height" in said:
        return OrthographicCamera(0.5 * said["height"], znear=near, zfar=far)
    if "intrinsics" in said:
        return IntrinsicsCamera(**said["intrinsics"], znear=near, zfar=far)
    yfov = math.radians(said.get("yfov_degrees", _YFOV))
    return PerspectiveCamera(yfov, znear=near, zfar=far)
