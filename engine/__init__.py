"""engine3d: draw 3D scenes on the CPU, the same bytes on every machine.

This module only lists the public names: each is imported from its module on first use, so that
``import engine3d`` is fast. `__init__.pyi` declares the same for type checkers. docs/conventions.md
defines the spaces, units and colours used everywhere.
"""

if __name__ != "engine3d":
    raise ImportError(
        f"this package is engine3d and was imported as {__name__!r}: install it (pip install .) "
        "and import engine3d"
    )

from importlib import import_module

from .version import PICTURES, __version__

# public name -> module that defines it
_PUBLIC = {
    "Engine3DError": "errors",
    "Engine3DWarning": "errors",
    "FileAccessError": "errors",
    "FileFormatError": "errors",
    "InvalidArgumentError": "errors",
    "Mesh": "model.geometry.mesh",
    "Material": "model.materials.material",
    "linear": "model.materials.linear_colors",
    "Texture": "model.materials.textures",
    "PlacedTexture": "model.materials.textures",
    "Environment": "model.environments.environment",
    "InstancedMesh": "model.scene.instances",
    "Fog": "model.scene.fog",
    "ExponentialFog": "model.scene.fog",
    "Gradient": "model.scene.gradients",
    "box": "model.primitives",
    "cylinder": "model.primitives",
    "icosphere": "model.primitives",
    "plane": "model.primitives",
    "torus": "model.primitives",
    "uv_sphere": "model.primitives",
    "load": "io.scenes.upright_loading",
    "load_mesh": "io.loaders",
    "load_camera": "io.camera_files",
    "load_texture": "io.loaders",
    "load_scene": "io.scenes.scene_loading",
    "save_mesh": "io.writers",
    "save_scene": "io.writing.scene_saving",
    "save_animation": "io.output.animation_saving",
    "look_at": "base.linalg",
    "orbit": "model.scene.orbiting",
    "Camera": "model.scene.cameras",
    "IntrinsicsCamera": "model.scene.cameras",
    "OrthographicCamera": "model.scene.cameras",
    "PerspectiveCamera": "model.scene.cameras",
    "BrownConradyCamera": "model.scene.lenses.brown_conrady_camera",
    "CylindricalCamera": "model.scene.lenses.panorama_cameras",
    "DoubleSphereCamera": "model.scene.lenses.double_sphere_camera",
    "EquirectangularCamera": "model.scene.lenses.panorama_cameras",
    "FisheyeCamera": "model.scene.lenses.fisheye_camera",
    "frame_bounds": "stage.views.framing",
    "frame_scene": "stage.views.framing",
    "DirectionalLight": "model.scene.lights",
    "PointLight": "model.scene.lights",
    "SpotLight": "model.scene.lights",
    "HemisphereLight": "model.scene.ambient_lights",
    "LightProbe": "model.scene.ambient_lights",
    "Animator": "model.scene.animation",
    "Values": "model.geometry.values",
    "AnimationPlayer": "model.motion.player",
    "Node": "model.scene.nodes",
    "NodeSelection": "model.scene.selection",
    "Scene": "model.scene.scene",
    "RayHit": "model.spatial.rays",
    "RayHits": "model.spatial.rays",
    "Frame": "rendering.frame",
    "RenderOptions": "rendering.options",
    "Renderer": "stage.renderer",
    "Look": "stage.look",
    "render": "stage.render",
    "Canvas": "rendering.canvas",
    "Font": "rendering.fonts.font",
    "Window": "apps.viewer.window",
    "show": "apps.viewer.show",
    "backends": "rendering.backend_selection",
}
_MODULES = (
    *("batch", "choices", "colliders", "datasets", "detail", "drawings", "errors", "events"),
    *("lights", "linalg", "loaders", "measuring", "motion", "navigation", "plugins"),
    *("primitives", "rasterization", "resources", "sensors", "sheets", "worlds"),
)

# Modules with optional dependencies or few users: not for ``import *``.
_MODULES_APART = ("compat", "golden", "notebook")

__all__ = ["PICTURES", "__version__", *_PUBLIC, *_MODULES]


def _names():
    """Return the public names; those in a module with the module's, such as ``worlds.city``."""
    modules = {each: import_module(f".{each}", __name__) for each in _MODULES}
    inner = (f"{each}.{name}" for each, m in modules.items() for name in getattr(m, "__all__", ()))
    return [*__all__, *inner]


def __getattr__(name):
    """Import a public name from its module on first use (PEP 562)."""
    if name in _PUBLIC:
        value = getattr(import_module(f".{_PUBLIC[name]}", __name__), name)
    elif name in _MODULES or name in _MODULES_APART:
        value = import_module(f".{name}", __name__)
    elif name[0] == "_":  # special names that Python itself asks for
        raise AttributeError(f"module 'engine3d' has no attribute {name!r}")
    else:
        from .base.foreign_names import UnknownName

        raise UnknownName(__name__, name, _names)
    globals()[name] = value
    return value


def __dir__():
    return sorted(__all__)  # without the modules behind them, which are imported as they are used
