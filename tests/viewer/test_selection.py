"""Clicks select what shows; double clicks and the wheel go where the mouse is."""

import numpy as np
import pytest
from viewer.scripted_window import ScriptedWindow

import engine3d as e3d
from engine3d import events
from engine3d.apps.viewer.viewer import Viewer
from engine3d.stage.overlays.selection_outline import OUTLINE
from engine3d.stage.stage_settings import Settings
from engine3d.stage.view_renderer import ViewRenderer
from engine3d.stage.viewed_scene import ViewedScene

SIZE = (320, 240)


@pytest.fixture
def viewer():
    """A red box on the left, a sphere on the right, nothing between them."""
    scene = e3d.Scene((10, 20, 30))
    box = e3d.box()
    box.materials = [e3d.Material(color=(1.0, 0.0, 0.0), name="red")]
    scene.add(box, name="the box", translation=(-1.2, 0, 0))
    scene.add(e3d.uv_sphere(0.5), translation=(1.2, 0, 0))
    view_renderer = ViewRenderer(ViewedScene(scene, "two", azimuth=0.0), Settings({}), SIZE)
    return Viewer(view_renderer, ScriptedWindow(size=SIZE))


def place_of(viewer, name):
    """The pixel that shows the middle of an object."""
    viewer.draw()
    (node,) = (
        n
        for n in viewer.view_renderer.viewed.scene.nodes
        if n.name == name and n.bounds is not None
    )
    pixels, _ = viewer.frame.project(np.array(node.bounds).mean(axis=0))
    return [int(part) for part in pixels]


def click(viewer, x, y, clicks=1, button="left"):
    for down in (True, False):
        viewer.handle(events.MouseButton(button, down, x=x, y=y, clicks=clicks))


def outlined(viewer):
    viewer.draw()
    return (viewer.frame.color == OUTLINE).all(axis=2)


def test_a_click_selects_and_outlines_what_is_there(viewer):
    x, y = place_of(viewer, "the box")
    plain = viewer.frame.color.copy()
    assert not outlined(viewer).any()
    click(viewer, x, y)
    lines = viewer._selection()
    assert lines[0] == "the box" and lines[2] == "material red"
    assert lines[1] == f"face {viewer.selected.face_id} of 12"
    line = outlined(viewer)
    assert line.sum() > 200 and not line[:, 160:].any()
    inside = viewer.frame.object_id == viewer.selected.node.id
    assert inside.sum() > 2000 and not (line & inside).any()
    np.testing.assert_array_equal(viewer.frame.color[inside], plain[inside])
    near = np.argwhere(line)[:, np.newaxis] - np.argwhere(inside)
    assert np.abs(near).max(axis=2).min(axis=1).max() == 2
    click(viewer, 160, y)
    assert viewer.selected is None and not outlined(viewer).any()


def test_what_is_selected_is_told_in_a_corner(viewer):
    click(viewer, *place_of(viewer, "the box"))
    viewer.messages.said = ""
    viewer.draw()
    told = viewer.window.shown[-1]
    viewer.selected = None
    viewer.draw()
    assert (told[180:, 200:] != viewer.window.shown[-1][180:, 200:]).mean() > 0.3


def test_one_instance_of_many_is_selected():
    scene = e3d.Scene()
    poses = np.array([(x, 0, 0, 1) for x in (-3, 0, 3)], np.float32)
    scene.add(e3d.InstancedMesh(e3d.box(), poses), name="boxes")
    view_renderer = ViewRenderer(ViewedScene(scene, "boxes", azimuth=0.0), Settings({}), SIZE)
    viewer = Viewer(view_renderer, ScriptedWindow(size=SIZE))
    click(viewer, 160, 125)
    assert viewer._selection()[:2] == ["boxes", "instance 1 of 3"]
    line = outlined(viewer)
    assert line.any() and not line[:, :100].any() and not line[:, 220:].any()


