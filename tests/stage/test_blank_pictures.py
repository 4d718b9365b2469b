"""`engine3d.render` says why its picture shows nothing; a renderer in a loop does not."""

import json
import warnings

import numpy as np
import pytest

import engine3d as e3d

SIZE = 32, 24
AWAY = e3d.PerspectiveCamera(), e3d.look_at((0, 0, 5), (0, 0, 9))


def lit(thing):
    """A scene with light of its own, which wears no look."""
    scene = e3d.Scene()
    scene.add(thing)
    scene.add(e3d.PointLight(), translation=(3, 3, 3))
    return scene


def empty_file(folder):
    path = folder / "empty.gltf"
    path.write_text(json.dumps({"asset": {"version": "2.0"}, "scenes": [{"nodes": []}]}))
    return path


NO_POINTS = e3d.Mesh(np.full((3, 3), np.nan, np.float32), [(0, 1, 2)])


@pytest.mark.parametrize(
    ("thing", "camera", "reason"),
    [
        (empty_file, None, "there is no mesh in the scene"),
        (e3d.Scene(), None, "there is no mesh in the scene"),
        (NO_POINTS, None, "no vertex has finite coordinates"),
        (e3d.box(), AWAY, "behind the camera"),
        (lit(e3d.box()), AWAY, "behind the camera"),
        (lit(NO_POINTS), None, "no vertex has finite coordinates"),
    ],
)
@pytest.mark.parametrize("look", ["studio", "plain"])
def test_an_empty_picture_says_why(thing, camera, reason, look, tmp_path):
    thing = thing(tmp_path) if callable(thing) else thing
    with pytest.warns(e3d.Engine3DWarning, match=f"nothing shows: .*{reason}"):
        e3d.render(thing, camera, size=SIZE, look=look)


@pytest.mark.parametrize("look", ["studio", "plain"])
@pytest.mark.parametrize("thing", [e3d.box(), lit(e3d.box()), np.zeros((5, 3), np.float32)])
def test_what_shows_warns_of_nothing(thing, look):
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        e3d.render(thing, size=SIZE, look=look)


def test_a_renderer_draws_empty_pictures_without_a_word():
    with e3d.Renderer(SIZE) as renderer, warnings.catch_warnings():
        warnings.simplefilter("error")
        renderer.render(e3d.Scene())


@pytest.mark.parametrize(("cull", "is_blank"), [("none", False), ("front", False), ("back", True)])
def test_faces_that_are_culled_are_told(cull, is_blank):
    glass = e3d.Mesh(np.float32([(-1, -1, 0), (0, 1, 0), (1, -1, 0)]), [(0, 1, 2)])
    glass.materials = [e3d.Material(color=(200, 0, 0, 128), alpha_mode="blend")]
    camera = e3d.PerspectiveCamera(), e3d.look_at((0, 0, 5), (0, 0, 0))
    with warnings.catch_warnings(record=True) as said:
        warnings.simplefilter("always")
        e3d.render(lit(glass), camera, size=SIZE, cull=cull)
    assert ["their backs" in str(one.message) for one in said] == [True] * is_blank
