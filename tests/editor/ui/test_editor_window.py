"""The editor's window, driven by events: what one clicks and types changes the scene."""

import functools
import os
import subprocess
import sys
import time

import numpy as np
import pytest

import engine3d as e3d
from engine3d import data, events

pytest.importorskip(
    "imgui_bundle", reason="it is an extra: pip install -e .[editor]", exc_type=ImportError
)

from importlib.resources import files

from engine3d.apps.editor.ui import fog_fields
from engine3d.apps.editor.ui.editor_window import SETTLING, EditorWindow
from engine3d.apps.editor.ui.panel_layout import layout_path, load_layout, save_layout
from engine3d.apps.editor.ui.properties_panel import _COLLIDERS, _KINDS
from engine3d.apps.editor.ui.workspace import Workspace
from engine3d.apps.editor.value_commands import SetValues
from engine3d.model.scene.fog import ExponentialFog, Fog

SIZE = (1000, 640)
STUBBORN = "exec('while True:\\n try:\\n  while True: pass\\n except BaseException: pass')"


@pytest.fixture
def editor(monkeypatch, tmp_path):
    monkeypatch.setenv("SDL_VIDEODRIVER", "dummy")
    for variable in ("XDG_STATE_HOME", "XDG_CACHE_HOME"):
        monkeypatch.setenv(variable, str(tmp_path / variable))
    path = files(data) / "models" / "train.asc"
    with EditorWindow(str(path), size=SIZE) as editor:
        editor.window.present = lambda pixels: None  # nobody looks, and nobody waits for a screen
        editor._scene._overlays.shown["marks"] = False
        editor._scene._draw_times = lambda corner: None
        settle(editor)
        yield editor


def settle(editor):
    """Draw until nothing changes any more; return the picture."""
    for _ in range(SETTLING):
        editor._pictures_due = 1
        editor.turn(0.0)
    return editor._pixels.copy()


def do(editor, *happened):
    """Let things happen, each a picture after the last one."""
    for event in happened:
        editor._take(event)
        settle(editor)


def press(editor, key, *, control=False, shift=False):
    held = ["Left Ctrl"] * control + ["Left Shift"] * shift
    downs = [*(events.KeyDown(name, name, shift, control) for name in held)]
    ups = [events.KeyUp(name, name) for name in held]
    do(editor, *downs, events.KeyDown(key, key, shift, control), events.KeyUp(key, key), *ups)


def click(editor, x, y, *, shift=False):
    at = {"x": int(x), "y": int(y)}
    if shift:
        do(editor, events.KeyDown("Left Shift", "Left Shift", True))
    do(editor, events.MouseMotion(0, 0, **at))
    do(editor, *(events.MouseButton("left", down, shift, **at) for down in (True, False)))
    if shift:
        do(editor, events.KeyUp("Left Shift", "Left Shift"))


def drag(editor, button, *places):
    (x, y), *others = places
    do(editor, events.MouseMotion(0, 0, x, y), events.MouseButton(button, True, x=x, y=y))
    do(editor, *(events.MouseMotion(0, 0, *place) for place in others))
    x, y = places[-1]
    do(editor, events.MouseButton(button, False, x=x, y=y))


