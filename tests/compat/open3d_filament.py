"""Pixels of Open3D's own offscreen renderer, and the scenes that they are from.

Measured with Open3D 0.20.0 in November 2026, by Filament on Mesa's software Vulkan: 320 x 240
pixels, as `stand` sets the camera. Drawing takes Open3D minutes there, too long for a test.
"""

import open3d as o3d

from engine3d.compat.open3d import rendering

SIZE = (320, 240)
#: Rows and columns of the pixels of `MEASURED`.
PLACES = ((120, 160), (100, 140), (140, 180), (90, 160), (150, 150), (5, 5))
MEASURED = {
    "white": "e2dfd9 e8e4de cfcecb e6e3dd dbd8d4 e5e1db",
    "grey": "c2c2c0 cecdca a1a3a4 c8c7c5 b4b4b4 e6e2dc",
    "colour": "dba569 e6b479 c08149 e1ac70 d19459 e6e2db",
    "gloss": "daa469 e6c39f c0834e e1ad74 cf9257 e6e1db",
    "metal": "a69864 ede5ca b0a16d afa16d 938453 e6e2db",
    "mirror": "aaacab b6b7b7 babab8 97999a 9c9ea0 e6e2dc",
    "unlit": "d35118 d45118 d35118 d45219 d45219 e6e1db",
    "background": "dba469 e6b479 c1824b e1ac70 d1955a 022568",
    "no sun": "d0d0cd d7d6d2 c5c5c3 d5d4d0 c6c6c4 e6e2dc",
    "no environment": "a8a7a6 c5c3c0 575859 b7b6b4 979797 e6e2dc",
    "evening": "c79a62 c3955e c5975f c79962 bd8e58 e6e2dc",
    "no post-processing": "b1461a e35921 712c10 ca4f1d 923915 ffffff",
    "lamp": "0c0c0c 090909 0b0b0b 0c0c0c 060607 e6e2dc",
}
#: Codes by which a pixel may differ: of mirrors, whose picture is prefiltered in another way, more.
APART = {"metal": 14, "mirror": 14, "gloss": 20}


def ball(color=None):
    mesh = o3d.geometry.TriangleMesh.create_sphere(1.0, resolution=40)
    mesh.compute_vertex_normals()
    if color is not None:
        mesh.paint_uniform_color(color)
    return mesh


def record(shader="defaultLit", **values):
    made = rendering.MaterialRecord()
    made.shader = shader
    for name, value in values.items():
        setattr(made, name, value)
    return made


def stand(name):
    """Return a renderer with one of the scenes."""
    renderer = rendering.OffscreenRenderer(*SIZE)
    scene, low = renderer.scene, renderer.scene.scene
    rust, white = ball((0.8, 0.3, 0.1)), ball((1.0, 1.0, 1.0))
    mesh, material = {
        "grey": (ball(), record()),
        "colour": (rust, record()),
        "gloss": (rust, record(base_roughness=0.3)),
        "metal": (
            white,
            record(base_metallic=1.0, base_roughness=0.2, base_color=[0.9, 0.7, 0.3, 1]),
        ),
        "mirror": (white, record(base_metallic=1.0, base_roughness=0.0)),
        "unlit": (white, record("defaultUnlit", base_color=[0.8, 0.3, 0.1, 1.0])),
        "background": (rust, record()),
        "no post-processing": (rust, record()),
    }.get(name, (white, record()))
    scene.add_geometry("ball", mesh, material)
    if name == "background":
        scene.set_background([0.1, 0.2, 0.4, 1.0])
    low.enable_sun_light(name not in ("no sun", "lamp"))
    low.enable_indirect_light(name not in ("no environment", "evening", "lamp"))
    if name == "evening":
        low.set_sun_light([-1, -1, -1], [1, 0.5, 0.2], 60000)
    if name == "lamp":
        low.add_point_light("lamp", [1, 1, 1], [2, 2, 2], 100000.0, 10.0, False)
    scene.view.set_post_processing(name != "no post-processing")
    renderer.setup_camera(60.0, [0, 0, 0], [1.5, 1.5, 2.5], [0, 1, 0])
    return renderer
