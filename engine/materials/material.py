"""What a surface is made of: the numbers and the textures that shading reads.

A `Material` is plain data, with the fields of glTF 2.0. Colours are kept as they were given (floats
are linear light, 8-bit integers sRGB; see `engine3d.materials.colors`) and become linear when the
renderer reads them. Whatever a file says beyond this is kept in ``extras``.
"""

from __future__ import annotations

import functools
import math
from dataclasses import replace
from typing import Any, TypeAlias, get_args

from .._support.angles import finite_angle
from .._support.held_values import kept
from .._support.numbers import real, shown
from .._support.validation import (
    CheckedAttribute,
    Closed,
    ColorAttribute,
    NumberAttribute,
    OptionalNumberAttribute,
    finite,
    flag,
    fraction,
    not_negative,
    one_of,
    optional_fraction,
    text,
)
from ..choices import AlphaMode, Color, ColorLike, SurfaceColor
from ..errors import InvalidArgumentError
from .colors import check_color, check_surface_color, linear_color, split_alpha
from .textures import PlacedTexture, Texture

ALPHA_MODES: tuple[AlphaMode, ...] = get_args(AlphaMode)
SlotTexture: TypeAlias = Texture | PlacedTexture | None


def _check_texture(value: SlotTexture, what: str) -> SlotTexture:
    if value is not None and not isinstance(value, (Texture, PlacedTexture)):
        raise InvalidArgumentError(f"{what} must be a Texture or None: {type(value).__name__}")
    return value


class TextureSlot(CheckedAttribute[SlotTexture, SlotTexture]):
    """A texture of a material; the core lists them in csrc/include/e3d_material.h.

    Parameters
    ----------
    is_color : bool
        Whether its bytes are colours, to be read as the texture's ``color_space`` says; those of
        the others are numbers, and read as they are.
    """

    def __init__(self, *, is_color: bool) -> None:
        super().__init__(_check_texture)
        self.is_color = is_color


def _check_ior(value: float, what: str) -> float:
    number = real(value)
    if not (number == 0 or 1 <= number < math.inf):
        raise InvalidArgumentError(f"{what} must be 0, or 1 or greater, not {shown(value)}")
    return number


def _check_film_ior(value: float, what: str) -> float:
    number = real(value)
    if not 1 <= number < math.inf:
        raise InvalidArgumentError(f"{what} must be 1 or greater, not {shown(value)}")
    return number


def _check_reach(value: float, what: str) -> float:
    number = real(value)
    if not number > 0:
        raise InvalidArgumentError(f"{what} must be greater than 0, not {shown(value)}")
    return number


def _check_dict(value: dict[str, Any], what: str) -> dict[str, Any]:
    if not isinstance(value, dict):
        raise InvalidArgumentError(f"{what} must be a dict: {type(value).__name__}")
    return kept(value)


_Flag: TypeAlias = CheckedAttribute[bool, bool]