def scene_corner(editor):
    """Where the picture of the scene is in the window: it is there byte for byte."""
    shown, scene = editor._pixels, editor._scene._frame.color
    height, width = scene.shape[:2]
    first = scene[height // 2].view(np.uint32)[:, 0]
    for y in range(shown.shape[0] - height + 1):
        row = shown[y + height // 2].view(np.uint32)[:, 0]
        windows = np.lib.stride_tricks.sliding_window_view(row, width)
        for x in np.flatnonzero((windows[:, ::37] == first[::37]).all(axis=1)):
            if np.array_equal(shown[y : y + height, x : x + width], scene):
                return int(x), y
    raise AssertionError("the scene is not in the window")


def middle_of(editor, node):
    """A pixel of the window where a node shows, in the middle of what shows."""
    rows, columns = np.nonzero(editor._scene._frame.object_id == node.id)
    middle = np.argmin(np.hypot(rows - rows.mean(), columns - columns.mean()))
    x, y = scene_corner(editor)
    return x + int(columns[middle]), y + int(rows[middle])


def row_of(editor, node):
    """Where a node's row is: what changes on the left when it is selected."""
    selection = editor.workspace.document.selection
    selection.set()
    before = settle(editor)
    selection.set([node])
    changed = (settle(editor) != before).any(-1)
    changed[:, scene_corner(editor)[0] :] = False
    selection.set()
    settle(editor)
    rows, columns = np.nonzero(changed)
    assert len(rows)
    return columns.mean(), rows.mean()


def find(editor, name):
    return next(node for node in editor.workspace.scene.nodes if node.name == name)


def test_the_scene_is_shown_to_the_byte_between_the_panels(editor):
    x, y = scene_corner(editor)
    height, width = editor._scene._frame.color.shape[:2]
    assert x > 100 and y > 20 and x + width < SIZE[0] - 100
    assert height > 200 and len(np.unique(editor._pixels[:, :x].reshape(-1, 4), axis=0)) > 50


def test_nothing_is_drawn_while_nothing_happens(editor):
    drawn = []
    editor.window.present = drawn.append
    for _ in range(5):
        editor.turn(0.0)
    assert drawn == []
    do(editor, events.MouseMotion(1, 1, 5, 5))
    assert len(drawn) >= 1


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


def test_a_click_in_the_tree_selects(editor):
    base = find(editor, "Base")
    click(editor, *row_of(editor, base))
    assert editor.workspace.document.selection.nodes == (base,)


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


def test_keys_duplicate_delete_and_undo(editor):
    scene, workspace = editor.workspace.scene, editor.workspace
    count = len(scene.nodes)
    cab = find(editor, "Cab")
    workspace.document.selection.set([cab])
    press(editor, "D", control=True)
    assert len(scene.nodes) == count + 1
    assert workspace.document.selection.active.name == "Cab" != cab
    press(editor, "Delete")
    assert len(scene.nodes) == count
    press(editor, "Z", control=True)
    press(editor, "Z", control=True)
    assert len(scene.nodes) == count and not workspace.document.is_modified
    press(editor, "Z", control=True, shift=True)
    assert len(scene.nodes) == count + 1 and workspace.document.is_modified


def test_keys_that_come_at_once_count_one_after_the_other(editor):
    nodes = editor.workspace.scene.nodes
    name = "Left Ctrl"
    for key in "AQAQ":
        editor._late += [
            events.KeyDown(name, name, False, True),
            events.KeyDown(key, key, False, True),
            *(events.KeyUp(name, name), events.KeyUp(key, key))[:: 1 if key == "Q" else -1],
        ]
    while editor._pictures_due or editor._late:
        editor.turn(0.0)
    assert editor.workspace.wants_exit
    assert len(nodes) > 1 and editor.workspace.document.selection.nodes == ()


def test_f2_renames(editor):
    cab = find(editor, "Cab")
    editor.workspace.document.selection.set([cab])
    press(editor, "F2")
    do(editor, *(events.TextEntered(letter) for letter in "Hütte"))
    press(editor, "Return")
    assert cab.name == "Hütte"
    press(editor, "Z", control=True)
    assert cab.name == "Cab"


def test_letters_choose_tools_unless_somebody_types(editor):
    press(editor, "W")
    assert editor.workspace.tools.chosen == "move"
    editor.workspace.document.selection.set([find(editor, "Cab")])
    press(editor, "F2")
    press(editor, "E")
    assert editor.workspace.tools.chosen == "move"


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


def scene_corner_of_gizmo(editor):
    """The scene's corner, found before the gizmo was drawn over it."""
    tool, editor.workspace.tools.chosen = editor.workspace.tools.chosen, "select"
    settle(editor)
    corner = scene_corner(editor)
    editor.workspace.tools.chosen = tool
    settle(editor)
    return corner


def test_files_that_are_dropped_are_added_and_a_bad_one_is_told(editor, tmp_path):
    teapot = str(files(data) / "models" / "teapot.obj")
    count = len(editor.workspace.scene.nodes)
    bad = tmp_path / "bad.obj"
    bad.write_text("f 1 2 3\n")
    do(editor, events.FilesDropped((str(bad), teapot)))
    added = editor.workspace.scene.nodes[count:]
    assert [node.name for node in added][0] == "teapot" and added[1].parent is added[0]
    errors = [entry.text for entry in editor.workspace.console.filtered(["error"])]
    assert len(errors) == 1 and "bad.obj" in errors[0]
    press(editor, "Z", control=True)
    assert len(editor.workspace.scene.nodes) == count


def test_a_scene_is_saved_and_opened_again(editor, tmp_path):
    asked, path = editor._files, tmp_path / "train.e3d.json"
    editor.workspace.document.selection.set([find(editor, "Cab")])
    press(editor, "Delete")
    names = [node.name for node in editor.workspace.scene.nodes]
    press(editor, "S", control=True)
    asked._dialog._go(str(tmp_path))
    do(editor, *(events.TextEntered(letter) for letter in "train"))
    press(editor, "Return")
    assert path.exists() and not editor.workspace.document.is_modified
    assert editor.window.title == "train.e3d.json - engine3d"
    press(editor, "N", control=True)
    assert editor.workspace.scene.nodes == ()
    press(editor, "O", control=True)
    settle(editor)
    assert asked._dialog._recent.paths() == (str(path), str(files(data) / "models" / "train.asc"))
    asked._dialog._name = path.name
    asked._dialog._finish()
    settle(editor)
    assert [node.name for node in editor.workspace.scene.nodes] == names


def test_what_is_not_saved_is_asked_about(editor):
    editor.workspace.document.selection.set([find(editor, "Cab")])
    press(editor, "Delete")
    do(editor, events.CloseRequested())
    assert not editor.workspace.wants_exit
    assert list(editor._files._answers) == ["Save", "Discard", "Cancel"]
    press(editor, "Z", control=True)  # keys do nothing to the scene behind the question
    assert editor.workspace.document.is_modified
    editor._files._answers["Discard"]()
    assert editor.workspace.wants_exit


def test_a_scene_that_was_left_behind_is_offered(editor, monkeypatch):
    editor.workspace.document.selection.set([find(editor, "Cab")])
    press(editor, "Delete")
    count = len(editor.workspace.scene.nodes)
    assert editor.workspace._autosave.save()
    monkeypatch.setattr("engine3d.apps.editor.autosave._is_locked", lambda path: False)
    editor._files.offer_recovery()
    settle(editor)
    editor.workspace._autosave._path = None  # as if its process had ended
    editor._files._answers["Recover"]()
    settle(editor)
    assert len(editor.workspace.scene.nodes) == count and editor.workspace.document.is_modified


def test_every_panel_of_a_selected_light_camera_and_mesh_is_laid_out(editor):
    pictures = set()
    for name in ("Light01", "Camera01", "Cab"):
        editor.workspace.document.selection.set([find(editor, name)])
        pictures.add(settle(editor)[:, -200:].tobytes())
    assert len(pictures) == 3


def test_what_can_be_shown_over_the_scene_is_drawn_and_stays_within_it(editor):
    overlays, workspace = editor._scene._overlays, editor.workspace
    workspace.document.selection.set([find(editor, "Cab"), find(editor, "Camera01")])
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


def test_an_image_paints_the_node_that_it_is_dropped_onto(editor):
    cab = find(editor, "Cab")
    image = str(files(data) / "models" / "teapot.tga")
    x, y = middle_of(editor, cab)
    do(editor, events.MouseMotion(0, 0, x, y), events.FilesDropped((image,)))
    assert cab.object.materials[0].texture is not None
    press(editor, "Z", control=True)
    assert cab.object.materials[0].texture is None


def test_a_texture_is_loaded_into_a_slot(editor, tmp_path):
    workspace, material = editor.workspace, find(editor, "Cab").object.materials[0]
    assert not workspace.load_texture(str(tmp_path / "none.png"), material, "texture")
    assert "none.png" in workspace.console.entries[-1].text
    image = str(files(data) / "models" / "teapot.tga")
    assert workspace.load_texture(image, material, "texture")
    assert material.texture.pixels.shape[2] == 4
    workspace.undo()
    assert material.texture is None


def test_every_kind_of_collider_fits_a_mesh(editor):
    cab = find(editor, "Cab")
    for name, make in _COLLIDERS.items():
        cab.collider = make(cab.object)
        assert _KINDS.get(type(cab.collider), "none") == name
    workspace = editor.workspace
    workspace.document.selection.set([cab])
    settle(editor)


def test_fog_is_set_dragged_and_undone(editor):
    workspace = editor.workspace
    scene, assigned = workspace.scene, []
    workspace.document.selection.set([])
    before = settle(editor)
    for kind in (Fog, ExponentialFog):
        fog = fog_fields._new_fog(kind, scene, workspace.bounds.radius)
        workspace.do(SetValues([scene], {"fog": fog}))
        x, y = middle_of(editor, find(editor, "Cab"))  # of the scene, not of the panel
        assert (settle(editor)[y, x] != before[y, x]).any() and scene.fog == fog
        workspace.undo()
        assert scene.fog is None
    fog = Fog((9, 8, 7), 1.0, 2.0)
    for name, value in (("near", 5.0), ("far", 0.5), ("far", 0.0)):
        assigned.append(fog_fields._with(fog, name, value))
        assert getattr(assigned[-1], name) == max(value, 1e-4) and assigned[-1].color == (9, 8, 7)
    assert assigned[0].far > 5.0 and assigned[1].near < 0.5
    assert fog_fields._with(ExponentialFog((9, 8, 7), 1.0), "density", 0.25).density == 0.25


def test_an_error_of_a_panel_is_told_and_the_editor_goes_on(editor, monkeypatch):
    def fail(self, *arguments):
        raise ZeroDivisionError("planted")

    name = "engine3d.apps.editor.ui.hierarchy_panel.HierarchyPanel._draw_name"
    with monkeypatch.context() as patched:
        patched.setattr(name, fail)
        settle(editor)
    errors = [entry.text for entry in editor.workspace.console.filtered(["error"], "planted")]
    assert errors[-1] == "ZeroDivisionError: planted"
    settle(editor)
    click(editor, *row_of(editor, find(editor, "Base")))
    assert editor.workspace.document.selection.active.name == "Base"


def test_an_error_amid_a_picture_ends_it(editor, monkeypatch):
    with monkeypatch.context() as patched:
        patched.setattr(editor, "_guarded", lambda act: raise_from(KeyboardInterrupt))
        with pytest.raises(KeyboardInterrupt):
            settle(editor)
    first = settle(editor)
    assert (settle(editor) == first).all()


def raise_from(kind):
    raise kind("planted")


def test_what_is_not_saved_is_kept_when_the_editor_fails(tmp_path):
    """In a process of its own, which must end as Python does after an error."""
    program = (
        "import sys\n"
        "from engine3d.apps.editor.ui.editor_window import EditorWindow\n"
        "with EditorWindow(size=(600, 400)) as editor:\n"
        "    editor.workspace.lines_to_run.append('scene.add()')\n"
        "    editor.turn(0.0)\n"
        "    editor._guarded = lambda act: sys.exit('planted')\n"
        "    editor.run()\n"
    )
    homes = {name: str(tmp_path) for name in ("XDG_STATE_HOME", "XDG_CACHE_HOME")}
    environment = {**os.environ, **homes, "SDL_VIDEODRIVER": "dummy"}
    done = subprocess.run([sys.executable, "-c", program], env=environment, capture_output=True)
    assert (done.returncode, done.stderr) == (1, b"planted\n")
    assert len(list((tmp_path / "engine3d" / "unsaved").glob("*.e3d.json"))) == 1


@pytest.mark.parametrize(
    ("path", "line"),
    [
        ("new.e3d.json", ""),
        ("", ""),
        ("", "while True: pass"),
        ("", "import time; time.sleep(99)"),
        ("", STUBBORN),
    ],
)
def test_sigterm_ends_the_editor_whatever_it_does(tmp_path, path, line):
    program = (
        "import os, signal, sys, threading\n"
        "from engine3d.apps.editor.ui.editor_window import EditorWindow\n"
        f"with EditorWindow({path!r}, size=(600, 400)) as editor:\n"
        f"    editor.workspace.lines_to_run += ['scene.add()', {line!r}, '']\n"
        "    end = lambda: os.kill(os.getpid(), signal.SIGTERM)\n"
        "    threading.Timer(0.5, end).start()\n"
        "    sys.exit(editor.run())\n"
    )
    homes = {name: str(tmp_path) for name in ("XDG_STATE_HOME", "XDG_CACHE_HOME")}
    environment = {**os.environ, **homes, "SDL_VIDEODRIVER": "dummy"}
    done = subprocess.run(
        [sys.executable, "-c", program], env=environment, capture_output=True, cwd=tmp_path
    )
    assert (done.returncode, done.stderr) == (143, b"")
    assert len(list((tmp_path / "engine3d" / "unsaved").glob("*.e3d.json"))) == 1


def test_a_file_is_opened_by_two_clicks(editor, tmp_path):
    (tmp_path / "inside").mkdir()
    e3d.box().save(tmp_path / "inside" / "box.obj")
    dialog = editor._files._dialog
    press(editor, "O", control=True)
    dialog._go(str(tmp_path))
    settle(editor)
    x = SIZE[0] // 2
    y = next(y for y in range(120, 400, 9) if click(editor, x, y) or dialog._name == "inside")
    for _ in range(2):
        time.sleep(0.4)  # this is another double click
        click(editor, x, y)
        click(editor, x, y)
    assert editor.workspace.document.scene.nodes[0].name == "box"
    assert not editor.workspace.console.filtered(["error"])


def test_panels_can_be_closed_and_come_back(editor):
    everything = settle(editor)
    editor.workspace.panels.closed.add("Console")
    assert (settle(editor) != everything).any()
    editor.workspace.panels.wants_usual_places = True
    assert (settle(editor) == everything).all() and not editor.workspace.panels.closed


def test_closed_panels_and_steps_are_kept(editor):
    editor.workspace.panels.closed.add("Resources")
    editor.workspace.tools.steps["turn"] = 22.5
    save_layout(editor.workspace)
    again = Workspace()
    assert load_layout(again)
    assert (again.panels.closed, again.tools.steps) == (
        editor.workspace.panels.closed,
        editor.workspace.tools.steps,
    )
    layout_path().write_text("[engine3d][Editor]\nmove=-1\nturn=x\nscale\nclosed=Console,Cat\n")
    damaged = Workspace()
    assert load_layout(damaged)
    assert damaged.tools.steps == Workspace().tools.steps and damaged.panels.closed <= {"Console"}


def test_time_goes_on_until_space_is_pressed_again(editor):
    workspace, base = editor.workspace, find(editor, "Base")
    press(editor, "Space")
    assert not workspace.plays and "nothing moves" in workspace.console.entries[-1].text
    workspace.document.animator.spin(base, period=5)
    still = settle(editor)
    press(editor, "Space")
    assert workspace.moments > 0 and editor._pictures_due
    press(editor, "Space")
    moments, paused = workspace.moments, settle(editor)
    assert (paused != still).any() and (settle(editor) == paused).all()
    assert workspace.moments == moments and not workspace.document.is_modified
    workspace.rewind()
    assert base.rotation.tolist() == [0, 0, 0, 1]


def test_a_mesh_is_loaded_into_a_node_and_removed(editor, tmp_path):
    workspace, cab = editor.workspace, find(editor, "Cab")
    old = cab.object
    assert not workspace.load_mesh(str(tmp_path / "none.obj"), cab)
    assert workspace.load_mesh(str(files(data) / "models" / "teapot.obj"), cab)
    assert cab.object is not old
    workspace.undo()
    assert cab.object is old


@pytest.mark.parametrize(
    "name, why",
    [
        ("broken.obj", "broken.obj:1: "),
        ("none.obj", "none.obj: cannot read: "),
        ("none/scene.e3d.json", "its folder is not there"),
    ],
)
def test_a_file_that_cannot_be_opened_ends_the_command(name, why, monkeypatch, tmp_path, capsys):
    from engine3d.apps.cli import main

    monkeypatch.setenv("SDL_VIDEODRIVER", "dummy")
    monkeypatch.chdir(tmp_path)
    (tmp_path / "broken.obj").write_text("v 1 x\n")
    assert main(["edit", name]) == 1
    said = capsys.readouterr().err
    assert said.count("\n") == 1 and said.startswith("engine3d: error: ") and why in said


def test_the_bounds_hold_the_scene_without_a_look_at_each_node(editor, monkeypatch):
    workspace = editor.workspace
    workspace.document.animator.spin(find(editor, "Base"), period=5)
    workspace.document.animator.seek(1.0)
    with monkeypatch.context() as patched:  # which takes microseconds a node
        patched.setattr(e3d.Node, "world_pose", property(lambda node: raise_from(AssertionError)))
        center, radius = workspace.bounds
    assert np.allclose(np.linalg.norm(workspace.scene.bounds - center, axis=1), radius)


def test_places_of_panels_are_kept(editor):
    save_layout(editor.workspace)
    assert "[Docking]" in layout_path().read_text("utf-8")


def test_a_layout_that_cannot_be_kept_does_no_harm(editor, monkeypatch, tmp_path):
    (tmp_path / "file").write_text("")
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path / "file"))
    save_layout(editor.workspace)
    assert not layout_path().exists()


