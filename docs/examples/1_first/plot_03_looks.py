"""
Looks
=====

This draws one model in four looks. A look is a set of lights, a background and a shadow on the
ground, for whatever has no light of its own.
"""

import numpy as np

import engine3d as e3d

ring = e3d.torus(1.0, 0.4)
looks = (
    "studio",
    "plain",
    e3d.Look.studio(background="dark", ground=False),
    e3d.Look.studio(lights="two colours"),
)
steel = e3d.Material(color=(0.7, 0.72, 0.75), metallic=1.0, roughness=0.35)
frames = [e3d.render(ring, size=(230, 170), look=look, material=steel) for look in looks]
rows = [np.hstack([a.color, b.color]) for a, b in (frames[:2], frames[2:])]
picture = e3d.Canvas(np.vstack(rows))
for place, name in enumerate(("studio", "plain", "dark, no ground", "two colours")):
    picture.text(8 + place % 2 * 230, 8 + place // 2 * 170, name, "white", background="black")
