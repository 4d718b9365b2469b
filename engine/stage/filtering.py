"""The filtering of textures that the command line or the viewer asks for."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

from ..model.materials.material import Material, textures_of
from ..model.materials.textures import Texture
from ..model.scene.scene import Scene
from .visibility import DRAWABLE, mesh_of

#: What models get whose files say nothing: how these were chosen is in docs/performance.md.
USUAL_ANISOTROPY = 8
USUAL_LOD_BIAS = -0.25


@dataclass(frozen=True)
class Filtering:
    """The filtering that all textures of a scene get.

    Attributes
    ----------
    anisotropy : int or None
        Of every texture; None leaves those that have one of their own.
    lod_bias : float or None
        Likewise.
    is_usual : bool
        Whether what is None becomes the usual value where a texture has none of its own.
    """

    anisotropy: int | None = None
    lod_bias: float | None = None
    is_usual: bool = False

    def put(self, scene: Scene) -> None:
        """Give them to a scene's textures."""
        things = [node.object for node in scene.nodes if isinstance(node.object, DRAWABLE)]
        materials = {id(m): m for thing in things for m in mesh_of(thing).materials}
        for texture in _textures(materials.values()):
            anisotropy, bias = self.anisotropy, self.lod_bias
            if self.is_usual and (texture.anisotropy, texture.lod_bias) == (1, 0.0):
                anisotropy = USUAL_ANISOTROPY if anisotropy is None else anisotropy
                bias = USUAL_LOD_BIAS if bias is None else bias
            if anisotropy is not None:
                texture.anisotropy = anisotropy
            if bias is not None:
                texture.lod_bias = bias


def _textures(materials: Iterable[Material]) -> list[Texture]:
    """The textures of materials, each once."""
    found: dict[int, Texture] = {}
    for material in materials:
        found.update((id(texture), texture) for texture in textures_of(material).values())
    return list(found.values())
