"""Loads files as scenes that stand upright in metres, whatever the axes and units of their formats.

In: a path. Out: a `Scene` whose +Y is up; `scene_loading` keeps the coordinates of files.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from ...base.calls import checks_types
from ...model.scene.orbiting import home_axes
from ...model.scene.scene import Scene
from ..formats.threemf.threemf_model import METRES
from ..reading.loading import load_document
from ..reading.sources import File
from .scene_loading import scene_from_document

if TYPE_CHECKING:
    from numpy.typing import NDArray

_UP = {"X": (1.0, 0.0, 0.0), "Y": (0.0, 1.0, 0.0), "Z": (0.0, 0.0, 1.0)}


@checks_types
def load(path: File, *, variant: str | int | None = None, **options: Any) -> Scene:
    """Load a file as a scene that stands upright: +Y is up.

    `load_scene` and `load_mesh` keep the file's coordinates.

    Parameters
    ----------
    path : str, path-like, bytes, binary file object or Traversable
        A file of any mesh format; as in `load_mesh`.
    variant, **options
        As in `load_scene`.

    Returns
    -------
    scene : Scene
        If the up direction of the format is another one, all of the file's nodes are below a node
        ``"upright"``, which turns them. If the format has a unit, it also scales them to metres.

    Raises
    ------
    FileFormatError, FileAccessError, InvalidArgumentError

    Examples
    --------
    >>> scene = e3d.load("part.stl")
    >>> e3d.render(scene).save("part.png")
    """
    document = load_document(path, **options)
    scene = scene_from_document(document, variant)
    stand_upright(scene, document.up, document.unit)
    return scene


def stand_upright(scene: Scene, up: str, unit: str = "") -> None:
    """Put all nodes of a scene below one that turns its up direction to +Y, unless it is +Y.

    Parameters
    ----------
    scene : Scene
    up : {"+X", "-X", "+Y", "-Y", "+Z", "-Z"}
    unit : str
        The symbol of the unit that becomes a metre, such as ``"mm"``; empty: lengths stay.
    """
    pose = _upright_pose(up, unit)
    if pose is None:
        return
    tops = [node for node in scene.nodes if node.parent is None]
    group = scene.add(name="upright", pose=pose)
    for node in tops:
        node.reparent(group, keep_world_pose=False)


def _upright_pose(up: str, unit: str) -> NDArray[np.float64] | None:
    """Return the pose that turns a file's up direction to +Y and its unit to metres, or None."""
    scale = METRES.get(unit, 1.0)
    if up == "+Y" and scale == 1.0:
        return None
    direction = np.array(_UP[up[1]]) * (1.0 if up[0] == "+" else -1.0)
    pose = np.eye(4)
    pose[:3, :3] = np.stack(tuple(home_axes(direction))) * scale
    return pose
