"""Textures: images that cover surfaces.

A `Texture` holds 8-bit RGBA pixels and says how to sample them: colour space, filter and wrap.
Pixels are stored top row first, as in image files; texture coordinates have their origin at the
bottom left, and the core flips them. The core makes mip levels anew when ``version`` changes.
"""

from __future__ import annotations

import math
import os
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import NamedTuple, TypeAlias, TypedDict, get_args

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..._native.loaders import frozen, is_frozen
from ...base.angles import finite_angle
from ...base.calls import hints_keywords
from ...base.dirty_tracking import renew
from ...base.linalg import cos, sin
from ...base.notebook_pictures import ShownInNotebooks
from ...base.numbers import as_array, real, shown
from ...base.validation import CheckedAttribute, Closed, choose, one_of, text, whole_number
from ...choices import ColorSpace, Filter, Wrap
from ...errors import InvalidArgumentError
from .colors import COLOR_SPACES

FILTERS: tuple[Filter, ...] = get_args(Filter)
WRAPS: tuple[Wrap, ...] = get_args(Wrap)
#: One wrap for both coordinates, or one along u and one along v.
SideWraps: TypeAlias = Wrap | tuple[Wrap, Wrap]
MAX_SIDE = 16384
MAX_ANISOTROPY = 16
MAX_LOD_BIAS = 16


def _check_wrap(value: SideWraps, what: str) -> SideWraps:
    """Return one wrap if both coordinates have the same, or else a pair."""
    if not isinstance(value, (tuple, list)):
        return choose(value, WRAPS, what)
    if len(value) != 2:
        raise InvalidArgumentError(f"{what} must be one name or a pair (u, v), not {shown(value)}")
    u, v = (choose(name, WRAPS, what) for name in value)
    return u if u == v else (u, v)


def _check_anisotropy(value: int, what: str) -> int:
    if isinstance(value, bool) or real(value) not in range(1, MAX_ANISOTROPY + 1):
        raise InvalidArgumentError(
            f"{what} must be a whole number in 1..{MAX_ANISOTROPY}, not {shown(value)}"
        )
    return int(value)


def _check_bias(value: float, what: str) -> float:
    bias = real(value)
    if not -MAX_LOD_BIAS <= bias <= MAX_LOD_BIAS:
        raise InvalidArgumentError(
            f"{what} must be in -{MAX_LOD_BIAS}..{MAX_LOD_BIAS}, not {shown(value)}"
        )
    return bias


class TextureOptions(TypedDict, total=False):
    """The keyword arguments of `Texture`, for functions that pass them on."""

    color_space: ColorSpace
    filter: Filter
    wrap: SideWraps
    name: str
    anisotropy: int
    lod_bias: float


class ImageFile(NamedTuple):
    """The source of a texture's pixels, so that it can be saved by naming it.

    Attributes
    ----------
    path : str or None
        Absolute.
    content : bytes or None
        The image's bytes, if it is embedded in another file.
    is_missing : bool
        Whether the file is missing and placeholder pixels stand in for it.
    """

    path: str | None = None
    content: bytes | None = None
    is_missing: bool = False


class Texture(ShownInNotebooks, Closed):
    """An image and how to sample it.

    Parameters
    ----------
    pixels : array-like of uint8
        (H, W) or (H, W, 1) grey, (H, W, 2) grey and alpha, (H, W, 3) RGB or (H, W, 4) RGBA; the
        top row first. Sides from 1 to 16384.
    color_space : {"srgb", "linear"}
        How the RGB bytes encode light; alpha is always linear.
    filter : {"trilinear", "bilinear", "nearest"}
    wrap : {"repeat", "clamp", "mirror"} or pair of these
        Address mode beyond the edges; a pair gives it along u and along v. An equal pair is kept as
        one name.
    name : str
    anisotropy : int
        Maximum anisotropy, 1 to 16: how many places along its footprint a pixel samples at most. 1
        blurs receding surfaces. Only trilinear textures use it: others have no mip levels.
    lod_bias : float
        Added to the mip level of trilinear textures, -16 to 16: each -1 reads an image twice as
        wide, which is sharper and flickers more.

    Attributes
    ----------
    pixels : (H, W, 4) uint8, read-only
        Assigning replaces the image.
    version : int
        Grows with every assignment.

    Raises
    ------
    InvalidArgumentError
    """

    name: str
    version: int
    _file: ImageFile  # the file of these pixels
    color_space: CheckedAttribute[ColorSpace, ColorSpace] = CheckedAttribute(one_of(COLOR_SPACES))
    filter: CheckedAttribute[Filter, Filter] = CheckedAttribute(one_of(FILTERS))
    wrap: CheckedAttribute[SideWraps, SideWraps] = CheckedAttribute(_check_wrap)
    anisotropy: CheckedAttribute[int, int] = CheckedAttribute(_check_anisotropy)
    lod_bias: CheckedAttribute[float, float] = CheckedAttribute(_check_bias)

    def __init__(
        self,
        pixels: ArrayLike,
        *,
        color_space: ColorSpace = "srgb",
        filter: Filter = "trilinear",
        wrap: SideWraps = "repeat",
        name: str = "",
        anisotropy: int = 1,
        lod_bias: float = 0.0,
    ) -> None:
        self.pixels = pixels
        self.color_space = color_space
        self.filter = filter
        self.wrap = wrap
        self.name = text(name, "name")
        self.anisotropy = anisotropy
        self.lod_bias = lod_bias

    @property
    def pixels(self) -> NDArray[np.uint8]:
        return self._pixels

    @pixels.setter
    def pixels(self, value: ArrayLike) -> None:
        self._pixels = as_rgba(value)
        self._file = ImageFile()
        renew(self)

    @property
    def side_wraps(self) -> tuple[Wrap, Wrap]:
        """The wrap along u and the wrap along v."""
        return (self.wrap, self.wrap) if isinstance(self.wrap, str) else self.wrap

    @property
    def width(self) -> int:
        return self._pixels.shape[1]

    @property
    def height(self) -> int:
        return self._pixels.shape[0]

    def __repr__(self) -> str:
        return f"Texture({self.width}x{self.height}, name={self.name!r})"