@pytest.mark.parametrize("is_there", [False, True])
def test_without_imgui_one_line_says_what_lacks(is_there, monkeypatch, capsys, tmp_path):
    from engine3d.apps.cli import main

    monkeypatch.setenv("SDL_VIDEODRIVER", "dummy")
    for name in list(sys.modules):
        if name.startswith(("engine3d.apps.editor.ui", "imgui_bundle")):
            monkeypatch.delitem(sys.modules, name)
    if is_there:
        (tmp_path / "imgui_bundle").mkdir()
        (tmp_path / "imgui_bundle" / "__init__.py").write_text(
            "raise ImportError('libX11.so.6: no such file', name='imgui_bundle._imgui_bundle')\n"
        )
        monkeypatch.syspath_prepend(tmp_path)
    else:
        monkeypatch.setitem(sys.modules, "imgui_bundle", None)
    assert main(["edit"]) == 1
    said = capsys.readouterr().err
    lacks = "it does not load: libX11.so.6" if is_there else "pip install 'engine3d[editor]'"
    assert said.count("\n") == 1 and lacks in said


@pytest.mark.parametrize(
    "key, answer", [("Return", "one"), ("Keypad Enter", "one"), ("Escape", "three")]
)
def test_a_question_hears_keys(editor, key, answer):
    given = []
    answers = ("one", "two", "three")
    editor._files._ask("Which?", {name: functools.partial(given.append, name) for name in answers})
    settle(editor)
    press(editor, key)
    assert given == [answer]
    press(editor, key)
    assert given == [answer], "the question is closed"


def test_a_question_hears_the_arrows(editor):
    given = []
    answers = ("one", "two", "three")
    editor._files._ask("Which?", {name: functools.partial(given.append, name) for name in answers})
    settle(editor)
    press(editor, "Right")
    press(editor, "Return")
    assert given == ["two"]
