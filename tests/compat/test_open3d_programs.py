"""Programs in the manner of public ones that use Open3D, run with one line before them.

They run in a process that finds neither libGL nor libEGL nor libX11, nor a display.
"""

import json
import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

pytest.importorskip("open3d", exc_type=ImportError)

LINE = "import engine3d.compat.open3d; engine3d.compat.open3d.install()\n"
#: Files of these names that are no libraries stand before the system's.
MASKED = (
    "libGL.so.1",
    "libEGL.so.1",
    "libX11.so.6",
    "libusb-1.0.so.0",
    "libudev.so.1",
    "libidn2.so.0",
    "libvulkan.so.1",
    "libOSMesa.so.8",
)
START = """
import numpy as np, open3d as o3d
mesh = o3d.geometry.TriangleMesh.create_torus()
mesh.compute_vertex_normals()
mesh.paint_uniform_color([0.8, 0.3, 0.1])
cloud = mesh.sample_points_uniformly(500)
"""
PROGRAMS = {
    "a mesh offscreen, turned": """
import open3d.visualization.rendering as rendering
render = rendering.OffscreenRenderer(160, 120, headless=True)
mat = rendering.MaterialRecord()
mat.shader = "defaultLit"
render.scene.add_geometry("mesh", mesh, mat)
for angle in (0.0, 1.0):
    eye = np.array([4 * np.sin(angle), 2, 4 * np.cos(angle)])
    render.scene.camera.look_at(mesh.get_center(), eye, [0, 1, 0])
    keep(np.asarray(render.render_to_image()))
""",
    "pictures of clouds, in a loop": """
for number in range(4):
    vis = o3d.visualization.Visualizer()
    vis.create_window(width=112, height=112, visible=False)
    points = o3d.geometry.PointCloud()
    points.points = o3d.utility.Vector3dVector(np.asarray(cloud.points) * [1, number + 1, 1])
    vis.add_geometry(points)
    image = np.asarray(vis.capture_screen_float_buffer(do_render=True))
    assert image.dtype == np.float32 and 0 <= image.min() < image.max() == 1
    vis.destroy_window()
    keep((image * 255).astype(np.uint8))
""",
    "frames into files": """
vis = o3d.visualization.Visualizer()
vis.create_window(width=96, height=64)
vis.get_render_option().save_to_json("options.json")
vis.get_render_option().load_from_json("options.json")
vis.add_geometry(mesh)
for number in range(3):
    mesh.rotate(mesh.get_rotation_matrix_from_xyz((0, 0.3, 0)))
    vis.update_geometry(mesh)
    assert vis.poll_events()
    vis.update_renderer()
    vis.capture_screen_image(f"frame{number}.png")
    vis.capture_depth_image(f"depth{number}.png", do_render=True)
    keep(np.asarray(o3d.io.read_image(f"frame{number}.png")))
depth = np.asarray(o3d.io.read_image("depth0.png"))
assert depth.dtype == np.uint16 and 1000 < depth.max() < 32767 and depth.min() == 0
vis.capture_depth_point_cloud("seen.ply", do_render=True, convert_to_world_coordinate=True)
seen = np.asarray(o3d.io.read_point_cloud("seen.ply").points)
near = np.asarray(o3d.geometry.PointCloud(o3d.utility.Vector3dVector(seen)).get_max_bound())
assert (near <= mesh.get_max_bound() + 0.01).all() and len(seen) > 100
vis.destroy_window()
""",
    "keys, and a view": """
vis = o3d.visualization.VisualizerWithKeyCallback()
vis.create_window(width=96, height=64)
vis.add_geometry(mesh)
vis.register_key_callback(ord("S"), lambda vis: False)
vis.register_key_action_callback(256, lambda vis, action, mods: False)
control = vis.get_view_control()
control.set_zoom(0.5)
control.set_up([0, 0, 1])
control.set_lookat([0, 0, 0])
control.set_front([1, 0.5, 0.2])
keep(np.asarray(vis.capture_screen_float_buffer(True)) * 255)
vis.run()
""",
    "a camera of another picture": """
vis = o3d.visualization.Visualizer()
vis.create_window(width=96, height=64, visible=False)
vis.add_geometry(mesh)
control = vis.get_view_control()
params = control.convert_to_pinhole_camera_parameters()
o3d.io.write_pinhole_camera_parameters("camera.json", params)
params = o3d.io.read_pinhole_camera_parameters("camera.json")
extrinsic = np.array(params.extrinsic)
extrinsic[2, 3] += 1.0
params.extrinsic = extrinsic
assert control.convert_from_pinhole_camera_parameters(params, allow_arbitrary=True)
keep(np.asarray(vis.capture_screen_float_buffer(True)) * 255)
option = vis.get_render_option()
option.background_color = np.asarray([0, 0, 0])
option.point_size, option.mesh_show_back_face, option.light_on = 2.0, True, False
option.mesh_show_wireframe = True
keep(np.asarray(vis.capture_screen_float_buffer(True)) * 255)
""",
    "depths for a data set": """
from open3d.visualization import rendering
render = rendering.OffscreenRenderer(160, 120)
material = rendering.MaterialRecord()
material.base_color, material.shader = [1.0, 0.5, 0.2, 1.0], "defaultUnlit"
render.scene.add_geometry("mesh", mesh, material)
render.scene.set_background([0, 0, 0, 1])
intrinsic = o3d.camera.PinholeCameraIntrinsic(160, 120, 150.0, 150.0, 79.5, 59.5)
extrinsic = np.eye(4)
extrinsic[2, 3] = 5.0
render.setup_camera(intrinsic, extrinsic)
render.scene.scene.set_sun_light([0.7, -0.7, -0.7], [1, 1, 1], 75000)
render.scene.scene.enable_sun_light(True)
render.scene.scene.enable_indirect_light(False)
render.scene.view.set_antialiasing(False)
render.scene.view.set_sample_count(1)
render.scene.view.set_post_processing(False)
depth = np.asarray(render.render_to_depth_image(z_in_view_space=True))
assert np.isinf(depth[0, 0]) and 3 < depth[np.isfinite(depth)].min() < 6
keep(np.asarray(render.render_to_image()))
render.scene.remove_geometry("mesh")
render.scene.clear_geometry()
""",
    "draw_geometries replaced": """
def draw(geometries, **how):
    vis = o3d.visualization.Visualizer()
    vis.create_window(width=96, height=64, visible=False)
    for one in geometries:
        vis.add_geometry(one)
    keep(np.asarray(vis.capture_screen_float_buffer(True)) * 255)
original = o3d.visualization.draw_geometries
o3d.visualization.draw_geometries = draw
o3d.visualization.draw_geometries([mesh, cloud], zoom=0.7)
original([mesh], zoom=0.7, front=[0, 0, 1], lookat=[0, 0, 0], up=[0, 1, 0])
o3d.visualization.draw([{"name": "mesh", "geometry": mesh}], bg_color=(1, 1, 1, 1))
""",
    "an animation that ends by itself": """
frames = []
def turn(vis):
    vis.get_view_control().rotate(10.0, 0.0)
    frames.append(np.asarray(vis.capture_screen_float_buffer(True)))
    if len(frames) == 3:
        vis.close()
    return False
o3d.visualization.draw_geometries_with_animation_callback([mesh], turn, width=96, height=64)
assert len(frames) == 3
for frame in frames:
    keep(frame * 255)
""",
}
DRIVER = """
import json, os, traceback, warnings
import numpy as np
programs, done, start = json.load(open("programs.json")), {}, os.getcwd()
for name, code in programs.items():
    shown, told = [], []
    os.mkdir(name)
    try:
        with warnings.catch_warnings(record=True) as told:
            warnings.simplefilter("always")
            os.chdir(name)
            exec(code, {"keep": lambda picture: shown.append(np.array(picture))})
        error = ""
    except Exception:
        error = traceback.format_exc()
    os.chdir(start)
    spreads = [float(np.ptp(one.astype(float), axis=(0, 1)).max()) for one in shown]
    kinds = len({one.tobytes() for one in shown})
    done[name] = error, spreads, kinds, [str(one.message) for one in told]
json.dump(done, open("done.json", "w"))
"""


