"""How pictures read textures: as the user chose, as the texture says, or as looks do."""

from __future__ import annotations

from dataclasses import dataclass, replace

from ..model.materials.textures import Texture

#: How looks read textures that do not specify it; docs/performance.md explains the choice.
USUAL_ANISOTROPY = 8
USUAL_LOD_BIAS = -0.25
_SAYS_NOTHING = (1, 0.0)  # the anisotropy and bias of a new texture


@dataclass(frozen=True)
class Filtering:
    """Filtering settings for all textures of a picture; the textures themselves stay unchanged.

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

    def without_usual(self) -> Filtering:
        """Return the settings that read textures as they say where None is chosen."""
        return replace(self, is_usual=False)

    def __call__(self, texture: Texture) -> tuple[int, float]:
        """Return the anisotropy and the bias with which a texture is read."""
        anisotropy, bias = texture.anisotropy, texture.lod_bias
        if self.is_usual and (anisotropy, bias) == _SAYS_NOTHING:
            anisotropy, bias = USUAL_ANISOTROPY, USUAL_LOD_BIAS
        return (
            anisotropy if self.anisotropy is None else self.anisotropy,
            bias if self.lod_bias is None else self.lod_bias,
        )