class Material(Closed):
    """Surface properties shared by the faces that name it.

    With ``metallic`` or ``roughness`` a material is physically based: lit by the model of glTF 2.0
    (its appendix B: GGX, Smith, Schlick). Without, it is lit by Lambert's and Blinn's and Phong's.
    A texture of a slot multiplies what the slot is named after, by the channels given below.

    Parameters
    ----------
    color : sequence of 3 or 4 numbers
        Base colour; multiplies the texture, the vertex colour and the instance colour. The fourth
        is alpha: linear, from 0 to 1, or to 255 if the four are 8-bit integers.
    texture : Texture or PlacedTexture, optional
        Of the base colour.
    specular : sequence of 3 numbers
        Colour of the Blinn-Phong highlight; black means none. Physical materials have none.
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
    metallic, roughness : float, optional
        From 0 to 1. If one is given, the material is physical and the other counts as 1. The
        roughness is perceptual, its square GGX's alpha; less than 0.045 is drawn as 0.045.
    unlit : bool
        Lit frames show the base colour, without light and emission (KHR_materials_unlit).
    alpha_mode : {"opaque", "mask", "blend"}
        What alpha means: nothing; nothing shows below ``alpha_cutoff``; how much hides what is
        behind.
    alpha_cutoff : float
        Not negative.
    normal_scale : float
        Multiplies the first two components of ``normal_texture``.
    occlusion_strength : float
        How much of ``occlusion_texture`` counts, from 0 to 1.
    emissive_strength : float
        Multiplies ``emissive`` of physical materials, not negative.
    ior : float
        Index of refraction, 1 or more; 0 reflects everything (KHR_materials_ior).
    specular_intensity : float
        Strength of what is reflected by what is no metal, from 0 to 1 (KHR_materials_specular).
    specular_color : sequence of 3 numbers
        Its colour seen from straight above.
    clearcoat, clearcoat_roughness : float
        A coat of varnish: its strength and roughness, from 0 to 1 (KHR_materials_clearcoat).
    clearcoat_normal_scale : float
        Multiplies the first two components of ``clearcoat_normal_texture``.
    sheen_color : sequence of 3 numbers
        Of the fuzz of cloth, black means none (KHR_materials_sheen).
    sheen_roughness : float
        From 0 to 1.
    transmission : float
        Share of the light that passes, from 0 to 1 (KHR_materials_transmission). It is neither
        bent nor blurred.
    thickness : float
        What lies below the surface, in units of the mesh, which its pose scales; 0 for a thin wall
        (KHR_materials_volume).
    attenuation_color : sequence of 3 numbers
        What white becomes after ``attenuation_distance`` world units.
    attenuation_distance : float
        Greater than 0; infinite: nothing is absorbed.
    anisotropy : float
        How much rougher the surface is along a direction than across it, from 0 to 1
        (KHR_materials_anisotropy): brushed metal.
    anisotropy_rotation : float
        Radians from the tangent to that direction, counter-clockwise.
    iridescence : float
        How much a thin film on the surface counts, from 0 to 1 (KHR_materials_iridescence).
    iridescence_ior : float
        The film's index of refraction, 1 or more.
    iridescence_thickness_minimum, iridescence_thickness_maximum : float
        Of the film, in nanometres: where its texture is black and white. Without one, the maximum
        counts.
    metallic_roughness_texture : Texture or PlacedTexture, optional
        G is the roughness, B metallic.
    normal_texture, clearcoat_normal_texture : Texture or PlacedTexture, optional
        Directions in tangent space, 0 … 255 for -1 … 1: red to the right, green up in the image.
    occlusion_texture : Texture or PlacedTexture, optional
        R: how much of the light from all around arrives.
    emissive_texture, specular_color_texture : Texture or PlacedTexture, optional
        RGB.
    sheen_color_texture : Texture or PlacedTexture, optional
        RGB.
    clearcoat_texture, transmission_texture, iridescence_texture : Texture, optional
        R. A PlacedTexture, too.
    clearcoat_roughness_texture, thickness_texture : Texture or PlacedTexture, optional
        G.
    iridescence_thickness_texture : Texture or PlacedTexture, optional
        G.
    anisotropy_texture : Texture or PlacedTexture, optional
        R and G: a direction in tangent space, 0 … 255 for -1 … 1, which is then turned; B: the
        strength.
    specular_texture, sheen_roughness_texture : Texture or PlacedTexture, optional
        Alpha.

    Attributes
    ----------
    version : int
        Grows with every assignment to one of the above.

    Raises
    ------
    InvalidArgumentError

    Notes
    -----
    Textures of colours are read as their ``color_space`` says; the bytes of all others are numbers,
    whatever it says.
    """

    version: int
    _is_implied = False  # whether a file names no material where this one is
    color: CheckedAttribute[ColorLike, SurfaceColor] = CheckedAttribute(check_surface_color)
    texture: TextureSlot = TextureSlot(is_color=True)
    specular: ColorAttribute = CheckedAttribute(check_color)
    shininess: NumberAttribute = CheckedAttribute(not_negative)
    emissive: ColorAttribute = CheckedAttribute(check_color)
    two_sided: _Flag = CheckedAttribute(flag)
    flat_shading: _Flag = CheckedAttribute(flag)
    name: CheckedAttribute[str, str] = CheckedAttribute(text)
    extras: CheckedAttribute[dict[str, Any], dict[str, Any]] = CheckedAttribute(_check_dict)
    metallic: OptionalNumberAttribute = CheckedAttribute(optional_fraction)
    roughness: OptionalNumberAttribute = CheckedAttribute(optional_fraction)
    unlit: _Flag = CheckedAttribute(flag)
    alpha_mode: CheckedAttribute[AlphaMode, AlphaMode] = CheckedAttribute(one_of(ALPHA_MODES))
    alpha_cutoff: NumberAttribute = CheckedAttribute(not_negative)
    normal_scale: NumberAttribute = CheckedAttribute(finite)
    occlusion_strength: NumberAttribute = CheckedAttribute(fraction)
    emissive_strength: NumberAttribute = CheckedAttribute(not_negative)
    ior: NumberAttribute = CheckedAttribute(_check_ior)
    specular_intensity: NumberAttribute = CheckedAttribute(fraction)
    specular_color: ColorAttribute = CheckedAttribute(check_color)
    clearcoat: NumberAttribute = CheckedAttribute(fraction)
    clearcoat_roughness: NumberAttribute = CheckedAttribute(fraction)
    clearcoat_normal_scale: NumberAttribute = CheckedAttribute(finite)
    sheen_color: ColorAttribute = CheckedAttribute(check_color)
    sheen_roughness: NumberAttribute = CheckedAttribute(fraction)
    transmission: NumberAttribute = CheckedAttribute(fraction)
    thickness: NumberAttribute = CheckedAttribute(not_negative)
    attenuation_color: ColorAttribute = CheckedAttribute(check_color)
    attenuation_distance: NumberAttribute = CheckedAttribute(_check_reach)
    metallic_roughness_texture: TextureSlot = TextureSlot(is_color=False)
    normal_texture: TextureSlot = TextureSlot(is_color=False)
    occlusion_texture: TextureSlot = TextureSlot(is_color=False)
    emissive_texture: TextureSlot = TextureSlot(is_color=True)
    clearcoat_texture: TextureSlot = TextureSlot(is_color=False)
    clearcoat_roughness_texture: TextureSlot = TextureSlot(is_color=False)
    clearcoat_normal_texture: TextureSlot = TextureSlot(is_color=False)
    specular_texture: TextureSlot = TextureSlot(is_color=False)
    specular_color_texture: TextureSlot = TextureSlot(is_color=True)
    sheen_color_texture: TextureSlot = TextureSlot(is_color=True)
    sheen_roughness_texture: TextureSlot = TextureSlot(is_color=False)
    transmission_texture: TextureSlot = TextureSlot(is_color=False)
    thickness_texture: TextureSlot = TextureSlot(is_color=False)
    anisotropy: NumberAttribute = CheckedAttribute(fraction)
    anisotropy_rotation: NumberAttribute = CheckedAttribute(finite_angle)
    iridescence: NumberAttribute = CheckedAttribute(fraction)
    iridescence_ior: NumberAttribute = CheckedAttribute(_check_film_ior)
    iridescence_thickness_minimum: NumberAttribute = CheckedAttribute(not_negative)
    iridescence_thickness_maximum: NumberAttribute = CheckedAttribute(not_negative)
    anisotropy_texture: TextureSlot = TextureSlot(is_color=False)
    iridescence_texture: TextureSlot = TextureSlot(is_color=False)
    iridescence_thickness_texture: TextureSlot = TextureSlot(is_color=False)

    def __init__(
        self,
        *,
        color: ColorLike = (1, 1, 1),
        texture: SlotTexture = None,
        specular: ColorLike = (0, 0, 0),
        shininess: float = 32.0,
        emissive: ColorLike = (0, 0, 0),
        two_sided: bool = False,
        flat_shading: bool = False,
        name: str = "",
        extras: dict[str, Any] | None = None,
        metallic: float | None = None,
        roughness: float | None = None,
        unlit: bool = False,
        alpha_mode: AlphaMode = "opaque",
        alpha_cutoff: float = 0.5,
        normal_scale: float = 1.0,
        occlusion_strength: float = 1.0,
        emissive_strength: float = 1.0,
        ior: float = 1.5,
        specular_intensity: float = 1.0,
        specular_color: ColorLike = (1, 1, 1),
        clearcoat: float = 0.0,
        clearcoat_roughness: float = 0.0,
        clearcoat_normal_scale: float = 1.0,
        sheen_color: ColorLike = (0, 0, 0),
        sheen_roughness: float = 0.0,
        transmission: float = 0.0,
        thickness: float = 0.0,
        attenuation_color: ColorLike = (1, 1, 1),
        attenuation_distance: float = math.inf,
        metallic_roughness_texture: SlotTexture = None,
        normal_texture: SlotTexture = None,
        occlusion_texture: SlotTexture = None,
        emissive_texture: SlotTexture = None,
        clearcoat_texture: SlotTexture = None,
        clearcoat_roughness_texture: SlotTexture = None,
        clearcoat_normal_texture: SlotTexture = None,
        specular_texture: SlotTexture = None,
        specular_color_texture: SlotTexture = None,
        sheen_color_texture: SlotTexture = None,
        sheen_roughness_texture: SlotTexture = None,
        transmission_texture: SlotTexture = None,
        thickness_texture: SlotTexture = None,
        anisotropy: float = 0.0,
        anisotropy_rotation: float = 0.0,
        iridescence: float = 0.0,
        iridescence_ior: float = 1.3,
        iridescence_thickness_minimum: float = 100.0,
        iridescence_thickness_maximum: float = 400.0,
        anisotropy_texture: SlotTexture = None,
        iridescence_texture: SlotTexture = None,
        iridescence_thickness_texture: SlotTexture = None,
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
        self.metallic = metallic
        self.roughness = roughness
        self.unlit = unlit
        self.alpha_mode = alpha_mode
        self.alpha_cutoff = alpha_cutoff
        self.normal_scale = normal_scale
        self.occlusion_strength = occlusion_strength
        self.emissive_strength = emissive_strength
        self.ior = ior
        self.specular_intensity = specular_intensity
        self.specular_color = specular_color
        self.clearcoat = clearcoat
        self.clearcoat_roughness = clearcoat_roughness
        self.clearcoat_normal_scale = clearcoat_normal_scale
        self.sheen_color = sheen_color
        self.sheen_roughness = sheen_roughness
        self.transmission = transmission
        self.thickness = thickness
        self.attenuation_color = attenuation_color
        self.attenuation_distance = attenuation_distance
        self.metallic_roughness_texture = metallic_roughness_texture
        self.normal_texture = normal_texture
        self.occlusion_texture = occlusion_texture
        self.emissive_texture = emissive_texture
        self.clearcoat_texture = clearcoat_texture
        self.clearcoat_roughness_texture = clearcoat_roughness_texture
        self.clearcoat_normal_texture = clearcoat_normal_texture
        self.specular_texture = specular_texture
        self.specular_color_texture = specular_color_texture
        self.sheen_color_texture = sheen_color_texture
        self.sheen_roughness_texture = sheen_roughness_texture
        self.transmission_texture = transmission_texture
        self.thickness_texture = thickness_texture
        self.anisotropy = anisotropy
        self.anisotropy_rotation = anisotropy_rotation
        self.iridescence = iridescence
        self.iridescence_ior = iridescence_ior
        self.iridescence_thickness_minimum = iridescence_thickness_minimum
        self.iridescence_thickness_maximum = iridescence_thickness_maximum
        self.anisotropy_texture = anisotropy_texture
        self.iridescence_texture = iridescence_texture
        self.iridescence_thickness_texture = iridescence_thickness_texture

    @property
    def is_physical(self) -> bool:
        """Whether the material is physically based: metallic or roughness is given."""
        return self.metallic is not None or self.roughness is not None

    @property
    def rgb(self) -> Color:
        """The base colour without its alpha."""
        return split_alpha(self.color)[0]

    @property
    def alpha(self) -> float:
        """The alpha of the base colour, from 0 to 1."""
        return split_alpha(self.color)[1]

    @classmethod
    def _plain(cls, name: str) -> Material:
        """Return ``Material(name=name)`` in a tenth of the time: files may name very many."""
        material = cls.__new__(cls)
        vars(material).update(_template(), name=name, extras={})
        return material

    def _twin(self) -> Material:
        """Return a copy in a fraction of the time: files may ask for very many."""
        twin = type(self).__new__(type(self))
        vars(twin).update(vars(self), extras=dict(self.extras))
        return twin

    def __repr__(self) -> str:
        texture = "" if self.texture is None else f", texture={self.texture!r}"
        return f"Material(name={self.name!r}, color={self.color}{texture})"


TEXTURE_SLOTS: tuple[str, ...] = tuple(
    name for name, value in vars(Material).items() if isinstance(value, TextureSlot)
)


def placed_textures_of(material: Material) -> dict[str, PlacedTexture]:
    """Return the textures that a material has, by slot, with the coordinates they are read at."""
    held = vars(material)
    return {
        slot: texture if isinstance(texture, PlacedTexture) else PlacedTexture(texture)
        for slot in TEXTURE_SLOTS
        if (texture := held[slot]) is not None
    }


def textures_of(material: Material) -> dict[str, Texture]:
    """Return the textures that a material has, by slot."""
    return {slot: placed.texture for slot, placed in placed_textures_of(material).items()}


def put_texture(material: Material, slot: str, texture: Texture) -> None:
    """Put another texture into a slot that has one, at the same coordinates."""
    held = getattr(material, slot)
    if isinstance(held, PlacedTexture):
        texture = replace(held, texture=texture)
    setattr(material, slot, texture)


def says_something(material: Material) -> bool:
    """Return whether anything of a material but its name differs from a default one.

    Its facets and sides do not count: an STL file sets them without a word on materials.
    """
    return bool(textures_of(material)) or _words(material) != _DEFAULT_WORDS


def _words(material: Material) -> tuple:
    colors = [material.rgb, material.specular, material.emissive]
    numbers = [material.alpha]
    for name in _LOOK:
        value = getattr(material, name)
        (colors if isinstance(value, tuple) else numbers).append(value)
    linear = (tuple(linear_color(color).tolist()) for color in colors)
    return (*linear, *numbers, material.shininess, material.extras)


# Of physical materials; what is beyond them, or two_sided, is no word on the material.
_LOOK = (
    "metallic",
    "roughness",
    "unlit",
    "alpha_mode",
    "alpha_cutoff",
    "normal_scale",
    "occlusion_strength",
    "emissive_strength",
    "ior",
    "specular_intensity",
    "specular_color",
    "clearcoat",
    "clearcoat_roughness",
    "clearcoat_normal_scale",
    "sheen_color",
    "sheen_roughness",
    "transmission",
    "thickness",
    "attenuation_color",
    "attenuation_distance",
    "anisotropy",
    "anisotropy_rotation",
    "iridescence",
    "iridescence_ior",
    "iridescence_thickness_minimum",
    "iridescence_thickness_maximum",
)


_DEFAULT_WORDS = _words(Material())


@functools.cache
def _template() -> dict[str, Any]:
    """The attributes of a material as it is made."""
    return vars(Material())
