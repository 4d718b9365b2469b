"""
Saving and loading a scene
==========================

This writes a scene with its lights and camera to a file, and reads it back: the picture has the
same bytes.
"""

import tempfile
from pathlib import Path

import numpy as np

import engine3d as e3d

scene = e3d.Scene(background=(214, 222, 230), ambient=(120, 124, 132))
for number, color in enumerate(("firebrick", "goldenrod", "seagreen")):
    block = e3d.box((1.0, 0.4 + 0.4 * number, 1.0))
    block.materials = [e3d.Material(color=color)]
    scene.add(block, name=color, translation=(1.2 * number, 0.2 + 0.2 * number, 0.0))
scene.add(e3d.plane(6.0), name="ground", translation=(1.2, 0.0, 0.0))
scene.add(e3d.DirectionalLight((-0.5, -1.0, -0.4), intensity=2.2, shadow="map"))
scene.add(e3d.PerspectiveCamera(0.6), pose=e3d.look_at((3.0, 3.0, 5.5), (1.2, 0.3, 0.0)))
frame = e3d.render(scene, size=(420, 260))

with tempfile.TemporaryDirectory() as folder:
    path = Path(folder) / "blocks.e3d.json"  # or .glb, for other programs
    scene.save(path)
    print(path.stat().st_size, "bytes")
    again = e3d.load_scene(path)
assert np.array_equal(e3d.render(again, size=(420, 260)).color, frame.color)
