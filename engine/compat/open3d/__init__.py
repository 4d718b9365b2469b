"""Open3D's visualizers, drawn by this engine on the CPU: no OpenGL, no EGL, no Vulkan, no display.

``engine3d.compat.open3d.install()`` puts them in the place of Open3D's; docs/open3d.md tells what
works and what differs. Importing this module imports open3d, also on machines without libGL, libEGL
and libX11. Needs the extra ``open3d``.
"""

from ._loading import load

load()

from . import rendering  # noqa: E402
from .drawing_functions import (  # noqa: E402
    draw,
    draw_geometries,
    draw_geometries_with_animation_callback,
    draw_geometries_with_key_callbacks,
)
from .key_callbacks import VisualizerWithKeyCallback  # noqa: E402
from .render_option import RenderOption  # noqa: E402
from .replacing import install  # noqa: E402
from .view_control import ViewControl  # noqa: E402
from .visualizer import Visualizer  # noqa: E402

__all__ = [
    "RenderOption",
    "ViewControl",
    "Visualizer",
    "VisualizerWithKeyCallback",
    "draw",
    "draw_geometries",
    "draw_geometries_with_animation_callback",
    "draw_geometries_with_key_callbacks",
    "install",
    "rendering",
]
