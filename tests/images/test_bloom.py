"""Bloom against R124 in NumPy, and what it leaves alone."""

import numpy as np
import pytest
from images.objects import with_material
from images.scenes_alpha import pane, seen_through
from images.scenes_glass import behind_glass
from images.scenes_tone import lamps
from kernels.test_encode import expected_bytes
from plain_picture import Renderer, render

import engine3d as e3d
from engine3d._native import rasterizer
from engine3d.model.materials.colors import srgb_to_linear_table

F = np.float32
SIZES = [(1, 1), (1, 7), (2, 2), (3, 5), (16, 16), (17, 33), (64, 1), (131, 257)]


def clamped(index, count):
    return np.clip(index, 0, count - 1)


def filtered(image, axis):
    """Half as many rows (axis 0) or columns."""
    size = image.shape[axis]
    first = 2 * np.arange((size + 1) // 2)
    a, b, c, d = (np.take(image, clamped(first + k, size), axis) for k in (-1, 0, 1, 2))
    return ((a + d) + (b + c) * F(3)) * F(0.125)


def doubled(image, size, axis):
    i = np.arange(size)
    near = np.take(image, i // 2, axis)
    far = np.take(image, clamped(i // 2 + np.where(i % 2, 1, -1), image.shape[axis]), axis)
    return near * F(0.75) + far * F(0.25)


def spread(image, shape):
    return doubled(doubled(image, shape[0], 0), shape[1], 1)


def glow_of(radiance, strength):
    """R124: what is added to each pixel, before it is mixed."""
    count = 1
    while count < 8 and 8 << (count + 1) <= len(radiance):
        count += 1
    levels = [np.clip(radiance - F(1), F(0), F(64))]
    for _ in range(count):
        levels.append(filtered(filtered(levels[-1], 0), 1))
    total = levels[-1]
    for level in levels[-2:0:-1]:
        total = level + spread(total, level.shape)
    return spread(total, radiance.shape) * (F(strength) * (F(1) / F(count)))


def expected(radiance, color, strength, srgb):
    glow = glow_of(radiance, strength)
    codes = color[..., :3]
    if srgb:
        sixteen = np.rint(srgb_to_linear_table().astype(np.float64) * 65535).astype(F)
        shown = sixteen[codes] * F(float.fromhex("0x1.0001p-16"))
    else:
        shown = codes.astype(F) * F(float.fromhex("0x1.010102p-8"))
    share = glow / (F(1) + glow)
    mixed = (shown + (F(1) - shown) * share).reshape(-1, 3)
    out = color.copy()
    planes = [np.ascontiguousarray(mixed[:, k]) for k in range(3)]
    codes = expected_bytes(planes, srgb).view(np.uint8).reshape(-1, 4)
    out[..., :3] = codes[:, :3].reshape(*color.shape[:2], 3)
    return out


@pytest.mark.parametrize("backend", list(rasterizer.BACKENDS))
def test_glow(backend):
    if backend not in e3d.backends():
        pytest.skip(f"{backend}: this build or CPU lacks it")
    rng = np.random.default_rng(1)
    for (height, width), srgb in ((size, s) for size in SIZES for s in (False, True)):
        radiance = (rng.random((height, width, 3)) ** 8 * 90).astype(F)
        color = rng.integers(0, 256, (height, width, 4), np.uint8)
        wanted = expected(radiance, color, 0.7, srgb)
        for threads in (1, 2, 5):
            got = color.copy()
            scratch = np.empty(rasterizer.bloom_scratch(width, height, threads), F)
            number = rasterizer.BACKENDS[backend]
            rasterizer.add_bloom(radiance, got, 0.7, srgb, number, threads, scratch)
            assert np.array_equal(got, wanted), (height, width, srgb, threads)


def test_a_single_bright_number():
    """Wherever it is, it glows: in the last pixel of a row as well."""
    for place in ((0, 0, 0), (36, 66, 2), (20, 66, 0), (36, 1, 1)):
        radiance = np.zeros((37, 67, 3), F)
        radiance[place] = 30
        color = np.full((37, 67, 4), 20, np.uint8)
        for backend in e3d.backends():
            got, scratch = color.copy(), np.empty(rasterizer.bloom_scratch(67, 37, 2), F)
            number = rasterizer.BACKENDS[backend]
            rasterizer.add_bloom(radiance, got, 1.0, True, number, 2, scratch)
            assert np.array_equal(got, expected(radiance, color, 1.0, True))
            assert got[place] > 20


def test_what_glows():
    """Around what is bright it is brighter, elsewhere the same; alpha stays everywhere."""
    scene = lamps(None)
    for options in ({}, {"samples": 4, "tone_mapping": "agx"}):
        plain = render(scene, size=(200, 150), outputs=("color", "radiance"), **options)
        glowing = render(scene, size=(200, 150), bloom=0.5, **options)
        assert glowing.outputs == ("color",)
        assert np.array_equal(glowing.color, expected(plain.radiance, plain.color, 0.5, True))
        assert (glowing.color >= plain.color).all() and (glowing.color != plain.color).any()


BLACK = (0, 0, 0)
LAMP, GLASS = e3d.linear(8.0, 4.0, 0.5), e3d.linear(0.0, 6.0, 3.0)


def panes(*alphas, **material):
    """Panes that shine, one before the other from behind: all of the picture."""
    scene = e3d.Scene(BLACK, ambient=BLACK)
    for number, alpha in enumerate(alphas):
        shine = GLASS if number else LAMP
        mode = "opaque" if alpha == 1 else "blend"
        own = {"emissive": shine, "alpha_mode": mode, **(material if number else {})}
        scene.add(pane((0, 0, 0, alpha), size=8, **own), translation=(0, -4, 0.2 * number))
    return scene, (e3d.OrthographicCamera(1.0), e3d.look_at((0, 0, 3), (0, 0, 0)))


def layers(light, *alphas):
    for alpha in alphas:
        light = F(GLASS) * F(alpha) + light * (F(1) - F(alpha))
    return light


@pytest.mark.parametrize("backend", e3d.backends())
def test_radiance_of_layers(backend):
    """Lights behind each other in any order, whatever samples, outputs and edges are asked for."""
    for alphas, method in (
        ((1, 0.25), {}),
        ((1, 0.5, 0.75), {"hidden_surfaces": "painter"}),
        ((0.5, 0.25), {"transparent_outputs": True}),
        ((1, 0.5), {"wireframe": "only", "tone_mapping": "agx"}),
    ):
        scene, camera = panes(*alphas)
        base = F(LAMP) if alphas[0] == 1 else F(LAMP) * F(alphas[0])
        for samples, antialiasing in ((1, "ssaa"), (4, "ssaa"), (16, "ssaa"), (4, "msaa")):
            with Renderer(
                (66, 20), backend=backend, threads=2, samples=samples, antialiasing=antialiasing
            ) as renderer:
                for outputs in (("radiance",), ("color", "radiance", "depth")):
                    frame = renderer.render(scene, camera, outputs=outputs, **method)
                    assert (frame.radiance == layers(base, *alphas[1:])).all()


@pytest.mark.parametrize("wireframe", [None, "only", "overlay"])
@pytest.mark.parametrize("backend", e3d.backends())
def test_a_layer_that_is_not_there_leaves_every_bit(backend, wireframe):
    """The sign of a zero, too: 0 times a colour would add +0 to -0."""
    for alpha in (0.0, 1e-9):
        scene, camera = panes(1, alpha)
        for node, color in zip(scene.nodes, ((-0.0, 0.5, -0.0), (0.0, 0.25, 1.0)), strict=True):
            material = node.object.materials[0]
            material.color = e3d.linear(*color, material.alpha)
        for samples in (1, 4):
            with Renderer((20, 12), backend=backend, samples=samples) as renderer:
                frame = renderer.render(
                    scene, camera, outputs=("radiance",), mode="unlit", wireframe=wireframe
                )
            signs = np.signbit(frame.radiance[6, 10])
            assert (signs == (True, False, True)).all(), (alpha, samples)


def test_radiance_is_what_shows():
    """Dim scenes show it, layer by layer, whatever lets light through."""
    for scene in (seen_through(BLACK), behind_glass(BLACK)):
        scene.exposure = -5.0
        for options in ({}, {"hidden_surfaces": "none"}, {"mode": "unlit"}):
            if scene.fog is None and options:
                scene.fog = e3d.ExponentialFog((90, 60, 30), 0.1)
            outputs = ("color", "radiance")
            frame = render(scene, size=(120, 90), outputs=outputs, **options)
            planes = [np.ascontiguousarray(frame.radiance[..., k].ravel()) for k in range(3)]
            shown = expected_bytes(planes, True).view(np.uint8).reshape(90, 120, 4)
            off = np.abs(shown[..., :3].astype(int) - frame.color[..., :3])
            assert off.max() <= 1 and (off > 0).mean() < 0.002


def test_radiance_alone_has_shadows():
    """What else is asked for changes nothing."""
    scene = seen_through()
    for kind in ("map", "exact"):
        scene.add(e3d.DirectionalLight((0.5, -1, -0.2), shadow=kind))
    options = {"size": (100, 80), "ambient_occlusion": True}
    both = render(scene, outputs=("color", "radiance"), **options)
    alone = render(scene, outputs=("radiance",), **options)
    assert np.array_equal(alone.radiance, both.radiance)


def test_light_too_bright_to_add_up():
    scene, camera = panes(1, 0.5, roughness=0.5, metallic=0.0, transmission=1.0)
    for node in scene.nodes:
        node.object.materials[0].emissive = e3d.linear(3e38, 3e38, 1.0)
    for backend in e3d.backends():
        frame = render(scene, camera, size=(9, 9), outputs=("radiance",), backend=backend)
        assert np.isfinite(frame.radiance).all()


def test_glass_glows_and_dims():
    """Emissive glass glows; what shines behind dark glass glows less, the more so the darker."""

    def glow(*alphas, emissive):
        scene = e3d.Scene(BLACK, ambient=BLACK)
        ball = with_material(
            e3d.icosphere(0.15, 2), color=BLACK, emissive=e3d.linear(9.0, 9.0, 9.0)
        )
        if not emissive:
            scene.add(ball)
        for alpha in alphas:
            shine = e3d.linear(6.0, 6.0, 6.0) if emissive else BLACK
            own = {"alpha_mode": "blend", "emissive": shine}
            glass = pane((0, 0, 0, alpha), size=0.4, **own)
            scene.add(glass, translation=(0, -0.2, 0.5))
        camera = e3d.OrthographicCamera(1.0), e3d.look_at((0, 0, 3), (0, 0, 0))
        plain, shown = (
            render(scene, camera, size=(80, 80), bloom=bloom).color.astype(int) for bloom in (0, 1)
        )
        return (shown - plain)[40, 20, 0]  # beside the glass

    assert glow(emissive=True) == 0
    assert glow(0.9, emissive=True) > glow(0.4, emissive=True) > 0
    bare, grey, dark = (glow(*alphas, emissive=False) for alphas in ((), (0.4,), (0.4, 0.95)))
    assert bare > grey > dark == 0


def test_dark_scenes_and_other_modes_stay():
    scene = lamps()
    dim = e3d.Scene((30, 38, 54))
    dim.add(e3d.box(1))
    for one, options in ((scene, {"mode": "normal"}), (scene, {"mode": "overdraw"}), (dim, {})):
        plain = render(one, size=(80, 60), **options)
        assert np.array_equal(plain.color, render(one, size=(80, 60), bloom=3, **options).color)


def test_bad_strengths():
    for bloom in (-1, 101, float("nan"), "much"):
        with pytest.raises(e3d.InvalidArgumentError, match="bloom"):
            render(e3d.Scene(), size=(8, 8), bloom=bloom)
