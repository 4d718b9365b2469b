"""Imports Open3D, also on machines without OpenGL, EGL and X11."""

from __future__ import annotations

import sys
from importlib.util import find_spec
from types import ModuleType

from ...base.optional_packages import require
from ._stand_ins import provide_missing


def load() -> ModuleType:
    """Return the package open3d.

    Raises
    ------
    ModuleNotFoundError
        It is not installed.
    ImportError
        A library is missing that Open3D calls.
    """
    require("open3d", "engine3d.compat.open3d", "open3d")
    if "open3d" not in sys.modules:
        spec = find_spec("open3d")
        for folder in (spec and spec.submodule_search_locations) or ():
            provide_missing(folder)
    import open3d

    return open3d
