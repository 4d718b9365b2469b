"""The grid, the icons of what has no surface, views along the axes, and through cameras."""

import numpy as np
import pytest
from editor.ui.editor_hands import click, do, drag, find, press, scene_corner, settle

import engine3d as e3d
from engine3d import events
from engine3d.apps.editor.ui.keys_window import KeysWindow
from engine3d.apps.editor.ui.overlays import place_of_name
from engine3d.apps.editor.ui.view.clickable_axes import MARGIN
from engine3d.apps.editor.ui.view.ground_grid import GroundGrid, grid_sphere
from engine3d.apps.editor.ui.view.standard_views import STANDARD_VIEWS
from engine3d.stage.overlays.axes_ball import RADIUS, BallPlace, tips
from engine3d.stage.overlays.selection_outline import OUTLINE
from engine3d.stage.views.viewpoint import Viewpoint


@pytest.fixture
def fresh(editor):
    """An editor with a new scene."""
    editor.workspace.new()
    editor.workspace.panels.offers_start = False
    settle(editor)
    return editor


def test_the_grid_lies_below_things_and_is_no_node(fresh):
    scene, shown = fresh.workspace.scene, fresh._scene._overlays.shown
    box = scene.add(e3d.box(), translation=(0, 0.5, 0))
    plain = settle(fresh) * 0 + fresh._pixels
    shown["grid"] = True
    with_grid = settle(fresh)
    changed = (with_grid != plain).any(-1)
    assert changed.sum() > 500
    ids = fresh._scene._frame.object_id
    x, y = scene_corner(fresh)
    height, width = ids.shape
    inside = (ids == box.id)[2:-2, 2:-2]
    assert (
        not (changed[y : y + height, x : x + width][2:-2, 2:-2] & inside).sum()
        > 0.02 * inside.sum()
    )
    rows, columns = np.nonzero(ids > box.id)
    assert len(rows) > 100
    click(fresh, x + columns[0], y + rows[0])
    assert fresh.workspace.document.selection.nodes == ()
    assert len(scene.nodes) == 3


def test_the_grid_parts_neither_outlines_nor_clicks(fresh):
    workspace = fresh.workspace
    box = workspace.scene.add(e3d.box(), scale=2.0)  # half of it is below the ground
    fresh._scene._overlays.shown["grid"] = True
    workspace.document.selection.set([box])
    settle(fresh)
    x, y = scene_corner(fresh)
    frame = fresh._scene._frame
    lines, inside = frame.object_id > box.id, frame.object_id == box.id
    rows, columns = np.nonzero(inside)
    middle = (
        slice(rows.mean().astype(int), rows.max() - 20),
        slice(*np.percentile(columns, (30, 70)).astype(int)),
    )
    crossing = lines[middle]
    assert crossing.sum() > 50
    assert not (frame.color[middle] == OUTLINE).all(-1).any()
    row, column = (
        places[0] + part.start for places, part in zip(np.nonzero(crossing), middle, strict=True)
    )
    workspace.document.selection.set()
    click(fresh, x + column, y + row)
    assert workspace.document.selection.nodes == (box,)


def test_the_grid_rests_until_the_view_is_twice_as_far(editor):
    view, grid, scene = Viewpoint(np.zeros(3), 9.0), GroundGrid(), e3d.Scene()
    first = [id(node) for node in grid.beside(scene, view).beside.nodes]
    view.distance, view.azimuth = 15.0, 2.0
    assert [id(node) for node in grid.beside(scene, view).beside.nodes] == first
    view.distance = 17.0
    assert [id(node) for node in grid.beside(scene, view).beside.nodes] != first
    assert grid_sphere(view).radius == 8.0


@pytest.mark.parametrize("name", STANDARD_VIEWS)
def test_keys_look_along_the_axes(fresh, name):
    key = STANDARD_VIEWS[name][2]
    press(fresh, key[-1], control=key.startswith("Ctrl"))
    ahead = {
        "Front": (0, 0, -1),
        "Back": (0, 0, 1),
        "Right": (-1, 0, 0),
        "Left": (1, 0, 0),
        "Top": (0, -1, 0),
        "Bottom": (0, 1, 0),
    }[name]
    assert (-fresh.workspace.view.rotation()[:, 2]).round(9).tolist() == list(ahead)


def test_the_picture_through_a_camera_is_its_own(fresh):
    workspace = fresh.workspace
    workspace.scene.add(e3d.box(), translation=(0, 0.5, 0))
    camera = find(fresh, "camera")
    settle(fresh)
    x, y = scene_corner(fresh)
    press(fresh, "0")
    settle(fresh)
    frame = fresh._scene._frame
    size = frame.width, frame.height
    drawn = e3d.render(workspace.scene, camera, size=size, samples=4, look="plain").color
    assert np.array_equal(frame.color, drawn)
    own = workspace.view.yfov
    drag(fresh, "middle", (x + 50, y + 50), (x + 60, y + 50))
    assert workspace.through.node is None and workspace.view.yfov != own
    assert np.allclose(np.linalg.norm(workspace.view.position()), 3.7, atol=0.7)
    press(fresh, "0")
    press(fresh, "0")
    assert workspace.through.node is None
    press(fresh, "0")
    workspace.scene.remove(camera)
    settle(fresh)
    assert workspace.through.node is None and not fresh._told
    press(fresh, "0")
    assert "no camera" in workspace.console.entries[-1].text


