"""Open3D's visualizers, drawn by this engine on the CPU: no OpenGL, no EGL, no Vulkan, no display.

``engine3d.compat.open3d.install()`` puts them in the place of Open3D's; docs/open3d.md tells what
works and what differs. Importing this module imports open3d, also on machines without libGL, libEGL
and libX11. Needs the extra ``open3d``.
"""

from ._loading import load

load()

from .visualizer import Visualizer  # noqa: E402

__all__ = ["Visualizer"]
