"""The `Visualizer` as an object: captures, copies, keys, options, what it refuses."""

import numpy as np
import pytest

o3d = pytest.importorskip("open3d", exc_type=ImportError)

from compat.open3d_scenes import ball, cloud, lines, torus, voxels  # noqa: E402

from engine3d.compat.open3d import Visualizer, VisualizerWithKeyCallback  # noqa: E402
from engine3d.errors import Engine3DWarning, FileAccessError, InvalidArgumentError  # noqa: E402


def opened(*geometries, make=Visualizer, size=(60, 40)):
    visualizer = make()
    assert visualizer.create_window("Name", *size, visible=False) is True
    for one in geometries:
        assert visualizer.add_geometry(one)
    return visualizer


def seen(visualizer, do_render=True):
    return np.asarray(visualizer.capture_screen_float_buffer(do_render)).copy()


def test_pictures_without_drawing_are_those_of_the_last_events():
    visualizer = opened(torus())
    first = seen(visualizer, do_render=False)
    visualizer.get_view_control().rotate(100, 0)
    assert np.array_equal(seen(visualizer, do_render=False), first)
    visualizer.poll_events()  # nothing asks for a new picture
    assert np.array_equal(seen(visualizer, do_render=False), first)
    visualizer.update_renderer()
    visualizer.poll_events()
    assert not np.array_equal(seen(visualizer, do_render=False), first)


def test_geometries_are_copied_until_updated():
    mesh = torus()
    visualizer = opened(mesh)
    first = seen(visualizer)
    mesh.scale(0.5, (0, 0, 0))
    assert np.array_equal(seen(visualizer), first)
    assert visualizer.update_geometry(mesh)
    assert not np.array_equal(seen(visualizer), first)


def test_geometries_are_removed():
    mesh, points = torus(), cloud()
    visualizer = opened(mesh, points)
    assert visualizer.remove_geometry(mesh, reset_bounding_box=False)
    assert not visualizer.remove_geometry(mesh)
    assert (seen(visualizer) < 1).any()
    assert visualizer.clear_geometries()
    assert (seen(visualizer) == 1).all()


def test_a_view_is_kept_when_asked_for():
    visualizer = opened(torus())
    before = visualizer.get_view_status()
    assert visualizer.add_geometry(ball(), reset_bounding_box=False)
    assert visualizer.get_view_status() == before
    visualizer.get_view_control().set_zoom(0.3)
    visualizer.set_view_status(before)
    assert visualizer.get_view_status() == before
    with pytest.raises(InvalidArgumentError, match="no view status"):
        visualizer.set_view_status("{}")


def test_tensors_are_drawn_as_what_they_hold():
    mesh = torus()
    tensor = o3d.t.geometry.TriangleMesh.from_legacy(mesh)
    ours, legacy = seen(opened(tensor)), seen(opened(mesh))
    assert np.mean(ours != legacy) < 0.01


def test_tensors_are_updated_and_removed():
    tensor = o3d.t.geometry.TriangleMesh.from_legacy(torus())
    visualizer = opened(tensor)
    first = seen(visualizer)
    tensor.vertex.positions = tensor.vertex.positions * 0.5
    assert np.array_equal(seen(visualizer), first)
    visualizer.update_geometry(tensor)
    assert not np.array_equal(seen(visualizer), first)
    assert visualizer.remove_geometry(tensor, reset_bounding_box=False)
    assert (seen(visualizer) == 1).all()


def test_what_is_not_drawn_is_named():
    visualizer = opened()
    with pytest.warns(Engine3DWarning, match="draws no Image"):
        assert not visualizer.add_geometry(o3d.geometry.Image(np.zeros((2, 2, 3), np.uint8)))
    with pytest.warns(Engine3DWarning, match="draws no int"):
        assert not visualizer.add_geometry(5)
    assert not visualizer.add_geometry(None)
    assert not Visualizer().add_geometry(torus())


def test_nothing_to_see_is_no_error():
    points = np.full((3, 3), np.inf)
    for empty in (o3d.geometry.PointCloud(), o3d.geometry.TriangleMesh(), o3d.geometry.LineSet()):
        assert (seen(opened(empty)) == 1).all()
    visualizer = opened(o3d.geometry.PointCloud(o3d.utility.Vector3dVector(points)))
    with pytest.warns(Engine3DWarning):
        assert (seen(visualizer) == 1).all()


