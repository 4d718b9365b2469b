"""Writes an agent's objects, or its last picture, to a file below the root folder."""

from __future__ import annotations

import os
from typing import Any

from ...base import linalg
from ...base.files.atomic_write import atomic_write
from ...base.validation import choose
from ...errors import InvalidArgumentError, warn
from ...io.formats.gltf.gltf_writer import EXTENSIONS as SCENE_EXTENSIONS
from ...io.output.animation_files import PICTURE_SUFFIXES
from ...io.writers import formats, save_mesh
from ...io.writing.scene_saving import save_scene
from ...io.writing.writer_registry import SCENE_EXTENSION, find_writer
from ...model.geometry.mesh import Mesh
from ...model.geometry.posing import posed_mesh
from ...model.scene.instances import InstancedMesh, instance_matrices
from ...model.scene.scene import Scene
from .pictures import visible_parts
from .session import Session
from .shown_scene import light_scene, lights_of
from .things import Part, Thing

#: Of pictures only PNG: it keeps every pixel.
_PICTURE = ".png"


def export(
    session: Session, path: str, objects: Any, format: str, overwrite: bool
) -> dict[str, Any]:
    """Write objects as a model, or with a path that ends in .png the last picture.

    Raises
    ------
    InvalidArgumentError, FileAccessError
    """
    target = session.limits.path_to_write(path, overwrite)
    if format:
        choose(f".{format.lower().lstrip('.')}", written_formats(), "export: format")
    suffix = f".{format.lower().lstrip('.')}" if format else os.path.splitext(path)[1].lower()
    if suffix in PICTURE_SUFFIXES:
        _save_picture(session, target, suffix)
    else:
        parts = visible_parts(session.things, objects, ())
        if not parts:
            raise InvalidArgumentError("export: there is no object to write")
        with session.limits.reading():  # images are copied from the files that they came from
            _save_model(parts, session.things.lamps(objects), target, suffix)
    return {"path": session.limits.shown(target), "bytes": os.path.getsize(target)}


def _save_picture(session: Session, target: str, suffix: str) -> None:
    if suffix != _PICTURE:
        raise InvalidArgumentError(f"export: pictures are written as {_PICTURE}, not {suffix}")
    if session.last is None:
        raise InvalidArgumentError("export: there is no picture yet: call render first")
    with atomic_write(target) as file:
        file.write(session.last.encode())


def _save_model(
    parts: list[tuple[Thing, Part]], lamps: list[Thing], target: str, suffix: str
) -> None:
    if suffix in SCENE_EXTENSIONS or suffix == SCENE_EXTENSION:
        if not target.lower().endswith(suffix):
            raise InvalidArgumentError(f"export: the path of a {suffix} file ends in {suffix}")
        save_scene(_scene(parts, lamps), target)
        return
    if lights := lights_of(parts, lamps):
        warn(f"{target}: {suffix} files hold no lights: {len(lights)} left out")
    writer = find_writer(target, suffix)
    meshes, names = [], []
    for thing, part in parts:
        instanced = isinstance(part.drawn, InstancedMesh)
        for own in instance_matrices(part.drawn.poses) if instanced else [None]:
            mesh = part.drawn.mesh if instanced else part.drawn
            pose = part.pose if own is None else linalg.multiply(part.pose, own)
            meshes.append(posed_mesh(mesh, pose))
            names.append(thing.label(part))
    save_mesh(Mesh.concatenate(meshes, name=names[0]), target, format=writer.name)


def _scene(parts: list[tuple[Thing, Part]], lamps: list[Thing]) -> Scene:
    scene = Scene()
    for thing, part in parts:
        scene.add(part.drawn, name=thing.label(part), pose=part.pose)
    light_scene(scene, parts, lamps)
    return scene


def written_formats() -> list[str]:
    """Return the extensions that `export` writes."""
    ends = {end for one in formats() for end in one.extensions}
    return sorted({*ends, SCENE_EXTENSION, _PICTURE})
