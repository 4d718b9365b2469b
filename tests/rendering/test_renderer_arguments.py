"""What a renderer refuses, each message naming the argument and what is allowed."""

import numpy as np
import pytest

import engine3d as e3d


@pytest.fixture(scope="module")
def renderer():
    return e3d.Renderer((8, 6))


@pytest.fixture
def scene():
    return e3d.Scene()


@pytest.mark.parametrize(
    ("size", "options", "message"),
    [
        ((0, 6), {}, r"width must be a whole number in 1\.\.16384"),
        ((8, 16385), {}, "height"),
        ((8.5, 6), {}, "width"),
        ((8, 6), {"samples": 2, "antialiasing": "ssaa"}, "samples=2 needs antialiasing=.msaa"),
        ((8, 6), {"color_space": "hsv"}, "color_space must be one of 'srgb', 'linear'"),
        ((8, 6), {"threads": -1}, "threads"),
    ],
)
def test_renderer(size, options, message):
    with pytest.raises(e3d.InvalidArgumentError, match=message):
        e3d.Renderer(size, **options)


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"mode": "raytraced"}, "mode must be one of 'lit', 'unlit'"),
        ({"mode": ["lit"]}, "mode must be one of"),
        ({"wireframe": "hidden"}, "wireframe must be one of None, 'overlay', 'only'"),
        ({"cull": None}, "cull must be one of"),
        ({"shading": "lazy"}, "shading must be one of 'deferred', 'forward'"),
        ({"normals": "none"}, "normals must be one of 'auto', 'smooth', 'flat'"),
        ({"hidden_surfaces": "bsp"}, "hidden_surfaces must be one of"),
        ({"outputs": "color"}, "outputs must be a tuple of names, not 'color'"),
        ({"outputs": 5}, "outputs must be a tuple of names, not 5"),
        ({"outputs": ("colour",)}, "outputs must be one of 'color', 'depth'"),
        ({"outputs": ()}, "at least one output"),
        ({"line_width": 0}, "line_width must be more than 0 and at most 256"),
        ({"line_width": 257}, "line_width"),
        ({"point_size": float("nan")}, "point_size"),
        ({"line_color": (1, 2)}, "line_color"),
        ({"line_color": "redd"}, "line_color: 'redd' is neither #rrggbb nor the name of a colour"),
        ({"out": np.zeros((6, 8, 4))}, "out must be a Frame"),
        ({"camera": e3d.PerspectiveCamera()}, "a camera alone has no place"),
        ({"camera": 5}, "must be None, a node or a pair"),
        ({"camera": (e3d.PerspectiveCamera(), np.eye(3))}, "camera pose must have shape"),
        ({"camera": (e3d.PerspectiveCamera(), np.zeros((4, 4)))}, "no inverse"),
    ],
)
def test_render(renderer, scene, options, message):
    with pytest.raises(e3d.InvalidArgumentError, match=message):
        renderer.render(scene, **options)


def test_something_drawable_is_drawn(renderer):
    with pytest.raises(e3d.InvalidArgumentError, match="a mesh or points can be drawn, not int"):
        renderer.render(5)


def test_camera_node_must_hold_a_camera(renderer, scene):
    with pytest.raises(e3d.InvalidArgumentError, match="a node that holds a camera"):
        renderer.render(scene, scene.add(e3d.box()))


@pytest.mark.parametrize("argument", ["camera", "culling_camera"])
def test_a_camera_is_one_of_the_scene_or_comes_with_its_pose(argument):
    scene, other = e3d.Scene(), e3d.Scene()
    lens, pose = e3d.PerspectiveCamera(), e3d.look_at((0, 0, 3), (0, 0, 0))
    node, elsewhere = scene.add(lens, pose=pose), other.add(lens, pose=pose)
    with e3d.Renderer((8, 8)) as renderer:
        renderer.render(scene, **{argument: node})
        renderer.render(scene, **{argument: (elsewhere.object, elsewhere.world_pose)})
        with pytest.raises(e3d.InvalidArgumentError, match="not a node of this scene: give"):
            renderer.render(scene, **{argument: elsewhere})
        scene.remove(node)
        with pytest.raises(e3d.InvalidArgumentError, match="not a node of this scene"):
            renderer.render(scene, **{argument: node})


def test_out_must_have_the_size(renderer, scene):
    other = e3d.render(scene, size=(4, 4))
    with pytest.raises(e3d.InvalidArgumentError, match="out must be 8x6, not 4x4"):
        renderer.render(scene, out=other)


def test_size_must_be_a_pair(scene):
    with pytest.raises(e3d.InvalidArgumentError, match="size must be"):
        e3d.render(scene, size=5)


def test_window_light_without_range(renderer, scene):
    light = e3d.PointLight(range=2, falloff="window")
    scene.add(light)
    light.range = float("inf")
    with pytest.raises(e3d.InvalidArgumentError, match="needs a finite range"):
        renderer.render(scene)


def test_closed(scene):
    with e3d.Renderer((4, 4)) as renderer:
        frame = renderer.render(scene)
    assert frame.color.shape == (4, 4, 4)
    renderer.close()
    with pytest.raises(e3d.InvalidArgumentError, match="closed"):
        renderer.render(scene)


def test_a_failed_frame_does_not_spoil_the_next(renderer, scene):
    scene.add(e3d.box())
    with pytest.raises(e3d.InvalidArgumentError):
        renderer.render(scene, mode="none")
    assert renderer.render(scene).color.shape == (6, 8, 4)
