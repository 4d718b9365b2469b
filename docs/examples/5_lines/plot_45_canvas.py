"""
Text and shapes on a picture
============================

This draws letters, lines and boxes over a rendered picture. ``frame.canvas()`` draws into the
frame's own pixels.
"""

from importlib.resources import files

import engine3d as e3d

train = files("engine3d.data") / "models" / "train.asc"
frame = e3d.render(train, size=(480, 320))
canvas = frame.canvas()
canvas.rectangle(0, 282, 480, 38, (20, 24, 32, 200))
canvas.text(10, 287, "A toy train", "white", scale=2)
canvas.rectangle(8, 8, 464, 266, (20, 24, 32), fill=False)
canvas.line(170, 60, 235, 112, "crimson", width=2)
canvas.text(70, 48, "driver's cab", "crimson")
