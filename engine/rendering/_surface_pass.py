"""What shows, drawn before the picture: depths, positions, normals and IDs that other passes read.

The renderer's own core draws these outputs at the middle of each pixel, with its backend and
threads, so that the scalar reference stays apart from the kernels.
"""

from __future__ import annotations

from ._pass import Pass, Picture
from .frame import OUTPUTS

#: Before the names of outputs: those that are drawn here.
SURFACE = "surface_"
_ONE_SAMPLE = 1, 0


class SurfacePass(Pass):
    """Draws outputs of the surfaces that a picture keeps: the nearest that aren't blended (R16).

    Pictures in mode "lit" have the normals that these need.
    """

    writes = tuple(SURFACE + name for name in OUTPUTS if name != "color")

    def draw(self, picture: Picture) -> None:
        view = picture.view
        self.tools.native.render(
            self.tools.draw_list.native,
            {
                name.removeprefix(SURFACE): array
                for name, array in picture.arrays.items()
                if name.startswith(SURFACE)
            },
            picture.frame_options.surfaces,
            *picture.size,
            *_ONE_SAMPLE,
            view.clip_from_world,
            view.view_from_world,
            view.eye,
            id(view.camera),
            0.0,
            1.0,
            picture.frozen_clip_from_world,
        )