def run(code, folder):
    """Run Python where no library for windows loads."""
    bare = folder / "masked"
    bare.mkdir()
    for name in MASKED:
        (bare / name).touch()
    environment = {key: value for key, value in os.environ.items() if "DISPLAY" not in key}
    environment["LD_LIBRARY_PATH"] = str(bare)
    return subprocess.run(
        [sys.executable, "-c", code],
        cwd=folder,
        env=environment,
        capture_output=True,
        text=True,
    )


@pytest.fixture(scope="module")
def results(tmp_path_factory):
    """Run all programs in one process, as importing open3d takes seconds."""
    folder = tmp_path_factory.mktemp("programs")
    programs = {name: START + code for name, code in PROGRAMS.items()}
    (folder / "programs.json").write_text(json.dumps(programs))
    done = run(LINE + DRIVER, folder)
    assert done.returncode == 0, done.stderr[-2000:]
    return json.loads((folder / "done.json").read_text())


@pytest.mark.parametrize("name", PROGRAMS)
def test_programs_run_unchanged(results, name):
    error, spreads, kinds, told = results[name]
    assert not error
    assert len(spreads) == kinds > 0 and min(spreads) > 60
    shows_windows = "run()" in PROGRAMS[name] or "original(" in PROGRAMS[name]
    assert any("shows nothing: there is no screen" in one for one in told) == shows_windows


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="libraries of Linux")
def test_without_the_line_open3d_does_not_load_here(tmp_path):
    """What the stand-ins are for; were it not so, the programs would prove nothing."""
    done = run("import open3d", tmp_path)
    assert done.returncode != 0 and "file too short" in done.stderr


def test_stand_ins_are_for_what_is_missing_alone():
    """Where the libraries are there, nothing is loaded in their place."""
    from importlib.util import find_spec

    from engine3d.compat.open3d._stand_ins import _LIBRARIES, _loads, provide_missing

    folder = find_spec("open3d").submodule_search_locations[0]
    assert list(Path(folder).glob("**/*.so*"))
    there = [name for name in _LIBRARIES if _loads(name)]
    assert not set(there) & set(provide_missing(folder))


def test_the_same_bytes_with_any_backend_and_threads(monkeypatch):
    import open3d as o3d
    from compat.open3d_scenes import ball, cloud, draw

    from engine3d.compat.open3d import Visualizer

    drawn = set()
    for backend, threads in (("scalar", "1"), ("auto", "2"), ("auto", "1")):
        monkeypatch.setenv("ENGINE3D_BACKEND", backend)
        monkeypatch.setenv("ENGINE3D_THREADS", threads)
        shades = {"mesh_shade_option": o3d.visualization.MeshShadeOption.Color}
        drawn.add(draw(Visualizer, [ball(), cloud(normals=True)], shades, {}, 0)[0].tobytes())
    assert len(drawn) == 1 and np.ptp(np.frombuffer(drawn.pop(), np.uint8)) > 100
