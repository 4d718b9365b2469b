"""``scene.save_image()`` of trimesh: light by hand, flags, cameras, what is told."""

import io
import sys

import numpy as np
import pytest
from PIL import Image

import engine3d as e3d

trimesh = pytest.importorskip("trimesh", exc_type=ImportError)

SIZE = (60, 44)


@pytest.fixture(autouse=True)
def installed():
    from engine3d.compat import trimesh as door

    door.install()
    yield door
    door.uninstall()


def picture(scene, **options):
    data = scene.save_image(resolution=SIZE, **options)
    return np.asarray(Image.open(io.BytesIO(data)))


def middle(scene, **options):
    return picture(scene, **options)[SIZE[1] // 2, SIZE[0] // 2 + 2].tolist()


def test_light_is_that_of_the_fixed_pipeline():
    """A face towards +Z under two lights at opposite corners: 0.2, twice 60/255, and one cosine."""
    expected = 102 * (0.2 + 60 / 255 * (2 + np.sqrt(1 / 3)))
    assert np.allclose(middle(trimesh.creation.box().scene())[:3], expected, atol=1)


@pytest.mark.parametrize("kind", ["face", "vertex"])
def test_colours_of_a_scene_with_one_light_at_the_camera(kind):
    box = trimesh.creation.box()
    setattr(box.visual, f"{kind}_colors", [200, 100, 50, 255])
    scene = box.scene()
    lamp = trimesh.scene.lighting.PointLight(name="lamp", color=[128, 128, 128, 255])
    scene.lights = [lamp]
    scene.graph.update("lamp", matrix=trimesh.transformations.translation_matrix([0, 0, 9]))
    light = 128 / 255
    base = np.array([200, 100, 50]) * (0.2 + 2 * light) + 255 * 0.508273 * light
    assert np.allclose(middle(scene)[:3], np.minimum(base, 255), atol=1)


def test_texture():
    box = trimesh.creation.box()
    image = Image.new("RGB", (4, 4), (250, 120, 10))
    box.visual = trimesh.visual.TextureVisuals(uv=np.zeros((8, 2)), image=image)
    found = middle(box.scene(), smooth=False)[:3]
    assert found[0] > found[1] > found[2]
    assert abs(found[0] / found[1] - 250 / 120) < 0.1


def test_back_faces_show_without_culling():
    open_box = trimesh.creation.box()
    open_box.update_faces(open_box.face_normals[:, 2] < 0.5)
    scene = open_box.scene()
    assert middle(scene)[:3] == [255, 255, 255]
    assert middle(scene, flags={"cull": False})[:3] != [255, 255, 255]


def test_flags():
    scene = trimesh.creation.icosphere(subdivisions=1).scene()
    plain = picture(scene)
    wire = picture(scene, flags={"wireframe": True})
    for flags in ({"axis": True}, {"axis": "all"}):
        assert not np.array_equal(picture(scene, flags={"wireframe": True} | flags), wire), flags
    wires = (wire[..., :3] < 200).all(-1).sum()
    assert wires < 0.7 * (plain[..., :3] < 200).all(-1).sum()
    for flags in ({"wirefame": True}, {"axis": "al"}):
        with pytest.raises(e3d.InvalidArgumentError, match="did you mean"):
            picture(scene, flags=flags)


def test_camera_and_resolution():
    scene = trimesh.creation.box().scene()
    scene.camera.resolution = (31, 17)
    assert Image.open(io.BytesIO(scene.save_image())).size == (31, 17)
    assert picture(scene).shape[:2] == SIZE[::-1]
    assert tuple(scene.camera.resolution) == SIZE
    near = (picture(scene)[..., 0] < 200).sum()
    scene.set_camera(angles=(0.4, 0.2, 0.1), distance=6)
    assert 0 < (picture(scene)[..., 0] < 200).sum() < near
    turned = scene.camera_transform.copy()
    scene.camera_transform = trimesh.transformations.rotation_matrix(0.5, [0, 1, 0]) @ turned
    assert scene.save_image(resolution=SIZE) != scene.save_image(resolution=(SIZE[0], SIZE[1] + 1))
    for resolution in ((0, 5), (3,), "ab", (np.nan, 1)):
        with pytest.raises(e3d.InvalidArgumentError, match="resolution"):
            scene.save_image(resolution=resolution)


def test_background():
    scene = trimesh.creation.box(extents=(0.1, 0.1, 0.1)).scene()
    scene.set_camera(distance=5)
    assert picture(scene)[0, 0].tolist() == [255, 255, 255, 255]
    assert picture(scene, background=[10, 20, 30, 255])[0, 0].tolist() == [10, 20, 30, 255]
    assert picture(scene, background=[0, 0, 0, 0])[0, 0, 3] == 0
    with pytest.raises(e3d.InvalidArgumentError, match="background"):
        picture(scene, background="no such colour")


def test_points():
    cloud = trimesh.PointCloud(np.zeros((1, 3)) + [[0, 0, 0]], colors=[[255, 0, 0, 255]])
    scene = trimesh.Scene([cloud, trimesh.PointCloud([[1.0, 1, 0]], colors=[[0, 0, 255, 255]])])
    found = picture(scene, line_settings={"point_size": 9})
    assert (found[..., 0] > found[..., 2] + 50).sum() > 40
    assert (found[..., 2] > found[..., 0] + 50).sum() > 40


def test_lines():
    line = trimesh.path.Path3D(
        entities=[trimesh.path.entities.Line([0, 1])], vertices=[[-1, 0, 0], [1, 0.2, 0]]
    )
    found = picture(trimesh.Scene([line]), line_settings={"line_width": 5})
    assert (found[..., 0] < 100).sum() > 100


def test_what_the_viewer_takes_and_ignores(tmp_path):
    scene = trimesh.creation.box().scene()
    called = []
    ignored = {"visible": False, "window_conf": object(), "caption": "x", "callback_period": 1}
    expected = scene.save_image(resolution=SIZE)
    assert scene.save_image(resolution=SIZE, callback=called.append, **ignored) == expected
    assert called == [scene]
    with pytest.warns(e3d.errors.Engine3DWarning, match="smoot"):
        scene.save_image(resolution=SIZE, smoot=True)
    viewer = trimesh.viewer.SceneViewer(scene, start_loop=False, resolution=SIZE)
    viewer.save_image(str(tmp_path / "a.png"))
    assert (tmp_path / "a.png").read_bytes() == expected
    for node in scene.graph.nodes_geometry:
        viewer.hide_geometry(node)
    file = viewer.save_image(io.BytesIO())
    assert (np.asarray(Image.open(file)) == 255).all()


@pytest.fixture
def shown(monkeypatch):
    """What a window would show: a function that returns it."""
    held = []
    monkeypatch.setattr(windowed(), "show_viewed", lambda *given: held.append(given))

    def show(scene, **options):
        scene.show(**options)
        return held.pop()

    return show


def windowed():
    return sys.modules["trimesh.viewer.windowed"]


def test_the_window_has_what_it_was_asked_for(shown):
    scene = trimesh.creation.icosphere(subdivisions=1).scene()
    flags = {"cull": False, "wireframe": True, "grid": True, "axis": True}
    sizes = {"line_width": 3, "point_size": 0.5}
    viewed, settings, size = shown(
        scene,
        caption="A ball",
        resolution=(90, 60),
        flags=flags,
        line_settings=sizes,
        background=[10, 20, 30],
        smooth=False,
    )
    assert (viewed.title, size) == ("A ball", (90, 60))
    assert settings.appearance == {
        "cull": "none",
        "wireframe": "only",
        "line_width": 3,
        "point_size": 1,
    }
    assert (settings.grid, settings.axes, settings.background) == (True, True, (10, 20, 30))
    (ball,) = (node.object for node in viewed.scene.nodes if isinstance(node.object, e3d.Mesh))
    assert ball.materials[0].flat_shading
    viewed, settings, _ = shown(trimesh.creation.box().scene())
    assert settings.appearance == {} and settings.background is None


def test_a_window_follows_what_a_callback_moves(shown):
    scene = trimesh.Scene({"a": trimesh.creation.box(), "b": trimesh.creation.box()})
    move = trimesh.transformations.translation_matrix([0, 2, 0])

    def callback(scene):
        scene.graph.update("a", matrix=move)
        scene.delete_geometry("b")

    viewed, _, size = shown(scene, callback=callback)
    a, b = (node for node in viewed.scene.nodes if isinstance(node.object, e3d.Mesh))
    assert size is None and viewed.plays and b.visible
    viewed.update(0.0)
    with pytest.warns(e3d.errors.Engine3DWarning, match="no new shapes and views") as caught:
        scene.geometry["a"].apply_scale(2)
        viewed.update(0.1)
        viewed.update(0.2)
    assert len(caught) == 1
    assert np.array_equal(a.world_pose, move) and not b.visible


def test_what_the_window_does_not_take_is_named(shown):
    options = {"fixed": ["a"], "record": True, "visible": False, "flags": {"fullscreen": True}}
    told = "does not support visible, fullscreen, fixed, record$"
    with pytest.warns(e3d.errors.Engine3DWarning, match=told):
        shown(trimesh.creation.box().scene(), **options)


def test_empty_scenes_and_broken_meshes():
    assert (picture(trimesh.Scene()) == 255).all()
    broken = trimesh.Trimesh([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]], process=False)
    scene = trimesh.Scene(broken)
    scene.graph.update("world", matrix=np.eye(4))
    for node in scene.graph.nodes_geometry:
        scene.graph.update(node, matrix=np.diag([0.0, 0.0, 0.0, 1.0]))
    assert picture(scene).shape == (*SIZE[::-1], 4)