#: Returns with which anisotropy and with which bias a texture is read in a picture.
Reading: TypeAlias = Callable[[Texture], tuple[int, float]]


def own_reading(texture: Texture) -> tuple[int, float]:
    """Return the anisotropy and the bias that a texture says."""
    return texture.anisotropy, texture.lod_bias


def image_file_of(texture: Texture) -> ImageFile:
    """Return the file that a texture's pixels come from; none once they are replaced."""
    return texture._file


def remember_image_file(texture: Texture, file: ImageFile) -> None:
    """Record the file that a texture's pixels come from."""
    texture._file = file


UV_SETS = 2  # of a mesh: `uvs` and `uvs1`


@hints_keywords
@dataclass(frozen=True)
class PlacedTexture:
    """A texture in a material's slot, with its texture coordinates and their transform.

    A vertex's coordinates are scaled, then rotated, then translated, as in KHR_texture_transform:
    with the origin at the top left and v downwards, ``u' = sx * u * cos + sy * v * sin + tx`` and
    ``v' = -sx * u * sin + sy * v * cos + ty``.

    Parameters
    ----------
    texture : Texture
    uv_set : {0, 1}
        0 for `Mesh.uvs`, 1 for `Mesh.uvs1`.
    offset : (2,) float
        tx and ty, in sides of the image.
    rotation : float
        Radians, counter-clockwise about the origin.
    scale : (2,) float
        sx and sy: how often the image repeats within its original extent.

    Raises
    ------
    InvalidArgumentError
    """

    texture: Texture
    uv_set: int = 0
    offset: Sequence[float] = (0.0, 0.0)
    rotation: float = 0.0
    scale: Sequence[float] = (1.0, 1.0)

    def __init__(
        self,
        texture: Texture,
        *,
        uv_set: int = 0,
        offset: Sequence[float] = (0.0, 0.0),
        rotation: float = 0.0,
        scale: Sequence[float] = (1.0, 1.0),
    ) -> None:
        if not isinstance(texture, Texture):
            raise InvalidArgumentError(f"texture must be a Texture: {type(texture).__name__}")
        self.__dict__.update(
            texture=texture,
            uv_set=whole_number(uv_set, "uv_set", 0, UV_SETS - 1),
            offset=_two(offset, "offset"),
            rotation=finite_angle(rotation, "rotation"),
            scale=_two(scale, "scale"),
        )

    @property
    def is_moved(self) -> bool:
        """Whether texture coordinates are transformed."""
        return (self.offset, self.rotation, self.scale) != ((0.0, 0.0), 0.0, (1.0, 1.0))

    @property
    def matrix(self) -> NDArray[np.float64]:
        """The transform of coordinates whose origin is at the bottom left: (2, 3) float64."""
        (sx, sy), (tx, ty) = self.scale, self.offset
        c, s = cos(self.rotation), sin(self.rotation)
        return np.array([[sx * c, -(sy * s), sy * s + tx], [sx * s, sy * c, 1 - sy * c - ty]])


def _two(value: Sequence[float], what: str) -> tuple[float, float]:
    try:
        numbers = tuple(map(real, value))
    except TypeError:
        numbers = ()
    if len(numbers) != 2 or not all(map(math.isfinite, numbers)):
        raise InvalidArgumentError(f"{what} must be two finite numbers, not {shown(value)}")
    return numbers


def as_rgba(pixels: ArrayLike) -> NDArray[np.uint8]:
    """Return an image of one to four channels as (H, W, 4) uint8, C-contiguous and read-only.

    Alpha is 255 if the image has none. The result never shares writable memory.
    """
    if isinstance(pixels, (str, os.PathLike)):
        raise InvalidArgumentError(f"a Texture is made of pixels: use load_texture({pixels!r})")
    image = as_array(pixels, "pixels")
    if image.dtype != np.uint8:
        raise InvalidArgumentError(f"texture pixels must be uint8, got {image.dtype}")
    if image.ndim == 2:
        image = image[:, :, np.newaxis]
    if image.ndim != 3 or not 1 <= image.shape[2] <= 4:
        raise InvalidArgumentError(f"texture pixels must be (H, W[, 1..4]), got {image.shape}")
    height, width, channels = image.shape
    if not (1 <= height <= MAX_SIDE and 1 <= width <= MAX_SIDE):
        raise InvalidArgumentError(
            f"a texture's sides must be in 1..{MAX_SIDE}, got {width}x{height}"
        )
    if channels == 4 and image.flags.c_contiguous and is_frozen(image):
        return image
    rgba = np.empty((height, width, 4), np.uint8)
    rgba[:, :, :3] = image[:, :, :3] if channels >= 3 else image[:, :, :1]
    rgba[:, :, 3] = image[:, :, channels - 1] if channels in (2, 4) else 255
    return frozen(rgba)
