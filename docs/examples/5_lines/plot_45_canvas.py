"""
Text and shapes on a picture
============================

This draws letters, lines and boxes over a rendered picture. ``frame.canvas()`` draws into the frame's
own pixels.
"""

from importlib.resources import files

import engine3d as e3d

train = files("engine3d.data") / "models" / "train.asc"
frame = e3d.render(train, size=(480, 320))
canvas = frame.canvas()
canvas.rectangle(0, 290, 480, 30, (20, 24, 32, 200))
canvas.text(10, 297, "A toy train", "white", scale=2)
canvas.rectangle(8, 8, 464, 274, (20, 24, 32), fill=False)
canvas.line(300, 60, 250, 120, "crimson", width=2)
canvas.text(304, 48, "smoke goes here", "crimson")
