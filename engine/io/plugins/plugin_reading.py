"""Reads files with the readers of other packages.

In: a plug-in of the group ``engine3d.readers``, and a `Source`. Out: a `Document` of the mesh or
scene that it returns, checked as that of any reader. Errors name the file, and the plug-in unless
it said itself what is wrong with the file.
"""

from __future__ import annotations

import re
from typing import Any

from ...base import linalg
from ...base.numbers import shown
from ...base.plugins.plugin import Plugin, fault
from ...errors import (
    Engine3DError,
    FileAccessError,
    FileFormatError,
    PluginError,
)
from ...model.geometry.creases import SMOOTH
from ...model.geometry.mesh import Mesh
from ...model.scene.instances import InstancedMesh
from ...model.scene.scene import Scene
from ..reading.documents import Document, DocumentObject
from ..reading.open_files import unreadable
from ..reading.posed_parts import MAX_REPEATED, PosedPart, counts_of, document_objects
from ..reading.sources import Source
from ..reading.warning_list import WarningList
from .plugin_files import PluginFile

_UP = re.compile(r"[+-][XYZ]")


def up_of(plugin: Plugin, source: Source) -> str:
    """Return the up axis that a reader states for its format, imported for that; +Y by default.

    Raises
    ------
    FileFormatError
        The plug-in cannot be imported, or is no reader.
    """
    try:
        read = plugin.load()
        up = getattr(read, "up", "+Y")
        if not (isinstance(up, str) and _UP.fullmatch(up)):
            raise fault(plugin, f'says up = {shown(up)}: it must be one of "+Y", "+Z", "-X", …')
    except PluginError as error:
        raise FileFormatError(str(error), source.path) from error
    return up


def read_with_plugin(plugin: Plugin, source: Source, split: bool = False) -> Document:
    """Read a file with a plug-in, as `Reader.read`."""
    warnings = WarningList(source.path)
    made = _made(plugin, source, PluginFile(source, warnings=warnings))
    if isinstance(made, Mesh):
        _crease(made, source)
        objects = [DocumentObject(made.name or source.stem or plugin.name, made)]
        if not len(made.positions):
            raise FileFormatError("no vertices in this file", source.path)
        scene = None
    else:
        parts = _parts(made)
        for part in parts:
            _crease(part.mesh, source)
        objects = document_objects(source, parts, MAX_REPEATED + source.size, split)
        scene = made
    told = [*made.warnings, *warnings.messages()]
    return Document(plugin.name, objects, counts=counts_of(objects), warnings=told, made=scene)


def _made(plugin: Plugin, source: Source, file: PluginFile) -> Mesh | Scene:
    """Return what a reader returns; all its errors are about the file."""
    try:
        with plugin.named_in_errors(OSError):
            made = plugin.use()(file)
    except FileFormatError as error:
        if error.path is not None:
            raise
        raise FileFormatError(error.message, source.path, error.line) from error
    except OSError as error:
        raise _inaccessible(plugin, source, error) from error
    except PluginError as error:
        raise FileFormatError(str(error), source.path) from (error.__cause__ or error)
    except Engine3DError as error:
        raise FileFormatError(f"{plugin}: {error}", source.path) from error
    if not isinstance(made, (Mesh, Scene)):
        kind = type(made).__name__
        raise FileFormatError(
            f"{plugin} returned {'nothing' if made is None else kind}, not a Mesh or a Scene",
            source.path,
        )
    return made


def _inaccessible(plugin: Plugin, source: Source, error: OSError) -> FileAccessError:
    """Return the error to raise where a reader cannot read a file, its own or another."""
    if not isinstance(error, FileAccessError):
        error = unreadable(str(error.filename or source.path), error)
    return FileAccessError(f"{plugin}: {error.message}", error.path or source.path)


def _parts(scene: Scene) -> list[PosedPart]:
    """Return the visible meshes of a scene, those of instances one by one."""
    parts = []
    for node in scene.nodes:
        thing: Any = node.object
        if not node.shown:
            continue
        if isinstance(thing, Mesh):
            parts.append(PosedPart(node.name or thing.name, thing, node.world_pose))
        elif isinstance(thing, InstancedMesh):
            poses = linalg.multiply(node.world_pose, thing.poses)
            parts += [PosedPart(node.name, thing.mesh, pose) for pose in poses]
    return parts


def _crease(mesh: Mesh, source: Source) -> None:
    """Let normals that a mesh lacks follow the caller's crease angle, as in other formats."""
    if not mesh.has_normals and mesh.crease_angle == SMOOTH:
        mesh.crease_angle = source.crease_angle
