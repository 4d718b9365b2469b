"""pyrender's names with pyrender's meaning, drawn by this engine on the CPU.

``import engine3d.compat.pyrender as pyrender`` is all that a program has to change; one that cannot
be changed runs after `install`. docs/pyrender.md tells what works and what differs.
"""

from . import platforms, shader_program, trackball, utils
from .camera import Camera, IntrinsicsCamera, OrthographicCamera, PerspectiveCamera
from .constants import GLTF, RenderFlags, TextAlign
from .installing import install
from .light import DirectionalLight, Light, PointLight, SpotLight
from .material import Material, MetallicRoughnessMaterial
from .mesh import Mesh
from .node import Node
from .offscreen import OffscreenRenderer
from .primitive import Primitive
from .renderer import Renderer
from .sampler import Sampler
from .scene import Scene
from .settings import settings
from .texture import Texture
from .version import __version__
from .viewer import Viewer

__all__ = [
    "GLTF",
    "Camera",
    "DirectionalLight",
    "IntrinsicsCamera",
    "Light",
    "Material",
    "Mesh",
    "MetallicRoughnessMaterial",
    "Node",
    "OffscreenRenderer",
    "OrthographicCamera",
    "PerspectiveCamera",
    "PointLight",
    "Primitive",
    "RenderFlags",
    "Renderer",
    "Sampler",
    "Scene",
    "SpotLight",
    "TextAlign",
    "Texture",
    "Viewer",
    "__version__",
    "install",
    "platforms",
    "settings",
    "shader_program",
    "trackball",
    "utils",
]
