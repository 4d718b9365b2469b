"""Mirrors: what flat mirrors of a scene reflect, each drawn as one more view of the scene.

In: an up-to-date draw list, and the picture's view. Out: for each mirror in view its plane, and the
radiance that it reflects at each sample of a part of the picture, by which the core shades faces
(docs/exactness, section 27). The views are drawn by the same passes, this one included.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..options import RenderOptions, as_mirrored, shows_light
from .mirror_backgrounds import MirrorBackgrounds
from .mirror_planes import MirrorFinder, slack_of
from .mirror_views import Reflection, part_of
from .protocol import MirrorPainter, Pass, Picture, Sight, Tools

_FINER = 2  # rows and columns in a pixel with multisampling, whose outputs have one sample


class Mirrors(Pass):
    """Draws what mirrors reflect, for pictures with lit surfaces."""

    reads = ("scene",)
    writes = ("mirrors",)

    def __init__(self, tools: Tools) -> None:
        super().__init__(tools)
        self._finder = MirrorFinder(tools.draw_list)
        self._backgrounds = MirrorBackgrounds(tools.is_srgb)
        self._painters: list[MirrorPainter] = []  # by the mirror's number in the picture

    def is_in(self, options: RenderOptions, wanted: set[str]) -> bool:
        return options.mode == "lit" and options.mirror_depth > 0 and shows_light(wanted)

    def draw(self, picture: Picture) -> None:
        if not self.tools.draw_list.has_mirrors:
            return
        axis, multiple = self.tools.samples
        scale = _FINER if multiple else 1
        size = picture.size[0] * axis, picture.size[1] * axis
        options = as_mirrored(picture.options, axis * scale)
        bounds = picture.scene.bounds
        slack = slack_of(bounds)
        beyond = self._backgrounds.beyond(picture.scene, picture.options)
        for plane in self._finder.find(picture, slack):
            part = part_of(plane, picture.view, size)
            if part is None:
                continue
            view = Reflection(picture.view, plane, part, size, scale, bounds)
            if not view.is_usable:
                continue
            sight = Sight(
                view,
                (part.width * scale, part.height * scale),
                picture.sight.rows * axis * scale,
                picture.sight.headlight,
                beyond=beyond,
            )
            radiance = self._painter(len(picture.mirrors)).radiance(picture.scene, options, sight)
            picture.mirrors.append(
                (
                    (*plane.normal.tolist(), plane.offset),
                    slack,
                    part.left,
                    part.top,
                    _resolved(radiance) if multiple else radiance,
                )
            )

    def _painter(self, number: int) -> MirrorPainter:
        if number == len(self._painters):
            self._painters.append(self.tools.another())
        return self._painters[number]


def _resolved(radiance: NDArray[np.float32]) -> NDArray[np.float32]:
    """Return the mean of the samples of each pixel."""
    upper, lower = radiance[0::2], radiance[1::2]
    total = upper[:, 0::2] + upper[:, 1::2]
    total += lower[:, 0::2] + lower[:, 1::2]
    total *= np.float32(0.25)
    return total
