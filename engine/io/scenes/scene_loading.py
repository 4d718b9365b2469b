"""Builds a scene from a file or document with objects, lights and cameras.

In: a path, or its `Document`. Out: a `Scene` in the file's coordinates, with the file's tree of
nodes if it has one, else one node an object. This module converts differing concepts of files
(lights without falloff, camera rolls).
"""

from __future__ import annotations

import os
from collections.abc import Callable
from typing import TYPE_CHECKING

import numpy as np

from ...base import linalg
from ...base.calls import checks_types
from ...errors import InvalidArgumentError
from ...model.geometry.creases import CREASE_ANGLE
from ...model.materials.linear_colors import LinearColor
from ...model.scene.cameras import PerspectiveCamera
from ...model.scene.lights import WHITE_INTENSITY, DirectionalLight, PointLight
from ...model.scene.scene import Scene
from ..loaders import CameraRecord, Document, LightRecord, load_document
from ..reading.sources import File

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from ..reading.robot_options import RobotOptions


@checks_types
def load_scene(
    path: File,
    *,
    format: str | None = None,
    progress: Callable[[float], object] | None = None,
    variant: str | int | None = None,
    crease_angle: float = CREASE_ANGLE,
    root: str | os.PathLike[str] | None = None,
    **robot: Unpack[RobotOptions],
) -> Scene:
    """Load a file with all its objects, lights, cameras, skins and animations.

    Parameters
    ----------
    path : str, path-like, bytes, binary file object or Traversable
        A file of any mesh format; as in `load_mesh`.
    format : str, optional
        The format's name, such as ``"asc"``; by default detected by content and name.
    progress : callable, optional
        As in `load_mesh`.
    variant : str or int, optional
        The name or number of a glTF file's material variant (KHR_materials_variants); by default
        the standard materials.
    crease_angle : float, optional
        As in `load_mesh`.
    root, **robot
        As in `load_mesh`.

    Returns
    -------
    scene : Scene
        In the file's coordinates; ``scene.warnings`` lists what was omitted or replaced, and
        ``scene.robots`` has the robot of a URDF file.

    Raises
    ------
    FileFormatError, FileAccessError, InvalidArgumentError
    """
    document = load_document(
        path,
        format=format,
        progress=progress,
        crease_angle=crease_angle,
        root=root,
        **robot,
    )
    return scene_from_document(document, variant)


@np.errstate(all="ignore")
def scene_from_document(document: Document, variant: str | int | None = None) -> Scene:
    """Return the scene that a document describes; ``variant`` as in `load_scene`.

    Raises
    ------
    InvalidArgumentError
        The variant does not exist.
    """
    scene = Scene() if document.made is None else document.made.copy()
    scene.warnings = list(document.warnings)
    if variant is not None:
        from .tree_records import choose_variant

        choose_variant(document.tree, variant)
    if document.made is not None:
        return scene
    if document.tree is not None:
        from .tree_records import fill_from_tree

        if document.states_sides:
            scene.ambient = (0, 0, 0)  # glTF has no ambient light
        fill_from_tree(scene, document.tree)
        return scene
    if document.scene is not None:
        from .scene_records import fill_scene

        fill_scene(scene, document.scene)
        return scene
    for name, mesh, pose in document.objects:
        scene.add(mesh, name=name, pose=pose)
    bounds = scene.bounds
    for light in document.lights:
        _try_light(scene, light, bounds)
    for camera in document.cameras:
        _add_camera(scene, camera, bounds)
    return scene


def _try_light(scene: Scene, record: LightRecord, bounds: np.ndarray) -> None:
    """Add a light, or warn why it is left out."""
    try:
        _add_light(scene, record, bounds)
    except InvalidArgumentError as error:
        scene.warnings.append(f"light {record.name!r} is left out: {error}")


def _add_light(scene: Scene, record: LightRecord, bounds: np.ndarray) -> None:
    """Add a light; file lights have no falloff, so match their brightness at the scene's centre."""
    color = LinearColor(float(component) for component in record.color)
    if record.kind == "ambient":
        scene.ambient = LinearColor(component * record.intensity for component in color)
        return
    strength = record.intensity * WHITE_INTENSITY
    if record.kind == "directional" and record.target is not None:
        direction = np.subtract(record.target, record.position)
        scene.add(DirectionalLight(direction, color, strength), name=record.name)
        return
    if record.kind == "spot":
        scene.warnings.append(f"spot light {record.name!r} shines in all directions")
    distance = max(_distance(record.position, bounds), _radius(bounds))
    light = PointLight(color, strength * distance * distance)
    scene.add(light, name=record.name, translation=record.position)


def _add_camera(scene: Scene, record: CameraRecord, bounds: np.ndarray) -> None:
    distance, radius = _distance(record.position, bounds), _radius(bounds)
    zfar = 1.1 * (distance + radius)
    znear = max(0.9 * (distance - radius), 1e-3 * zfar)
    try:
        pose = linalg.look_at(record.position, record.target, record.up)
        camera = PerspectiveCamera(record.yfov, znear=znear, zfar=zfar)
    except InvalidArgumentError as error:
        scene.warnings.append(f"camera {record.name!r} is left out: {error}")
        return
    pose = linalg.multiply(pose, linalg.rotation_z(record.roll))
    scene.add(camera, name=record.name, pose=pose)


def _distance(position: tuple[float, float, float], bounds: np.ndarray) -> float:
    """Return the distance of a point from the centre of a box."""
    return float(linalg.length(np.subtract(position, (bounds[0] + bounds[1]) * 0.5)))


def _radius(bounds: np.ndarray) -> float:
    """Return half the diagonal of a box, 1 for an empty one."""
    return float(linalg.length((bounds[1] - bounds[0]) * 0.5)) or 1.0
