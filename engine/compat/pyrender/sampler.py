"""Samplers: filtering and wrapping of textures."""

from ._held import Named
from .constants import GLTF


class Sampler(Named):
    """Filter and wrap modes of a texture.

    Parameters
    ----------
    name : str, optional
    magFilter, minFilter : int, optional
        Numbers of `GLTF`; by default LINEAR and LINEAR_MIPMAP_LINEAR.
    wrapS, wrapT : int
        REPEAT, MIRRORED_REPEAT or CLAMP_TO_EDGE.
    """

    def __init__(
        self, name=None, magFilter=None, minFilter=None, wrapS=GLTF.REPEAT, wrapT=GLTF.REPEAT
    ):
        self.name = name
        self.magFilter = magFilter
        self.minFilter = minFilter
        self.wrapS = wrapS
        self.wrapT = wrapT


__all__ = ["Sampler"]
