"""Open3D's offscreen renderer and its scene, drawn by this engine: no Vulkan, no display.

`install` of the package above puts these names into ``open3d.visualization.rendering``. Materials,
models, gradients and colour grading stay Open3D's.
"""

from .._loading import load
from .low_level_scene import Scene
from .offscreen_renderer import OffscreenRenderer
from .open3d_scene import Open3DScene
from .view import View
from .view_camera import Camera

_own = load().visualization.rendering
ColorGrading = _own.ColorGrading
Gradient = _own.Gradient
MaterialRecord = _own.MaterialRecord
TriangleMeshModel = _own.TriangleMeshModel

__all__ = [
    "Camera",
    "ColorGrading",
    "Gradient",
    "MaterialRecord",
    "OffscreenRenderer",
    "Open3DScene",
    "Scene",
    "TriangleMeshModel",
    "View",
]
