"""Outputs as drawing modes, nine of them side by side, and what culling works with as lines."""

import numpy as np
import pytest
from viewer.scripted_window import ScriptedWindow

import engine3d as e3d
from engine3d import events
from engine3d.apps.viewer.viewer import Viewer
from engine3d.rendering.options import OUTPUT_MODES
from engine3d.stage.output_pictures import SPLIT, picture_of, whole_pixel
from engine3d.stage.overlays.debug_lines import BOX, FRUSTUM, LEVELS, frustum_lines, tree_lines
from engine3d.stage.overlays.selection_outline import OUTLINE
from engine3d.stage.stage_settings import Settings
from engine3d.stage.view_renderer import ViewRenderer
from engine3d.stage.viewed_scene import ViewedScene

SIZE = (300, 240)
BACKGROUND = (10, 20, 30)


@pytest.fixture
def viewer():
    scene = e3d.Scene(BACKGROUND)
    group = scene.add(name="group")
    mesh = e3d.box()
    mesh.materials = [e3d.Material(color=e3d.linear(0.5, 0.25, 0.0))]
    scene.add(mesh, parent=group, name="left", translation=(-1.2, 0, 0))
    scene.add(mesh, parent=group, name="right", translation=(1.2, 0, 0))
    view_renderer = ViewRenderer(ViewedScene(scene, "boxes", azimuth=0.3), Settings({}), SIZE)
    return Viewer(view_renderer, ScriptedWindow(size=SIZE))


def drawn(viewer, **options):
    return viewer.view_renderer.draw(viewer.view, 0.0, **options)


@pytest.mark.parametrize("mode", OUTPUT_MODES)
def test_each_output_is_a_mode(viewer, mode):
    plain = drawn(viewer, outputs=("color", "depth"))
    viewer.view_renderer.appearance.mode = mode
    frame = drawn(viewer, outputs=("color", "depth", mode))
    covered = frame.depth > 0
    np.testing.assert_array_equal(frame.color[~covered], plain.color[~covered])
    shown = frame.color[covered, :3]
    picture = picture_of(mode, getattr(frame, mode), viewer.view_renderer.bounds)
    np.testing.assert_array_equal(shown, picture[covered])
    even = {"albedo", "metallic_roughness", "emissive", "tangent", "instance_id", "material_id"}
    varies = mode not in even
    assert (len(np.unique(shown, axis=0)) > 2) == varies
    assert (frame.color[..., 3] == 255).all()


def test_values_are_where_they_belong(viewer):
    names = ("albedo", "world_normal", "world_position", "object_id", "depth")
    frame = drawn(viewer, outputs=("color", *names))
    bounds = viewer.view_renderer.bounds
    covered = frame.depth > 0
    albedo = picture_of("albedo", frame.albedo, bounds)[covered]
    assert np.abs(albedo.astype(int) - (188, 137, 0)).max() <= 1
    normals = picture_of("world_normal", frame.world_normal, bounds)[covered]
    assert set(map(tuple, normals)) <= {(128, 128, 255), (128, 255, 128), (255, 128, 128)}
    places = picture_of("world_position", frame.world_position, bounds)[covered].astype(int)
    expected = (frame.world_position[covered] / (2 * bounds.radius) + 0.5) * 255
    assert np.abs(places - expected).max() <= 1
    grey = picture_of("depth", frame.depth, bounds)[..., 0]
    nearest = np.unravel_index(np.where(covered, frame.depth, np.inf).argmin(), covered.shape)
    assert grey[nearest] == 255 and grey[covered].min() == 38
    ids = picture_of("object_id", frame.object_id, bounds)[covered]
    assert len(set(map(tuple, ids))) == 2


