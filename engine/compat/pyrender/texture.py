"""Textures: images with samplers."""

from __future__ import annotations

import numpy as np

from ._held import Named, held
from .sampler import Sampler
from .utils import format_texture_source

_TEXTURE_2D, _UNSIGNED_BYTE = 3553, 5121  # numbers of OpenGL


class Texture(Named):
    """An image and its sampler.

    Parameters
    ----------
    name : str, optional
    sampler : Sampler, optional
    source : (H, W, C) array or image of Pillow, optional
        Floats are of 0 to 1.
    source_channels : {"D", "R", "RG", "GB", "RGB", "RGBA"}
        Which channels of the source are kept.
    width, height : int, optional
        Of textures without a source.
    tex_type, data_format : int
        Numbers of OpenGL, kept as they are.
    """

    def __init__(
        self,
        name=None,
        sampler=None,
        source=None,
        source_channels=None,
        width=None,
        height=None,
        tex_type=_TEXTURE_2D,
        data_format=_UNSIGNED_BYTE,
    ):
        self.source_channels = source_channels
        self.name = name
        self.sampler = sampler
        self.source = source
        self.width, self.height = width, height
        self.tex_type, self.data_format = tex_type, data_format

    sampler = held(
        "sampler", lambda value: Sampler() if value is None else value, "How it is read."
    )

    @property
    def source(self) -> np.ndarray | None:
        """The image as uint8, top row first."""
        return self._source

    @source.setter
    def source(self, value) -> None:
        self._source = format_texture_source(value, self.source_channels)
        self._native = None
        self._alpha: bool | None = None

    def _has_alpha(self) -> bool:
        """Return whether any texel is transparent."""
        if self._alpha is None:
            self._alpha = bool((self._source[:, :, 3] < 255).any())
        return self._alpha

    def is_transparent(self, cutoff: float = 1.0) -> bool:
        """Return False: pyrender's node sorting ignores the transparency of textures."""
        return False

    def delete(self) -> None:
        """Free the cached drawing data of the texture."""
        self._native = None

    def __getstate__(self) -> dict:
        return {**self.__dict__, "_native": None}


__all__ = ["Texture"]
