"""Puts these visualizers in the place of Open3D's, for programs that cannot be changed."""

from __future__ import annotations

from . import drawing_functions, rendering
from ._loading import load
from .key_callbacks import VisualizerWithKeyCallback
from .visualizer import Visualizer


def install() -> None:
    """Make ``open3d.visualization`` draw by this engine from now on.

    Replaced are ``Visualizer``, ``VisualizerWithKeyCallback``, ``draw`` and the functions
    ``draw_geometries…`` but those for editing and selecting; and in its module ``rendering``
    ``OffscreenRenderer``, ``Open3DScene``, ``Scene``, ``View`` and ``Camera``. Call it before the
    program takes these names by ``from open3d.visualization import …``.
    """
    package = load()
    replaced = {
        "Visualizer": Visualizer,
        "VisualizerWithKeyCallback": VisualizerWithKeyCallback,
        **{name: getattr(drawing_functions, name) for name in drawing_functions.__all__},
    }
    package.visualization.__dict__.update(replaced)
    for name in ("OffscreenRenderer", "Open3DScene", "Scene", "View", "Camera"):
        setattr(package.visualization.rendering, name, getattr(rendering, name))