@pytest.mark.parametrize(
    ("call", "said"),
    [
        (lambda vis: vis.get_view_control().set_front([1, 2]), "front must be three"),
        (lambda vis: vis.get_view_control().set_zoom("x"), "zoom must be a finite number"),
        (lambda vis: vis.capture_screen_image("picture.xyz", True), ".png or .jpg"),
        (lambda vis: vis.create_window(width=0), "width"),
        (lambda vis: Visualizer().get_view_control(), "create_window first"),
    ],
)
def test_wrong_calls_are_refused(call, said):
    with pytest.raises(InvalidArgumentError, match=said):
        call(opened(torus()))


def test_files_that_cannot_be_written(tmp_path):
    with pytest.raises(FileAccessError, match="cannot be written"):
        opened(torus()).capture_screen_image(tmp_path / "no" / "picture.png", True)


def test_a_camera_of_another_size_needs_leave():
    visualizer = opened(torus())
    control = visualizer.get_view_control()
    other = opened(torus(), size=(80, 40)).get_view_control()
    parameters = other.convert_to_pinhole_camera_parameters()
    with pytest.warns(Engine3DWarning, match="allow_arbitrary"):
        assert not control.convert_from_pinhole_camera_parameters(parameters)
    assert control.convert_from_pinhole_camera_parameters(parameters, allow_arbitrary=True)


def test_options_of_files_change_the_lights(tmp_path):
    visualizer = opened(ball())
    option, path = visualizer.get_render_option(), tmp_path / "options.json"
    before = seen(visualizer)
    option.save_to_json(str(path))
    path.write_text(
        path.read_text().replace(
            'light0_color" : [ 1.0, 1.0, 1.0 ]', 'light0_color" : [ 1.0, 0.0, 0.0 ]'
        )
    )
    option.load_from_json(path)
    after = seen(visualizer)
    shows = (before < 1).any(axis=2)
    assert after[shows][:, 1].mean() < before[shows][:, 1].mean() - 0.05
    assert np.allclose(after[shows][:, 0], before[shows][:, 0], atol=1 / 255)


def test_wires_lie_over_faces_and_behind_what_is_nearer():
    visualizer = opened(ball())
    plain = seen(visualizer)
    visualizer.get_render_option().mesh_show_wireframe = True
    wires = seen(visualizer)
    changed = (wires != plain).any(axis=2)
    assert changed.any() and np.allclose(wires[changed], 26 / 255)
    near = o3d.geometry.TriangleMesh.create_box(9, 9, 0.1).translate([-4.5, -4.5, 1.5])
    visualizer.add_geometry(near, reset_bounding_box=False)
    middle = seen(visualizer)[18:22, 28:32]
    assert np.mean(abs(middle * 255 - 178.5) < 1) > 0.7  # the rest are wires of its own


def test_voxels_as_wires_and_normals_of_points():
    visualizer = opened(voxels())
    faces = seen(visualizer)
    visualizer.get_render_option().mesh_show_wireframe = True
    visualizer.update_geometry()
    assert (seen(visualizer) == 1).all(axis=2).sum() > (faces == 1).all(axis=2).sum()
    other = opened(cloud(normals=True))
    before = seen(other)
    other.get_render_option().point_show_normal = True
    other.update_geometry()
    black = [np.isclose(one, 26 / 255).all(axis=2).sum() for one in (before, seen(other))]
    assert black[1] > black[0] + 15


def test_keys_do_what_open3d_does():
    visualizer = opened(cloud(), lines(), ball())
    option, control = visualizer.get_render_option(), visualizer.get_view_control()
    for key, name in (
        ("W", "mesh_show_wireframe"),
        ("B", "mesh_show_back_face"),
        ("L", "light_on"),
        ("N", "point_show_normal"),
    ):
        before = getattr(option, name)
        visualizer._key(ord(key), 1, 0)
        assert getattr(option, name) is not before
    visualizer._key(ord("="), 1, 0)
    visualizer._key(ord("="), 2, 1)
    assert (option.point_size, option.line_width) == (6.0, 2.0)
    visualizer._key(ord("9"), 1, 2)
    visualizer._key(ord("2"), 1, 0)
    assert option.mesh_color_option == o3d.visualization.MeshColorOption.Normal
    assert option.point_color_option == o3d.visualization.PointColorOption.XCoordinate
    visualizer._key(ord("["), 1, 0)
    assert control.get_field_of_view() == 55.0
    before, jet = seen(visualizer), ord("1")
    visualizer._key(ord("0"), 1, 1)
    try:
        assert not np.array_equal(seen(visualizer), before)
    finally:
        visualizer._key(jet, 1, 1)
    visualizer._key(ord("R"), 1, 0)
    assert control.get_field_of_view() == 60.0 and visualizer.poll_events()
    visualizer._key(ord("Q"), 0, 0)
    assert visualizer.poll_events()
    visualizer._key(ord("Q"), 1, 0)
    assert not visualizer.poll_events()


