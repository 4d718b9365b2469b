"""How a look finishes materials: what models without physically based materials are made of.

In: a material. Out: the material that is drawn instead; the model keeps its own. Materials of the
models of Lambert and Phong become dielectrics, like paint or plastic. Otherwise they would reflect
nothing, while Khronos's neutral tone mapping takes off what a white dielectric reflects in a white
room: dark colours would turn black, and the same model would look another way from a file of glTF.
Mirrors stay as they are: a dielectric would hardly mirror.
"""

from __future__ import annotations

from dataclasses import dataclass

from ..model.environments.cove import SHEEN
from ..model.materials.colors import linear_color
from ..model.materials.linear_colors import LinearColor
from ..model.materials.material import Material, copy_of, states_nothing
from ..model.materials.phong import roughness_of
from ..model.scene.staged_scene import StagedScene
from .look import Look

#: A warm mid-grey that shows form on light ground, for what states no material.
CLAY = (172, 169, 164)
#: The roughness of materials that state no highlight, and of what states no material.
ROUGHNESS = 0.6


@dataclass(frozen=True)
class StudioFinish:
    """Returns the material that is drawn for one of a model: a `Finish` of scenes.

    Attributes
    ----------
    reflects : bool
        Whether materials that are not physically based become dielectrics.
    sheen : float
        What dielectrics reflect where there is no environment to reflect: linear light.
    colors : bool
        Whether what states no material is grey instead of white.
    """

    reflects: bool
    sheen: float
    colors: bool

    def __call__(self, material: Material, tinted: bool) -> Material:
        if material.unlit or material.mirror:
            return material
        is_clay = self.colors and not tinted and states_nothing(material)
        is_changed = is_clay or (self.reflects and not material.is_physical)
        if not is_changed:
            return material
        made = copy_of(material)
        changes = vars(made)
        if is_clay:
            changes["color"] = CLAY
        if self.reflects or material.is_physical:
            roughness = None if is_clay else roughness_of(material)
            changes["metallic"] = 0.0
            changes["roughness"] = ROUGHNESS if roughness is None else roughness
        if self.reflects and self.sheen:
            changes["emissive"] = _lighter(material, self.sheen)
        return made


def _lighter(material: Material, light: float) -> LinearColor:
    """Return what a material emits, and some white light more."""
    strength = material.emissive_strength if material.is_physical else 1.0
    own = linear_color(material.emissive) * strength
    return LinearColor(float(component) + light for component in own)


def finish_for(look: Look, staged: StagedScene, shows_numbers: bool) -> StudioFinish | None:
    """Return how a look finishes the materials of a model; None if it leaves them as they are.

    Parameters
    ----------
    look : Look
    staged : StagedScene
        Its environment is the one that surfaces reflect.
    shows_numbers : bool
        Whether colours stand for numbers, so that no reflection may change them.
    """
    reflects, colors = look.environment and not shows_numbers, look.lights is not None
    sheen = SHEEN if staged.environment is None else 0.0
    return StudioFinish(reflects, sheen, colors) if reflects or colors else None
