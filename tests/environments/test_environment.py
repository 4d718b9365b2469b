"""`Environment`, and the properties of scenes that have to do with it."""

import copy
import pickle

import numpy as np
import pytest
from plain_picture import Renderer, render

import engine3d as e3d
from engine3d.rendering.draw_list import native_handles as _native_handles


def test_pixels_are_kept_and_cannot_be_written():
    given = np.arange(24, dtype=np.float64).reshape(2, 4, 3)
    environment = e3d.Environment(given, name="steps")
    given[:] = 0
    assert environment.pixels.dtype == np.float32 and environment.pixels.max() == 23
    assert (environment.width, environment.height, environment.name) == (4, 2, "steps")
    assert environment.path is None and environment.built_in is None
    with pytest.raises(ValueError, match="read-only"):
        environment.pixels[0] = 1
    for name in ("pixels", "name", "path", "version"):
        with pytest.raises(AttributeError):
            setattr(environment, name, None)
    for other in (copy.copy(environment), pickle.loads(pickle.dumps(environment))):
        assert np.array_equal(other.pixels, environment.pixels) and other.name == "steps"


@pytest.mark.parametrize(
    ("pixels", "told"),
    [
        (np.ones((2, 4)), r"must be \(H, W, 3\)"),
        (np.ones((2, 4, 4)), r"must be \(H, W, 3\)"),
        (np.ones((0, 4, 3)), "sides must be"),
        (np.ones((1, 16385, 3), np.float32), "sides must be"),
        ("sky.hdr", "use Environment.load"),
        ([["a"]], "pixels"),
        (None, "pixels"),
    ],
)
def test_what_is_no_picture(pixels, told):
    with pytest.raises(e3d.InvalidArgumentError, match=told):
        e3d.Environment(pixels)


@pytest.mark.parametrize(("name", "height"), [("studio", 256), ("sky", 512), ("hall", 512)])
def test_built_in_environments(name, height):
    make = getattr(e3d.Environment, name)
    environment = make()
    assert make() is environment and environment.built_in == environment.name == name
    pixels = environment.pixels
    assert pixels.shape == (height, 2 * height, 3)
    assert np.isfinite(pixels).all() and pixels.min() > 0
    native = _native_handles.native_environment(environment, 1)
    irradiance = np.asarray(native.level(8))[:, 1:-1, 1:-1, :3]
    assert 0.5 < irradiance.mean() < 1.5  # white surfaces show about white
    up, down = irradiance[2].mean(), irradiance[3].mean()
    assert up > down


def test_it_is_prepared_once():
    environment = e3d.Environment(np.ones((8, 16, 3)))
    native = _native_handles.native_environment(environment, 1)
    assert _native_handles.native_environment(environment, 2) is native
    scene = e3d.Scene(environment)
    for _ in range(2):
        render(scene, size=(8, 8))
    assert _native_handles.native_environment(environment, 1) is native


def test_load_from_a_path(tmp_path):
    path = tmp_path / "tiny.hdr"
    path.write_bytes(b"#?RADIANCE\n\n-Y 1 +X 2\n" + bytes([9, 8, 7, 128] * 2))
    environment = e3d.Environment.load(path)
    assert environment.name == "tiny" and environment.path == str(path)
    with pytest.raises(e3d.FileAccessError, match="cannot read"):
        e3d.Environment.load(tmp_path / "none.hdr")


def test_properties_of_scenes():
    scene = e3d.Scene()
    assert scene.environment is None and scene.environment_intensity == 1.0
    assert scene.environment_rotation == 0.0 and scene.background_blur == 0.0
    scene.background = scene.environment = e3d.Environment(np.ones((1, 2, 3)))
    assert scene.background is scene.environment
    for name, wrong in (
        ("environment", "studio"),
        ("environment", (1, 1, 1)),
        ("environment_intensity", -1),
        ("environment_intensity", np.inf),
        ("environment_rotation", np.nan),
        ("background_blur", 1.5),
        ("background_blur", -0.1),
        ("background", "sky"),
    ):
        before = getattr(scene, name)
        with pytest.raises(e3d.InvalidArgumentError, match=name):
            setattr(scene, name, wrong)
        assert getattr(scene, name) is before


def test_a_change_shows_in_the_next_frame():
    pixels = np.ones((16, 32, 3)) * np.linspace(0, 1, 32)[:, None]
    scene = e3d.Scene(e3d.Environment(pixels))
    camera = e3d.PerspectiveCamera(), np.eye(4)
    seen = set()
    with Renderer((32, 16)) as renderer:
        for name, value in (
            ("environment_rotation", 1.0),
            ("environment_intensity", 0.5),
            ("background_blur", 0.7),
            ("background", (9, 9, 9)),
            ("background", e3d.Environment(pixels[::-1, ::-1])),
        ):
            seen.add(renderer.render(scene, camera).color.tobytes())
            setattr(scene, name, value)
        seen.add(renderer.render(scene, camera).color.tobytes())
    assert len(seen) == 6
