"""Exact shadows: the lights that have them, and the nodes that cast them.

In: an up-to-date draw list, its lights without shadows or with maps. Out: the native draw list
holds the casters, inside the picture or not. For each sample, the core tests whether a caster is
between it and the light (docs/exactness, section 17); data about casters is kept as long as their
version is unchanged.
"""

from __future__ import annotations

import itertools
from collections.abc import Sequence

import numpy as np

from ...model.scene.staged_data import NodeRows
from ...model.scene.staged_scene import AnyScene
from .._memo import Memo
from ..casters import placed_casters
from ..draw_list.lamps import lamp_slots
from ..options import RenderOptions, lights_faces
from .protocol import Pass, Picture, Tools
from .shadow_maps import size_of

_versions = itertools.count(1)


class ExactShadows(Pass):
    """Enables exact shadows for lights whose ``shadow`` is "exact".

    Raises InvalidArgumentError if there are more such lights than the core takes, or if their
    shadows exceed a frame's memory limit.
    """

    reads = ("scene",)
    writes = ("exact_shadows",)

    def __init__(self, tools: Tools) -> None:
        super().__init__(tools)
        self._moment, self._casters = Memo(), Memo()  # when casters were listed, and which
        self._version = 0

    def is_in(self, options: RenderOptions, wanted: set[str]) -> bool:
        return lights_faces(options, wanted)

    def draw(self, picture: Picture) -> None:
        draw_list, scene = self.tools.draw_list, picture.scene
        lights = [at for at in draw_list.lights.placed() if at[1].shadow == "exact"]
        for number, light, *_ in lights:
            draw_list.native.set_exact_shadow(number, size_of(light))
        if lights:
            spared = [self._spared(scene, number, place) for number, _, (_, place) in lights]
            self._list_casters(scene.data.arrays, spared)
            soft = sum(light.shadow_softness > 0.0 for _, light, _ in lights)
            self.tools.memory.add_exact(len(lights) - soft, soft, draw_list.native.hiding_faces())

    def _spared(
        self, scene: AnyScene, number: int, place: Sequence[float] | None
    ) -> tuple[int, ...]:
        """Return the slots that do not shadow a light."""
        if place is None:
            return ()
        return lamp_slots(scene.data, self.tools.draw_list.lights.slot_of(number), place)

    def _list_casters(self, arrays: NodeRows, spared: list[tuple[int, ...]]) -> None:
        """List the casters unless they are listed; their version grows when any of them changes.

        ``spared`` holds, for each light, the slots that do not shadow it.
        """
        draw_list = self.tools.draw_list
        if not self._moment.differs(arrays, arrays.updated, draw_list.renewals, spared):
            return
        if self._casters.differs(arrays, draw_list.renewals, spared, placed_casters(arrays)):
            self._version = next(_versions)
        bits = None
        if any(spared):
            bits = np.zeros(arrays.count, np.uint32)
            for number, slots in enumerate(spared):
                bits[list(slots)] |= np.uint32(1 << number)
        draw_list.native.place_hiding(arrays.rows, arrays.count, self._version, bits)
        self._casters.done()
        self._moment.done()
