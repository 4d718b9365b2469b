"""Materials: numbers, colours and textures of surfaces."""

from __future__ import annotations

import abc

import numpy as np
from numpy.typing import NDArray

from ._held import Named, held
from .constants import TexFlags
from .texture import Texture
from .utils import format_color_vector, format_texture_source

_ALPHA_MODES = ("OPAQUE", "MASK", "BLEND")


def _flag(name: str, doc: str) -> property:
    """Return a property that holds only True or False."""

    def made(value) -> bool:
        if not isinstance(value, bool | np.bool_):
            raise TypeError(f"{name} must be a boolean value")
        return bool(value)

    return held(name, made, doc)


def _texture(name: str, channels: str, doc: str) -> property:
    """Return a property that holds a texture, and converts images."""

    def made(value) -> Texture | None:
        if value is None or isinstance(value, Texture):
            return value
        texels = format_texture_source(value, channels)
        return Texture(source=texels, source_channels=channels)

    return held(name, made, doc)


def _share(name: str, what: str, doc: str) -> property:
    """Return a property that holds a number from 0 to 1; None is 1."""

    def made(value) -> float:
        value = 1.0 if value is None else value
        if value < 0 or value > 1:
            raise ValueError(f"{what} must be in range [0,1]")
        return float(value)

    return held(name, made, doc)


def _color(name: str, length: int, default: float, doc: str) -> property:
    """Return a property that holds a colour, float32; None is the default."""

    def made(value) -> NDArray[np.float32]:
        return format_color_vector(np.full(length, default) if value is None else value, length)

    return held(name, made, doc)


def _checked_mode(value) -> str:
    if value not in _ALPHA_MODES:
        raise ValueError(f"Invalid alpha mode {value}")
    return value


class Material(Named, abc.ABC):
    """The base of all materials.

    Parameters
    ----------
    name : str, optional
    normalTexture, occlusionTexture, emissiveTexture : array, image of Pillow or Texture, optional
    emissiveFactor : sequence of 3 numbers, optional
        Light that the surface gives off; counts squared, as in pyrender.
    alphaMode : {"OPAQUE", "MASK", "BLEND"}
        MASK draws as OPAQUE does, as in pyrender.
    alphaCutoff : float
    doubleSided : bool
        Draw backs, too; they are lit as fronts are.
    smooth : bool
        Not read.
    wireframe : bool
        Draw the edges of triangles alone.
    """

    #: Names of the textures, with the flag of each.
    _slots = (
        ("normalTexture", TexFlags.NORMAL),
        ("occlusionTexture", TexFlags.OCCLUSION),
        ("emissiveTexture", TexFlags.EMISSIVE),
    )

    def __init__(
        self,
        name=None,
        normalTexture=None,
        occlusionTexture=None,
        emissiveTexture=None,
        emissiveFactor=None,
        alphaMode=None,
        alphaCutoff=None,
        doubleSided=False,
        smooth=True,
        wireframe=False,
    ):
        self.name = name
        self.normalTexture = normalTexture
        self.occlusionTexture = occlusionTexture
        self.emissiveTexture = emissiveTexture
        self.emissiveFactor = emissiveFactor
        self.alphaMode = "OPAQUE" if alphaMode is None else alphaMode
        self.alphaCutoff = 0.5 if alphaCutoff is None else alphaCutoff
        self.doubleSided = doubleSided
        self.smooth = smooth
        self.wireframe = wireframe

    normalTexture = _texture("normalTexture", "RGB", "Directions of normals.")
    occlusionTexture = _texture("occlusionTexture", "R", "What of light is left.")
    emissiveTexture = _texture("emissiveTexture", "RGB", "Multiplies emissiveFactor; sRGB.")
    emissiveFactor = _color("emissiveFactor", 3, 0.0, "Light given off, (3,) float32.")
    doubleSided = _flag("doubleSided", "Whether backs are drawn.")
    smooth = _flag("smooth", "Not read.")
    wireframe = _flag("wireframe", "Whether only edges are drawn.")
    alphaMode = held("alphaMode", _checked_mode, '"OPAQUE", "MASK" or "BLEND".')

    @property
    def alphaCutoff(self) -> float:
        """Alpha cutoff: with MASK, smaller base colour alphas sort as transparent."""
        return self._alphaCutoff

    @alphaCutoff.setter
    def alphaCutoff(self, value) -> None:
        if value < 0 or value > 1:
            raise ValueError("Alpha cutoff must be in range [0,1]")
        self._alphaCutoff = float(value)

    @property
    def _factor(self) -> NDArray[np.float32]:
        """Return the colour whose fourth number is alpha."""
        return np.ones(4, np.float32)

    @property
    def is_transparent(self) -> bool:
        """Whether meshes with it are drawn after the others."""
        if self.alphaMode == "OPAQUE":
            return False
        return bool(self._factor[3] < (1.0 if self.alphaMode == "BLEND" else self.alphaCutoff))

    @property
    def tex_flags(self) -> int:
        """Which textures it has, as `TexFlags`."""
        return sum(flag for name, flag in self._slots if getattr(self, name) is not None)

    @property
    def textures(self) -> set[Texture]:
        """The textures that it has."""
        return {getattr(self, name) for name, _ in self._slots} - {None}


