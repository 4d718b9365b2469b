"""Installs this module as pyrender, for programs that cannot be changed."""

from __future__ import annotations

import sys
from importlib import import_module

_MODULES = (
    *("camera", "constants", "light", "material", "mesh", "node", "offscreen", "platforms"),
    *("primitive", "renderer", "sampler", "scene", "shader_program", "texture", "trackball"),
    *("utils", "version", "viewer"),
)


def install() -> None:
    """Make ``import pyrender`` and ``import pyrender.…`` load this module from now on.

    Call it before the first import of pyrender: earlier importers keep the original.
    """
    package = __package__
    sys.modules["pyrender"] = sys.modules[package]
    for name in _MODULES:
        sys.modules[f"pyrender.{name}"] = import_module(f"{package}.{name}")
