"""
Light from an environment
=========================

This lights two balls by a picture of everything around them, and shows it as the background.

``Environment.sky()``, ``hall()`` and ``studio()`` are built in. ``Environment.load("room.hdr")``
reads a photograph.
"""

import numpy as np

import engine3d as e3d


def balls(environment):
    """A mirror and a matt ball in an environment."""
    scene = e3d.Scene(background=environment, ambient=(0, 0, 0))
    scene.environment = environment
    for x, metallic, roughness in ((-0.6, 1.0, 0.05), (0.6, 0.0, 0.9)):
        ball = e3d.uv_sphere(0.5, (64, 32))
        ball.materials = [e3d.Material(metallic=metallic, roughness=roughness)]
        scene.add(ball, translation=(x, 0.0, 0.0))
    camera = e3d.PerspectiveCamera(0.8), e3d.look_at((0.0, 0.5, 2.4), (0.0, 0.0, 0.0))
    return e3d.render(scene, camera, size=(240, 180), tone_mapping="neutral").color


sky = e3d.Environment.sky((0.5, 0.6, 0.4), sun_disc=False)
picture = e3d.Canvas(np.hstack([balls(sky), balls(e3d.Environment.hall())]))
