"""What a surface is made of: the numbers and the texture that shading reads.

A `Material` is plain data. Colours are kept as they were given (floats are linear light, 8-bit
integers sRGB; see `engine3d.materials.colors`) and become linear when the renderer reads them.
Whatever a file says beyond this (physically based parameters, further maps) is kept in ``extras``.
"""

from __future__ import annotations

import functools
from typing import Any

from .._support.validation import (
    CheckedAttribute,
    Closed,
    ColorAttribute,
    NumberAttribute,
    not_negative,
)
from ..choices import ColorLike
from ..errors import InvalidArgumentError
from .colors import check_color, linear_color
from .textures import Texture


def _check_texture(value: Texture | None, what: str) -> Texture | None:
    if value is not None and not isinstance(value, Texture):
        raise InvalidArgumentError(f"{what} must be a Texture or None: {type(value).__name__}")
    return value


class TextureSlot(CheckedAttribute[Texture | None, Texture | None]):
    """A texture of a material; the core lists them in csrc/include/e3d_material.h."""

    def __init__(self) -> None:
        super().__init__(_check_texture)


def _check_dict(value: dict[str, Any], what: str) -> dict[str, Any]:
    if not isinstance(value, dict):
        raise InvalidArgumentError(f"{what} must be a dict: {type(value).__name__}")
    return dict(value)


class Material(Closed):
    """Surface properties shared by the faces that name it.

    Parameters
    ----------
    color : sequence of 3 numbers
        Diffuse colour; multiplies the texture, the vertex colour and the instance colour.
    texture : Texture, optional
        Base colour texture.
    specular : sequence of 3 numbers
        Colour of the Blinn-Phong highlight; black means none.
    shininess : float
        Blinn-Phong exponent, not negative.
    emissive : sequence of 3 numbers
        Light that the surface gives off, added after lighting.
    two_sided : bool
        Draw and light the back of the faces as well, whatever is culled.
    flat_shading : bool
        Use one normal per polygon instead of the vertex normals.
    name : str
    extras : dict, optional
        What else a file says about the material, by the file's own keys; not read by the renderer.

    Attributes
    ----------
    version : int
        Grows with every assignment to one of the above.

    Raises
    ------
    InvalidArgumentError
    """

    version: int
    color: ColorAttribute = CheckedAttribute(check_color)
    texture: TextureSlot = TextureSlot()
    specular: ColorAttribute = CheckedAttribute(check_color)
    shininess: NumberAttribute = CheckedAttribute(not_negative)
    emissive: ColorAttribute = CheckedAttribute(check_color)
    two_sided: CheckedAttribute[bool, bool] = CheckedAttribute(lambda value, what: bool(value))
    flat_shading: CheckedAttribute[bool, bool] = CheckedAttribute(lambda value, what: bool(value))
    name: CheckedAttribute[str, str] = CheckedAttribute(lambda value, what: str(value))
    extras: CheckedAttribute[dict[str, Any], dict[str, Any]] = CheckedAttribute(_check_dict)

    def __init__(
        self,
        *,
        color: ColorLike = (1, 1, 1),
        texture: Texture | None = None,
        specular: ColorLike = (0, 0, 0),
        shininess: float = 32.0,
        emissive: ColorLike = (0, 0, 0),
        two_sided: bool = False,
        flat_shading: bool = False,
        name: str = "",
        extras: dict[str, Any] | None = None,
    ) -> None:
        self.color = color
        self.texture = texture
        self.specular = specular
        self.shininess = shininess
        self.emissive = emissive
        self.two_sided = two_sided
        self.flat_shading = flat_shading
        self.name = name
        self.extras = {} if extras is None else extras

    @classmethod
    def _plain(cls, name: str) -> Material:
        """Return ``Material(name=name)`` in a tenth of the time: files may name very many."""
        material = cls.__new__(cls)
        vars(material).update(_template(), name=name, extras={})
        return material

    def __repr__(self) -> str:
        texture = "" if self.texture is None else f", texture={self.texture!r}"
        return f"Material(name={self.name!r}, color={self.color}{texture})"


TEXTURE_SLOTS: tuple[str, ...] = tuple(
    name for name, value in vars(Material).items() if isinstance(value, TextureSlot)
)


def textures_of(material: Material) -> dict[str, Texture]:
    """Return the textures that a material has, by slot."""
    held = {slot: getattr(material, slot) for slot in TEXTURE_SLOTS}
    return {slot: texture for slot, texture in held.items() if texture is not None}


def says_something(material: Material) -> bool:
    """Return whether anything of a material but its name differs from a default one.

    Its facets and sides do not count: an STL file sets them without a word on materials.
    """
    return bool(textures_of(material)) or _words(material) != _DEFAULT_WORDS


def _words(material: Material) -> tuple:
    colors = (material.color, material.specular, material.emissive)
    return (*(tuple(linear_color(c).tolist()) for c in colors), material.shininess, material.extras)


_DEFAULT_WORDS = _words(Material())


@functools.cache
def _template() -> dict[str, Any]:
    """The attributes of a material as it is made."""
    return vars(Material())
