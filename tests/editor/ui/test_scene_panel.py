"""What hands do in the picture of the scene: they select, move the camera, and drag the gizmo."""

import numpy as np
import pytest
from editor.ui.editor_hands import (
    SIZE,
    click,
    do,
    drag,
    find,
    middle_of,
    press,
    scene_corner,
    settle,
)

import engine3d as e3d
from engine3d import events
from engine3d.model.scene.lights import LIGHTS


def test_the_scene_is_shown_to_the_byte_between_the_panels(editor):
    x, y = scene_corner(editor)
    height, width = editor._scene._frame.color.shape[:2]
    assert x > 100 and y > 20 and x + width < SIZE[0] - 100
    assert height > 200 and len(np.unique(editor._pixels[:, :x].reshape(-1, 4), axis=0)) > 50


def shown(editor):
    """Return the pixels of the window where the scene is, and what `render` draws there."""
    frame, (x, y) = editor._scene._frame, scene_corner(editor)
    size = frame.width, frame.height
    drawn = e3d.render(
        editor.workspace.scene,
        editor.workspace.camera(),
        size=size,
        look=editor.workspace.display.worn_look,
    )
    return editor._pixels[y : y + size[1], x : x + size[0]], drawn.color


def put_out(workspace):
    """Take all light from the scene."""
    for node in list(workspace.scene.nodes):
        if isinstance(node.object, LIGHTS):
            workspace.scene.remove(node)
    workspace.scene.ambient = (0, 0, 0)
    workspace.changes += 1


