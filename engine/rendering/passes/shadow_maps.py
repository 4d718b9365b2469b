"""Shadow maps of a scene's lights, redrawn when something they show changes.

In: an up-to-date draw list, and the camera's view. Out: the native draw list's lights have their
maps. A map is kept until its light, the casters it shows or, for directional lights, the part of
the world it covers changes.
"""

from __future__ import annotations

from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from ..._native.rasterizer import (
    CULLS,
    LIGHT_TRAITS,
    find_shadow_ranges,
    find_soft_ranges,
    shadow_ranges_side,
)
from ...base.linalg import cos, sin
from ...model.scene.lights import DirectionalLight, DirectLight
from ...model.scene.shadow_casting import widest_radius
from ...model.scene.staged_data import NodeRows
from .._memo import Memo
from ..casters import placed_casters
from ..draw_list.lamps import lamp_slots
from ..draw_list.light_list import Where
from ..options import RenderOptions, lights_faces
from .protocol import Pass, Picture, Tools
from .shadow_region import Lookups, lookups_of, region_of
from .shadow_views import VIEWS, MapView, ShadowViews, Sight, sight_of

#: The scene's nodes, their changes, the list's renewals, the culled side, and the spared slots.
Moment: TypeAlias = tuple[NodeRows, object, int, int, tuple[int, ...]]


class _LightMaps:
    """The maps of one light: depths, ranges, and the state each was drawn from."""

    def __init__(self, count: int, size: int) -> None:
        self.depths = np.empty((count, size, size), np.float32)
        self.ranges = np.empty((0, 0, 0), np.uint32)
        self.drawn = [_Drawn() for _ in range(count)]

    def fits(self, count: int, size: int) -> bool:
        return self.depths.shape == (count, size, size)

    def find_ranges(self, taps: int, step: int, widest: float = 0.0) -> NDArray[np.uint32] | None:
        """Return the ranges of all maps; None if one is new.

        ``widest`` is the greatest radius of a soft light's lookups; 0 if its shadows are hard.
        Ranges are computed at the second lookup of a map, because computing them takes about as
        long as they save in a frame.
        """
        compared = (taps, step, widest) if widest > 0.0 else (taps, step)
        side, words = shadow_ranges_side(self.depths.shape[1]), len(compared) - 1
        shape = words * len(self.depths), side, side
        if self.ranges.shape != shape:
            self.ranges = np.empty(shape, np.uint32)
        for k, (depths, drawn) in enumerate(zip(self.depths, self.drawn, strict=True)):
            if not drawn.is_new and drawn.compared != compared:
                if widest > 0.0:
                    find_soft_ranges(depths, taps, step, widest, self.ranges[2 * k : 2 * k + 2])
                else:
                    find_shadow_ranges(depths, taps, step, self.ranges[k])
                drawn.compared = compared
        are_found = all(drawn.compared == compared for drawn in self.drawn)
        for drawn in self.drawn:
            drawn.is_new = False
        return self.ranges if are_found else None

    def find_nearest(self) -> float:
        """Return the least depth of all maps, which is where blockers of soft lights begin."""
        for depths, drawn in zip(self.depths, self.drawn, strict=True):
            if drawn.nearest is None:
                drawn.nearest = float(depths.min())
        return min(drawn.nearest for drawn in self.drawn if drawn.nearest is not None)


def size_of(light: DirectLight) -> float:
    """Return the size of a light as R196 and R225 take it; 0 if its shadows are hard."""
    if not isinstance(light, DirectionalLight) or not light.shadow_softness:
        return light.shadow_softness
    half = 0.5 * light.shadow_softness
    return float(sin(half) / cos(half))


#: A map with fewer faces is drawn faster than its region is found.
_MANY_FACES = 1 << 16


class _Drawn:
    """The state that a map was drawn from: the scene's moment, then the nodes themselves.

    If its ranges are known, also the comparisons used to look it up.
    """

    def __init__(self) -> None:
        self.moment, self.casters = Memo(), Memo()
        self.is_new = True
        self.compared: tuple[float, ...] | None = None
        self.nearest: float | None = None  # the least depth, if it was asked for
        self.changes = 0  # pictures in a row before which its casters changed
        self.faces = 0  # that it shows as a whole, unless hidden ones are left out
        self.lookups: Lookups | None = None  # the only ones that it serves; None: any

    def serves(self, lookups: Lookups | None) -> bool:
        return self.lookups is None or self.lookups == lookups

    def choose_region(self, seen: MapView, lookups: Lookups | None) -> NDArray[np.float64] | None:
        """Return the region to draw, for a map that changes anyway before it is looked up again.

        None: the whole map.
        """
        self.is_new, self.compared, self.nearest, self.lookups = True, None, None, None
        self.casters.forget()
        self.moment.forget()
        if lookups is None or self.changes < 2 or self.faces < _MANY_FACES:
            return None
        region = region_of(lookups, seen.clip_from_world)
        if region is not None:
            self.lookups = lookups
        return region


