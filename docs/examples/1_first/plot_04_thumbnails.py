"""
Thumbnails of models
====================

This draws a small picture of each model of a folder, all with one renderer.

The background is transparent, so that thumbnails suit any page. The last lines lay them side by
side on a coloured page.
"""

from importlib.resources import files

import numpy as np

import engine3d as e3d

folder = files("engine3d.data") / "models"
look = e3d.Look.studio(background=None, ground=False)
models = [path for path in folder.iterdir() if path.name.endswith((".obj", ".asc"))]
thumbnails = [e3d.render(path, size=(96, 96), look=look) for path in sorted(models, key=str)]

# %%
# ``thumbnails[0].save("globe.webp")`` writes one. Alpha says how much of a pixel is covered.

pixels = np.hstack([frame.color for frame in thumbnails]).astype(float)
alpha = pixels[..., 3:] / 255
page = np.full(pixels.shape, (70, 110, 140, 255))
strip = e3d.Canvas((alpha * pixels + (1 - alpha) * page).round().astype(np.uint8))
