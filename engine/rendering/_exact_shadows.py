"""Exact shadows: which lights have them, and what may hide these lights.

In: a scene whose draw list is up to date, its lights without shadows or with maps. Out: the native
draw list holds what casts shadows, in the picture or not. The core finds, sample by sample, whether
any of it is between the sample and the light (docs/exactness, section 17); what it found out
about the casters it keeps for as long as they have the same version.
"""

from __future__ import annotations

import itertools

import numpy as np

from ..scene.node_arrays import NodeArrays
from ..scene.scene import Scene
from ._draw_list import DrawList
from ._frame_memory import FrameMemory
from ._lamps import lamp_slots
from .casters import placed_casters

_versions = itertools.count(1)


class ExactShadows:
    """What may hide the lights of one renderer's scene.

    Parameters
    ----------
    draw_list : DrawList
    """

    def __init__(self, draw_list: DrawList) -> None:
        self._draw_list = draw_list
        self._moment: tuple | None = None  # of the scene, when its casters were listed
        self._casters: tuple | None = None
        self._version = 0

    def update(self, scene: Scene, memory: FrameMemory) -> None:
        """Let lights whose ``shadow`` is "exact" have it, for a frame with lit surfaces.

        Raises
        ------
        InvalidArgumentError
            There are more such lights than the core takes, or their shadows take more memory than a
            frame may.
        """
        native = self._draw_list.native
        lights = [at for at in self._draw_list.lights.placed() if at[1].shadow == "exact"]
        for number, *_ in lights:
            native.set_exact_shadow(number)
        if lights:
            spared = [self._spared(scene, number, place) for number, _, (_, place) in lights]
            self._list_casters(scene._arrays, spared)
            memory.add_exact(len(lights), native.hiding_faces())

    def _spared(self, scene: Scene, number: int, place) -> tuple[int, ...]:
        """The slots of what does not hide a light."""
        if place is None:
            return ()
        return lamp_slots(scene, self._draw_list.lights.slot_of(number), place)

    def _list_casters(self, arrays: NodeArrays, spared: list[tuple[int, ...]]) -> None:
        """List the casters, unless they are listed; a version is theirs until one is another.

        ``spared`` are, for each light, the slots of what does not hide it.
        """
        renewals = self._draw_list.renewals
        moment = arrays, arrays.updated, renewals, spared
        if moment == self._moment:
            return
        casters = arrays, renewals, spared, *placed_casters(arrays)
        if casters != self._casters:
            self._version = next(_versions)
        self._moment = self._casters = None  # for if anything below raises
        bits = None
        if any(spared):
            bits = np.zeros(arrays.count, np.uint32)
            for number, slots in enumerate(spared):
                bits[list(slots)] |= np.uint32(1 << number)
        self._draw_list.native.place_hiding(arrays.count, arrays.columns, self._version, bits)
        self._moment, self._casters = moment, casters
