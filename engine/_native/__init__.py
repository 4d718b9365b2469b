"""The only gateway to the C core: one compiled module for each part of its API.

Modules here check shapes and dtypes, release the GIL, make one C call and turn its status into an
exception. They hold no algorithm and no loop over pixels, vertices or triangles.

All are in one shared library, ``_core``, so that there is one core in a process, with one pool of
threads, and a handle of one module is plain memory to another. Python looks for each in a file of
its own name: `_CoreFinder` leads it to that library.
"""

from __future__ import annotations

import sys
from importlib.machinery import EXTENSION_SUFFIXES, ExtensionFileLoader, ModuleSpec
from importlib.util import spec_from_file_location
from os.path import dirname, exists, join
from typing import Any

MODULES = (
    "canvas",
    "drawing",
    "images",
    "lens",
    "loaders",
    "mujoco",
    "navigation",
    "pybullet",
    "pyrender",
    "rasterizer",
    "scene_graph",
    "ui",
    "writers",
)


class _CoreFinder:
    """Finds the modules that the library holds; ``_common`` is what Cython writes for all."""

    _names = frozenset(f"{__name__}.{module}" for module in (*MODULES, "_common"))
    _places = [join(dirname(__file__), f"_core{suffix}") for suffix in EXTENSION_SUFFIXES]

    @classmethod
    def find_spec(cls, name: str, path: Any = None, target: Any = None) -> ModuleSpec | None:
        library = next(filter(exists, cls._places), None) if name in cls._names else None
        if library is None:
            return None
        return spec_from_file_location(name, library, loader=ExtensionFileLoader(name, library))


sys.meta_path.append(_CoreFinder)