def test_nine_outputs_stand_side_by_side(viewer):
    plain = drawn(viewer).color.copy()
    viewer.handle(events.KeyDown("S", "S"))
    viewer.messages.said = ""
    viewer.draw()
    frame = viewer.frame
    first = frame.color[30:80, :100]
    np.testing.assert_array_equal(first, plain[1::3, 1::3][30:])
    tiles = [
        frame.color[row * 80 + 30 : row * 80 + 80, column * 100 : column * 100 + 100].tobytes()
        for row in range(3)
        for column in range(3)
    ]
    assert len(set(tiles)) == 9 == sum(map(len, SPLIT))
    assert whole_pixel(225, 123, SIZE) == whole_pixel(25, 43, SIZE) == (76, 130)
    x, y = (int(part) // 3 for part in frame.project((-1.2, 0, 0))[0])
    viewer.select(x + 200, y + 80)
    assert viewer.selected.node.name == "left"
    viewer.draw()
    assert not (viewer.frame.color == OUTLINE).all(axis=2).any()
    viewer.handle(events.KeyDown("S", "S"))
    viewer.selected, viewer.messages.said = None, ""
    viewer.draw()
    np.testing.assert_array_equal(viewer.frame.color, plain)


def colored(viewer, color):
    return (drawn(viewer).color == color).all(axis=2)


def test_boxes_are_drawn_round_what_shows(viewer):
    viewer.handle(events.KeyDown("D", "D"))
    line = colored(viewer, BOX)
    ids = drawn(viewer, outputs=("color", "object_id")).object_id >= 0
    assert line.sum() > 300
    rows, columns = np.nonzero(line)
    inside_rows, inside_columns = np.nonzero(ids)
    for drawn_at, covered in ((rows, inside_rows), (columns, inside_columns)):
        assert abs(drawn_at.min() - covered.min()) <= 2
        assert abs(drawn_at.max() - covered.max()) <= 2


def boxes_of(lines):
    """The boxes that lines are the edges of, (N, 2, 3)."""
    corners = lines.segments.reshape(-1, 24, 3)
    return np.stack([corners.min(axis=1), corners.max(axis=1)], axis=1)


def test_the_tree_is_that_of_culling_level_by_level(viewer):
    scene = viewer.view_renderer.viewed.scene
    for x in range(40):
        scene.add(e3d.box(), translation=(3 * x, 0, 0))
    lines = tree_lines(scene)
    assert [line.color for line in lines] == [BOX, LEVELS[0], LEVELS[1]]
    assert [len(boxes_of(line)) for line in lines] == [42, 11, 3]  # four below each
    top = boxes_of(lines[-1])
    around = np.stack([top[:, 0].min(axis=0), top[:, 1].max(axis=0)])
    np.testing.assert_allclose(around, scene.bounds, rtol=1e-6)
    for below, above in zip(lines[:-1], lines[1:], strict=True):
        for number, (low, high) in enumerate(boxes_of(above)):
            held = boxes_of(below)[4 * number : 4 * number + 4]
            np.testing.assert_array_equal(low, held[:, 0].min(axis=0))
            np.testing.assert_array_equal(high, held[:, 1].max(axis=0))
    view = e3d.PerspectiveCamera(), e3d.look_at((0, 0, 500), (0, 0, 0))
    stats = e3d.render(scene, view, size=(8, 8), culling="frustum").stats
    assert stats["boxes_tested"] == len(boxes_of(lines[0]))
    for _ in range(2):
        viewer.handle(events.KeyDown("D", "D"))
    assert colored(viewer, LEVELS[0]).any()


def test_the_tree_of_many_instances_turns_with_their_node(monkeypatch):
    scene = e3d.Scene()
    random = np.random.default_rng(1)
    poses = np.c_[random.uniform(-5, 5, (1500, 3)), np.full(1500, 0.1)]
    scene.add(e3d.InstancedMesh(e3d.box(), poses), translation=(100, 0, 0), rotation=(0, 0, 1, 1))
    lines = tree_lines(scene)
    counts = [len(line.segments) // 12 for line in lines]
    assert counts == [1500, 375, 94, 24, 6, 2, 1]  # the instances' six levels, the only node
    for line in lines:
        low, high = line.segments.min(axis=(0, 1)), line.segments.max(axis=(0, 1))
        assert (low > scene.bounds[0] - 1e-3).all() and (high < scene.bounds[1] + 1e-3).all()
    monkeypatch.setattr("engine3d.stage.overlays.debug_lines.MOST_IN_TREES", 200)
    assert [len(line.segments) // 12 for line in tree_lines(scene)] == counts[2:]


@pytest.mark.parametrize("orthographic", [False, True])
def test_the_frustum_stays_where_it_was_and_the_frozen_one_is_shown(viewer, orthographic):
    viewer.view.orthographic = orthographic
    for _ in range(3):
        viewer.handle(events.KeyDown("D", "D"))
    viewer.view.orthographic = False
    viewer.view.azimuth += 1.0
    viewer.view.distance *= 4
    before = colored(viewer, FRUSTUM)
    assert before.sum() > 100
    viewer.handle(events.KeyDown("C", "C"))
    viewer.view.azimuth += 0.5
    frozen = colored(viewer, FRUSTUM)
    assert frozen.any() and (frozen != before).any()
    viewer.handle(events.KeyUp("C", "C"))
    viewer.handle(events.KeyDown("D", "D"))
    assert not colored(viewer, FRUSTUM).any()


def test_a_frustum_has_the_corners_of_its_camera():
    camera = e3d.PerspectiveCamera(np.pi / 2, znear=1.0, zfar=10.0)
    (lines,) = frustum_lines(camera, np.eye(4), (200, 100))
    corners = np.unique(lines.segments.reshape(-1, 3).round(6), axis=0)
    expected = [(2 * z * x, z * y, -z) for z in (1, 10) for x in (-1, 1) for y in (-1, 1)]
    np.testing.assert_allclose(corners, np.unique(np.array(expected, float), axis=0))
    assert lines.segments.shape == (12, 2, 3)


def test_lines_behind_the_camera_are_cut(viewer):
    viewer.view.look_from((-1.2, 0.2, 0.3), (1.2, 0.0, 0.0))
    viewer.handle(events.KeyDown("D", "D"))
    assert colored(viewer, BOX).any()


def test_statistics_tell_where_the_camera_is(viewer):
    viewer.view.look_from((1, 2, 3), (0, 0, 0))
    viewer.draw()
    viewer.statistics = "long"
    assert any("camera at 1, 2, 3" in line for line in viewer.statistics_lines())


def test_a_scene_of_no_instances_has_a_view():
    scene = e3d.Scene()
    scene.add(e3d.InstancedMesh(e3d.box(), np.zeros((0, 4), np.float32)))
    view_renderer = ViewRenderer(ViewedScene(scene, "nothing"), Settings({}), SIZE)
    view_renderer.draw(view_renderer.view())
