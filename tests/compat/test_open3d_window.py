"""The window of a `VisualizerWithKeyCallback` on a virtual screen: keys, the mouse, its end."""

import numpy as np
import pytest
from desktop import MARKS, Desktop, virtual_screen

pytest.importorskip("open3d", exc_type=ImportError)

pytestmark = MARKS
PROGRAM = """
import engine3d.compat.open3d
engine3d.compat.open3d.install()
import open3d as o3d
mesh = o3d.geometry.TriangleMesh.create_torus()
mesh.compute_vertex_normals()
mesh.paint_uniform_color([0.8, 0.3, 0.1])
vis = o3d.visualization.VisualizerWithKeyCallback()
assert vis.create_window("Ring", 300, 200)
vis.add_geometry(mesh)
def dark(vis):
    vis.get_render_option().background_color = [0, 0, 0]
    print("dark", flush=True)
    return False
vis.register_key_callback(ord("K"), dark)
vis.run()
print("closed", flush=True)
vis.destroy_window()
"""


def test_keys_and_the_mouse_change_what_the_window_shows(tmp_path):
    with virtual_screen(400, 300) as screen, Desktop(screen, tmp_path, ["-c", PROGRAM]) as desktop:
        assert desktop.title == "Ring"
        plain = desktop.settle()
        assert (plain == 255).all(axis=2).sum() > 10000

        def after(*arguments):
            desktop.do(*arguments)
            desktop.wait_for_change(plain)
            return desktop.settle()

        wires = after("key", "w")
        assert np.isclose(wires, 26, atol=2).all(axis=2).sum() > 500
        desktop.do("key", "w")
        assert (desktop.settle() == plain).all()
        turned = after("mousedown", 1, "mousemove_relative", 40, 20, "mouseup", 1)
        assert (turned != plain).any()
        assert (after("key", "r", "key", "k") == 255).all(axis=2).sum() < 1000
        desktop.do("key", "q")
        status, printed = desktop.finish()
        assert status == 0 and b"dark" in printed and b"closed" in printed
