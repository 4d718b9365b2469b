"""
On a background of one's own
============================

This draws a model on a transparent background, and lays it over a picture.

With the background None, alpha says how much of a pixel is covered. The colour of an edge is that
of the model alone, so ``alpha * colour + (1 - alpha) * behind`` is right.
"""

from importlib.resources import files

import numpy as np
from PIL import Image

import engine3d as e3d

look = e3d.Look.studio(background=None)
island = files("engine3d.data") / "models" / "island.obj"
frame = e3d.render(island, size=(400, 300), look=look)

rows, columns = np.indices((300, 400))
stripes = np.where(((rows + columns) // 25 % 2)[..., np.newaxis], (250, 200, 80), (240, 130, 60))
alpha = frame.color[..., 3:] / 255
mixed = alpha * frame.color[..., :3] + (1 - alpha) * stripes
picture = Image.fromarray(np.rint(mixed).astype(np.uint8))
