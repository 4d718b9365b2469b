"""
Optical flow
============

This shows how far each pixel moves between two moments, and what the second picture hides.

A ``Moment`` keeps what a frame shows. Colours tell the direction of motion, their strength speed.
"""

from importlib.resources import files

import numpy as np
from PIL import Image

import engine3d as e3d
from engine3d.sensors import Moment

scene = e3d.Scene(background="lightsteelblue")
scene.add(e3d.DirectionalLight((-0.5, -1.0, -0.7)))
scene.add(e3d.plane(16.0))
teapot = scene.add(e3d.load_mesh(files("engine3d.data") / "models" / "teapot.obj"))
lens, pose = e3d.PerspectiveCamera(0.7), e3d.look_at((3.0, 5.0, 9.0), (0.0, 1.0, 0.0))

outputs = ("color", *Moment.OUTPUTS)
with e3d.Renderer((400, 300)) as renderer:
    first = Moment(renderer.render(scene, (lens, pose), outputs=outputs), scene)
    teapot.rotation = e3d.linalg.euler_to_quaternion((0.0, 0.25, 0.0))
    teapot.translation = (0.4, 0.0, 0.0)
    second = Moment(renderer.render(scene, (lens, pose), outputs=outputs), scene)

flow = first.flow_to(second)
picture = Image.fromarray(flow.colors())

# %%
# The second picture, read where each pixel of the first has gone. Where it hides what the first
# shows, it is red:

warped = flow.warp(second.frame.color)[..., :3].astype(np.uint8)
warped[flow.occluded] = (220, 40, 40)
back = Image.fromarray(warped)
