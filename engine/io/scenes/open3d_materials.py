"""Materials of Open3D's renderer as the engine's.

In: an ``open3d.visualization.rendering.MaterialRecord``, images of Open3D. Out: a `Material`,
textures. Base colours of lit materials are linear light, those of others and images display values,
as Open3D's shaders read them.
"""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...errors import InvalidArgumentError, warn
from ...model.materials.linear_colors import linear
from ...model.materials.material import Material
from ...model.materials.textures import Texture

#: Maps of records that have no counterpart here.
_ABSENT_MAPS = ("clearcoat_img", "clearcoat_roughness_img", "anisotropy_img", "reflectance_img")
_UNLIT = ("defaultUnlit", "defaultUnlitTransparency", "unlitSolidColor", "unlitLine")


#: By the keys of ``open3d.visualization.Material``: the fields of a record, and their defaults.
_RECORD_MAPS = {
    "albedo": "albedo_img",
    "normal": "normal_img",
    "ambient_occlusion": "ao_img",
    "roughness": "roughness_img",
    "metallic": "metallic_img",
    "reflectance": "reflectance_img",
    "clear_coat": "clearcoat_img",
    "clear_coat_roughness": "clearcoat_roughness_img",
    "anisotropy": "anisotropy_img",
    "ao_rough_metal": "ao_rough_metal_img",
}
_RECORD_NUMBERS = {
    "metallic": ("base_metallic", 0.0),
    "roughness": ("base_roughness", 1.0),
    "reflectance": ("base_reflectance", 0.5),
    "clear_coat": ("base_clearcoat", 0.0),
    "clear_coat_roughness": ("base_clearcoat_roughness", 0.0),
    "anisotropy": ("base_anisotropy", 0.0),
    "thickness": ("thickness", 1.0),
    "transmission": ("transmission", 1.0),
    "absorption_distance": ("absorption_distance", 1.0),
    "point_size": ("point_size", 3.0),
    "line_width": ("line_width", 1.0),
}
_RECORD_COLORS = {
    "base_color": ("base_color", (1.0, 1.0, 1.0, 1.0)),
    "absorption_color": ("absorption_color", (1.0, 1.0, 1.0)),
}


def record_of_tensor(geometry: Any) -> Any:
    """Return the material of a geometry of ``open3d.t`` as a record; None without one.

    It has the fields of a ``MaterialRecord`` that `material_of_record` reads.
    """
    material = getattr(geometry, "material", None)
    if material is None or not material.is_valid():
        return None
    record = SimpleNamespace(
        shader=material.material_name or "defaultLit", has_alpha=False, sRGB_color=False
    )
    maps, numbers = material.texture_maps, material.scalar_properties
    for key, field in _RECORD_MAPS.items():
        setattr(record, field, maps[key].to_legacy() if key in maps else None)
    for key, (field, number) in _RECORD_NUMBERS.items():
        setattr(record, field, float(numbers[key]) if key in numbers else number)
    for key, (field, color) in _RECORD_COLORS.items():
        given = material.vector_properties
        held = np.asarray(given[key], np.float64) if key in given else np.array(color)
        setattr(record, field, held[: len(color)])
    return record


def bytes_of_image(image: Any) -> NDArray[np.uint8]:
    """Return the pixels of an ``open3d.geometry.Image`` as bytes, (H, W, 1 to 4).

    Raises
    ------
    InvalidArgumentError
        It has another number of channels, or another type of numbers than Open3D draws.
    """
    pixels = np.asarray(image)
    pixels = pixels[..., np.newaxis] if pixels.ndim == 2 else pixels
    if pixels.ndim != 3 or not 1 <= pixels.shape[2] <= 4 or not pixels.size:
        raise InvalidArgumentError(f"an image of shape {pixels.shape} is no texture")
    if pixels.dtype == np.uint16:
        return (pixels >> 8).astype(np.uint8)
    if pixels.dtype.kind == "f":
        return (np.clip(np.nan_to_num(pixels), 0.0, 1.0) * 255.0 + 0.5).astype(np.uint8)
    if pixels.dtype != np.uint8:
        raise InvalidArgumentError(f"an image of {pixels.dtype} is no texture")
    return pixels