def test_a_selected_camera_shows_what_it_sees(fresh):
    fresh.workspace.scene.add(e3d.box(), translation=(0, 0.5, 0))
    fresh.workspace.document.selection.set([find(fresh, "camera")])
    before = settle(fresh)
    fresh._scene._overlays.shown["preview"] = True
    changed = (settle(fresh) != before).any(-1)
    rows, columns = np.nonzero(changed)
    assert changed.sum() > 2000 and np.ptp(columns) < 260 and np.ptp(rows) < 160
    preview = fresh._scene._preview
    drawn = preview._drawn
    settle(fresh)
    assert preview._drawn is drawn, "it is drawn once"


@pytest.mark.parametrize(
    "pixel, place",
    [
        ((50.0, 40.0), (60.0, 35.0)),
        ((0.0, 0.0), (10.0, 0.0)),
        ((95.0, 79.5), (55.0, 70.0)),  # to the left, where there is room
        ((-9.0, 40.0), (1.0, 35.0)),  # half of the icon shows
        ((-11.0, 40.0), None),
        ((50.0, 91.0), None),
    ],
)
def test_names_are_not_cut_by_the_edge_of_the_picture(pixel, place):
    assert place_of_name(pixel, (30.0, 10.0), (100, 80), 10.0) == place


def test_an_empty_is_seen_and_clicked(fresh):
    workspace = fresh.workspace
    empty = workspace.scene.add(name="place", translation=(0.5, 0.0, 0.0))
    before = settle(fresh)
    fresh._scene._overlays.shown |= {"icons": True, "names": True}
    assert (settle(fresh) != before).any()
    pixel, _ = fresh._scene._frame.project(empty.world_pose[:3, 3])
    fresh._scene._overlays.shown |= {"icons": False, "names": False}
    settle(fresh)
    x, y = np.add(scene_corner(fresh), pixel)
    click(fresh, x, y)
    assert workspace.document.selection.nodes == (empty,)
    workspace.scene.add(e3d.box(), parent=empty, translation=(5, 0, 0))
    workspace.document.selection.set()
    click(fresh, x, y)
    assert workspace.document.selection.nodes == (), "groups do not stand in the way"


def test_the_start_is_offered_and_goes(editor, monkeypatch, tmp_path):
    workspace = editor.workspace
    press(editor, "N", control=True)
    assert workspace.panels.offers_start
    settle(editor)
    press(editor, "Escape")
    assert not workspace.panels.offers_start
    press(editor, "N", control=True)
    settle(editor)
    workspace.document.do(_adding(workspace.scene))
    settle(editor)
    assert not workspace.panels.offers_start, "work has begun"


def _adding(scene):
    from engine3d.apps.editor.node_commands import AddNodes

    return AddNodes(scene, lambda scene: scene.add(name="x"), "Add")


def test_a_start_is_chosen_with_the_mouse(editor):
    workspace = editor.workspace
    press(editor, "N", control=True)
    settle(editor)
    x, y = (side // 2 for side in editor.window.size)
    for dy in range(-120, 120, 8):
        if workspace.panels.offers_start:
            do(editor, events.MouseMotion(0, 0, x, y + dy))
            if workspace.panels.offers_start:
                click(editor, x, y + dy)
    assert not workspace.panels.offers_start
    assert [node.name for node in workspace.scene.nodes] == ["key light", "camera"]
    assert not workspace.document.is_modified


def test_the_list_of_keys_opens_and_closes(editor):
    before = settle(editor)
    press(editor, "F1")
    opened = settle(editor)
    assert (opened != before).sum() > 10_000
    press(editor, "Escape")
    assert (settle(editor) == before).all()
    (keys,) = (one for one in editor._dialogs if isinstance(one, KeysWindow))
    menus = {menu for _, _, menu in keys._rows}
    assert menus == {"File", "Edit", "View", "Tools", "Motion", "Window", "Help"}


def test_a_click_on_the_ball_of_axes_looks_along_one(fresh):
    workspace = fresh.workspace
    workspace.document.selection.set([find(fresh, "camera")])
    fresh._scene._overlays.shown["ball"] = True
    x, y = scene_corner_without_ball(fresh)
    frame = fresh._scene._frame
    radius = RADIUS
    place = BallPlace(x + frame.width - MARGIN - radius, y + MARGIN + radius, radius)
    for name, ahead in (("+X", (-1, 0, 0)), ("+Y", (0, -1, 0)), ("-Z", (0, 0, 1))):
        workspace.view.azimuth, workspace.view.elevation = 0.5, 0.3
        settle(fresh)
        tip = next(tip for tip in tips(workspace.view.rotation(), place) if tip.name == name)
        before = settle(fresh)
        do(fresh, events.MouseMotion(0, 0, int(tip.x), int(tip.y)))
        assert (settle(fresh) != before).any(), "it lights up"
        click(fresh, tip.x, tip.y)
        assert (-workspace.view.rotation()[:, 2]).round(9).tolist() == list(ahead)
    assert workspace.document.selection.active.name == "camera", "nothing was selected"


def scene_corner_without_ball(editor):
    shown = editor._scene._overlays.shown
    shown["ball"] = False
    settle(editor)
    corner = scene_corner(editor)
    shown["ball"] = True
    settle(editor)
    return corner
