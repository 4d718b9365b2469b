"""Warning texts about the content that a format cannot hold."""

from __future__ import annotations

from collections.abc import Iterable

from ...model.geometry.mesh import Mesh
from ...model.materials.colors import linear_color
from ...model.materials.material import Material, states_nothing, textures_of
from ...model.materials.textures import Texture

_NAMES = {
    "uvs": "texture coordinates",
    "uvs1": "a second set of texture coordinates",
    "tangents": "tangents",
    "colors": "vertex colours",
    "lines": "lines",
    "points": "points",
    "groups": "groups",
    "values": "values",
}
# This many materials are listed by name.
_MOST_NAMED = 3


def lost_parts(mesh: Mesh, format: str, *parts: str) -> list[str]:
    """Return a line that lists the given parts that the mesh has, if any."""
    lost = []
    for part in parts:
        if part == "materials":
            lost += ["materials"] if any(map(_shows, mesh.materials)) else []
        elif part == "normals":
            lost += ["vertex normals"] if mesh.has_normals else []
        elif part == "edge_visible":
            hides = mesh.edge_visible is not None and not mesh.edge_visible.all()
            lost += ["polygons"] if hides else []
        else:
            array = getattr(mesh, part)
            lost += [_NAMES[part]] if array is not None and len(array) else []
    return not_held(format, lost)


def not_held(format: str, things: Iterable[str]) -> list[str]:
    """Return a line about parts that are not held, if there are any."""
    named = ", ".join(things)
    return [f"{format} files do not hold {named}"] if named else []


def lost_mirrors(format: str, names: list[str]) -> list[str]:
    """Return a line about materials that mirror, if there are any."""
    return [f"{format} files do not hold mirror of {_some(names)}"] if names else []


def lost_of_materials(mesh: Mesh, unwritten: dict[str, list[str]]) -> list[str]:
    """Return a line for each material feature that MTL cannot express.

    Parameters
    ----------
    mesh : Mesh
    unwritten : dict of str to list of str
        Other losses, and their materials.
    """
    lost: dict[str, list[str]] = {}
    for number, material in enumerate(mesh.materials):
        for thing in _beyond_mtl(material, mesh.has_normals):
            lost.setdefault(thing, []).append(material.name or f"material_{number}")
    return [
        f"obj files do not hold {thing} of {_some(names)}"
        for thing, names in (lost | unwritten).items()
    ]


def lost_of_reading(texture: Texture) -> list[str]:
    """Return the sampling settings of a texture that only engine3d's own files hold."""
    usual = {"anisotropy": 1, "lod_bias": 0.0}
    return [name for name, value in usual.items() if getattr(texture, name) != value]


def _beyond_mtl(material: Material, has_normals: bool) -> list[str]:
    things = ["two_sided"] if material.two_sided else []
    if material.mirror:
        things.append("mirror")
    if material.flat_shading and has_normals:
        things.append("flat_shading")  # without normals, smoothing groups express it
    if material.alpha_mode == "mask" and material.alpha_cutoff != 0.5:
        things.append("alpha_cutoff")
    texture = textures_of(material).get("texture")
    if texture is not None:
        is_held = texture.wrap in ("repeat", "clamp")
        things += [] if is_held else [f"the texture's wrap {texture.wrap!r}"]
        is_usual = texture.filter == "trilinear"
        things += [] if is_usual else [f"the texture's filter {texture.filter!r}"]
        things += [f"the texture's {thing}" for thing in lost_of_reading(texture)]
        is_srgb = texture.color_space == "srgb"
        things += [] if is_srgb else [f"the texture's colour space {texture.color_space!r}"]
        if not linear_color(material.rgb).any():
            things.append("black under a texture")  # readers take it for a missing colour
    if linear_color(material.specular).any() and not material.shininess:
        things.append("a highlight of no shininess")
    return things


def _some(names: list[str]) -> str:
    named = ", ".join(map(repr, names[:_MOST_NAMED]))
    rest = len(names) - _MOST_NAMED
    return f"{named} and {rest} more" if rest > 0 else named


def _shows(material: Material) -> bool:
    return not states_nothing(material) or material.two_sided