@pytest.mark.parametrize("look", ["studio", "plain", None])
@pytest.mark.parametrize("is_lit", [False, True])
def test_the_view_as_rendered_is_what_render_draws(editor, look, is_lit):
    workspace = editor.workspace
    if not is_lit:
        put_out(workspace)
    before = editor._scene._frame.color.copy()
    workspace.display.look, workspace.display.as_rendered, workspace.display.wireframe = (
        look,
        True,
        True,
    )
    workspace.tools.chosen = "move"
    workspace.document.selection.set([find(editor, "Smoke")])
    for orthographic in (False, True):
        workspace.view.orthographic = orthographic
        settle(editor)
        window, drawn = shown(editor)
        assert np.array_equal(window, drawn)
        assert is_lit or not np.array_equal(before, drawn) or workspace.display.worn_look == "plain"
    click(editor, *middle_of(editor, find(editor, "Cab")))
    assert workspace.document.selection.nodes == (find(editor, "Cab"),)
    height, width = drawn.shape[:2]
    x, y = scene_corner(editor)
    for place in ((10, height - 10), (width - 10, height - 10), (width // 2, height - 5)):
        click(editor, x + place[0], y + place[1])  # perhaps on the ground, which is no node
    settle(editor)
    assert np.array_equal(*shown(editor))


def test_a_look_dresses_the_view_that_one_works_in(editor):
    workspace = editor.workspace
    put_out(workspace)
    pictures = []
    for look in (None, "studio", "plain"):
        for mode in ("lit", "normal"):
            workspace.display.look, workspace.display.mode = look, mode
            settle(editor)
            pictures.append(editor._scene._frame.color.tobytes())
    assert pictures[:2] == pictures[4:]
    assert not {*pictures[:2]} & {*pictures[2:4]}
    workspace.document.selection.set([find(editor, "Smoke")])
    workspace.display.look, workspace.display.mode = "studio", "lit"
    settle(editor)
    assert editor._scene._frame.color.tobytes() not in pictures  # it has an outline


def test_a_click_in_the_scene_selects(editor):
    selection = editor.workspace.document.selection
    smoke, cab = find(editor, "Smoke"), find(editor, "Cab")
    click(editor, *middle_of(editor, smoke))
    assert selection.nodes == (smoke,)
    click(editor, *middle_of(editor, cab), shift=True)
    assert selection.nodes == (smoke, cab)
    x, y = scene_corner(editor)
    click(editor, x + 20, y + 20)
    assert selection.nodes == ()


def test_a_rectangle_in_the_scene_selects_what_shows_in_it(editor):
    smoke = find(editor, "Smoke")
    x, y = middle_of(editor, smoke)
    drag(editor, "left", (x - 3, y - 6), (x + 2, y), (x + 6, y + 6))
    assert editor.workspace.document.selection.nodes == (smoke,)


def test_the_middle_button_turns_the_camera_and_the_wheel_approaches(editor):
    view = editor.workspace.view
    x, y = (side // 2 for side in SIZE)
    azimuth, elevation, distance = view.azimuth, view.elevation, view.distance
    drag(editor, "middle", (x, y - 100), (x + 10, y - 95))
    assert view.azimuth < azimuth and view.elevation > elevation
    do(editor, events.Wheel(2.0, x, y - 100))
    assert view.distance < distance


def test_the_right_button_looks_around_and_keys_fly(editor):
    view = editor.workspace.view
    x, y = scene_corner(editor)
    position, target = view.position(), view.target.copy()
    drag(editor, "right", (x + 90, y + 90), (x + 130, y + 80))
    assert np.allclose(view.position(), position) and not np.allclose(view.target, target)
    ahead = -view.rotation()[:, 2]
    position = view.position()
    do(editor, events.MouseButton("right", True, x=x + 90, y=y + 90))
    do(editor, events.KeyDown("W", "W"))
    assert editor._scene.is_flying and editor._pictures_due
    do(editor, events.KeyUp("W", "W"), events.MouseButton("right", False, x=x + 90, y=y + 90))
    moved = view.position() - position
    assert np.allclose(moved / np.linalg.norm(moved), ahead)
    assert editor.workspace.tools.chosen == "select"


def test_a_drag_of_the_gizmo_is_one_step(editor):
    workspace = editor.workspace
    cab = find(editor, "Cab")
    workspace.document.selection.set([cab])
    press(editor, "W")
    pixel, _ = editor._scene._frame.project(cab.world_pose[:3, 3])
    x, y = np.add(scene_corner_of_gizmo(editor), pixel).astype(int)
    drag(editor, "left", (x, y), (x + 9, y - 4), (x + 20, y - 9))
    assert np.abs(cab.translation).max() > 0.1
    assert workspace.document.history.position == 1
    assert workspace.document.selection.nodes == (cab,)
    assert np.array_equal(cab.world_pose[:3, :3], np.eye(3))
    press(editor, "Z", control=True)
    assert np.array_equal(cab.world_pose, np.eye(4))


@pytest.mark.parametrize("azimuth", [0.5, 0.5 + np.pi])
def test_the_red_arrow_points_along_x_from_everywhere(editor, azimuth):
    workspace, cab = editor.workspace, find(editor, "Cab")
    workspace.document.selection.set([cab])
    workspace.view.azimuth = azimuth
    corner = scene_corner_of_gizmo(editor)
    plain = settle(editor).astype(int)
    press(editor, "W")
    picture = settle(editor).astype(int)
    is_red = picture[..., 0] - picture[..., 1:3].max(-1) > 60
    red = is_red & (np.abs(picture - plain).max(-1) > 20)
    red[: int(corner[1])] = red[:, : int(corner[0])] = False  # beside the scene
    center, tip = (
        editor._scene._frame.project(place)[0]
        for place in (cab.world_pose[:3, 3], cab.world_pose[:3, 3] + cab.world_pose[:3, 0])
    )
    rows, columns = np.nonzero(red)
    drawn = np.array([columns.mean(), rows.mean()]) - corner - center
    assert red.sum() > 20 and drawn @ (np.array(tip) - center) > 0


def scene_corner_of_gizmo(editor):
    """The scene's corner, found before the gizmo was drawn over it."""
    tool, editor.workspace.tools.chosen = editor.workspace.tools.chosen, "select"
    settle(editor)
    corner = scene_corner(editor)
    editor.workspace.tools.chosen = tool
    settle(editor)
    return corner


def test_what_can_be_shown_over_the_scene_is_drawn_and_stays_within_it(editor):
    overlays, workspace = editor._scene._overlays, editor.workspace
    workspace.document.selection.set([find(editor, "Cab"), find(editor, "Camera01")])
    find(editor, "Cab").collider = e3d.colliders.BoxCollider()
    workspace.orbit.dolly(-12)
    overlays.shown = dict.fromkeys(overlays.shown, False)
    plain = settle(editor)
    x, y = scene_corner(editor)
    for name in overlays.shown:
        overlays.shown = dict.fromkeys(overlays.shown, False) | {name: True}
        changed = (settle(editor) != plain).any(-1)
        assert changed.sum() > 20, name
        height, width = editor._scene._frame.color.shape[:2]
        changed[y : y + height, x : x + width] = False
        assert not changed.any()
