"""
An animation from a glTF file
=============================

This writes a file with a ball that jumps, loads it and plays it.

``AnimationPlayer`` plays what ``scene.animations`` holds: ``play``, ``seek``, ``advance``.
"""

import tempfile
from pathlib import Path

import numpy as np

import engine3d as e3d

ball = e3d.icosphere(0.5, 4)
ball.materials = [e3d.Material(color="tomato", metallic=0.0, roughness=0.4)]
scene = e3d.Scene()
node = scene.add(ball, name="ball")
heights = [(0.0, 0.4, 0.0), (0.0, 0.5, 0.0), (0.0, 1.5, 0.0), (0.0, 0.5, 0.0), (0.0, 0.4, 0.0)]
shapes = [(1.2, 0.8, 1.2), (1.0, 1.0, 1.0), (0.95, 1.1, 0.95), (1.0, 1.0, 1.0), (1.2, 0.8, 1.2)]
times = [0.0, 0.1, 0.5, 0.9, 1.0]
channels = [
    e3d.motion.Channel(node, "translation", times, heights),
    e3d.motion.Channel(node, "scale", times, shapes),
]
scene.animations = {"jump": e3d.motion.AnimationClip(channels, "jump")}

with tempfile.TemporaryDirectory() as folder:
    scene.save(Path(folder) / "ball.glb")
    loaded = e3d.load_scene(Path(folder) / "ball.glb")
player = e3d.AnimationPlayer(loaded)
player.play("jump")
camera = e3d.PerspectiveCamera(0.7), e3d.look_at((0.0, 1.6, 4.2), (0.0, 0.95, 0.0))
moments = []
for time in (0.0, 0.2, 0.5, 0.8, 1.0):
    player.seek(time)
    moments.append(e3d.render(loaded, camera, size=(96, 160)).color)
picture = e3d.Canvas(np.hstack(moments))
