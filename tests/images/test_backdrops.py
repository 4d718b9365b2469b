"""An environment as the background: every backend and number of threads against the reference."""

import functools

import numpy as np
import pytest
from plain_picture import Renderer, render

import engine3d as e3d
from engine3d import linalg
from engine3d._native import rasterizer

SIZE = (150, 93)
BACKENDS = [("portable", 1), ("sse41", 2), ("avx2", 1), ("avx2", 3), ("avx512", 2), ("neon", 2)]
POSE = linalg.look_at((2, 2, 3), (0, 0, 0))
CAMERAS = {
    "perspective": e3d.PerspectiveCamera(1.2, znear=0.1, zfar=100),
    "orthographic": e3d.OrthographicCamera(2.5, znear=0.1, zfar=100),
    "intrinsics": e3d.IntrinsicsCamera(100, 110, 70, 40, znear=0.1, zfar=10),
}


@functools.cache
def environment():
    pixels = np.random.default_rng(0).random((64, 128, 3)).astype(np.float32) ** 4 * 3
    return e3d.Environment(pixels)


def some(background=None):
    scene = e3d.Scene(environment() if background is None else background)
    scene.add(e3d.torus())
    scene.add(e3d.box(), translation=(2, 0, -1))
    scene.environment_rotation, scene.environment_intensity = 0.7, 0.8
    scene.background_blur = 0.13
    return scene


def drawn(scene, camera="perspective", backend="scalar", threads=1, **options):
    look = CAMERAS[camera], POSE
    options = {"size": SIZE, "backend": backend, "threads": threads, **options}
    return render(scene, look, **options).color


CASES = [
    *({"camera": name, "samples": count} for name in CAMERAS for count in (1, 4, 16)),
    *({"mode": mode} for mode in ("unlit", "normal", "depth", "overdraw", "object_id")),
    *({"wireframe": how, "samples": n} for how in ("overlay", "only") for n in (1, 4)),
    {"wireframe": "only", "shading": "forward", "samples": 16},
    {"wireframe": "only", "hidden_surfaces": "painter"},
    {"shading": "forward", "samples": 4},
    {"hidden_surfaces": "painter", "samples": 4},
    {"hidden_surfaces": "none"},
    {"color_space": "linear", "samples": 4},
    {"color_space": "linear", "mode": "unlit"},
    {"culling": "always"},
    {"size": (1, 1)},
    {"size": (64, 65), "samples": 4},
    {"size": (129, 64), "samples": 16},
]


@pytest.mark.parametrize("options", CASES, ids=str)
def test_every_backend_gives_the_bytes_of_the_reference(options):
    for scene in (some(), e3d.Scene(environment())):
        expected = drawn(scene, **options)
        assert (expected[:, :, 3] == 255).all()
        for backend, threads in BACKENDS:
            if rasterizer.backend_available(rasterizer.BACKENDS[backend]):
                got = drawn(scene, backend=backend, threads=threads, **options)
                assert np.array_equal(got, expected), (backend, threads)


@pytest.mark.parametrize("samples", [1, 4])
def test_a_frame_in_rounds(samples):
    """Tiles that were cleared, or drawn, before more comes to lie in them."""
    scene = some()
    rng = np.random.default_rng(3)
    poses = np.concatenate(
        [rng.uniform(-3, 3, (3000, 3)), rng.uniform(0.02, 0.2, (3000, 1))], axis=1
    ).astype(np.float32)
    scene.add(e3d.InstancedMesh(e3d.icosphere(subdivisions=1), poses))
    options = {"samples": samples, "size": (300, 200), "culling": "always"}
    expected = drawn(scene, **options)
    with Renderer((300, 200), samples=samples, threads=2) as renderer:
        for _ in range(4):
            frame = renderer.render(scene, (CAMERAS["perspective"], POSE), culling="always")
            assert np.array_equal(frame.color, expected)


