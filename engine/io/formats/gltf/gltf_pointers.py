"""JSON pointers of KHR_animation_pointer, and the properties they refer to.

In: a pointer. Out: the object, its property and the number of components; or, for writing, the
pointer of a property. Sources: Khronos, KHR_animation_pointer and "glTF 2.0 Asset Object Model";
RFC 6901.
"""

from __future__ import annotations

from typing import Any, NamedTuple

from .gltf_file import LIGHTS, GltfFile
from .gltf_materials import PARTS, Numbers
from .gltf_nodes import VISIBILITY
from .gltf_textures import TRANSFORM

POINTER = "KHR_animation_pointer"
#: The extension handled here.
READ = (POINTER,)
_POSE = {"translation": 3, "rotation": 4, "scale": 3}
_PLACE = {"offset": 2, "rotation": 1, "scale": 2}
_LENSES = {
    "perspective/yfov": "yfov",
    "perspective/znear": "znear",
    "perspective/zfar": "zfar",
    "orthographic/ymag": "ymag",
    "orthographic/znear": "znear",
    "orthographic/zfar": "zfar",
}
_LAMPS = {
    "color": "color",
    "intensity": "intensity",
    "range": "range",
    "spot/innerConeAngle": "inner_cone_angle",
    "spot/outerConeAngle": "outer_cone_angle",
}
_VISIBLE = f"extensions/{VISIBILITY}/visible"
_LIGHT_LIST = f"extensions/{LIGHTS}/lights"


class Target(NamedTuple):
    """The property that a pointer refers to.

    Attributes
    ----------
    kind : {"node", "mesh", "material", "camera", "light"}
    number : int
        The index in the file's list.
    path : str
        "translation", "rotation", "scale" and "weights" of a node, "weights" of a mesh; else the
        path of a `PropertyRecord`.
    width : int
        The number of components; 0 means one for each morph target.
    """

    kind: str
    number: int
    path: str
    width: int


def _material_pointers() -> dict[str, tuple[str, int]]:
    """Return a map from paths after a material's number to properties and their widths."""
    found: dict[str, tuple[str, int]] = {}
    for part, items in PARTS.items():
        place = f"extensions/{part}/" if part.startswith("KHR") else f"{part}/" if part else ""
        for item in items:
            key = f"{place}{item.key}"
            if isinstance(item, Numbers):
                found[key] = item.field, len(item.default) if isinstance(item.default, tuple) else 1
                continue
            if item.beside:
                found[f"{key}/{item.beside_key}"] = item.beside, 1
            for name, width in _PLACE.items():
                found[f"{key}/extensions/{TRANSFORM}/{name}"] = f"{item.field}.{name}", width
    return found


_MATERIALS = _material_pointers()


def target_of(file: GltfFile, pointer: Any, where: str) -> Target | None:
    """Return the target of a pointer; None if it cannot be animated here.

    Raises
    ------
    DamagedError
        It is not a pointer, or its target does not exist.
    """
    if not isinstance(pointer, str) or not pointer.startswith("/"):
        raise file.damaged(f"{where} has no pointer")
    text = pointer[1:].replace("~1", "/").replace("~0", "~")
    place = _LIGHT_LIST if text.startswith(f"{_LIGHT_LIST}/") else text.partition("/")[0]
    number, _, key = text[len(place) + 1 :].partition("/")
    if place not in _FINDERS or not (number.isascii() and number.isdecimal() and len(number) < 10):
        return None
    return _FINDERS[place](file, int(number), key, where)


def _node_target(file: GltfFile, number: int, key: str, where: str) -> Target | None:
    file.number_in("nodes", number, where)
    if key in _POSE:
        return Target("node", number, key, _POSE[key])
    if key == _VISIBLE:
        return Target("node", number, "visible", 1)
    return _weights_target("node", number, key)


def _mesh_target(file: GltfFile, number: int, key: str, where: str) -> Target | None:
    file.number_in("meshes", number, where)
    return _weights_target("mesh", number, key)


def _weights_target(kind: str, number: int, key: str) -> Target | None:
    if key == "weights":
        return Target(kind, number, key, 0)
    name, _, of_one = key.partition("/")
    is_one = name == "weights" and of_one.isascii() and of_one.isdecimal() and len(of_one) < 9
    return Target(kind, number, f"weights.{int(of_one)}", 1) if is_one else None


def _material_target(file: GltfFile, number: int, key: str, where: str) -> Target | None:
    file.number_in("materials", number, where)
    return Target("material", number, *_MATERIALS[key]) if key in _MATERIALS else None


def _camera_target(file: GltfFile, number: int, key: str, where: str) -> Target | None:
    file.number_in("cameras", number, where)
    return Target("camera", number, _LENSES[key], 1) if key in _LENSES else None


def _light_target(file: GltfFile, number: int, key: str, where: str) -> Target | None:
    file.index(number, len(file.lights()), "lights", where)
    width = 3 if key == "color" else 1
    return Target("light", number, _LAMPS[key], width) if key in _LAMPS else None


_FINDERS = {
    "nodes": _node_target,
    "meshes": _mesh_target,
    "materials": _material_target,
    "cameras": _camera_target,
    _LIGHT_LIST: _light_target,
}


def pointer_of(kind: str, number: int, path: str, lens: str = "") -> str | None:
    """Return the pointer of a property; None if files cannot express it.

    Parameters
    ----------
    kind : {"node", "material", "camera", "light"}
    number : int
        The index in the file's list.
    path : str
        See `PropertyRecord`.
    lens : str
        For cameras: "perspective" or "orthographic".
    """
    if kind == "node":
        is_weight = path.startswith("weights.")
        key = path.replace(".", "/") if is_weight else _VISIBLE if path == "visible" else None
        return None if key is None else f"/nodes/{number}/{key}"
    if kind == "material":
        keys = (key for key, (held, _) in _MATERIALS.items() if held == path)
        return _joined(f"/materials/{number}", next(keys, None))
    if kind == "camera":
        keys = (key for key, held in _LENSES.items() if held == path and key.startswith(lens))
        return _joined(f"/cameras/{number}", next(keys, None))
    keys = (key for key, held in _LAMPS.items() if held == path)
    return _joined(f"/{_LIGHT_LIST}/{number}", next(keys, None))


def _joined(place: str, key: str | None) -> str | None:
    return None if key is None else f"{place}/{key}"
