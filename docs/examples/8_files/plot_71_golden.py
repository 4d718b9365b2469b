"""
Comparing with a golden picture
===============================

This finds what changed between two pictures. A scene has the same bytes everywhere, so every
pixel that differs was changed by someone.

In tests, the fixture ``golden`` of pytest does this, and keeps the pictures: see the page
:doc:`/golden`.
"""

import numpy as np

import engine3d as e3d


def blocks(height):
    """Three blocks, of which one has this height."""
    scene = e3d.Scene(background=(196, 208, 220), ambient=(120, 124, 132))
    scene.add(e3d.DirectionalLight((-0.3, -1.0, -0.6), intensity=2.0))
    for x, tall in ((-1.2, 0.6), (0.0, height), (1.2, 1.0)):
        scene.add(e3d.box((0.9, tall, 0.9)), translation=(x, tall / 2, 0.0))
    camera = e3d.PerspectiveCamera(0.5), e3d.look_at((2.0, 2.0, 5.0), (0.0, 0.5, 0.0))
    return e3d.render(scene, camera, size=(160, 140)).color


golden, now = blocks(0.8), blocks(0.83)
differs = (golden != now).any(axis=-1)
rows, columns = np.nonzero(differs)
print(f"{len(rows)} pixels differ, in rows {rows.min()} to {rows.max()}")
marked = now // 3
marked[differs] = (255, 60, 60, 255)
marked[..., 3] = 255
picture = e3d.Canvas(np.hstack([golden, now, marked]))