def gradient():
    """Red goes with the azimuth, green with the elevation."""
    rows, columns = np.mgrid[0:256, 0:512]
    return np.stack([columns / 512, rows / 256, np.full((256, 512), 0.5)], axis=-1)


@pytest.mark.parametrize("turn", [0.0, 0.5, -2.0])
@pytest.mark.parametrize("camera", ["perspective", "intrinsics"])
def test_the_background_is_what_lies_along_the_ray(camera, turn):
    scene = e3d.Scene(e3d.Environment(gradient()))
    scene.environment_rotation = turn
    got = drawn(scene, camera, size=(160, 100), color_space="linear")[:, :, :3] / 255
    inverse = np.linalg.inv(CAMERAS[camera].projection((160, 100)))
    x, y = np.meshgrid((np.arange(160) + 0.5) / 80 - 1, 1 - (np.arange(100) + 0.5) / 50)
    far = np.stack([x, y, np.ones_like(x), np.ones_like(x)], axis=-1) @ inverse.T
    d = (far[..., :3] / far[..., 3:]) @ POSE[:3, :3].T
    c, s = np.cos(turn), np.sin(turn)
    x, z = c * d[..., 0] - s * d[..., 2], s * d[..., 0] + c * d[..., 2]
    u = np.arctan2(z, x) / (2 * np.pi) + 0.5
    v = 0.5 - np.arcsin(d[..., 1] / np.linalg.norm(d, axis=-1)) / np.pi
    apart = np.abs(got - np.stack([u, v, np.full_like(u, 0.5)], axis=-1))
    inner = (u > 0.01) & (u < 0.99) & (np.abs(v - 0.5) < 0.45)  # neither seam nor poles
    assert inner.mean() > 0.5
    assert apart[inner].max() < 0.006


def test_without_perspective_all_pixels_look_the_same_way():
    scene = e3d.Scene(environment())
    colors = drawn(scene, "orthographic")
    assert (colors == colors[0, 0]).all()
    inside = drawn(scene, "perspective", size=(151, 93))[46, 75]
    assert np.abs(colors[0, 0].astype(int) - inside).max() <= 1


def test_intensity_and_blur():
    scene = e3d.Scene(e3d.Environment(np.full((8, 16, 3), 0.5)))
    for intensity, blur, value in ((1, 0, 0.5), (0.5, 0.3, 0.25), (4, 1, 1.0), (0, 0, 0.0)):
        scene.environment_intensity, scene.background_blur = intensity, blur
        colors = drawn(scene, color_space="linear")
        assert (colors[:, :, :3] == round(255 * value)).all()
    noisy = e3d.Scene(environment())
    spread = []
    for blur in (0.0, 0.25, 0.5, 1.0):
        noisy.background_blur = blur
        spread.append(drawn(noisy, color_space="linear")[:, :, 0].astype(float).std())
    assert spread == sorted(spread, reverse=True) and spread[0] > 4 * spread[3]


def test_outputs_and_other_modes_show_no_environment():
    scene, plain = some(), some((0, 0, 0))
    for mode in ("normal", "depth", "random", "overdraw"):
        assert np.array_equal(drawn(scene, mode=mode), drawn(plain, mode=mode))
    look = CAMERAS["perspective"], POSE
    frames = [
        render(s, look, size=SIZE, outputs=("depth", "albedo", "object_id")) for s in (scene, plain)
    ]
    for name in ("depth", "albedo", "object_id"):
        assert np.array_equal(getattr(frames[0], name), getattr(frames[1], name))


def test_the_plan_says_it():
    look = CAMERAS["perspective"], POSE
    plans = [
        render(scene, look, size=SIZE, mode=mode).stats["plan"]
        for scene, mode in ((some(), "lit"), (some((0, 0, 0)), "lit"), (some(), "normal"))
    ]
    assert ["backdrop" in plan for plan in plans] == [True, False, False]
