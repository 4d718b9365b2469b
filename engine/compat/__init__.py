"""Modules compatible with other packages, drawn by this engine."""

from importlib import import_module

__all__ = ["matplotlib", "mujoco", "pyrender", "pyvista", "trimesh"]


def __getattr__(name):
    """Import a module on first use, as for ``engine3d.batch``."""
    if name not in __all__:
        raise AttributeError(f"module 'engine3d.compat' has no attribute {name!r}")
    return import_module(f".{name}", __name__)
