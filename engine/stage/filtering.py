"""Texture filtering as chosen on the command line or in the viewer."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

from ..model.materials.material import Material, textures_of
from ..model.materials.textures import Texture
from ..model.scene.scene import Scene
from .visibility import DRAWABLE, mesh_of

#: The default for models whose files do not specify it; docs/performance.md explains the choice.
USUAL_ANISOTROPY = 8
USUAL_LOD_BIAS = -0.25


@dataclass(frozen=True)
class Filtering:
    """Filtering settings for all textures of a scene.

    Attributes
    ----------
    anisotropy : int or None
        Anisotropy of every texture; None keeps each texture's own.
    lod_bias : float or None
        As for ``anisotropy``.
    is_usual : bool
        Whether None becomes the default value for textures that specify none.
    """

    anisotropy: int | None = None
    lod_bias: float | None = None
    is_usual: bool = False

    def put(self, scene: Scene) -> None:
        """Apply the settings to a scene's textures."""
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
    """Return the textures of materials, each once."""
    found: dict[int, Texture] = {}
    for material in materials:
        found.update((id(texture), texture) for texture in textures_of(material).values())
    return list(found.values())
