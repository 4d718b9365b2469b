"""The light's direction, turning it; textures off; clip planes; what frozen counters show."""

import numpy as np
import pytest
from viewer.scripted_window import ScriptedWindow

import engine3d as e3d
from engine3d import events
from engine3d.apps.viewer.viewer import Viewer
from engine3d.stage.stage_settings import Settings
from engine3d.stage.view_renderer import ViewRenderer
from engine3d.stage.viewed_scene import ViewedScene

SIZE = (96, 72)


def ball(light=None):
    scene = e3d.Scene((0, 0, 0))
    mesh = e3d.uv_sphere(1.0, (32, 16))
    mesh.materials = [e3d.Material(texture=e3d.Texture(np.full((2, 2, 3), (255, 0, 0), np.uint8)))]
    scene.add(mesh)
    if light is not None:
        scene.add(light)
    return ViewedScene(scene, "ball", azimuth=0.0, elevation=0.0)


def make_viewer(viewed=None, **settings):
    view_renderer = ViewRenderer(viewed or ball(), Settings({"cull": "back"}, **settings), SIZE)
    return Viewer(view_renderer, ScriptedWindow(size=SIZE))


def brightest(viewer):
    """Where on the ball most light falls, as x and y from its middle, in parts of the picture."""
    red = viewer.view_renderer.draw(viewer.view).color[..., 0].astype(int)
    rows, columns = np.nonzero(red > 0.98 * red.max())
    return columns.mean() / SIZE[0] - 0.5, 0.5 - rows.mean() / SIZE[1]


@pytest.mark.parametrize(
    ("direction", "x", "y"), [((-1, 0, -0.3), 1, 0), ((1, 0, -0.3), -1, 0), ((0, -1, -0.3), 0, 1)]
)
def test_light_comes_from_where_it_is_said_to(direction, x, y):
    found = brightest(make_viewer(light_direction=direction))
    for part, expected in zip(found, (x, y), strict=True):
        assert abs(part) < 0.05 if expected == 0 else part * expected > 0.15


@pytest.mark.parametrize("name", ["headlight", "sun", "directed light"])
def test_a_drag_turns_the_light_with_the_hand(name):
    direction = (0, 0, -1) if name == "directed light" else None
    viewer = make_viewer(light_direction=direction)
    viewer.view_renderer.lighting.choose(name)
    before = brightest(viewer)
    viewer.handle(events.MouseButton("right", True, shift=True))
    viewer.handle(events.MouseMotion(9, 0))
    right = brightest(viewer)
    assert right[0] > before[0] + 0.04
    viewer.handle(events.MouseMotion(0, 9))
    assert brightest(viewer)[1] < right[1] - 0.05
    viewer.handle(events.MouseButton("right", False))
    np.testing.assert_array_equal(viewer.view.pose(), viewer.first_view.pose())


@pytest.mark.parametrize("own", [True, False])
def test_lights_that_stay_say_so(own):
    viewer = make_viewer(
        ball(e3d.PointLight()) if own else None, light_position=None if own else (3, 0, 0)
    )
    before = viewer.view_renderer.draw(viewer.view).color.copy()
    viewer.handle(events.MouseButton("right", True, control=True))
    viewer.handle(events.MouseMotion(20, 0))
    assert "cannot be turned" in viewer.messages.said
    np.testing.assert_array_equal(viewer.view_renderer.draw(viewer.view).color, before)


def test_textures_can_be_left_out_and_come_back():
    viewed = ball()
    (material,) = viewed.scene.nodes[0].object.materials
    texture = material.texture
    viewer = make_viewer(viewed)
    plain = viewer.view_renderer.draw(viewer.view).color
    viewer.handle(events.KeyDown("T", "T"))
    grey = viewer.view_renderer.draw(viewer.view).color
    assert not plain[..., 1].any() and grey[..., 1].max() > 200
    viewer.handle(events.KeyDown("T", "T"))
    np.testing.assert_array_equal(viewer.view_renderer.draw(viewer.view).color, plain)
    viewer.handle(events.KeyDown("T", "T"))
    assert material.texture is texture


def test_the_light_can_be_clamped_and_the_planes_placed():
    viewer = make_viewer(light_clamp=(0.5, 0.5))
    colors = np.unique(viewer.view_renderer.draw(viewer.view).color[..., 0])
    assert colors.tolist() == [0, 188]
    near = make_viewer(near=viewer.view.distance - 0.5).view_renderer
    far = make_viewer(far=viewer.view.distance - 0.9).view_renderer
    whole = (viewer.view_renderer.draw(viewer.view).color[..., 0] > 0).sum()
    parts = [(one.draw(viewer.view).color[..., 0] > 0) for one in (near, far)]
    assert not parts[0][36, 48] and parts[1][36, 48]
    assert 0 < parts[1].sum() < whole
    with pytest.raises(e3d.InvalidArgumentError, match="must be nearer than the far one"):
        make_viewer(near=1e6).draw()


def test_counters_and_the_log_stand_still_while_culling_is_frozen():
    reported = []
    scene = e3d.Scene()
    for x in range(9):
        scene.add(e3d.box(), translation=(3 * x, 0, 0))
    view_renderer = ViewRenderer(
        ViewedScene(scene, "row"), Settings({}), SIZE, report=reported.append
    )
    viewer = Viewer(view_renderer, ScriptedWindow(size=SIZE), statistics=True)
    viewer.draw()
    told, count = viewer.statistics_lines()[2:], len(reported)
    viewer.handle(events.KeyDown("C", "C"))
    viewer.view.distance /= 20
    viewer.draw()
    assert viewer.statistics_lines()[2:] == told and len(reported) == count
    viewer.handle(events.KeyUp("C", "C"))
    viewer.draw()
    assert viewer.statistics_lines()[2:] != told and len(reported) == count + 1


def test_ways_of_culling_give_one_picture_and_their_own_counts():
    scene = e3d.Scene()
    for x in range(40):
        scene.add(e3d.box(), translation=(3 * x, 0, 0))
    viewer = Viewer(
        ViewRenderer(ViewedScene(scene, "row"), Settings({}), SIZE), ScriptedWindow(size=SIZE)
    )
    viewer.view.look_from((0, 0, 6), (0, 0, 0))
    pictures, counts = [], {}
    tested, told = {}, {}
    viewer.statistics = "long"
    for _ in range(5):
        viewer.handle(events.KeyDown("Y", "Y"))
        viewer.messages.said = ""
        viewer.draw()
        view_renderer = viewer.view_renderer
        pictures.append(view_renderer.draw(viewer.view).color.copy())
        culling = view_renderer.appearance.culling
        counts[culling] = view_renderer.stats["nodes_drawn"]
        tested[culling] = view_renderer.stats["boxes_tested"]
        told[culling] = next(
            line for line in viewer.statistics_lines() if line.startswith("culling")
        )
    assert all((picture == pictures[0]).all() for picture in pictures)
    assert set(counts) == {"all", "tree", "frustum", "none", "always"}
    assert counts["none"] == 40 > counts["frustum"] == counts["tree"] >= counts["all"]
    assert tested["frustum"] == 40 > tested["tree"] == tested["all"] > tested["none"] == 0
    assert told["frustum"] == "culling frustum: 40 boxes tested, one by one"
    assert told["tree"] == f"culling tree: {tested['tree']} boxes tested, by the tree"
    assert told["none"] == "culling none: nothing is left out: no box was tested"
