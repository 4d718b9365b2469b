"""Materials of the optional package trimesh.

In: the visuals of trimesh's meshes. Out: a `Material` for each, with the fields of glTF that
trimesh has, or with those of OBJ; what is left out is a warning that names it. Factors of
physically based materials are linear light, as in glTF; other colours are display values.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..choices import AlphaMode
from ..errors import InvalidArgumentError, warn
from ..model.materials.linear_colors import LinearColor
from ..model.materials.material import PARAMETERS, TEXTURE_SLOTS, Material
from ..model.materials.textures import Texture
from .formats.images import check_image_size, made_pixels
from .reading.warning_list import WarningList

#: The fields of `Material` that a ``PBRMaterial`` has, with glTF's names of them.
_PBR = {
    field: row.gltf.rpartition("/")[2]
    for field, row in PARAMETERS.items()
    if row.gltf and row.part in ("", "pbrMetallicRoughness") and "." not in row.gltf
}
_NUMBERS = ("metallic", "roughness", "alpha_cutoff")
#: What OBJ files call them, which keep them by these names.
_KEPT = {"metallicFactor": "Pm", "roughnessFactor": "Pr"}
_ALPHA_MODES: dict[str, AlphaMode] = {"OPAQUE": "opaque", "MASK": "mask", "BLEND": "blend"}
#: Maps of MTL files whose names do not begin with ``map_``.
_MAPS = ("bump", "disp", "norm")
#: What trimesh holds for colours that nobody gave.
_UNSAID = (102, 102, 102, 255)


class TrimeshMaterials:
    """The materials of one thing of trimesh, which share textures.

    Parameters
    ----------
    warnings : WarningList, optional
        Of the file; otherwise warnings are those of the program, and damaged images are errors.
    """

    def __init__(self, warnings: WarningList | None = None) -> None:
        self._warnings = warnings
        self._told: set[str] = set()
        # Also holds the image: otherwise its ID could be reused.
        self._textures: dict[int, tuple[object, Texture | None]] = {}

    def of(self, visual: Any, count: int) -> tuple[list[Material], NDArray[np.int32] | None]:
        """Return the materials of visuals with textures, and which of them each face has.

        Parameters
        ----------
        visual : trimesh.visual.TextureVisuals
        count : int
            Of the faces.

        Returns
        -------
        materials : list of Material
        ids : (count,) int32 or None
            None if all faces have the first.
        """
        several = list(getattr(visual.material, "materials", None) or [visual.material])
        materials = [self._material(material) for material in several]
        if len(several) == 1:
            return materials, None
        given = getattr(visual, "face_materials", None)
        ids = np.zeros(0, np.int32) if given is None else np.asarray(given).reshape(-1)
        if len(ids) != count or not count or ids.min() < 0 or ids.max() >= len(several):
            self._tell(
                f"face_materials do not say which of {len(several)} materials each face has: all "
                f"have the first, {materials[0].name!r}"
            )
            return materials, None
        return materials, ids.astype(np.int32)

    def _material(self, given: Any) -> Material:
        material = Material(name=str(getattr(given, "name", None) or ""), color=(1.0, 1.0, 1.0))
        material.two_sided = bool(getattr(given, "doubleSided", False))
        if hasattr(given, "baseColorFactor"):
            self._take_physical(material, given)
        else:
            self._take_simple(material, given)
        return material

    def _take_physical(self, material: Material, given: Any) -> None:
        """Take the fields of a ``PBRMaterial``; without metal and roughness it is not physical."""
        for field, key in _PBR.items():
            value = getattr(given, key, None)
            if value is None:
                continue
            if field in TEXTURE_SLOTS:
                setattr(material, field, self._texture(value))
            elif field in _NUMBERS:
                self._put(material, field, float(value), key)
                material.extras |= {_KEPT[key]: float(value)} if key in _KEPT else {}
            else:
                self._put(material, field, _color(value, is_linear=True), key)
        if material.metallic_roughness_texture is not None and not material.is_physical:
            material.metallic = material.roughness = 1.0
        alpha = _alpha(getattr(given, "baseColorFactor", None))
        # Without a mode, trimesh's viewer blends.
        usual = "BLEND" if alpha < 1.0 else "OPAQUE"
        material.alpha_mode = _ALPHA_MODES[getattr(given, "alphaMode", None) or usual]
        if alpha < 1.0 and material.alpha_mode != "opaque":
            material.color = _with_alpha(material.color, alpha)

    def _take_simple(self, material: Material, given: Any) -> None:
        """Take the fields of a ``SimpleMaterial``, as of an MTL file."""
        diffuse, image = getattr(given, "diffuse", None), getattr(given, "image", None)
        said = _words(getattr(given, "kwargs", None))
        if image is not None:
            material.texture = self._texture(image)
        # trimesh's default grey for materials without a colour would darken the image.
        if diffuse is not None and image is None:
            material.color = _color(diffuse, is_linear=False)
        alpha = min(_alpha(diffuse), said.get("d", 1.0))
        if alpha < 1.0:
            material.color = _with_alpha(material.color, alpha)
            material.alpha_mode = "blend"
        specular = getattr(given, "specular", None)
        is_said = specular is not None and not np.array_equal(specular, _UNSAID)
        if (is_said or "ks" in said) and said.get("illum", 2.0) >= 2.0:
            material.specular = _color(specular, is_linear=False)
            if (glossiness := getattr(given, "glossiness", None)) is not None:
                self._put(material, "shininess", float(glossiness), "glossiness")
        kept = sorted(getattr(given, "kwargs", None) or ())
        if maps := [key for key in kept if key.startswith("map_") or key in _MAPS]:
            self._tell(f"{', '.join(maps)} of material {material.name!r}: trimesh holds no image")

    def _put(self, material: Material, field: str, value: Any, key: str) -> None:
        try:
            setattr(material, field, value)
        except InvalidArgumentError as error:
            self._tell(f"{key} of material {material.name!r} is left out: {error}")

    def _texture(self, image: Any) -> Texture | None:
        if id(image) not in self._textures:
            self._textures[id(image)] = (image, self._made(image))
        return self._textures[id(image)][1]

    def _made(self, image: Any) -> Texture | None:
        name = str(getattr(image, "name", None) or "")
        try:
            check_image_size(image.width, image.height, "texture")
            return Texture(made_pixels(image, "texture"), name=name)
        # Pillow decodes the image only here, and raises various errors for damaged ones.
        except Exception as error:
            if self._warnings is None:
                raise
            reason = str(error) or type(error).__name__
            self._warnings.add(f"texture {name!r} is left out: {reason}")
            return None

    def _tell(self, message: str) -> None:
        """Warn once."""
        if self._warnings is not None:
            self._warnings.add_once(message)
        elif message not in self._told:
            self._told.add(message)
            warn(message)


def _parts(color: Any) -> list[float]:
    """Return the numbers of a colour, of which whole ones range to 255."""
    color = np.asarray(color)
    scale = 255.0 if color.dtype.kind in "iu" else 1.0
    return [float(part) / scale for part in np.nan_to_num(color).clip(min=0).tolist()]


def _color(color: Any, is_linear: bool) -> tuple[float, ...]:
    parts = _parts(color)[:3]
    return LinearColor(parts) if is_linear else tuple(min(part, 1.0) for part in parts)


def _alpha(color: Any) -> float:
    parts = () if color is None else _parts(color)
    return min(parts[3], 1.0) if len(parts) > 3 else 1.0


def _with_alpha(color: Any, alpha: float) -> Any:
    """Return a colour of floats with an alpha; marked colours stay marked."""
    return type(color)((*color[:3], alpha))


def _words(given: Mapping[str, Any] | None) -> dict[str, float]:
    """Return the numbers among what an MTL file says beside colours and images."""
    words = {str(key).lower(): _number(value) for key, value in (given or {}).items()}
    return {key: number for key, number in words.items() if number is not None}


def _number(value: Any) -> float | None:
    """Return a number, or the first of a list of words; None if it is none."""
    try:
        return float(np.ravel(np.asarray(value, np.float64))[0])
    except (TypeError, ValueError, IndexError):
        return None
