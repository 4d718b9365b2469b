"""Packages that pages of the documentation import, and that a first install lacks."""

import re
from importlib.util import find_spec

EXTRAS = ("build123d", "matplotlib", "meshio", "mujoco", "open3d", "pandas")
EXTRAS += ("pybullet", "pyvista", "trimesh")


def missing_extra(text):
    """Return the first of these packages that a page imports and that isn't there, or None."""
    named = (each for each in EXTRAS if re.search(rf"import (engine3d\.compat\.)?{each}\b", text))
    return next((each for each in named if find_spec(each) is None), None)
