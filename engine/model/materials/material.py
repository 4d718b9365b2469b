"""Materials: the numbers and textures that shading reads.

A `Material` is plain data, with the fields of glTF 2.0. Colours are kept as given (words as 8-bit
values; see `colors`) and converted to linear light when the renderer reads them. ``extras`` keeps
everything else that a file says.

To add a number, add a row here and a member of e3d_physical (csrc/include/e3d_material.h): with the
same name if the core takes the value unchanged, else with a conversion in
rendering/draw_list/material_list.py. To add a texture, add a row here and one of
E3D_EACH_TEXTURE_SLOT, in the same order, and a row in csrc/kernels/types/texture_slots.h for the
value it varies. Kernels and reference implement the rest.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import replace
from typing import TYPE_CHECKING, Any, TypeAlias

from ...base.calls import refuse_unknown
from ...base.dirty_tracking import renew
from ...base.notebook_pictures import ShownInNotebooks
from ...base.validation import Versioned
from ...choices import AlphaMode, Color, ColorLike, SurfaceColor
from .colors import linear_color, split_alpha
from .parameters import (
    ALPHA_MODE,
    ANGLE,
    AT_LEAST_ONE,
    COLOR,
    DICT,
    FLAG,
    IOR,
    NOT_NEGATIVE,
    NUMBER,
    REACH,
    SHARE,
    SHARE_OR_NONE,
    SURFACE_COLOR,
    TEXT,
    Parameter,
    StatedColor,
    TextureSlot,
    made_of_parameters,
    parameters_of,
)
from .textures import PlacedTexture, Texture

Number: TypeAlias = Parameter[float, float]
OptionalNumber: TypeAlias = Parameter[float | None, float | None]
ColorNumbers: TypeAlias = Parameter[ColorLike, Color]
Flag: TypeAlias = Parameter[bool, bool]


@made_of_parameters
class Material(ShownInNotebooks, Versioned):
    """Surface properties of the faces that refer to it.

    With ``metallic`` or ``roughness`` a material is physically based: lit by the model of glTF 2.0
    (its appendix B: GGX, Smith, Schlick). Otherwise it is lit by the models of Lambert and
    Blinn-Phong. A texture multiplies the property that its slot is named after, by the channels
    given below. Properties of glTF extensions bear their names: ``clearcoat`` comes from
    KHR_materials_clearcoat.

    Parameters
    ----------
    Each attribute below.

    Attributes
    ----------
    version : int
        Grows with every assignment to one of the above.

    Raises
    ------
    InvalidArgumentError

    Notes
    -----
    Colour textures are decoded by their ``color_space``; all others hold plain numbers and ignore
    it.
    """

    _is_implied = False  # see `imply`
    _states_color = False  # whether the colour was ever assigned
    color: Parameter[ColorLike, SurfaceColor] = StatedColor(
        SURFACE_COLOR,
        default=(1, 1, 1),
        gltf="pbrMetallicRoughness/baseColorFactor",
        doc="Base colour; multiplies the texture, the vertex colour and the instance colour. The "
        "fourth is alpha: linear, from 0 to 1, or to 255 if the four are 8-bit integers.",
    )
    texture: TextureSlot = TextureSlot(
        default=None, is_color=True, gltf="pbrMetallicRoughness/baseColorTexture", doc="RGBA."
    )
    specular: ColorNumbers = Parameter(
        COLOR, default=(0, 0, 0), doc="Colour of the Blinn-Phong highlight, if not physical."
    )
    shininess: Number = Parameter(NOT_NEGATIVE, default=32.0, doc="Blinn-Phong exponent.")
    emissive: ColorNumbers = Parameter(
        COLOR, default=(0, 0, 0), gltf="emissiveFactor", doc="Light of its own, added at the end."
    )
    two_sided: Flag = Parameter(
        FLAG, default=False, doc="Draw and light the back of the faces as well, whatever is culled."
    )
    flat_shading: Flag = Parameter(
        FLAG, default=False, doc="Use one normal per polygon instead of the vertex normals."
    )
    name: Parameter[str, str] = Parameter(TEXT, default="", doc="")
    extras: Parameter[dict[str, Any] | None, dict[str, Any]] = Parameter(
        DICT, default=None, doc="What else a file says of it, by its own keys; not drawn."
    )
    metallic: OptionalNumber = Parameter(
        SHARE_OR_NONE,
        default=None,
        gltf="pbrMetallicRoughness/metallicFactor",
        doc="If this or ``roughness`` is given, the material is physical, as rows of glTF's "
        "extensions need it. The other counts as 1.",
    )
    roughness: OptionalNumber = Parameter(
        SHARE_OR_NONE,
        default=None,
        gltf="pbrMetallicRoughness/roughnessFactor",
        doc="Perceptual: its square is GGX's alpha. Less than 0.045 is drawn as 0.045.",
    )
    unlit: Flag = Parameter(
        FLAG, default=False, doc="Lit frames show the base colour alone (KHR_materials_unlit)."
    )
    alpha_mode: Parameter[AlphaMode, AlphaMode] = Parameter(
        ALPHA_MODE,
        default="opaque",
        doc="Alpha means nothing, holes below ``alpha_cutoff``, or how much hides what is behind.",
    )
    alpha_cutoff: Number = Parameter(
        NOT_NEGATIVE, default=0.5, gltf="alphaCutoff", doc="The least alpha shown in mode mask."
    )
    normal_scale: Number = Parameter(
        NUMBER,
        default=1.0,
        gltf="normalTexture.scale",
        doc="Multiplies the first two components of ``normal_texture``.",
    )
    occlusion_strength: Number = Parameter(
        SHARE, default=1.0, gltf="occlusionTexture.strength", doc="Of ``occlusion_texture``."
    )
    emissive_strength: Number = Parameter(
        NOT_NEGATIVE,
        default=1.0,
        gltf="emissive_strength/emissiveStrength",
        doc="Multiplies ``emissive`` of physical materials.",
    )
    ior: Number = Parameter(
        IOR, default=1.5, gltf="ior/ior", doc="Index of refraction; 0 reflects everything."
    )
    specular_intensity: Number = Parameter(
        SHARE, default=1.0, gltf="specular/specularFactor", doc="Of the reflection of non-metals."
    )
    specular_color: ColorNumbers = Parameter(
        COLOR, default=(1, 1, 1), gltf="specular/specularColorFactor", doc="Its colour from above."
    )
    mirror: Number = Parameter(
        SHARE,
        default=0.0,
        doc="How much of a perfect mirror flat faces are in mode lit. Of physical materials, it "
        "replaces what they reflect of the environment, and their colours and angles weigh it; of "
        "others it covers the colour.",
    )
    clearcoat: Number = Parameter(
        SHARE, default=0.0, gltf="clearcoat/clearcoatFactor", doc="Strength of a coat of varnish."
    )
    clearcoat_roughness: Number = Parameter(
        SHARE, default=0.0, gltf="clearcoat/clearcoatRoughnessFactor", doc="Of the coat."
    )
    clearcoat_normal_scale: Number = Parameter(
        NUMBER,
        default=1.0,
        gltf="clearcoat/clearcoatNormalTexture.scale",
        doc="Multiplies the first two components of ``clearcoat_normal_texture``.",
    )
    sheen_color: ColorNumbers = Parameter(
        COLOR, default=(0, 0, 0), gltf="sheen/sheenColorFactor", doc="Of cloth's fuzz; black: none."
    )
    sheen_roughness: Number = Parameter(
        SHARE, default=0.0, gltf="sheen/sheenRoughnessFactor", doc="Of the fuzz."
    )
    transmission: Number = Parameter(
        SHARE,
        default=0.0,
        gltf="transmission/transmissionFactor",
        doc="Share of the light that passes; metals let none pass: give ``metallic=0``, too. "
        "``roughness`` blurs it where ``ior`` is not 1 or 0. Its shadow is that of an opaque body, "
        "unless its node has ``cast_shadows=False``.",
    )
    thickness: Number = Parameter(
        NOT_NEGATIVE,
        default=0.0,
        unit="units of the mesh",
        gltf="volume/thicknessFactor",
        doc="What lies below the surface, which the mesh's pose scales; 0 for a thin wall. It and "
        "``ior`` bend light.",
    )
    dispersion: Number = Parameter(
        NOT_NEGATIVE,
        default=0.0,
        gltf="dispersion/dispersion",
        doc="How much ``ior`` differs between colours: 20 divided by the Abbe number.",
    )
    attenuation_color: ColorNumbers = Parameter(
        COLOR,
        default=(1, 1, 1),
        gltf="volume/attenuationColor",
        doc="What white becomes after ``attenuation_distance``.",
    )
    attenuation_distance: Number = Parameter(
        REACH,
        default=math.inf,
        unit="world units",
        gltf="volume/attenuationDistance",
        doc="Infinite: nothing is absorbed.",
    )
    diffuse_transmission: Number = Parameter(
        SHARE,
        default=0.0,
        gltf="diffuse_transmission/diffuseTransmissionFactor",
        doc="Share of the scattered light that leaves on the other side: of leaves, paper, wax. "
        "Metals scatter none: give `metallic=0`, too.",
    )
    diffuse_transmission_color: ColorNumbers = Parameter(
        COLOR,
        default=(1, 1, 1),
        gltf="diffuse_transmission/diffuseTransmissionColorFactor",
        doc="Of the light that does; the base colour does not count there.",
    )
    metallic_roughness_texture: TextureSlot = TextureSlot(
        default=None,
        is_color=False,
        gltf="pbrMetallicRoughness/metallicRoughnessTexture",
        doc="G is the roughness, B metallic.",
    )
    normal_texture: TextureSlot = TextureSlot(
        default=None,
        is_color=False,
        is_normals=True,
        gltf="normalTexture",
        doc="Directions in tangent space, 0 … 255 for -1 … 1: red to the right, green up in the "
        "image.",
    )
    occlusion_texture: TextureSlot = TextureSlot(
        default=None, is_color=False, gltf="occlusionTexture", doc="R: of light from all around."
    )
    emissive_texture: TextureSlot = TextureSlot(
        default=None, is_color=True, gltf="emissiveTexture", doc="RGB."
    )
    clearcoat_texture: TextureSlot = TextureSlot(
        default=None, is_color=False, gltf="clearcoat/clearcoatTexture", doc="R."
    )
    clearcoat_roughness_texture: TextureSlot = TextureSlot(
        default=None, is_color=False, gltf="clearcoat/clearcoatRoughnessTexture", doc="G."
    )
    clearcoat_normal_texture: TextureSlot = TextureSlot(
        default=None,
        is_color=False,
        is_normals=True,
        gltf="clearcoat/clearcoatNormalTexture",
        doc="As ``normal_texture``, of the coat.",
    )
    specular_texture: TextureSlot = TextureSlot(
        default=None, is_color=False, gltf="specular/specularTexture", doc="Alpha: the intensity."
    )
    specular_color_texture: TextureSlot = TextureSlot(
        default=None, is_color=True, gltf="specular/specularColorTexture", doc="RGB."
    )
    sheen_color_texture: TextureSlot = TextureSlot(
        default=None, is_color=True, gltf="sheen/sheenColorTexture", doc="RGB."
    )
    sheen_roughness_texture: TextureSlot = TextureSlot(
        default=None, is_color=False, gltf="sheen/sheenRoughnessTexture", doc="Alpha."
    )
    transmission_texture: TextureSlot = TextureSlot(
        default=None, is_color=False, gltf="transmission/transmissionTexture", doc="R."
    )
    thickness_texture: TextureSlot = TextureSlot(
        default=None, is_color=False, gltf="volume/thicknessTexture", doc="G."
    )
    anisotropy: Number = Parameter(
        SHARE,
        default=0.0,
        gltf="anisotropy/anisotropyStrength",
        doc="How much rougher the surface is along a direction than across it: brushed metal.",
    )
    anisotropy_rotation: Number = Parameter(
        ANGLE,
        default=0.0,
        unit="radians",
        gltf="anisotropy/anisotropyRotation",
        doc="From the tangent to that direction, counter-clockwise.",
    )
    iridescence: Number = Parameter(
        SHARE, default=0.0, gltf="iridescence/iridescenceFactor", doc="Share of a thin film above."
    )
    iridescence_ior: Number = Parameter(
        AT_LEAST_ONE, default=1.3, gltf="iridescence/iridescenceIor", doc="Of the film, as ``ior``."
    )
    iridescence_thickness_minimum: Number = Parameter(
        NOT_NEGATIVE,
        default=100.0,
        unit="nanometres",
        gltf="iridescence/iridescenceThicknessMinimum",
        doc="Of the film where its texture is black.",
    )
    iridescence_thickness_maximum: Number = Parameter(
        NOT_NEGATIVE,
        default=400.0,
        unit="nanometres",
        gltf="iridescence/iridescenceThicknessMaximum",
        doc="Of the film where its texture is white, and where there is no texture.",
    )
    anisotropy_texture: TextureSlot = TextureSlot(
        default=None,
        is_color=False,
        gltf="anisotropy/anisotropyTexture",
        doc="R and G: a direction in tangent space, 0 … 255 for -1 … 1, which is then turned; B: "
        "the strength.",
    )
    iridescence_texture: TextureSlot = TextureSlot(
        default=None, is_color=False, gltf="iridescence/iridescenceTexture", doc="R."
    )
    iridescence_thickness_texture: TextureSlot = TextureSlot(
        default=None, is_color=False, gltf="iridescence/iridescenceThicknessTexture", doc="G."
    )
    diffuse_transmission_texture: TextureSlot = TextureSlot(
        default=None,
        is_color=False,
        gltf="diffuse_transmission/diffuseTransmissionTexture",
        doc="Alpha.",
    )
    diffuse_transmission_color_texture: TextureSlot = TextureSlot(
        default=None,
        is_color=True,
        gltf="diffuse_transmission/diffuseTransmissionColorTexture",
        doc="RGB.",
    )

    if not TYPE_CHECKING:  # the parameters generate the constructor

        def __init__(self, **values) -> None:
            refuse_unknown(Material, values, PARAMETERS)
            given = {
                name: PARAMETERS[name].kind.check(value, name) for name, value in values.items()
            }
            vars(self).update({**_DEFAULTS, "extras": {}, **given})
            self._states_color = "color" in given
            renew(self)

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

    def __repr__(self) -> str:
        texture = "" if self.texture is None else f", texture={self.texture!r}"
        return f"Material(name={self.name!r}, color={self.color}{texture})"


#: Returns the material that is drawn for a material, which may be tinted by other colours.
Finish: TypeAlias = Callable[[Material, bool], Material]
PARAMETERS = parameters_of(Material)
TEXTURE_SLOTS = tuple(name for name, row in PARAMETERS.items() if isinstance(row, TextureSlot))
_DEFAULTS = {name: row.kind.check(row.default, name) for name, row in PARAMETERS.items()}
# What only physically based materials show, and what shows without any other of it.
_PHYSICAL = (
    "transmission",
    "diffuse_transmission",
    "clearcoat",
    "sheen_color",
    "iridescence",
    "anisotropy",
)
_UNSAID = ("name", "two_sided", "flat_shading", *TEXTURE_SLOTS)
_SAID = tuple(name for name in PARAMETERS if name not in _UNSAID)


def placed_textures_of(material: Material) -> dict[str, PlacedTexture]:
    """Return a material's textures by slot, with their placements."""
    held = vars(material)
    return {
        slot: texture if isinstance(texture, PlacedTexture) else PlacedTexture(texture)
        for slot in TEXTURE_SLOTS
        if (texture := held[slot]) is not None
    }