def test_a_drag_selects_nothing_and_a_shaky_click_turns_nothing(viewer):
    x, y = place_of(viewer, "the box")
    viewer.handle(events.MouseButton("left", True, x=x, y=y))
    viewer.handle(events.MouseMotion(2, -2, x + 2, y - 2))
    np.testing.assert_array_equal(viewer.view.pose(), viewer.first_view.pose())
    viewer.handle(events.MouseButton("left", False, x=x + 2, y=y - 2))
    assert viewer.selected is not None
    viewer.selected = None
    viewer.handle(events.MouseButton("left", True, x=x, y=y))
    viewer.handle(events.MouseMotion(3, 0, x + 3, y))
    viewer.handle(events.MouseMotion(20, 0, x + 23, y))
    viewer.handle(events.MouseButton("left", False, x=x + 23, y=y))
    assert viewer.selected is None
    turned = viewer.first_view.azimuth - viewer.view.azimuth
    assert turned == pytest.approx(2 * np.pi * 23 / SIZE[1])


@pytest.mark.parametrize("orthographic", [False, True])
def test_a_double_click_brings_a_point_to_the_middle(viewer, orthographic):
    viewer.view.orthographic = orthographic
    x, y = place_of(viewer, "the box")
    hit = viewer.view_renderer.pick(viewer.view, 0.0, x, y)
    click(viewer, x, y, clicks=2)
    viewer.draw()
    pixels, _ = viewer.frame.project(hit.position)
    np.testing.assert_allclose(pixels, np.array(SIZE) / 2, atol=0.01)
    np.testing.assert_array_equal(viewer.view.target, hit.position)
    before = viewer.view.copy()
    click(viewer, 2, 2, clicks=2)
    np.testing.assert_array_equal(viewer.view.pose(), before.pose())


@pytest.mark.parametrize("orthographic", [False, True])
def test_the_wheel_zooms_to_where_the_mouse_is(viewer, orthographic):
    viewer.view.orthographic = orthographic
    viewer.draw()
    right, up, _ = viewer.view.rotation().T
    point = viewer.view.target + right * 0.7 + up * 0.3
    at, _ = viewer.frame.project(point)
    viewer.handle(events.Wheel(6, *at))
    viewer.draw()
    np.testing.assert_allclose(viewer.frame.project(point)[0], at, atol=0.01)
    assert viewer.view.distance < 0.8 * viewer.first_view.distance
    viewer.handle(events.Wheel(-6, *at))
    np.testing.assert_allclose(viewer.view.target, viewer.first_view.target, atol=1e-12)


def test_a_key_chooses_which_way_is_up(viewer):
    staging = viewer.view_renderer.staging
    staging.show_grid(True)
    added = len(staging.scene.beside.nodes)
    for name, shift, up in [("Z", False, "+Z"), ("Z", True, "-Z"), ("Y", False, "+Y")]:
        viewer.handle(events.KeyDown(name, name, control=True, shift=shift))
        assert staging.up == up
        axis = viewer.view.up
        assert (axis[1], axis[2]) == {"+Z": (0, 1), "-Z": (0, -1), "+Y": (1, 0)}[up]
        assert viewer.first_view.up == axis
        assert len(staging.scene.beside.nodes) == added
        grid = staging.scene.beside.find("grid").object.positions
        assert np.ptp(grid @ np.array(axis)) < 1e-6


def test_another_file_forgets_the_selection(viewer, tmp_path):
    path = tmp_path / "triangle.obj"
    path.write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
    click(viewer, *place_of(viewer, "the box"))
    viewer.opening.open([str(path)])
    assert viewer.selected is None
    viewer.draw()


def test_which_way_is_up_is_chosen_for_one_model_only(viewer, tmp_path):
    path = tmp_path / "triangle.obj"
    path.write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
    viewer.handle(events.KeyDown("Z", "Z", control=True))
    viewer.opening.open([str(path)])
    assert viewer.view_renderer.staging.up == "+Y" and viewer.view.up == (0, 1, 0)


def test_a_click_on_what_is_too_far_away_selects_nothing():
    scene = e3d.Scene()
    scene.add(e3d.Mesh(np.float32([(1e30, 0, 0), (1e30, 0, 0), (1e30, 1, 0)]), [(0, 1, 2)]))
    view_renderer = ViewRenderer(ViewedScene(scene, "far"), Settings({}), SIZE)
    viewer = Viewer(view_renderer, ScriptedWindow(size=SIZE))
    for kind in ("perspective", "orthographic"):
        viewer.view.orthographic = kind == "orthographic"
        viewer.select(160, 120)
        viewer.focus(160, 120)
        assert viewer.selected is None
