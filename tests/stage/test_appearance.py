"""What nobody said about lines and points: colours that are seen, sizes that suit the cloud."""

import numpy as np
import pytest

import engine3d as e3d
from engine3d.stage.appearance import contrasting, point_size
from engine3d.stage.stage_settings import Settings
from engine3d.stage.view_renderer import ViewRenderer
from engine3d.stage.viewed_scene import ViewedScene


def luminance(color):
    return float(np.dot([(c / 255) ** 2.2 for c in color], (0.2126, 0.7152, 0.0722)))


@pytest.mark.parametrize(
    "background",
    [
        (255, 255, 255),
        (0, 0, 0),
        (43, 46, 53),
        (142, 178, 204),
        (255, 255, 0),
        (0, 0, 255),
        (1, 1, 1),
    ],
)
def test_lines_alone_contrast_with_the_background(background):
    scene = e3d.Scene(background)
    scene.add(e3d.box())
    with ViewRenderer(
        ViewedScene(scene, "box"), Settings({"wireframe": "only"}), (160, 120)
    ) as view_renderer:
        picture = view_renderer.draw(view_renderer.view()).color[..., :3]
    behind = picture[0, 0]
    lines = np.unique(picture[(picture != behind).any(axis=2)], axis=0)
    assert len(lines) == 1
    high, low = sorted((luminance(lines[0]), luminance(behind)), reverse=True)
    assert (high + 0.05) / (low + 0.05) > 4.0


def test_a_line_colour_that_was_given_stays():
    scene = e3d.Scene((255, 255, 255))
    scene.add(e3d.box())
    settings = Settings({"wireframe": "only", "line_color": (250, 250, 250)})
    with ViewRenderer(ViewedScene(scene, "box"), settings, (160, 120)) as view_renderer:
        picture = view_renderer.draw(view_renderer.view()).color[..., :3]
    assert set(np.unique(picture)) == {250, 255}
    assert contrasting(None) == contrasting((0, 0, 0))


def cloud(count):
    random = np.random.default_rng(1)
    places = random.normal(size=(count, 3))
    places /= np.sqrt((places * places).sum(axis=1))[:, np.newaxis]
    scene = e3d.Scene((0, 0, 0))
    scene.add(e3d.Mesh(places.astype(np.float32), points=np.arange(count)))
    return scene


def covered(scene, size, appearance):
    with ViewRenderer(ViewedScene(scene, "cloud"), Settings(appearance), size) as view_renderer:
        picture = view_renderer.draw(view_renderer.view()).color[..., :3]
        return float((picture != 0).any(axis=2).mean()), view_renderer.point_size


@pytest.mark.parametrize("size", [(640, 360), (1280, 720), (2560, 1440)])
def test_a_cloud_of_5000_points_is_seen_at_every_resolution(size):
    share, pixels = covered(cloud(5000), size, {})
    assert 0.05 < share < 0.25
    assert pixels == round(4.07 * size[1] / 720)
    assert covered(cloud(5000), size, {"point_size": 1.0})[1] == 1.0


def test_points_are_the_smaller_the_more_there_are_within_limits():
    sizes = [point_size(count, (1280, 720)) for count in (0, 1, 500, 5000, 20_000, 10**5, 10**8)]
    assert sizes == [6, 6, 6, 4, 2, 1, 1]
    assert point_size(10**8, (3840, 2160)) == 3
    assert point_size(1, (1, 1)) == 1


def test_points_of_instances_count():
    scene = e3d.Scene((0, 0, 0))
    mesh = e3d.Mesh(np.zeros((100, 3), np.float32), points=np.arange(100))
    scene.add(e3d.InstancedMesh(mesh, np.array([(k, 0, 0, 1) for k in range(50)], np.float32)))
    assert covered(scene, (1280, 720), {})[1] == point_size(5000, (1280, 720))
