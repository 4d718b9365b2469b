"""
A model in one line
===================

This draws a file of any format that engine3d reads, in the light of a studio.

``engine3d render teapot.obj`` writes the same bytes.
"""

from importlib.resources import files

import engine3d as e3d

teapot = files("engine3d.data") / "models" / "teapot.obj"
frame = e3d.render(teapot, size=(480, 320))

# %%
# ``frame.save("teapot.png")`` writes it. The suffix chooses the format: PNG, JPEG, TGA or WebP.
# ``frame.color`` holds the pixels, and ``numpy.asarray(frame)`` is the same array.

print(frame.color.shape, frame.color.dtype)
