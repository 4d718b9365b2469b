"""Names from other libraries, and their equivalents here.

In: a class, module or function, and a name that it lacks. Out: the end of a sentence that suggests
a name, or nothing. The names come from pyrender, trimesh, three.js, Open3D, PyVista and Blender;
other names are treated as possible typos.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import Any, NoReturn, TypeVar

from .near_words import nearest

Kind = TypeVar("Kind", bound=type)

_PLACED = "its place is its node's: scene.add({thing}, {how})"
_LIGHT = _PLACED.format(thing="light", how="translation=(x, y, z)")
_CAMERA = _PLACED.format(thing="camera", how="pose=engine3d.look_at(eye, target)")
_PLACES = ("position", "translation", "location", "pose", "rotation", "euler", "eye", "target")
_SIZE = "size=(width, height)"
_HITS = {
    "face": "face_id",
    "triangle": "face_id",
    "triangle_id": "face_id",
    "index_tri": "face_id",
    "instance": "instance_id",
    "point": "position",
    "location": "position",
}
_MATERIALS = "mesh.materials[0].{}"
_LIGHT_NODES = "[node for node in scene.nodes if isinstance(node.object, engine3d.PointLight)]"

#: By class or function: a foreign name, and the name here or an explanation.
_NAMES: dict[str, dict[str, str]] = {
    "engine3d": {
        "sphere": "uv_sphere or icosphere",
        "Sphere": "uv_sphere or icosphere",
        "SphereGeometry": "uv_sphere",
        "ico_sphere": "icosphere",
        "cube": "box",
        "Cube": "box",
        "Box": "box",
        "BoxGeometry": "box",
        "Plane": "plane",
        "PlaneGeometry": "plane",
        "grid": "plane",
        "cone": "trimesh.creation.cone by Mesh.from_trimesh",
        "TriangleMesh": "Mesh",
        "Trimesh": "Mesh",
        "PolyData": "Mesh",
        "BufferGeometry": "Mesh",
        "read": "load, load_mesh or load_scene",
        "read_triangle_mesh": "load_mesh",
        "save": "save_mesh or save_scene",
        "export": "save_mesh or save_scene",
        "write_triangle_mesh": "save_mesh",
        "lookat": "look_at",
        "lookAt": "look_at",
        "draw": "render or show",
        "view": "show",
        "plot": "show",
        "draw_geometries": "show",
        "Viewer": "show",
        "Plotter": "show",
        "OffscreenRenderer": "Renderer",
        "WebGLRenderer": "Renderer",
        "MetallicRoughnessMaterial": "Material",
        "MeshStandardMaterial": "Material",
        "MeshBasicMaterial": "Material(unlit=True)",
        "AmbientLight": "Scene(ambient=...)",
        "SunLight": "DirectionalLight",
        "AreaLight": "lights.RectangleLight, lights.DiscLight or lights.TubeLight",
        "RectAreaLight": "lights.RectangleLight",
        "RectLight": "lights.RectangleLight",
        "DiskLight": "lights.DiscLight",
        "CylinderLight": "lights.TubeLight",
        "Group": "Scene.add(), a node without an object",
        "Object3D": "Node, which Scene.add makes",
        "Vector3": "NumPy's arrays and engine3d.linalg",
        "Image": "Frame",
    },
    "Mesh": {
        "vertices": "positions",
        "verts": "positions",
        "v": "positions",
        "f": "faces",
        "triangles": "faces",
        "indices": "faces",
        "polys": "faces",
        "position": "positions",
        "vertex_normals": "normals",
        "normal": "normals",
        "vertex_colors": "colors",
        "color": _MATERIALS.format("color"),
        "texture": _MATERIALS.format("texture"),
        "material": "materials, a list",
        "visual": "materials and colors",
        "uv": "uvs",
        "texcoords": "uvs",
        "texture_coordinates": "uvs",
        "edges_unique": "edges()",
        "export": "save",
        "write": "save",
        "compute_vertex_normals": "normals, which are computed where none are given",
        "extents": "bounds",
        "bounding_box": "bounds",
        "translate": "a node's translation, or transformed(matrix)",
        "rotate": "a node's rotation or euler, or transformed(matrix)",
        "scale": "a node's scale, or transformed(matrix)",
        "apply_transform": "transformed(matrix)",
        "transform": "transformed(matrix)",
        "show": "engine3d.show(mesh)",
        "plot": "engine3d.show(mesh)",
    },
    "Material": {
        "metalness": "metallic",
        "metallicFactor": "metallic",
        "metallic_factor": "metallic",
        "roughnessFactor": "roughness",
        "roughness_factor": "roughness",
        "baseColorFactor": "color",
        "base_color": "color",
        "diffuse": "color",
        "albedo": "color",
        "map": "texture",
        "image": "texture",
        "base_color_texture": "texture",
        "baseColorTexture": "texture",
        "normal_map": "normal_texture",
        "normalMap": "normal_texture",
        "emission": "emissive",
        "emissive_intensity": "emissive_strength",
        "opacity": "color, whose fourth number is alpha, with alpha_mode='blend'",
        "alpha": "color, whose fourth number is alpha, with alpha_mode='blend'",
        "transparent": "alpha_mode='blend'",
        "double_sided": "two_sided",
        "doubleSided": "two_sided",
        "side": "two_sided",
        "smooth": "flat_shading",
        "flatShading": "flat_shading",
        "gloss": "shininess or roughness",
        "wireframe": "render(..., wireframe='only')",
        "index_of_refraction": "ior",
    },
    "Camera": {
        **dict.fromkeys(_PLACES, _CAMERA),
        "look_at": _CAMERA,
        "lookAt": _CAMERA,
        "near": "znear",
        "clip_start": "znear",
        "far": "zfar",
        "clip_end": "zfar",
    },
    "PerspectiveCamera": {
        "fov": "yfov, in radians",
        "fovy": "yfov, in radians",
        "field_of_view": "yfov, in radians",
        "view_angle": "yfov, in radians",
        "aspectRatio": "aspect",
        "aspect_ratio": "aspect",
        "focal_length": "yfov, in radians, or an IntrinsicsCamera",
    },
    "OrthographicCamera": {
        "scale": "ymag, half the height of what is seen",
        "parallel_scale": "ymag, half the height of what is seen",
        "size": "ymag, half the height of what is seen",
    },
    "CastsShadows": {
        **dict.fromkeys(_PLACES, _LIGHT),
        "castShadow": "shadow",
        "cast_shadow": "shadow",
        "shadows": "shadow",
        "energy": "intensity",
        "unit": "intensity, in lux or candela for all materials",
        "power": "intensity",
        "strength": "intensity",
    },
    "PointLight": {"distance": "range", "decay": "falloff"},
    "SpotLight": {
        "distance": "range",
        "angle": "outer_cone_angle, in radians",
        "innerConeAngle": "inner_cone_angle",
        "outerConeAngle": "outer_cone_angle",
    },
    "HemisphereLight": dict.fromkeys(_PLACES, _LIGHT),
    "LightProbe": dict.fromkeys(_PLACES, _LIGHT),
    "DirectionalLight": {"target": "direction"},
    "Texture": {"image": "pixels", "data": "pixels", "source": "pixels", "interpolation": "filter"},
    "Node": {
        "position": "translation",
        "location": "translation",
        "quaternion": "rotation",
        "orientation": "rotation, a quaternion, or euler",
        "rotation_euler": "euler",
        "rotation_quaternion": "rotation",
        "matrix": "pose",
        "matrix_local": "pose",
        "matrix_world": "world_pose",
        "matrixWorld": "world_pose",
        "transform": "pose",
        "world_matrix": "world_pose",
        "world_position": "world_pose[:3, 3]",
        "mesh": "object",
        "camera": "object",
        "light": "object",
        "material": "object.materials",
        "castShadow": "cast_shadows",
        "cast_shadow": "cast_shadows",
        "receiveShadow": "receive_shadows",
        "receive_shadow": "receive_shadows",
        "hide": "visible",
        "lookAt": "look_at",
        "add": "scene.add(..., parent=node)",
    },
    "Scene": {
        "lights": _LIGHT_NODES,
        "light_nodes": _LIGHT_NODES,
        "cameras": "nodes, those whose object is an engine3d.Camera",
        "camera": "render(scene, camera), or a node with one",
        "meshes": "nodes, those whose object is an engine3d.Mesh",
        "objects": "nodes",
        "children": "nodes",
        "geometry": "nodes",
        "graph": "nodes",
        "bg_color": "background",
        "background_color": "background",
        "ambient_light": "ambient",
        "add_mesh": "add",
        "add_light": "add",
        "add_camera": "add",
        "add_geometry": "add",
        "add_node": "add",
        "get": "find",
        "find_node": "find",
        "getObjectByName": "find",
        "export": "save",
        "render": "engine3d.render(scene)",
        "show": "engine3d.show(scene)",
        "traverse": "nodes",
    },
    "Frame": {
        "colour": "color",
        "rgb": "color",
        "rgba": "color",
        "pixels": "color",
        "data": "color",
        "array": "color",
        "png": "encode('png')",
        "write": "save",
        "show": "engine3d.show(frame)",
        "shape": "size",
        "segmentation": "object_id",
    },
    "RayHit": _HITS,
    "RayHits": _HITS,
    "Scene.add": {
        "position": "translation",
        "location": "translation",
        "quaternion": "rotation",
        "matrix": "pose",
        "transform": "pose",
        "material": "the mesh's materials",
        "color": "the mesh's materials",
        "visible": "node.visible",
        "parent_node": "parent",
    },
    "orbit": {"radius": "distance", "center": "target", "theta": "azimuth", "phi": "elevation"},
    "box": {"extents": "size", "dimensions": "size", "width": "size=(x, y, z)"},
    "plane": {"width": "size=(x, z)", "extents": "size", "subdivisions": "segments"},
    "uv_sphere": {"count": "segments=(around, bands)", "subdivisions": "segments, or icosphere"},
    "icosphere": {"segments": "subdivisions, or uv_sphere", "detail": "subdivisions"},
    "cylinder": {"sections": "segments", "resolution": "segments", "depth": "height"},
    "torus": {"radius": "major_radius", "tube": "minor_radius"},
    "Window": {"resolution": _SIZE, "fps": "max_fps", "caption": "title"},
    "Renderer": {
        "resolution": _SIZE,
        "viewport_width": _SIZE,
        "viewport_height": _SIZE,
        "msaa": "antialiasing='msaa', samples=4",
        "antialias": "antialiasing='msaa', samples=4",
        "num_threads": "threads",
    },
    "render": {
        **dict.fromkeys(("width", "height", "resolution"), _SIZE),
        "background": "scene.background",
        "shadows": "the light's shadow='map'",
        "msaa": "antialiasing='msaa', samples=4",
        "antialias": "antialiasing='msaa', samples=4",
        "tonemapping": "tone_mapping",
        "ssao": "ambient_occlusion",
        "flags": "mode, wireframe and other options",
    },
}


def hint(owner: str | type, name: str, known: Iterable[str]) -> str:
    """Return ``": did you mean ..."``, or nothing if no name is close.

    Parameters
    ----------
    owner : type or str
        The class, or the name of the module or function, that lacks the name.
    name : str
    known : iterable of str
        The names that it has; those in a module with its name, such as ``worlds.city``.
    """
    owners = [kind.__name__ for kind in owner.__mro__] if isinstance(owner, type) else [owner]
    for each in owners:
        if name in _NAMES.get(each, ()):
            here = _NAMES[each][name]
            return f": {here}" if here.startswith("its ") else f": did you mean {here}?"
    names = {each.rpartition(".")[2]: each for each in reversed(list(known)) if each[0] != "_"}
    near = nearest(name, names)
    return "" if near is None else f": did you mean {names[near]}?"


def foreign_names(kind: type) -> dict[str, str]:
    """Return the foreign names of a class and its bases, with their equivalents here."""
    found: dict[str, str] = {}
    for each in reversed(kind.__mro__):
        found.update(_NAMES.get(each.__name__, {}))
    return found


class UnknownName(AttributeError):
    """An unknown name was read; the text, with suggestions, is built only when shown.

    Raising it is cheap, since `getattr` with a default and `hasattr` never read the text.

    Parameters
    ----------
    owner : type or str
        A class, or the name of a module.
    name : str
    names : callable, optional
        Returns the names of a module.
    """

    def __init__(
        self, owner: type | str, name: str, names: Callable[[], Iterable[str]] = tuple
    ) -> None:
        # Without this, the interpreter would append its own guess.
        super().__init__(owner, name, names, name=None, obj=None)

    def __str__(self) -> str:
        owner, name, names = self.args
        if isinstance(owner, str):
            return f"module {owner!r} has no attribute {name!r}{hint(owner, name, names())}"
        known = [each for each in dir(owner) if hasattr(owner, each)]  # without foreign names
        kind = f"{'an' if owner.__name__[0] in 'AEIOU' else 'a'} {owner.__name__}"
        return f"{kind} has no attribute {name!r}{hint(owner, name, known)}"


class _Foreign:
    """A foreign name of a class, which raises an error when read or assigned.

    A ``__getattr__`` could do the same, but would slow down every attribute of the class.
    """

    def __init__(self, name: str) -> None:
        self._name = name

    def __get__(self, thing: Any, kind: type) -> NoReturn:
        raise UnknownName(kind, self._name)

    def __set__(self, thing: Any, value: Any) -> None:
        raise UnknownName(type(thing), self._name)


def refuses_foreign_names(kind: Kind) -> Kind:
    """Make a class answer foreign names with an error that suggests its own names.

    Python itself suggests corrections of typos when it shows an error.
    """
    foreign = frozenset(foreign_names(kind).keys() - set(dir(kind)))
    for name in foreign:
        setattr(kind, name, _Foreign(name))
    if foreign:
        kind.__dir__ = _own_names  # type: ignore[method-assign,assignment]
    return kind


def _own_names(thing: Any) -> list[str]:
    """Return the names for ``dir``, without foreign names."""
    refused = {
        n for kind in type(thing).__mro__ for n, v in vars(kind).items() if type(v) is _Foreign
    }
    return [name for name in object.__dir__(thing) if name not in refused]
