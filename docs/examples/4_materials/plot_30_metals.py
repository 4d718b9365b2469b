"""
Metals and lacquers in a studio
===============================

This draws balls of metal and lacquer, from smooth to rough. They mirror what is around them.
``Environment.studio()`` is a built-in room with lights; a picture in a file of the formats
``.hdr`` or ``.exr`` can take its place.
"""

import engine3d as e3d

studio = e3d.Environment.studio()
scene = e3d.Scene(background=(236, 236, 234), ambient=(0, 0, 0))
scene.environment = studio
for row, (color, metallic) in enumerate((((1.0, 0.78, 0.34), 1.0), ((0.75, 0.04, 0.05), 0.0))):
    for column in range(5):
        ball = e3d.uv_sphere(0.45, (64, 32))
        roughness = 0.05 + 0.22 * column
        ball.materials = [e3d.Material(color=color, metallic=metallic, roughness=roughness)]
        scene.add(ball, translation=(column - 2.0, 0.5 - row, 0.0))

camera = e3d.PerspectiveCamera(0.42), e3d.look_at((0.0, 0.0, 6.6), (0.0, 0.0, 0.0))
frame = e3d.render(
    scene, camera, size=(560, 260), samples=4, antialiasing="msaa", tone_mapping="neutral"
)