def test_the_mouse_turns_moves_rolls_and_zooms():
    visualizer = opened(torus())
    control = visualizer.get_view_control()

    def dragged(button, mods):
        before = visualizer.get_view_status()
        visualizer._mouse_button(button, 1, mods)
        visualizer._mouse_moved(30, 20, 10, 5)
        visualizer._mouse_button(button, 0, mods)
        visualizer._mouse_moved(40, 25, 10, 5)
        after = visualizer.get_view_status()
        visualizer.set_view_status(before)
        return after

    for button, mods, name, moved in (
        (0, 0, "rotate", (10, 5)),
        (0, 2, "translate", (10, 5)),
        (2, 0, "translate", (10, 5)),
        (0, 1, "roll", (10,)),
    ):
        after = dragged(button, mods)
        before = visualizer.get_view_status()
        getattr(control, name)(*moved)
        assert visualizer.get_view_status() == after != before
        visualizer.set_view_status(before)
    visualizer._scrolled(0, 2)
    assert '"zoom": 0.74' in visualizer.get_view_status()


def test_functions_of_a_program_take_keys_and_the_mouse():
    visualizer, called = opened(torus(), make=VisualizerWithKeyCallback), []
    visualizer.register_key_callback(ord("W"), lambda vis: called.append(vis) or False)
    visualizer.register_key_action_callback(65, lambda vis, *rest: called.append(rest) or True)
    visualizer.register_mouse_move_callback(lambda vis, x, y: called.append((x, y)) or False)
    visualizer.register_mouse_scroll_callback(lambda vis, x, y: called.append(y) or False)
    visualizer.register_mouse_button_callback(lambda vis, *rest: called.append(rest) or False)
    visualizer._key(ord("W"), 1, 0)
    visualizer._key(ord("W"), 0, 0)
    visualizer._key(65, 0, 2)
    visualizer._mouse_moved(3, 4, 1, 1)
    visualizer._scrolled(0, -1)
    visualizer._mouse_button(1, 1, 0)
    assert called == [visualizer, (0, 2), (3.0, 4.0), -1, (1, 1, 0)]
    assert not visualizer.get_render_option().mesh_show_wireframe
    visualizer._key(ord("B"), 1, 0)
    assert visualizer.get_render_option().mesh_show_back_face


@pytest.mark.filterwarnings("error")
def test_a_callback_may_end_it():
    visualizer = opened(torus())
    visualizer.register_animation_callback(lambda vis: vis.destroy_window())
    visualizer.run()
    assert not visualizer.poll_events()


def test_it_may_begin_again():
    visualizer = opened(torus())
    assert visualizer.get_window_name() == "Name"
    visualizer.destroy_window()
    assert not visualizer.poll_events() and not visualizer.add_geometry(torus())
    visualizer.create_window(width=60, height=40, visible=False)
    assert visualizer.add_geometry(torus())
    assert np.array_equal(seen(visualizer), seen(opened(torus())))


def test_wrong_indices_are_named():
    vectors = o3d.utility.Vector3dVector(np.eye(3))
    mesh = o3d.geometry.TriangleMesh(vectors, o3d.utility.Vector3iVector([[0, 1, 7]]))
    edges = o3d.geometry.LineSet(vectors, o3d.utility.Vector2iVector([[0, 5]]))
    for wrong, said in ((mesh, "triangles hold the index 7"), (edges, "lines hold the index 5")):
        with pytest.raises(InvalidArgumentError, match=said):
            seen(opened(wrong))


def test_any_numbers_of_arrays_are_drawn():
    rows = o3d.utility.Vector3dVector
    for values in (np.nan, 255.0, -1.0):
        mesh = torus()
        mesh.vertex_colors = rows(np.full((len(mesh.vertices), 3), values))
        mesh.triangle_normals = rows(np.full((len(mesh.triangles), 3), values))
        assert seen(opened(mesh)).shape == (40, 60, 3)
        points = cloud(normals=True)
        points.normals = rows(np.zeros((len(points.points), 3)))
        points.colors = rows(np.full((3, 3), values))
        assert seen(opened(points)).shape == (40, 60, 3)


@pytest.mark.parametrize("name", ["point_sizes", "lights_on", "backgroundcolor", "ambient_light"])
def test_options_that_do_not_exist_are_refused(name):
    option = opened(ball()).get_render_option()
    with pytest.raises(AttributeError, match=f"RenderOption has no '{name}'"):
        setattr(option, name, 3)
    option.point_size = 3
    assert option.point_size == 3