def texture_of_image(image: Any, *, is_color: bool = True) -> Texture:
    """Return a texture of an image of a material, whose first row lies at v = 1."""
    return Texture(bytes_of_image(image), color_space="srgb" if is_color else "linear")


def material_of_record(record: Any) -> Material:
    """Return the material of a ``MaterialRecord``.

    A map that is not drawn is a warning that names it.
    """
    color = np.clip(np.nan_to_num(np.asarray(record.base_color, np.float64)), 0.0, 1.0)
    is_clear = record.shader.endswith("Transparency") or record.has_alpha
    alpha = float(color[3]) if is_clear else 1.0
    is_unlit = record.shader in _UNLIT
    red, green, blue = (color[:3] * alpha).tolist()  # twice in all, as in Filament
    material = Material(
        color=(red, green, blue, alpha) if is_unlit else linear(red, green, blue, alpha),
        two_sided=not is_clear,  # of glass, Filament shows the nearest surface alone
        alpha_mode="blend" if is_clear else "opaque",
        unlit=is_unlit,
    )
    if not material.unlit:
        _make_physical(material, record)
    if _is_given(record.albedo_img):
        material.texture = texture_of_image(record.albedo_img)
    for name in _ABSENT_MAPS:
        if _is_given(getattr(record, name)):
            warn(f"the map {name} of a MaterialRecord is not drawn")
    return material


def _make_physical(material: Material, record: Any) -> None:
    """Set what only lit materials have."""
    material.metallic = _share(record.base_metallic)
    material.roughness = _share(record.base_roughness)
    # F0 = 0.16 r², in Filament; glTF's is 0.04 times the specular intensity.
    material.specular_intensity = min(_share(record.base_reflectance) ** 2 * 4.0, 1.0)
    if record.base_reflectance > 0.5:
        root = 0.4 * _share(record.base_reflectance)
        material.ior = (1.0 + root) / (1.0 - root)
    material.clearcoat = _share(record.base_clearcoat)
    material.clearcoat_roughness = _share(record.base_clearcoat_roughness)
    material.anisotropy = _share(record.base_anisotropy)
    if record.shader == "defaultLitSSR":
        material.transmission = _share(record.transmission)
        material.thickness = max(float(record.thickness), 0.0)
        material.attenuation_color = linear(*np.clip(record.absorption_color, 0, 1).tolist())
        material.attenuation_distance = max(float(record.absorption_distance), 1e-9)
    if _is_given(record.normal_img):
        material.normal_texture = texture_of_image(record.normal_img, is_color=False)
    packed = packed_map(record)
    if packed is not None:
        texture = Texture(packed, color_space="linear")
        material.metallic_roughness_texture = material.occlusion_texture = texture


def packed_map(record: Any) -> NDArray[np.uint8] | None:
    """Return occlusion, roughness and metallic in one image, (H, W, 3) uint8; None without any.

    Maps of another size than the metallic (else the roughness) map's are sampled to it.
    """
    if _is_given(record.ao_rough_metal_img):
        pixels = bytes_of_image(record.ao_rough_metal_img)
        return pixels[..., :3] if pixels.shape[2] >= 3 else None
    maps = [
        bytes_of_image(image)[..., 0] if _is_given(image) else None
        for image in (record.ao_img, record.roughness_img, record.metallic_img)
    ]
    sizes = [one.shape for one in maps if one is not None]
    if not sizes:
        return None
    return np.stack([_sampled(one, sizes[-1]) for one in maps], axis=2)


def _sampled(channel: NDArray[np.uint8] | None, shape: tuple[int, ...]) -> NDArray[np.uint8]:
    if channel is None:
        return np.full(shape, 255, np.uint8)
    rows, columns = (
        (np.arange(side) * given // side) for side, given in zip(shape, channel.shape, strict=True)
    )
    return channel[rows[:, np.newaxis], columns]


def _is_given(image: Any) -> bool:
    return image is not None and not image.is_empty()


def _share(value: Any) -> float:
    return float(np.clip(np.nan_to_num(value), 0.0, 1.0))
