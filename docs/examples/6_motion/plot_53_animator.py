"""
Things that turn
================

This lets planets go round a sun, and writes the motion as a GIF.

A node moves all that hangs below it. ``Animator.spin`` turns nodes evenly; ``track`` moves them
along keyframes.
"""

import engine3d as e3d


def ball(radius, color, **values):
    """A ball of one colour."""
    mesh = e3d.uv_sphere(radius, (48, 24))
    mesh.materials = [e3d.Material(color=color, **values)]
    return mesh


scene = e3d.Scene(background=(10, 11, 18), ambient=(26, 28, 36))
scene.add(ball(0.6, "black", emissive="gold"))
scene.add(e3d.PointLight("cornsilk", 26.0))
animator = e3d.Animator(scene)
for distance, radius, color, period in ((1.3, 0.16, "tan", 2.0), (2.2, 0.26, "dodgerblue", 4.0)):
    orbit = scene.add(rotation=e3d.linalg.euler_to_quaternion((0.0, 3.0 + distance, 0.0)))
    planet = scene.add(ball(radius, color), parent=orbit, translation=(distance, 0.0, 0.0))
    animator.spin(orbit, period=period)
scene.add(ball(0.07, "silver"), parent=planet, translation=(0.42, 0.0, 0.0))
animator.spin(planet, period=1.0)

camera = e3d.PerspectiveCamera(0.55), e3d.look_at((0.0, 3.2, 7.2), (0.0, -0.1, 0.0))
frames = []
for number in range(32):
    animator.seek(4.0 * number / 32)
    frames.append(e3d.render(scene, camera, size=(280, 180)))
e3d.save_animation(frames, "planets.gif", fps=8)
