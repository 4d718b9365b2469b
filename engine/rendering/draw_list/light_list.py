"""The lights of a frame: a scene's visible lights, at their current places.

Ambient lights become one polynomial (ambient_terms.py), direct lights a list.

In: an up-to-date `Scene`. Out: the lights of a `NativeDrawList`, renewed where they changed: Python
looks at every light that moved, but only at the versions of the others.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TypeAlias

import numpy as np

from ..._native.rasterizer import FALLOFFS, LIGHT_KINDS, LIGHT_TRAITS, NativeDrawList
from ..._native.scene_graph import SHOWN
from ...base.linalg.single import cross, normalize
from ...choices import ColorSpace
from ...model.materials.display_colors import shading_color
from ...model.scene.ambient_lights import AMBIENT_LIGHTS, AmbientLight
from ...model.scene.lights import AreaLight, DirectionalLight, DirectLight
from ...model.scene.staged_data import AnyData
from .ambient_terms import ambient_terms

#: Unit direction towards a directional light, and position of a light that has one.
Where: TypeAlias = tuple[Sequence[float] | None, Sequence[float] | None]
#: Colour times intensity of the light of a scene without lights, and the direction towards it.
Headlight: TypeAlias = tuple[Sequence[float], Sequence[float]]

_HEADLIGHT = DirectionalLight()
_NOT_KNOWN = (object(),)  # equal to nothing in a scene, not even to the absence of lights


class LightList:
    """The lights of one native draw list.

    Parameters
    ----------
    native : NativeDrawList
    color_space : {"srgb", "linear"}
        How 8-bit colours are decoded.
    """

    def __init__(self, native: NativeDrawList, color_space: ColorSpace) -> None:
        self._native = native
        self._color_space = color_space
        self._slots_of: tuple[object, ...] | None = None
        self._slots = np.empty(0, np.int32)
        self._lights: list[DirectLight] = []  # not their nodes, which would keep the scene alive
        self._around_slots = np.empty(0, np.int32)
        self._around: list[AmbientLight] = []  # also without nodes
        # By number, each visible light and its place; and all of them in order, once asked for.
        self._at: dict[int, tuple[DirectLight, Where]] = {}
        self._all_at: list[tuple[int, DirectLight, Where]] | None = None
        self.forget()

    def forget(self) -> None:
        """Force listing all lights anew at the next update."""
        self._listed: tuple[object, ...] | None = None
        self._shown = np.empty(0, bool)
        self._forget_places()
        self._changes: object = 0
        self._turned: Sequence[float] = ()  # the direction towards the headlight
        self._placed = np.empty(0, np.uint32)
        self._added: tuple[object, ...] = _NOT_KNOWN

    def update(self, data: AnyData, headlight: Headlight | None) -> None:
        """Update the native lights to a scene's; ``headlight`` is for scenes without lights."""
        state = data.lights_state()
        if self._slots_of != state:
            self._find_slots(data)
            self._slots_of = state
        self._add_around(data)
        if self._lights or self._around:
            headlight = None
        shines = None if headlight is None else headlight[0]
        listed = self._slots_of, [light.version for light in self._lights], shines
        same, self._listed = self._listed == listed, None  # in case anything below raises
        if self._lights:
            changes = data.arrays.updated
            if not same or self._changes != changes:
                self._renew(data, same)
            self._changes = changes
        elif not same:
            self._native.clear_lights()
            self._forget_places()
            if headlight is not None:
                self._add_native(headlight[0], _HEADLIGHT)
                self._turn_headlight(headlight)
        elif headlight is not None and headlight[1] is not self._turned:
            self._turn_headlight(headlight)
        self._listed = listed

    def _turn_headlight(self, headlight: Headlight) -> None:
        self._turned = headlight[1]
        self._native.turn_light(0, self._turned)

    def _renew(self, data: AnyData, same: bool) -> None:
        """List the visible lights if they have changed, and place those that moved."""
        columns = data.arrays.columns
        shown = columns["flags"][self._slots] & SHOWN != 0
        slots = self._slots[shown]
        placed = columns["world_version"][slots]
        if same and shown.tobytes() == self._shown.tobytes():
            moved = (placed != self._placed).nonzero()[0]
        else:
            moved = np.arange(len(slots))
            self._native.clear_lights()
            self._forget_places()
            for light in shown.nonzero()[0].tolist():
                self._add(self._lights[light])
        if len(moved):
            lights = shown.nonzero()[0][moved].tolist()
            poses = columns["world"][slots[moved]].tolist()
            for number, light, pose in zip(moved.tolist(), lights, poses, strict=True):
                self._place(number, self._lights[light], pose)
        self._shown, self._placed = shown, placed

    def _add_around(self, data: AnyData) -> None:
        """Sum the ambient lights, if any of them changed."""
        added: tuple[object, ...] = ()
        if self._around:
            columns = data.arrays.columns
            shown = (columns["flags"][self._around_slots] & SHOWN != 0).tolist()
            placed = columns["world_version"][self._around_slots].tolist()
            versions = [light.version for light in self._around]
            added = self._slots_of, shown, placed, versions
        if added == self._added:
            return
        self._added = _NOT_KNOWN  # in case anything below raises
        terms = None
        if added and any(shown):
            poses = columns["world"][self._around_slots].tolist()
            lights = zip(self._around, poses, shown, strict=True)
            seen = [(light, pose) for light, pose, shows in lights if shows]
            terms = ambient_terms(seen, self._color_space)
        self._native.set_ambient_light(terms)
        self._added = added

    def _find_slots(self, data: AnyData) -> None:
        """Find the lights, and their rows in the scene's arrays."""
        placed = data.placed_lights()
        around = [at for at in placed if isinstance(at[0], AMBIENT_LIGHTS)]
        others = [at for at in placed if not isinstance(at[0], AMBIENT_LIGHTS)]
        self._lights = [light for light, _ in others]
        self._slots = np.array([slot for _, slot in others], np.int32)
        self._around = [light for light, _ in around]
        self._around_slots = np.array([slot for _, slot in around], np.int32)

    def _add(self, light: DirectLight) -> None:
        shading = shading_color(light.color, self._color_space)
        light.check()
        self._add_native([component * light.intensity for component in shading], light)

    def _add_native(self, color: Sequence[float], light: DirectLight) -> None:
        """Add a light; parameters that its kind lacks get values without effect."""
        falloff = FALLOFFS[getattr(light, "falloff", "gltf")]
        cone = light.cone() if hasattr(light, "cone") else (0.0, 0.0)
        reach = getattr(light, "range", math.inf)
        kind = LIGHT_KINDS[light.kind]
        self._native.add_light(kind, color, range=reach, falloff=falloff, cone=cone)

    def placed(self) -> list[tuple[int, DirectLight, Where]]:
        """Return the visible direct lights: number, light, and direction and position.

        A directional light has a unit direction towards it, others a position; the other value is
        None.
        """
        if self._all_at is None:
            self._all_at = [(number, *at) for number, at in sorted(self._at.items())]
        return self._all_at

    def _forget_places(self) -> None:
        self._at, self._all_at = {}, None

    def slot_of(self, number: int) -> int:
        """Return the slot of a visible light, by its number."""
        return int(self._slots[self._shown][number])

    def _place(self, number: int, light: DirectLight, pose: list[float]) -> None:
        """Place a light by the first three rows of its world pose."""
        towards: Sequence[float] | None = None
        position: Sequence[float] | None = None
        traits = LIGHT_TRAITS[light.kind]
        if traits.has_position:
            position = pose[3::4]
            self._native.move_light(number, position)
            if traits.is_turned:
                towards = [pose[2], pose[6], pose[10]]
        elif isinstance(light, DirectionalLight):
            x, y, z = light.direction.tolist()
            towards = [-(pose[k] * x + pose[k + 1] * y + pose[k + 2] * z) for k in (0, 4, 8)]
        if isinstance(light, AreaLight):
            self._native.extend_light(number, *_extent(light, pose))
        if towards is not None:
            towards = normalize(towards)
            self._native.turn_light(number, towards)
        self._at[number], self._all_at = (light, (towards, position)), None


def _extent(light: AreaLight, pose: list[float]) -> tuple[list[tuple[float, ...]], float]:
    """Return the vectors of an area light's extent in the world, and its radius.

    The first lies along the pose's X, the second beside it, so that both are across its Z. That of
    a tube, which has no other, lies along X whatever Z is.
    """
    half, other_half, radius = light.halves()
    along = pose[0], pose[4], pose[8]
    z = normalize((pose[2], pose[6], pose[10]))
    y = normalize(cross(z, along))
    x = cross(y, z) if other_half else normalize(along)
    vectors = [tuple(half * part for part in x), tuple(other_half * part for part in y)]
    return vectors, radius
