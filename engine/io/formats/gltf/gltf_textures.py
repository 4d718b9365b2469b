"""The images and textures of a glTF file.

In: a `GltfFile` and its buffers. Out: a `Texture` for each pair of image and sampler, which keeps
the encoded image; with the transform that a material gives it. A missing, damaged or oversized
image gives a warning, and no texture. Images are decoded in parallel.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from ...._native.loaders import frozen
from ....base.side_by_side import side_by_side
from ....base.system import usable_processors
from ....errors import Engine3DError
from ....model.materials.textures import (
    ImageFile,
    PlacedTexture,
    Texture,
    image_file_of,
    remember_image_file,
)
from ...reading.reader_registry import find_reader
from ...reading.sources import Source
from ..images import read_image
from . import gltf_basisu
from .gltf_buffers import GltfBuffers
from .gltf_file import Entry, GltfFile, whole_of

if TYPE_CHECKING:
    from ....choices import Filter, Wrap
    from ....model.materials.parameters import SlotTexture

TRANSFORM, _WEBP = "KHR_texture_transform", "EXT_texture_webp"
#: The extensions handled here.
READ = (TRANSFORM, _WEBP, *gltf_basisu.READ)
_WRAPS: dict[int, Wrap] = {33071: "clamp", 33648: "mirror", 10497: "repeat"}
_NEAREST, _LINEAR = 9728, 9729
_SAMPLING = {
    "magFilter": (_NEAREST, _LINEAR),
    "minFilter": (_NEAREST, _LINEAR, 9984, 9985, 9986, 9987),
    "wrapS": tuple(_WRAPS),
    "wrapT": tuple(_WRAPS),
}
_MOST_THREADS = 4
# Signatures of PNG, JPEG and WebP images.
_USUAL = (b"\x89PNG\r\n\x1a\n", b"\xff\xd8\xff", b"RIFF")


class GltfTextures:
    """The textures of a file, each image decoded once.

    Parameters
    ----------
    file : GltfFile
    buffers : GltfBuffers
    """

    def __init__(self, file: GltfFile, buffers: GltfBuffers) -> None:
        self._file, self._buffers = file, buffers
        self._images: dict[int, Texture | None] = {}
        self._textures: dict[tuple[int | None, tuple[Wrap, Wrap], Filter], Texture] = {}
        self._sources: dict[int, int | None] = {}

    def decode(self, textures: set[int]) -> None:
        """Decode the images of some textures in parallel."""
        wanted = dict.fromkeys(self._image_of(texture) for texture in sorted(textures))
        images = [image for image in wanted if image is not None and image not in self._images]
        if not images:
            return
        results = side_by_side(self._decoded, images, _threads(images))
        for image, result in zip(images, results, strict=True):
            if isinstance(result, str):
                self._file.warnings.add(f"images[{image}] is left out: {result}")
            self._images[image] = None if isinstance(result, str) else result

    def get(self, info: Entry, where: str) -> Texture | None:
        """Return the texture for a material's ``info``; None if its image is left out."""
        index = self._file.number_in("textures", info.get("index"), where)
        entry = self._file.entries("textures")[index]
        self.decode({index})
        image = self._image_of(index)
        held = None if image is None else self._images[image]
        if held is None:
            return None
        wrap, filter = self._sampling(entry, f"textures[{index}]")
        key = image, wrap, filter
        if key not in self._textures:
            texture = Texture(held.pixels, wrap=wrap, filter=filter, name=held.name)
            remember_image_file(texture, image_file_of(held))
            self._textures[key] = texture
        return self._textures[key]

    def placed(self, info: Entry, where: str, uv_sets: tuple[int, ...]) -> SlotTexture:
        """Return a texture with its UV set and transform.

        Parameters
        ----------
        info : dict
        where : str
        uv_sets : tuple of int
            The file's UV sets that the mesh has.
        """
        texture = self.get(info, where)
        if texture is None:
            return None
        uv_set = self.uv_set(info, where)
        place = self._file.sound(f"{where}.{TRANSFORM}", self._place, info, where) or {}
        place["uv_set"] = uv_sets.index(uv_set) if uv_set in uv_sets else 0
        found = PlacedTexture(texture, **place)
        return found if found.uv_set or found.is_moved else texture

    def _place(self, info: Entry, where: str) -> dict[str, Any]:
        """Return the transform of the texture coordinates."""
        transform = self._transform(info, where)
        return {
            "offset": self._file.numbers(transform, "offset", where, (0.0, 0.0)),
            "rotation": self._file.number(transform, "rotation", where, 0.0),
            "scale": self._file.numbers(transform, "scale", where, (1.0, 1.0)),
        }

    def uv_set(self, info: Entry, where: str) -> int:
        """Return the UV set of ``info``; 0 if invalid."""
        return self._file.sound(f"{where}.texCoord", self._uv_set, info, where) or 0

    def _uv_set(self, info: Entry, where: str) -> int:
        default = self._file.whole(info, "texCoord", where, 0)
        return self._file.whole(self._transform(info, where), "texCoord", where, default)

    def _transform(self, info: Entry, where: str) -> Entry:
        extensions = self._file.spare_part(info, "extensions", where)
        return self._file.spare_part(extensions, TRANSFORM, where)

    def _image_of(self, index: int) -> int | None:
        """Return the image of a texture; warn once if it has none."""
        if index in self._sources:
            return self._sources[index]
        file, where = self._file, f"textures[{index}]"
        entry = file.entry("textures", index, where)
        extensions = file.spare_part(entry, "extensions", where)
        candidates = [file.spare_part(extensions, _WEBP, where).get("source"), entry.get("source")]
        place = 0 if gltf_basisu.is_installed() else len(candidates)
        for name in gltf_basisu.READ:
            candidates.insert(place, file.spare_part(extensions, name, where).get("source"))
        image = next((source for source in candidates if source is not None), None)
        if image is None:
            others = " that is read" if extensions else ""
            file.warnings.add(f"{where} has no image{others}: left out")
        else:
            image = file.sound(where, file.number_in, "images", image, where)
        self._sources[index] = image
        return image

    def _sampling(self, entry: Entry, where: str) -> tuple[tuple[Wrap, Wrap], Filter]:
        """Return the wraps along both sides, and the filter."""
        sampler: Entry = {}
        if "sampler" in entry:
            place = f"{where}.sampler"
            found = self._file.sound(place, self._file.entry, "samplers", entry["sampler"], where)
            sampler = found or {}
        for key, known in _SAMPLING.items():
            if key in sampler and whole_of(sampler[key]) not in known:
                self._file.warnings.add_once(
                    f"{where} is sampled by no {key} that is known: as by default"
                )
        wrap = _wrap(sampler.get("wrapS")), _wrap(sampler.get("wrapT"))
        if sampler.get("magFilter") == _NEAREST:
            return wrap, "nearest"
        has_levels = sampler.get("minFilter") not in (_NEAREST, _LINEAR)
        return wrap, "trilinear" if has_levels else "bilinear"

    def _decoded(self, image: int) -> Texture | str:
        """Return the image as a texture, or the reason why there is none."""
        where = f"images[{image}]"
        entry = self._file.entries("images")[image]
        uri = entry.get("uri")
        is_file = isinstance(uri, str) and uri[:5].lower() != "data:"
        try:
            if "bufferView" in entry:
                data = bytes(self._buffers.view(entry["bufferView"], where))
            else:
                data = self._buffers.named(uri, where)
            source = Source(f"<{uri if is_file else where}>", data)
            if gltf_basisu.is_packed(data):
                pixels = gltf_basisu.read_packed(source)
            else:
                pixels = _read_image(source)
        except gltf_basisu.NotInstalledError as error:
            raise self._file.error(f"{where} {error}") from None
        except Engine3DError as error:
            reason = getattr(error, "message", None) or str(error)
            return reason.removeprefix(f"{where}: ")
        texture = Texture(pixels, name=str(entry.get("name") or (uri if is_file else "")))
        remember_image_file(texture, ImageFile(content=data))
        return texture


def _read_image(source: Source) -> np.ndarray:
    """Decode an image; glTF's usual formats do not import all others."""
    if source.data.startswith(_USUAL):
        return read_image(source)
    return find_reader(source, "image").read(source)


def changed(texture: Texture, pixels: np.ndarray, name: str) -> Texture:
    """Return a texture with other pixels and the same sampling."""
    return Texture(frozen(pixels), wrap=texture.wrap, filter=texture.filter, name=name)


def _threads(images: list[int]) -> int:
    return max(min(len(images), usable_processors(), _MOST_THREADS), 1)


def _wrap(value: Any) -> Wrap:
    value = whole_of(value)
    return _WRAPS.get(value, "repeat") if type(value) is int else "repeat"
