"""Walking on the ground of any model, whichever axis is up, and not through its walls."""

import math

import numpy as np
import pytest
from viewer.scripted_window import ScriptedWindow

import engine3d as e3d
from engine3d import events
from engine3d.apps.viewer.viewer import Viewer
from engine3d.stage.stage_settings import Settings
from engine3d.stage.view_renderer import ViewRenderer
from engine3d.stage.viewed_scene import ViewedScene
from engine3d.stage.views.walkable_ground import MOST_CELLS, find_ground, told
from engine3d.stage.views.walking import GroundController, controller

SIZE = (64, 48)


def room(scale=1.0, up="+Y"):
    """A floor of 20 x 20 in a scene, and a wall across it at a depth of 3; a ramp of 30 degrees."""
    scene = e3d.Scene()
    turned = np.eye(4)
    turned[:3, :3] *= scale
    if up == "+Z":
        turned = np.array([[1, 0, 0, 0], [0, 0, -1, 0], [0, 1, 0, 0], [0, 0, 0, 1.0]]) @ turned
    group = scene.add(pose=turned)
    floor = e3d.plane((20, 20))
    floor.materials = [e3d.Material(name="floor")]
    scene.add(floor, parent=group)
    wall = e3d.box((20, 4, 0.2))
    wall.materials = [e3d.Material(name="wall")]
    scene.add(wall, parent=group, translation=(0, 2, -3))
    ramp = e3d.plane((4, 4))
    ramp.materials = [e3d.Material(name="ramp")]
    half = math.radians(15)
    tilt = (math.sin(half), 0, 0, math.cos(half))
    scene.add(ramp, parent=group, translation=(-7, 1, 7), rotation=tilt)
    return ViewedScene(scene, "room.obj", up=up)


def walker_in(viewed, **settings):
    view_renderer = ViewRenderer(viewed, Settings({}, walks=True, **settings), SIZE)
    view = view_renderer.view()
    view.azimuth, view.elevation = 0.0, 0.3
    return controller(view_renderer, view), view_renderer, view


@pytest.mark.parametrize("up", ["+Y", "+Z"])
@pytest.mark.parametrize("scale", [0.01, 1.0, 1000.0])
def test_one_walks_up_to_a_wall_and_no_further(scale, up):
    walker, view_renderer, _ = walker_in(room(scale, up))
    assert isinstance(walker, GroundController)
    axis, ahead = {"+Y": (1, (0, 0, -1)), "+Z": (2, (0, 1, 0))}[up]
    metre = walker.position[axis] / 1.7
    radius = view_renderer.bounds.radius
    assert radius / 400 * 0.999 <= metre <= radius / 4
    way = []
    for _ in range(200):
        walker.walk({"W"}, 0.5)
        way.append(float(np.dot(walker.position, ahead)) / scale)
    assert 1.5 < way[-1] < 2.9 and max(way) < 2.9
    assert walker.position[axis] == pytest.approx(1.7 * metre, rel=0.01)


def test_a_name_that_no_material_has_is_told():
    viewed = room()
    view = ViewRenderer(viewed, Settings({}), SIZE).view()
    names = {m.name for node in viewed.scene.nodes for m in getattr(node.object, "materials", ())}
    known = next(name for name in sorted(names) if len(name) > 3)
    with pytest.warns(e3d.Engine3DWarning) as told:
        find_ground(viewed.scene, viewed.bounds, view, walkable=(*names, "nosuch", known + "x"))
    assert [str(one.message) for one in told] == [
        "walkable: no material is called 'nosuch'",
        f"walkable: no material is called {known + 'x'!r}: did you mean {known}?",
    ]


def test_only_some_materials_and_slopes_are_walked_on():
    def standing(**options):
        viewed = room()
        view = ViewRenderer(viewed, Settings({}), SIZE).view()
        grid = find_ground(viewed.scene, viewed.bounds, view, **options).walker.grid
        return grid.sample_ground(np.array([0.0, -7.0]), np.array([5.0, 7.0]))[1].tolist()

    assert standing() == [True, True]
    assert standing(slope=math.radians(20)) == [True, False]
    assert standing(walkable=("ramp",)) == [False, True]
    assert standing(walkable=("floor",)) == [True, False]


def test_the_grid_is_told_and_has_not_too_many_cells():
    viewed = room(1000.0)
    view = ViewRenderer(viewed, Settings({}), SIZE).view()
    grid = find_ground(viewed.scene, viewed.bounds, view).walker.grid
    assert max(grid.shape) <= MOST_CELLS + 1
    rows, columns = grid.shape
    assert told(grid).startswith(f"navigation grid: {columns} x {rows} = {rows * columns:,} cells")


def viewer_of(viewed, **settings):
    view_renderer = ViewRenderer(viewed, Settings({}, **settings), SIZE)
    return Viewer(view_renderer, ScriptedWindow(size=SIZE))


def test_tab_walks_on_the_ground_where_that_was_asked_for():
    for walks in (True, False):
        viewer = viewer_of(room(), walks=walks)
        viewer.handle(events.KeyDown("Tab", "Tab"))
        assert isinstance(viewer.walker, GroundController) == walks
        assert ("navigation grid" in viewer.messages.said) == walks
        viewer.draw()


@pytest.mark.parametrize("settings", [{"walkable": ("water",)}, {}])
def test_where_there_is_no_ground_one_flies_and_is_told(settings):
    viewed = room()
    if not settings:
        viewed = ViewedScene(e3d.Scene(), "nothing")
    viewer = viewer_of(viewed, walks=True, **settings)
    viewer.handle(events.KeyDown("Tab", "Tab"))
    assert viewer.walker is not None and not isinstance(viewer.walker, GroundController)
    assert "no ground" in viewer.messages.said


def test_scenes_that_move_are_flown_through():
    viewed = room()
    viewed.update = lambda time: None
    assert not isinstance(walker_in(viewed)[0], GroundController)
