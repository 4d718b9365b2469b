"""The picture of a plotter.

In: a plotter of PyVista, filled. Out: its pixels, as ``screenshot`` returns them.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from ._actors import parts_of
from ._layer import draw_layer
from ._lights import lamps_of
from ._overlay import Overlay
from ._props import _FLAT, props_of
from ._samples import Samples
from ._view import view_of


def picture(plotter: Any):
    plotter._on_first_render_request()
    width, height = plotter.window_size
    out = Samples((width, height), 4)
    for renderer in plotter.renderers:
        view = view_of(renderer, (width, height))
        parts = []
        for q in props_of(renderer):
            if q.IsA("vtkActor") and not q.IsA("vtkCubeAxesActor"):
                parts += parts_of(q, view)
        region = out.part(view.left, view.top, view.width, view.height)
        region.fill(np.array(renderer.GetBackground()), renderer.GetBackgroundAlpha())
        draw_layer(region, parts, lamps_of(renderer, view), view, bool(renderer.GetUseDepthPeeling()))
        ov = Overlay(renderer, view, region)
        for q in props_of(renderer):
            for n, d in _FLAT.items():
                if q.IsA(n): d(ov, q); break
    return out.pixels()[..., :3]
