"""Taking pyrender's place for programs that cannot be changed."""

from __future__ import annotations

import sys
from importlib import import_module

_MODULES = (
    *("camera", "constants", "light", "material", "mesh", "node", "offscreen", "platforms"),
    *("primitive", "renderer", "sampler", "scene", "shader_program", "texture", "trackball"),
    *("utils", "version", "viewer"),
)


def install() -> None:
    """Let ``import pyrender`` and ``import pyrender.…`` find this module from now on.

    Call it before the first import of pyrender. Modules that imported pyrender before keep it.
    """
    package = __package__
    sys.modules["pyrender"] = sys.modules[package]
    for name in _MODULES:
        sys.modules[f"pyrender.{name}"] = import_module(f"{package}.{name}")