def textures_of(material: Material) -> dict[str, Texture]:
    """Return a material's textures by slot."""
    return {slot: placed.texture for slot, placed in placed_textures_of(material).items()}


def put_texture(material: Material, slot: str, texture: Texture) -> None:
    """Replace the texture of a slot that has one, and keep its placement."""
    held = getattr(material, slot)
    is_placed = isinstance(held, PlacedTexture)
    setattr(material, slot, replace(held, texture=texture) if is_placed else texture)


def copy_of(material: Material) -> Material:
    """Return a copy, much faster than `copy`: files may ask for very many."""
    copy = type(material).__new__(type(material))
    vars(copy).update(vars(material), extras=dict(material.extras))
    return copy


def imply(material: Material) -> None:
    """Mark a material as implied: its file names none, so a written file needs none either."""
    material._is_implied = True


def is_implied(material: Material) -> bool:
    """Return whether a material is implied: its file does not name it."""
    return material._is_implied


def states_color(material: Material) -> bool:
    """Return whether the colour of a material was ever given."""
    return material._states_color


def put_states_color(material: Material, stated: bool) -> None:
    """Put back what `states_color` returned, after the colour was."""
    material._states_color = stated


def states_nothing(material: Material) -> bool:
    """Return whether nobody has said how a material looks, so that looks may choose.

    White that was given is stated, unlike the white of a new material.
    """
    if is_implied(material):
        return not textures_of(material)
    if material._states_color or textures_of(material):
        return False
    return all(a == b for name, a, b in _words_beside(material) if name != "extras")


def said_of_physical_ones(material: Material) -> list[str]:
    """Return the parameters of a material that only physically based ones show."""
    return [name for name in _PHYSICAL if getattr(material, name) != _DEFAULTS[name]]


def says_something(material: Material) -> bool:
    """Return whether a material differs from a default one in more than its name.

    Flat shading and double-sidedness do not count: STL loading sets them without any material in
    the file.
    """
    return bool(textures_of(material)) or _words(material) != _DEFAULT_WORDS


def _words_beside(material: Material) -> Iterator[tuple[str, Any, Any]]:
    """Yield what a material and a default one say, by name."""
    return zip(_SAID, _words(material), _DEFAULT_WORDS, strict=True)


def _words(material: Material) -> list[Any]:
    held = vars(material)
    return [_word(held[name]) for name in _SAID]


def _word(value: Any) -> Any:
    """Return a value, or the linear light of a colour."""
    if not isinstance(value, tuple):
        return value
    rgb, alpha = split_alpha(value)
    return *linear_color(rgb).tolist(), alpha


_DEFAULT_WORDS = _words(Material())