class ShadowMaps(Pass):
    """Draws the shadow maps of lights, for pictures with lit surfaces.

    Raises InvalidArgumentError if a light's shadow_radius is too wide for its maps, or if the maps
    exceed a frame's memory limit.
    """

    reads = ("scene",)
    writes = ("shadow_maps",)

    def __init__(self, tools: Tools) -> None:
        super().__init__(tools)
        self._kept: dict[int, _LightMaps] = {}
        # By light number: the views of its maps, and the inputs they were computed from.
        self._found: dict[int, tuple[tuple[object, ...], ShadowViews | None]] = {}
        # By number of cascades: the camera's view in slices, and the inputs it was cut from.
        self._cut: dict[int, tuple[tuple[object, ...], Sight]] = {}

    def is_in(self, options: RenderOptions, wanted: set[str]) -> bool:
        return lights_faces(options, wanted)

    def draw(self, picture: Picture) -> None:
        scene, draw_list = picture.scene, self.tools.draw_list
        self._drawn = self._count = 0
        draw_list.native.clear_shadows()
        lights = [entry for entry in draw_list.lights.placed() if entry[1].shadow == "map"]
        if not lights:
            self._kept.clear()
            self._found.clear()
            return
        for known in (self._kept, self._found):
            for number in known.keys() - {number for number, _, _ in lights}:
                del known[number]
        cull = CULLS[picture.shadow_cull]
        arrays = scene.data.arrays
        moment = arrays, arrays.updated, draw_list.renewals, cull
        bounds = scene.data.shadow_bounds()
        seen = [
            (number, light, pose, views)
            for number, light, pose in lights
            if (views := self._views_of(number, light, pose, bounds, picture)) is not None
        ]
        self.tools.memory.add_maps(
            (type(light).__name__, len(views.maps), views.size) for _, light, _, views in seen
        )
        for number, light, (_, place), views in seen:
            slot = draw_list.lights.slot_of(number)
            spared = () if place is None else lamp_slots(scene.data, slot, place)
            lookups = lookups_of(light, views, picture.view, bounds)
            self._update_light(number, light, views, (*moment, spared), lookups)
        picture.shadow_maps = self._count, self._drawn

    def _views_of(
        self,
        number: int,
        light: DirectLight,
        pose: Where,
        bounds: NDArray[np.float64],
        picture: Picture,
    ) -> ShadowViews | None:
        """Return the views of a light's maps; reused if no input changed."""
        sight: Sight | None = None
        seen_by: tuple[object, ...] = ()
        if isinstance(light, DirectionalLight):
            sight = self._sight_of(light.shadow_cascades, bounds, picture)
            seen_by = picture.view, *(one.end for one in sight.slices)
        found_from = light, light.version, pose, bounds.tobytes(), seen_by
        known = self._found.get(number)
        if known is None or known[0] != found_from:
            light.check()
            layout = LIGHT_TRAITS[light.kind].maps
            known = self._found[number] = found_from, VIEWS[layout](light, pose, bounds, sight)
        return known[1]

    def _sight_of(self, cascades: int, bounds: NDArray[np.float64], picture: Picture) -> Sight:
        """Return the slices of the camera's view in which something is."""
        view = picture.view
        cut_from = view, bounds.tobytes()
        known = self._cut.get(cascades)
        if known is None or known[0] != cut_from:
            known = self._cut[cascades] = cut_from, sight_of(view, bounds, cascades)
        arrays = picture.scene.data.arrays
        boxes = arrays.columns["bounds"][: arrays.count]
        low, high = boxes[:, :3], boxes[:, 3:6]
        shown = [
            one
            for one in known[1].slices
            if ((low <= one.box[1]) & (high >= one.box[0])).all(axis=1).any()
        ]
        return known[1]._replace(slices=shown)

    def _update_light(
        self,
        number: int,
        light: DirectLight,
        views: ShadowViews,
        moment: Moment,
        lookups: list[Lookups | None],
    ) -> None:
        count, size = len(views.maps), views.size
        kept = self._kept.get(number)
        if kept is None or not kept.fits(count, size):
            kept = self._kept[number] = _LightMaps(count, size)
        taps, step = light.shadow_taps, round(256 * light.shadow_radius)
        soft, widest = size_of(light), widest_radius(light)
        for k, (seen, served) in enumerate(zip(views.maps, lookups, strict=True)):
            self._update_map(kept, k, seen, moment, served)
        self._count += count
        self.tools.draw_list.native.set_shadow(
            number,
            kept.depths,
            views.places,
            taps=taps,
            step=step,
            ranges=kept.find_ranges(taps, step, widest if soft > 0.0 else 0.0),
            margin=views.margin,
            bias=2.0 * light.shadow_bias,  # depths range from -1 to 1
            normal_bias=light.shadow_normal_bias,
            axes=views.axes,
            depth=views.depth,
            soft=soft,
            widest=widest,
            nearest=kept.find_nearest() if soft > 0.0 else 0.0,
        )

    def _update_map(
        self,
        kept: _LightMaps,
        number: int,
        seen: MapView,
        moment: Moment,
        lookups: Lookups | None,
    ) -> None:
        """Draw a map, unless it would show the same again.

        ``lookups``: all that look it up, where its region may be drawn alone.
        """
        drawn, clip = kept.drawn[number], seen.clip_from_world.tobytes()
        if not drawn.moment.differs(clip, moment) and drawn.serves(lookups):
            drawn.changes = 0
            return
        arrays, _, renewals, cull, spared = moment
        selection = np.empty((arrays.count + 63) // 64, np.uint64)
        arrays.select(seen.clip_from_world, 1.0, False, selection)
        for slot in spared:
            selection[slot >> 6] &= ~np.uint64(1 << (slot & 63))
        casters = placed_casters(arrays, selection)
        has_changed = drawn.casters.differs(clip, arrays, renewals, cull, casters)
        drawn.changes = drawn.changes + 1 if has_changed else 0
        if has_changed or not drawn.serves(lookups):
            region = drawn.choose_region(seen, lookups)
            native = self.tools.draw_list.native
            native.place_casters(arrays.rows, arrays.count, selection, seen.clip_from_world)
            faces = self.tools.native.draw_shadow_map(
                native, kept.depths[number], *seen, cull, id(drawn), region
            )
            if region is None:
                drawn.faces = faces
            self._drawn += 1
            drawn.casters.done()
        drawn.moment.done()
