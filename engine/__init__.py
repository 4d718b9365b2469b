"""engine3d: draw 3D scenes on the CPU, the same bytes on every machine.

This module is the list of public names and nothing else: each is imported from its module when it
is first used, so that ``import engine3d`` costs next to nothing. `__init__.pyi` says the same to
type checkers. docs/conventions.md tells the spaces, units and colours that hold everywhere.
"""

if __name__ != "engine3d":
    raise ImportError(
        f"this package is engine3d and was imported as {__name__!r}: install it (pip install .) "
        "and import engine3d"
    )

from importlib import import_module

from .version import __version__

# public name -> module that defines it
_PUBLIC = {
    "BackendError": "errors",
    "DisplayError": "errors",
    "Engine3DError": "errors",
    "Engine3DWarning": "errors",
    "FileAccessError": "errors",
    "FileFormatError": "errors",
    "InvalidArgumentError": "errors",
    "MissingOutputError": "errors",
    "OutOfMemoryError": "errors",
    "RendererBusyError": "errors",
    "SceneChangedError": "errors",
    "Mesh": "geometry.mesh",
    "Material": "materials.material",
    "Texture": "materials.textures",
    "PlacedTexture": "materials.textures",
    "Environment": "environments.environment",
    "InstancedMesh": "scene.instances",
    "Fog": "scene.fog",
    "ExponentialFog": "scene.fog",
    "Gradient": "scene.gradients",
    "box": "primitives",
    "cylinder": "primitives",
    "hexahedron": "primitives",
    "icosphere": "primitives",
    "plane": "primitives",
    "quad": "primitives",
    "torus": "primitives",
    "uv_sphere": "primitives",
    "World": "worlds",
    "city": "worlds",
    "DetailedInstances": "lod",
    "DetailedMeshes": "lod",
    "Impostor": "lod",
    "simplify": "lod",
    "NavigationGrid": "navigation",
    "Walker": "navigation",
    "load_mesh": "loaders",
    "load_texture": "loaders",
    "load_scene": "scene.loading",
    "save_mesh": "writers",
    "save_scene": "writers.scene",
    "save_animation": "files.animation_saving",
    "look_at": "linalg",
    "orbit": "scene.orbiting",
    "Camera": "scene.cameras",
    "IntrinsicsCamera": "scene.cameras",
    "OrthographicCamera": "scene.cameras",
    "PerspectiveCamera": "scene.cameras",
    "frame_bounds": "rendering.framing",
    "frame_scene": "rendering.framing",
    "DirectionalLight": "scene.lights",
    "PointLight": "scene.lights",
    "SpotLight": "scene.lights",
    "HemisphereLight": "scene.ambient_lights",
    "LightProbe": "scene.ambient_lights",
    "Animator": "scene.animation",
    "MorphTarget": "geometry.morph_targets",
    "Skin": "motion.skins",
    "AnimationClip": "motion.clips",
    "AnimationPlayer": "motion.player",
    "Channel": "motion.clips",
    "PropertyChannel": "motion.properties",
    "Node": "scene.nodes",
    "Resource": "files.resources",
    "Resources": "files.resources",
    "ResourceStats": "files.resources",
    "NodeSelection": "scene.selection",
    "Scene": "scene.scene",
    "BoxCollider": "spatial.colliders",
    "ColliderHit": "spatial.colliders",
    "MeshCollider": "spatial.colliders",
    "SphereCollider": "spatial.colliders",
    "RayHit": "spatial.rays",
    "RayHits": "spatial.rays",
    "Frame": "rendering.frame",
    "RenderOptions": "rendering.options",
    "Renderer": "rendering.renderer",
    "render": "rendering.renderer",
    "Canvas": "canvas",
    "Sheet": "sheet.sheet",
    "contact_sheet": "sheet.sheet",
    "Window": "viewer.window",
    "show": "viewer.show",
    "RasterizeResult": "rendering.rasterization",
    "rasterize": "rendering.rasterization",
    "backends": "rendering.backend_selection",
}
_MODULES = (
    *("batch", "choices", "datasets", "errors", "events", "linalg", "loaders", "primitives"),
)

# Modules that need other packages, or few programs need: not for ``import *``.
_MODULES_APART = ("compat", "golden", "notebook")

__all__ = ["__version__", *_PUBLIC, *_MODULES]


def __getattr__(name):
    """Import a public name from its module on first use (PEP 562)."""
    if name in _PUBLIC:
        value = getattr(import_module(f".{_PUBLIC[name]}", __name__), name)
    elif name in _MODULES or name in _MODULES_APART:
        value = import_module(f".{name}", __name__)
    elif name[0] == "_":  # Python's own questions
        raise AttributeError(f"module 'engine3d' has no attribute {name!r}")
    else:
        from ._support.foreign_names import UnknownName

        raise UnknownName(__name__, name, __all__)
    globals()[name] = value
    return value


def __dir__():
    return sorted(__all__)  # not the modules behind them, which are imported as they are used
