"""The picture of a plotter.

In: a plotter of PyVista, filled. Out: its pixels, as ``screenshot`` returns them.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from ._actors import parts_of
from ._layer import draw_layer
from ._lights import lamps_of
from ._view import view_of


def picture(plotter: Any):
    plotter._on_first_render_request()
    width, height = plotter.window_size
    out = np.zeros((height, width, 4), np.float32)
    for renderer in plotter.renderers:
        view = view_of(renderer, (width, height))
        parts = []
        it = renderer.GetViewProps()
        it.InitTraversal()
        for _ in range(it.GetNumberOfItems()):
            q = it.GetNextProp()
            if q.GetVisibility() and q.IsA("vtkActor") and not q.IsA("vtkCubeAxesActor"):
                parts += parts_of(q, view)
        layer = draw_layer(parts, lamps_of(renderer, view), view, samples=4, peels=bool(renderer.GetUseDepthPeeling()), wants_depth=False)
        region = out[view.top : view.top + view.height, view.left : view.left + view.width]
        region[..., :3] = 255 * np.array(renderer.GetBackground())
        region[..., 3] = 255
        region *= 1 - layer.rgba[..., 3:] / 255
        region += layer.rgba
    return np.clip(out[..., :3] + 0.5, 0, 255).astype(np.uint8)
