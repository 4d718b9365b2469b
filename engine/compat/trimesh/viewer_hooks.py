"""Takes the place of trimesh's window, which needs pyglet and a display."""

from __future__ import annotations

import sys
from typing import Any

import trimesh.viewer

from . import windowed

_NAME = "trimesh.viewer.windowed"
_NAMES = ("windowed", "SceneViewer", "render_scene")

#: What trimesh had, by name; None for what it lacked.
_kept: dict[str, Any] = {}


def install() -> None:
    """Let engine3d draw what ``trimesh.Scene.save_image`` and ``show`` do.

    Examples
    --------
    >>> import engine3d.compat.trimesh
    >>> engine3d.compat.trimesh.install()
    """
    if _kept:
        return
    viewer: Any = trimesh.viewer
    _kept[_NAME] = sys.modules.get(_NAME)
    _kept.update({name: getattr(viewer, name, None) for name in _NAMES})
    sys.modules[_NAME] = windowed
    viewer.windowed = windowed
    viewer.SceneViewer, viewer.render_scene = windowed.SceneViewer, windowed.render_scene


def uninstall() -> None:
    """Undo `install`."""
    if not _kept:
        return
    module = _kept.pop(_NAME)
    if module is None:
        sys.modules.pop(_NAME, None)
    else:
        sys.modules[_NAME] = module
    while _kept:
        name, value = _kept.popitem()
        if value is None:
            delattr(trimesh.viewer, name)
        else:
            setattr(trimesh.viewer, name, value)
