"""The colour that is made of the radiance, gradients, and fog that has one colour."""

import numpy as np
import pytest
from images.scenes_tone import HAZE, lamps
from kernels.test_encode import expected_bytes
from kernels.test_tone import mapped
from plain_picture import render

import engine3d as e3d
from engine3d._native.rasterizer import TONE_MAPPINGS

SIZE = (160, 120)
ORDER = np.zeros((1, 1), np.int64)
for _ in range(3):  # Bayer's matrix, from the next smaller one
    ORDER = np.block([[4 * ORDER, 4 * ORDER + 2], [4 * ORDER + 3, 4 * ORDER + 1]])


@pytest.mark.parametrize("name", TONE_MAPPINGS)
def test_colour_is_the_radiance_mapped(name):
    scene = lamps(e3d.Environment.sky(), e3d.ExponentialFog(HAZE, 0.1))
    for node in scene.nodes:  # neither lines nor glass, nor what is not lit
        material = getattr(node.object, "materials", [None])[0]
        plain = material is None or (material.alpha_mode == "opaque" and not material.unlit)
        node.visible = plain and len(getattr(node.object, "lines", ())) == 0
    scene.exposure = 2.0
    frame = render(scene, size=SIZE, outputs=("color", "radiance"), tone_mapping=name)
    planes = mapped(name, frame.radiance.reshape(-1, 3).T)
    shown = expected_bytes([np.ascontiguousarray(plane) for plane in planes], True)
    assert np.array_equal(frame.color.reshape(-1, 4).view(np.uint32)[:, 0], shown)
    assert frame.radiance.max() > 3


@pytest.mark.parametrize("name", TONE_MAPPINGS)
def test_all_fog_is_its_colour(name):
    """Whatever stands in it, lit or not, and whatever the exposure: no seam to the background."""
    scene = lamps(HAZE, e3d.Fog(HAZE, 0.0, 0.001))
    scene.exposure = 2.0
    frame = render(scene, size=SIZE, tone_mapping=name, samples=4)
    off = np.abs(frame.color[..., :3].astype(int) - HAZE)
    assert off.max() <= 1


@pytest.mark.parametrize("name", TONE_MAPPINGS)
@pytest.mark.parametrize("values", [{}, {"transmission": 0.5}, {"roughness": 0.4}, {"ior": 1.0}])
def test_glass_brings_no_more_fog_than_there_is(name, values):
    """Where all is fog, it doesn't show; in thin fog black behind it is what it is without."""
    held = {"color": (255, 200, 90), "metallic": 0.0, "roughness": 0.0, "transmission": 1.0}
    glass = e3d.Material(**{**held, **values}, thickness=0.3, alpha_mode="opaque")
    scene = e3d.Scene(HAZE, ambient=(0.0, 0.0, 0.0))
    scene.add(e3d.DirectionalLight((0, 1, 0), intensity=1e-9))
    scene.add(e3d.box((1, 1, 0.1))).object.materials = [glass]
    camera = e3d.PerspectiveCamera(0.6), e3d.look_at((0, 0, 5), (0, 0, 0))
    scene.fog = e3d.Fog(HAZE, 0.0, 4.0)
    frame = render(scene, camera, size=SIZE, tone_mapping=name, refraction=False)
    assert np.abs(frame.color[..., :3].astype(int) - HAZE).max() <= 1
    wall = scene.add(e3d.box((20, 20, 0.1)), translation=(0, 0, -1))
    wall.object.materials = [e3d.Material(color=(0, 0, 0))]
    scene.fog = e3d.Fog(HAZE, 0.0, 20.0)
    outputs = ("color", "radiance")
    seen = render(scene, camera, size=SIZE, tone_mapping=name, refraction=False, outputs=outputs)
    middle, edge = seen.radiance[SIZE[1] // 2, SIZE[0] // 2], seen.radiance[0, 0]
    assert (middle <= edge * 1.01).all()


def test_fog_by_depth():
    scene = e3d.Scene((0, 0, 0), ambient=(1.0, 1.0, 1.0))
    floor = e3d.plane((100, 100), 1)
    floor.materials = [e3d.Material(color=(0.0, 0.0, 0.0), unlit=True)]
    scene.add(floor)
    camera = e3d.PerspectiveCamera(0.9, znear=0.1), e3d.look_at((0, 2, 0), (0, 0, -6))
    outputs = ("color", "radiance", "depth")
    for fog, share in (
        (e3d.Fog((1.0, 1.0, 1.0), 3.0, 20.0), lambda d: np.clip((d - 3) / 17, 0, 1)),
        (e3d.ExponentialFog((1.0, 1.0, 1.0), 0.1), lambda d: 1 - np.exp(-((0.1 * d) ** 2))),
    ):
        scene.fog = fog
        frame = render(scene, camera, size=SIZE, outputs=outputs)
        seen = frame.depth > 0
        expected = share(frame.depth[seen].astype(np.float64))
        assert np.abs(frame.radiance[seen][:, 0] - expected).max() < 1e-5
        assert (frame.radiance[~seen] == 0).all()


def test_gradient():
    top, bottom = np.array((10, 200, 90)), np.array((60, 20, 91))
    scene = e3d.Scene(e3d.Gradient(tuple(top.tolist()), tuple(bottom.tolist())))
    width, height = 70, 33
    t = (np.arange(height) + 0.5) / height
    value = top + (bottom - top) * t[:, None]
    y, x = np.mgrid[0:height, 0:width]
    expected = np.floor(value[:, None] + (ORDER[y % 8, x % 8][..., None] + 0.5) / 64)
    for samples in (1, 4, 16):
        for mode in ("lit", "unlit", "depth", "overdraw"):
            frame = render(scene, size=(width, height), samples=samples, mode=mode)
            off = np.abs(frame.color[..., :3] - expected)
            assert (off > 0).mean() < 1e-3 and off.max() <= 1  # where a rounding decides
            assert (frame.color[..., 3] == 255).all()


def test_one_colour_has_no_pattern():
    for color in ((0, 77, 255), (128, 128, 128)):
        scene = e3d.Scene(e3d.Gradient(color, color))
        for color_space in ("srgb", "linear"):
            frame = render(scene, size=(20, 20), color_space=color_space)
            assert (frame.color[..., :3] == color).all()


def test_a_hundred_rows_show_no_bands():
    """Means of 8 x 8 pixels go down as evenly as the colours do, between two codes, too."""
    scene = e3d.Scene(e3d.Gradient((100, 100, 100), (90, 90, 90)))
    frame = render(scene, size=(64, 512))
    means = frame.color[..., 0].reshape(64, 8, 64).mean(axis=(1, 2))
    steps = np.diff(means)
    assert (steps < 0).all() and np.abs(steps + 10 / 64).max() < 0.05


def test_bad_values():
    for make in (
        lambda: e3d.Fog((1, 1, 1), 5, 5),
        lambda: e3d.Fog((1, 1, 1), float("nan"), 5),
        lambda: e3d.Fog((1, 1), 0, 5),
        lambda: e3d.ExponentialFog((1, 1, 1), -0.1),
        lambda: e3d.Gradient((1, 1, 1), None),
        lambda: e3d.Scene().__setattr__("fog", (1, 1, 1)),
        lambda: render(e3d.Scene(), size=(8, 8), tone_mapping="filmic"),
    ):
        with pytest.raises(e3d.InvalidArgumentError):
            make()