def test_uninstall(installed):
    assert sys.modules["trimesh.viewer.windowed"].__name__ == "engine3d.compat.trimesh.windowed"
    installed.uninstall()
    module = sys.modules.get("trimesh.viewer.windowed")
    assert module is None or "engine3d" not in module.__name__


@pytest.mark.parametrize("name", ["flags", "line_settings"])
@pytest.mark.parametrize("wrong", ["x", 3, ["axis"]])
def test_options_that_are_no_dict_are_refused(name, wrong):
    scene = trimesh.Scene([trimesh.creation.box()])
    with pytest.raises(e3d.InvalidArgumentError, match=f"{name} must be a dict, not "):
        scene.save_image(resolution=(8, 8), **{name: wrong})


@pytest.mark.parametrize("name", ["point_size", "line_width"])
@pytest.mark.parametrize("wrong", ["x", None, -1, 0, float("nan"), [1]])
def test_widths_that_are_no_numbers_are_named(name, wrong):
    scene = trimesh.Scene([trimesh.creation.box()])
    with pytest.raises(e3d.InvalidArgumentError, match=f"line_settings.*{name}"):
        scene.save_image(resolution=(8, 8), line_settings={name: wrong})


@pytest.mark.parametrize("empty", [{}, {"vertices": [[0, 0, 0], [1, 0, 0]]}])
def test_a_scene_of_empty_meshes_is_its_background(empty):
    assert (picture(trimesh.Scene([trimesh.Trimesh(**empty)])) == 255).all()


@pytest.mark.parametrize("value", [np.nan, np.inf, -np.inf])
def test_points_without_a_place_are_named_as_the_cause(value):
    good, bad = trimesh.creation.box(), trimesh.creation.box()
    bad.vertices[3, 1] = value
    scene = trimesh.Scene({"good": good, "bad": bad})
    with pytest.raises(e3d.InvalidArgumentError, match="'bad' has points that are not finite"):
        picture(scene)
    scene = trimesh.Scene([good])
    scene.camera_transform = np.full((4, 4), value)
    with pytest.raises(e3d.InvalidArgumentError, match="camera_transform is not finite$"):
        picture(scene)
