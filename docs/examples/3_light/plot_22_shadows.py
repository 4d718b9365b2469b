"""
Two kinds of shadows
====================

This draws both kinds of shadows. With ``shadow="map"`` a light casts shadows from a map of depths.
Their edges are soft. With ``shadow="exact"`` it casts the shadows that rays would find. Their
edges are hard, and there is nothing to tune.
"""

import math

import engine3d as e3d


def pillars(shadow):
    """A row of pillars in the evening sun."""
    scene = e3d.Scene(background=(200, 214, 232), ambient=(149, 153, 166))
    scene.add(e3d.plane(14.0))
    for x in (-3.0, -1.0, 1.0, 3.0):
        scene.add(e3d.cylinder(0.3, 2.0, 48), translation=(x, 1.0, 0.0))
    scene.add(
        e3d.DirectionalLight((-0.8, -0.7, 0.45), (255, 246, 229), 0.7 * math.pi, shadow=shadow)
    )
    scene.add(e3d.PerspectiveCamera(0.6), pose=e3d.look_at((2.0, 4.5, 10.0), (-0.8, 0.4, 0.5)))
    return e3d.render(scene, size=(480, 270), samples=4, antialiasing="msaa")


soft = pillars(shadow="map")

# %%
# This is the same scene with exact shadows:

exact = pillars(shadow="exact")