class MetallicRoughnessMaterial(Material):
    """A physically based material.

    Parameters
    ----------
    name, normalTexture, occlusionTexture, emissiveTexture, emissiveFactor, alphaMode, alphaCutoff,
    doubleSided, smooth, wireframe
        As for `Material`.
    baseColorFactor : sequence of 4 numbers, optional
        Linear, or of 0 to 255 if whole numbers; by default white.
    baseColorTexture : array, image of Pillow or Texture, optional
        sRGB; multiplies the factor.
    metallicFactor, roughnessFactor : float
        From 0 to 1; by default 1.
    metallicRoughnessTexture : array, image of Pillow or Texture, optional
        Green multiplies the roughness, blue the metallic factor.
    """

    _slots = (
        *Material._slots,
        ("baseColorTexture", TexFlags.BASE_COLOR),
        ("metallicRoughnessTexture", TexFlags.METALLIC_ROUGHNESS),
    )

    def __init__(
        self,
        name=None,
        normalTexture=None,
        occlusionTexture=None,
        emissiveTexture=None,
        emissiveFactor=None,
        alphaMode=None,
        alphaCutoff=None,
        doubleSided=False,
        smooth=True,
        wireframe=False,
        baseColorFactor=None,
        baseColorTexture=None,
        metallicFactor=1.0,
        roughnessFactor=1.0,
        metallicRoughnessTexture=None,
    ):
        super().__init__(
            *(name, normalTexture, occlusionTexture, emissiveTexture, emissiveFactor),
            *(alphaMode, alphaCutoff, doubleSided, smooth, wireframe),
        )
        self.baseColorFactor = baseColorFactor
        self.baseColorTexture = baseColorTexture
        self.metallicFactor = metallicFactor
        self.roughnessFactor = roughnessFactor
        self.metallicRoughnessTexture = metallicRoughnessTexture

    baseColorFactor = _color("baseColorFactor", 4, 1.0, "Base colour and alpha, (4,) float32.")
    baseColorTexture = _texture("baseColorTexture", "RGBA", "Multiplies baseColorFactor; sRGB.")
    metallicFactor = _share("metallicFactor", "Metallic factor", "0: no metal, 1: metal.")
    roughnessFactor = _share("roughnessFactor", "Roughness factor", "0: smooth, 1: rough.")
    metallicRoughnessTexture = _texture(
        "metallicRoughnessTexture", "GB", "Green: roughness, blue: metallic."
    )

    @property
    def _factor(self) -> NDArray[np.float32]:
        return self.baseColorFactor


class SpecularGlossinessMaterial(Material):
    """A material of KHR_materials_pbrSpecularGlossiness, which draws black, as in pyrender.

    Parameters
    ----------
    name, normalTexture, occlusionTexture, emissiveTexture, emissiveFactor, alphaMode, alphaCutoff,
    doubleSided, smooth, wireframe
        As for `Material`.
    diffuseFactor : sequence of 4 numbers, optional
    diffuseTexture, specularGlossinessTexture : array, image of Pillow or Texture, optional
    specularFactor : sequence of 3 numbers, optional
    glossinessFactor : float
    """

    _slots = (
        *Material._slots,
        ("diffuseTexture", TexFlags.DIFFUSE),
        ("specularGlossinessTexture", TexFlags.SPECULAR_GLOSSINESS),
    )

    def __init__(
        self,
        name=None,
        normalTexture=None,
        occlusionTexture=None,
        emissiveTexture=None,
        emissiveFactor=None,
        alphaMode=None,
        alphaCutoff=None,
        doubleSided=False,
        smooth=True,
        wireframe=False,
        diffuseFactor=None,
        diffuseTexture=None,
        specularFactor=None,
        glossinessFactor=1.0,
        specularGlossinessTexture=None,
    ):
        super().__init__(
            *(name, normalTexture, occlusionTexture, emissiveTexture, emissiveFactor),
            *(alphaMode, alphaCutoff, doubleSided, smooth, wireframe),
        )
        self.diffuseFactor = diffuseFactor
        self.diffuseTexture = diffuseTexture
        self.specularFactor = specularFactor
        self.glossinessFactor = glossinessFactor
        self.specularGlossinessTexture = specularGlossinessTexture

    diffuseFactor = _color("diffuseFactor", 4, 1.0, "Diffuse colour and alpha, (4,) float32.")
    diffuseTexture = _texture("diffuseTexture", "RGBA", "Multiplies diffuseFactor.")
    specularFactor = _color("specularFactor", 3, 1.0, "Specular colour, (3,) float32.")
    glossinessFactor = _share("glossinessFactor", "glossiness factor", "1: smooth.")
    specularGlossinessTexture = _texture("specularGlossinessTexture", "GB", "Kept as it is.")

    @property
    def _factor(self) -> NDArray[np.float32]:
        return self.diffuseFactor


__all__ = ["Material", "MetallicRoughnessMaterial", "SpecularGlossinessMaterial"]
