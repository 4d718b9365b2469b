"""The lights of a frame: those of a scene that show, where they are now.

Those that shine from all around become one polynomial (ambient_terms.py), the others a list.

In: a `Scene` that is up to date. Out: the lights of a `NativeDrawList`, renewed where they changed:
Python looks at every light that moved, and at the others' versions only.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TypeAlias

import numpy as np

from ..._native.rasterizer import FALLOFFS, LIGHT_KINDS, LIGHT_TRAITS, NativeDrawList
from ..._native.scene_graph import SHOWN
from ...base.linalg.single import normalize
from ...choices import ColorSpace
from ...model.materials.display_colors import shading_color
from ...model.scene.ambient_lights import AMBIENT_LIGHTS, AmbientLight
from ...model.scene.lights import DirectionalLight, DirectLight
from ...model.scene.staged_data import AnyData
from .ambient_terms import ambient_terms

#: Unit direction towards a light that is turned, and the place of one that has a position.
Where: TypeAlias = tuple[Sequence[float] | None, Sequence[float] | None]
#: Colour, lux and direction towards the light of a scene that has none.
Headlight: TypeAlias = tuple[Sequence[float], Sequence[float], Sequence[float]]

_HEADLIGHT = DirectionalLight()
_NOT_KNOWN = (object(),)  # equal to nothing that a scene has, not even to no light at all


class LightList:
    """The lights of one native draw list.

    Parameters
    ----------
    native : NativeDrawList
    color_space : {"srgb", "linear"}
        How 8-bit colours are read.
    """

    def __init__(self, native: NativeDrawList, color_space: ColorSpace) -> None:
        self._native = native
        self._color_space = color_space
        self._slots_of: tuple[object, ...] | None = None
        self._slots = np.empty(0, np.int32)
        self._lights: list[DirectLight] = []  # not their nodes, which hold the scene
        self._around_slots = np.empty(0, np.int32)
        self._around: list[AmbientLight] = []  # likewise
        self.forget()

    def forget(self) -> None:
        """List all lights anew at the next update."""
        self._listed: tuple[object, ...] | None = None
        self._shown = np.empty(0, bool)
        # Of each light that shows what it is, and where.
        self._at: dict[int, tuple[DirectLight, Where]] = {}
        self._changes: object = 0
        self._placed = np.empty(0, np.uint32)
        self._added: tuple[object, ...] = _NOT_KNOWN

    def update(self, data: AnyData, headlight: Headlight | None) -> None:
        """Make the native lights those of a scene; ``headlight`` is for one that has none."""
        state = data.lights_state()
        if self._slots_of != state:
            self._find_slots(data)
            self._slots_of = state
        self._add_around(data)
        if self._lights or self._around:
            headlight = None
        shines = None if headlight is None else headlight[:2]
        listed = self._slots_of, [light.version for light in self._lights], shines
        same, self._listed = self._listed == listed, None  # for if anything below raises
        if self._lights:
            changes = data.arrays.updated
            if not same or self._changes != changes:
                self._renew(data, same)
            self._changes = changes
        elif not same:
            self._native.clear_lights()
            self._at = {}
            if headlight is not None:
                self._add_native(*headlight[:2], _HEADLIGHT)
                self._native.turn_light(0, headlight[2])
        elif headlight is not None:
            self._native.turn_light(0, headlight[2])
        self._listed = listed

    def _renew(self, data: AnyData, same: bool) -> None:
        """List lights that show, if they are not the same as before, and place those that moved."""
        columns = data.arrays.columns
        shown = columns["flags"][self._slots] & SHOWN != 0
        slots = self._slots[shown]
        placed = columns["world_version"][slots]
        if same and shown.tobytes() == self._shown.tobytes():
            moved = (placed != self._placed).nonzero()[0]
        else:
            moved = np.arange(len(slots))
            self._native.clear_lights()
            self._at = {}
            for light in shown.nonzero()[0].tolist():
                self._add(self._lights[light])
        if len(moved):
            lights = shown.nonzero()[0][moved].tolist()
            poses = columns["world"][slots[moved]].tolist()
            for number, light, pose in zip(moved.tolist(), lights, poses, strict=True):
                self._place(number, self._lights[light], pose)
        self._shown, self._placed = shown, placed

    def _add_around(self, data: AnyData) -> None:
        """Sum up the light from all around, where anything of it changed."""
        added: tuple[object, ...] = ()
        if self._around:
            columns = data.arrays.columns
            shown = (columns["flags"][self._around_slots] & SHOWN != 0).tolist()
            placed = columns["world_version"][self._around_slots].tolist()
            versions = [light.version for light in self._around]
            added = self._slots_of, shown, placed, versions
        if added == self._added:
            return
        self._added = _NOT_KNOWN  # for if anything below raises
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
        color = [component * light.intensity for component in shading]
        lux = color if light.unit == "photometric" else [math.pi * component for component in color]
        light.check()
        self._add_native(color, lux, light)

    def _add_native(self, color: Sequence[float], lux: Sequence[float], light: DirectLight) -> None:
        """Add a light; what its kind does not have is as with those that reach everywhere."""
        falloff = FALLOFFS[getattr(light, "falloff", "gltf")]
        cone = light.cone() if hasattr(light, "cone") else (0.0, 0.0)
        reach = getattr(light, "range", math.inf)
        kind = LIGHT_KINDS[light.kind]
        self._native.add_light(kind, color, lux, range=reach, falloff=falloff, cone=cone)

    def placed(self) -> list[tuple[int, DirectLight, Where]]:
        """Return the lights that show: number, light, and the pair of where it shines from.

        That is the unit direction towards a light that is turned, and the place of one that has a
        position; else None.
        """
        return [(number, *at) for number, at in sorted(self._at.items())]

    def slot_of(self, number: int) -> int:
        """Return the slot of a light that shows, by its number."""
        return int(self._slots[self._shown][number])

    def _place(self, number: int, light: DirectLight, pose: list[float]) -> None:
        """Put a light where the first three rows of its world pose say."""
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
        if towards is not None:
            towards = normalize(towards)
            self._native.turn_light(number, towards)
        self._at[number] = light, (towards, position)
