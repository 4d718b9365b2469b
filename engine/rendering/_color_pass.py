"""The colour pass: the frame's outputs, drawn by the core in one call without the GIL."""

from __future__ import annotations

from ._pass import Pass, Picture
from .frame import OUTPUTS


class ColorPass(Pass):
    """Draws the outputs of pictures."""

    reads = ("shadow_maps", "exact_shadows", "ambient_visibility")
    writes = tuple(OUTPUTS)

    def draw(self, picture: Picture) -> None:
        view, options = picture.view, picture.frame_options
        picture.drawn = self.tools.native.render(
            self.tools.draw_list.native,
            picture.targets,
            options.native,
            *picture.size,
            *self.tools.samples,
            view.clip_from_world,
            view.view_from_world,
            view.eye,
            id(view.camera),
            *picture.depth_range,
            picture.frozen_clip_from_world,
            view.rays if options.has_backdrop else None,
            picture.arrays.get("ambient_visibility"),
        )
        picture.drawn.shadow_maps, picture.drawn.shadow_maps_drawn = picture.shadow_maps
