"""Mirrors: what flat mirrors of a scene reflect, each drawn as one more view of the scene.

In: an up-to-date draw list, and the picture's view. Out: for each mirror in view its plane, and the
radiance that it reflects at each sample of a part of the picture, by which the core shades faces
(docs/exactness, section 27). The views are drawn by the same passes, this one included.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ...base.image_size import MAX_SIZE
from ..options import RenderOptions, as_mirrored, lights_faces
from .mirror_backgrounds import MirrorBackgrounds
from .mirror_planes import MirrorFinder, MirrorPlane
from .mirror_views import Reflection, part_of
from .protocol import MirrorPainter, Pass, Picture, Shot, Tools

_FINER = 2  # rows and columns in a pixel with multisampling, whose outputs have one sample


class Mirrors(Pass):
    """Draws what mirrors reflect, for pictures with lit surfaces."""

    reads = ("scene",)
    writes = ("mirrors",)

    def __init__(self, tools: Tools) -> None:
        super().__init__(tools)
        self._finder = MirrorFinder(tools.draw_list)
        self._backgrounds = MirrorBackgrounds(tools.is_srgb)
        # By the mirror's number in the picture: what draws it, and its view with its inputs.
        self._painters: list[MirrorPainter] = []
        self._views: dict[int, tuple[tuple[object, ...], Reflection]] = {}

    def is_in(self, options: RenderOptions, wanted: set[str]) -> bool:
        return options.mirror_depth > 0 and lights_faces(options, wanted)

    def draw(self, picture: Picture) -> None:
        if not self.tools.draw_list.has_mirrors:
            return
        scene, bounds = picture.scene, picture.scene.bounds
        for plane in self._finder.find(picture):
            view = self._view(picture, plane, bounds)
            if view is None:
                continue
            fineness = self.tools.samples[0] * view.scale
            options = as_mirrored(picture.options, fineness)
            shot = self._shot(picture, view, fineness)
            painter = self._painter(len(picture.mirrors))
            radiance = painter.radiance(scene, options, shot)
            self.tools.memory.add_mirror(painter.memory)
            numbers = (*plane.normal.tolist(), plane.offset)
            place = view.part.left, view.part.top, view.scale
            picture.mirrors.append((numbers, plane.slack, *place, radiance))

    def _view(
        self, picture: Picture, plane: MirrorPlane, bounds: NDArray[np.float64]
    ) -> Reflection | None:
        """Return the view of what a mirror shows; None if it shows nothing."""
        axis, multiple = self.tools.samples
        samples = picture.size[0] * axis, picture.size[1] * axis
        part = part_of(plane, picture.view, samples)
        if part is None:
            return None
        if max(part.width, part.height) > MAX_SIZE:
            self._finder.warn(
                f"a mirror that shows on {part.width}x{part.height} samples looks as without "
                f"Material.mirror: they may be {MAX_SIZE} a side; fewer pixels or samples help"
            )
            return None
        is_small = _FINER * max(part.width, part.height) <= MAX_SIZE
        scale = _FINER if multiple and is_small else 1
        numbers = plane.normal.tobytes(), plane.offset, plane.slack
        made_of = picture.view, *numbers, part, scale, bounds.tobytes()
        known = self._views.get(len(picture.mirrors))
        if known is None or known[0] != made_of:
            view = Reflection(picture.view, plane, part, samples, scale, bounds)
            known = self._views[len(picture.mirrors)] = made_of, view
        return known[1] if known[1].is_usable else None

    def _shot(self, picture: Picture, view: Reflection, fineness: int) -> Shot:
        beyond = self._backgrounds.beyond(picture.scene, picture.options)
        rows, headlight = picture.shot.rows * fineness, picture.shot.headlight
        return Shot(view, view.size, rows, headlight, beyond=beyond)

    def _painter(self, number: int) -> MirrorPainter:
        if number == len(self._painters):
            self._painters.append(self.tools.another())
        return self._painters[number]
