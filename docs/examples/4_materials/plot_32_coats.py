"""
Varnish, cloth and thin films
=============================

This draws layers over a base: ``clearcoat`` is a coat of varnish, ``sheen_color`` the fuzz of
cloth, ``iridescence`` a thin film as on a soap bubble, and ``anisotropy`` the stretched highlight
of brushed metal.
"""

import engine3d as e3d

materials = {
    "clearcoat": {"color": "darkred", "metallic": 0.6, "roughness": 0.6, "clearcoat": 1.0},
    "sheen": {"color": (20, 60, 50), "metallic": 0.0, "sheen_color": (160, 230, 200)},
    "iridescence": {"color": "dimgray", "metallic": 1.0, "roughness": 0.2, "iridescence": 1.0},
    "anisotropy": {"color": "silver", "metallic": 1.0, "roughness": 0.35, "anisotropy": 0.9},
}
scene = e3d.Scene(background=(58, 60, 66), ambient=(0, 0, 0))
scene.environment = e3d.Environment.studio()
for column, values in enumerate(materials.values()):
    ball = e3d.uv_sphere(0.46, (64, 32)).with_tangents()
    ball.materials = [e3d.Material(**values)]
    scene.add(ball, translation=(column - 1.5, 0.0, 0.0))
scene.add(e3d.DirectionalLight((-0.4, -0.8, -0.6), intensity=2.0))
camera = e3d.OrthographicCamera(0.65), e3d.look_at((0.0, 0.0, 5.0), (0.0, 0.0, 0.0))
frame = e3d.render(scene, camera, size=(480, 156), tone_mapping="neutral")
picture = frame.canvas()
for column, name in enumerate(materials):
    picture.text(60 + 120 * column - 4 * len(name), 140, name, "white")
