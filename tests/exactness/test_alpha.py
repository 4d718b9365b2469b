"""Section 15 of docs/exactness: masks and blending, by sums in float32 of their own.

A square that fills the image exactly, seen without perspective, makes every pixel's place on the
surface known; colours are linear and unlit, so that a pixel is what its layers add up to.
"""

import itertools

import numpy as np
import pytest
from exactness.test_surfaces import CAMERA, CORNERS, TOWARDS_VIEWER, UVS
from plain_picture import render

import engine3d as e3d

ONE = np.float32(1)
BACKGROUND = (0.25, 0.5, 0.75)


@pytest.fixture(params=e3d.backends())
def backend(request):
    return request.param


def layer(z, color, mode="blend", *, corners=CORNERS, colors=None, **material):
    return e3d.Mesh(
        np.array(corners) + (0, 0, z),
        [[0, 1, 2], [0, 2, 3]],
        uvs=UVS,
        normals=TOWARDS_VIEWER,
        colors=colors,
        materials=[e3d.Material(color=color, alpha_mode=mode, two_sided=True, **material)],
    )


def draw(things, backend="scalar", size=(8, 8), background=BACKGROUND, threads=2, **options):
    scene = e3d.Scene(background=background)
    for thing in things:
        scene.add(thing)
    samples = options.pop("samples", 1)
    settings = {"backend": backend, "threads": threads, "color_space": "linear", "samples": samples}
    return render(scene, CAMERA, size=size, **settings, **{"mode": "unlit", **options})


def over(layers, background=BACKGROUND):
    """R84 and R85 of one sample: layers of (r, g, b, a), the farthest first; the pixel's bytes."""
    color = np.zeros(3, np.float32) if background is None else np.array(background, np.float32)
    alpha = np.float32(background is not None)
    for *rgb, a in np.array(layers, np.float32).reshape(-1, 4):
        color = np.array(rgb, np.float32) * a + color * (ONE - a)
        alpha = a + alpha * (ONE - a)
    color = color * (ONE / alpha)
    return [*np.rint(np.float32(255) * color).astype(int), round(255 * float(alpha))]


def random_layers(rng, count):
    layers = rng.random((count, 4)).astype(np.float32)
    layers[::4, 3] = 0
    layers[1::7, 3] = 1
    return layers


@pytest.mark.parametrize("count", [1, 2, 5, 16, 63, 64, 65, 200])
def test_layers_whatever_order_they_come_in(backend, count):
    rng = np.random.default_rng(count)
    layers = random_layers(rng, count)
    heights = np.linspace(-0.9, 0.9, count)
    expected = over(layers)
    for order in (np.arange(count), np.arange(count)[::-1], rng.permutation(count)):
        color = draw(
            [layer(heights[k], tuple(map(float, layers[k]))) for k in order], backend
        ).color
        assert (color == expected).all()


def test_layers_that_share_a_depth_lie_in_order(backend):
    """The first one is in front, as of opaque surfaces the first one shows."""
    layers = random_layers(np.random.default_rng(3), 6)
    color = draw([layer(0.25, tuple(map(float, one))) for one in layers], backend).color
    assert (color == over(layers[::-1])).all()


def test_surfaces_that_cross(backend):
    """Two squares that lean against each other: on each side another one is in front."""
    red, blue = (0.9, 0.1, 0.2, 0.5), (0.1, 0.2, 0.8, 0.625)
    leaning = np.array(CORNERS, float)
    leaning[:, 2] = leaning[:, 0] * 0.5
    color = draw(
        [layer(0, red, corners=leaning), layer(0, blue, corners=leaning * (1, 1, -1))], backend
    ).color
    assert (color[:, :4] == over([red, blue])).all()
    assert (color[:, 4:] == over([blue, red])).all()


def test_opaque_surfaces_hide_what_is_behind(backend):
    front, behind, wall = (0.9, 0.1, 0.2, 0.5), (0.1, 0.9, 0.2, 0.5), (0.5, 0.25, 0.125, 0.3)
    things = [layer(0.5, front), layer(-0.5, behind), layer(0, wall, "opaque")]
    assert (draw(things, backend).color == over([(*wall[:3], 1), front])).all()


def test_opaque_materials_have_no_alpha(backend):
    pixels = np.full((2, 2, 4), 128, np.uint8)
    texture = e3d.Texture(pixels, filter="nearest")
    colors = np.full((4, 4), 60, np.uint8)
    color = draw(
        [layer(0, (1.0, 1.0, 1.0, 0.1), "opaque", texture=texture, colors=colors)], backend
    ).color
    assert (color[..., 3] == 255).all()
    assert np.array_equal(color[..., :3], np.full((8, 8, 3), round(128 * 60 / 255)))


@pytest.mark.parametrize("background", [BACKGROUND, None])
@pytest.mark.parametrize("samples", [1, 4, 16])
def test_alpha_of_a_picture_without_background(backend, background, samples):
    layers = [(0.5, 0.25, 1.0, 0.25), (1.0, 0.5, 0.0, 0.5)]
    things = [layer(-0.5 + k, one) for k, one in enumerate(layers)]
    color = draw(things, backend, background=background, samples=samples).color
    assert (color == over(layers, background)).all()
    if background is None:
        empty = draw([layer(0, (1.0, 1.0, 1.0, 0.0))], backend, background=None, samples=samples)
        assert not empty.color.any()


@pytest.mark.parametrize(("cutoff", "shown"), [(0.0, 4), (0.5, 3), (0.7, 2), (1.0, 1), (1.5, 0)])
def test_masks(backend, cutoff, shown):
    """What is cut out neither hides nor shows, in any output; alpha at the cutoff shows."""
    pixels = np.full((8, 8, 4), 255, np.uint8)
    pixels[..., 3] = [0, 0, 128, 128, 191, 191, 255, 255]
    texture = e3d.Texture(pixels, filter="nearest")
    mask = layer(0.5, (1.0, 1.0, 1.0), "mask", texture=texture, alpha_cutoff=cutoff)
    wall = layer(0, (0.5, 0.5, 0.5), "opaque")
    shows = np.broadcast_to(np.arange(8) >= 8 - 2 * shown, (8, 8))
    frame = draw([mask, wall], backend, outputs=("color", "object_id", "ndc_depth"))
    alone = draw([wall], backend, outputs=("ndc_depth",)).ndc_depth
    assert np.array_equal(frame.color[..., 0] == 255, shows)
    assert np.array_equal(frame.object_id, np.where(shows, 0, 1))
    assert np.array_equal(frame.ndc_depth < alone, shows)
    counted = draw([mask, wall], backend, mode="overdraw").color
    once = draw([wall], backend, mode="overdraw").color
    assert np.array_equal((counted != once).any(axis=2), shows)


def test_alpha_is_a_product(backend):
    """Material, texture, vertex and instance, in this order."""
    texture = e3d.Texture(np.full((1, 1, 4), 200, np.uint8), filter="nearest")
    colors = np.full((4, 4), 255, np.uint8)
    colors[:, 3] = 100
    mesh = layer(0, (1.0, 0.0, 0.0, 0.75), texture=texture, colors=colors)
    poses = np.array([[0, 0, 0, 1]], np.float32)
    tint = np.array([[255, 255, 255, 50]], np.uint8)
    color = draw([e3d.InstancedMesh(mesh, poses, colors=tint)], backend, background=None).color
    alpha = 0.75 * 200 / 255 * 100 / 255 * 50 / 255
    assert (color[..., 3] == round(255 * alpha)).all()
    assert (color[..., 0] == 200).all()


def test_hostile_alpha(backend):
    """No number counts as 0, and more than 1 as 1."""
    for value, expected in ((np.nan, 0), (-3, 0), (7, 255), (1e38, 255)):
        colors = np.ones((4, 4), np.float32)
        colors[:, 3] = value
        color = draw([layer(0, (1.0, 1.0, 1.0), colors=colors)], backend, background=None).color
        assert (color[..., 3] == expected).all()


def test_outputs_are_of_what_is_not_blended(backend):
    things = [layer(0.5, (1.0, 0, 0, 0.5)), layer(0, (0, 1.0, 0), "opaque")]
    outputs = ("color", "object_id", "ndc_depth", "depth", "albedo")
    usual = draw(things, backend, outputs=outputs)
    nearest = draw(things, backend, outputs=outputs, transparent_outputs=True)
    assert np.array_equal(usual.color, nearest.color)
    assert (usual.object_id != nearest.object_id).all()
    assert (usual.depth - nearest.depth == np.float32(0.5)).all()
    assert (usual.ndc_depth > nearest.ndc_depth).all()
    assert (usual.albedo == (0, 1, 0)).all() and (nearest.albedo == (1, 0, 0)).all()
    for name in outputs[1:]:  # what else is asked for changes no output
        for flag, frame in ((False, usual), (True, nearest)):
            alone = draw(things, backend, outputs=(name,), transparent_outputs=flag)
            assert np.array_equal(getattr(alone, name), getattr(frame, name))
    nothing = draw(
        [layer(0.5, (1.0, 0, 0, 0.0))], backend, outputs=outputs, transparent_outputs=True
    )
    assert (nothing.object_id == -1).all()


@pytest.mark.parametrize("mode", ["depth", "normal", "random", "object_id", "face_id", "overdraw"])
def test_other_modes_show_blended_faces_as_opaque_ones(backend, mode):
    blended = [layer(0.5, (1.0, 0, 0, 0.5)), layer(0, (0, 1.0, 0, 0.5))]
    opaque = [layer(0.5, (1.0, 0, 0), "opaque"), layer(0, (0, 1.0, 0), "opaque")]
    assert np.array_equal(
        draw(blended, backend, mode=mode).color, draw(opaque, backend, mode=mode).color
    )


def test_other_methods_blend_as_they_draw(backend):
    """Painter's algorithm from far to near, without removal in order."""
    near, far = (0.9, 0.1, 0.2, 0.5), (0.1, 0.9, 0.2, 0.75)
    things = [layer(0.5, near), layer(0, far)]
    painted = draw(things, backend, hidden_surfaces="painter").color
    assert (painted == over([far, near])).all()
    drawn = draw(things, backend, hidden_surfaces="none").color
    assert (drawn == over([near, far])).all()
    things.append(layer(-0.5, (0.5, 0.5, 0.5), "opaque"))
    covered = draw(things, backend, hidden_surfaces="none").color
    assert (covered == over([(0.5, 0.5, 0.5, 1)])).all()


@pytest.mark.parametrize("samples", [1, 4, 16])
def test_random_stacks(samples):
    """Leaning, crossing and tiny triangles, masked and blended: the reference's bytes.

    Each backend draws with one thread, and with one of two, three and eight in turn.
    """
    outputs = ("color", "object_id", "ndc_depth", "normal")
    things, pictures = _random_stacks(samples, outputs)
    several = itertools.cycle((2, 3, 8))
    for options, expected in pictures:
        for backend in e3d.backends():
            for threads in (1, next(several)):
                frame = draw(things, backend, threads=threads, **options)
                for name in outputs:
                    same = getattr(frame, name).tobytes() == getattr(expected, name).tobytes()
                    assert same, (backend, threads, name)


def _random_stacks(samples, outputs):
    """Things to draw, and the reference's frames of them with their options."""
    rng = np.random.default_rng(samples)
    things = [_random_stack(rng) for _ in range(4)]
    usual = {"size": (97, 70), "samples": samples, "outputs": outputs, "mode": "lit"}
    nearest = {**usual, "transparent_outputs": True, "background": None}
    return things, [(options, draw(things, "scalar", **options)) for options in (usual, nearest)]


def _random_stack(rng):
    count = 60
    centre = rng.uniform(-1, 1, (count, 1, 3)) * (1, 1, 0.7)
    corners = centre + rng.uniform(-1, 1, (count, 3, 3)) * rng.choice(
        [0.02, 0.3, 1.5], (count, 1, 1)
    )
    modes = ["blend", "mask", "blend", "opaque", "mask", "blend"]
    pixels = rng.integers(0, 256, (16, 16, 4)).astype(np.uint8)
    texture = e3d.Texture(pixels, filter=str(rng.choice(["nearest", "bilinear", "trilinear"])))
    placed = e3d.PlacedTexture(texture, uv_set=1, offset=(0.2, 0.1), rotation=0.3, scale=(1.5, 0.7))
    slots = [None, texture, placed, None, placed, texture]
    materials = [
        e3d.Material(
            color=tuple(map(float, rng.random(4))),
            alpha_mode=mode,
            texture=slot,
            two_sided=True,
            roughness=0.4 if k > 3 else None,
        )
        for k, (mode, slot) in enumerate(zip(modes, slots, strict=True))
    ]
    return e3d.Mesh(
        corners.reshape(-1, 3),
        np.arange(3 * count).reshape(-1, 3),
        uvs=rng.uniform(-1, 2, (3 * count, 2)),
        uvs1=rng.uniform(-1, 2, (3 * count, 2)),
        materials=materials,
        material_ids=rng.integers(0, len(modes), count),
    )


def test_very_many_layers_take_little_memory():
    """400 layers over 256 x 256 pixels: 26 million fragments, a few megabytes at a time."""
    count = 400
    heights = np.linspace(-0.9, 0.9, count)
    corners = np.concatenate([np.array(CORNERS) + (0, 0, z) for z in heights])
    corners[::4, 2] -= 0.05  # all groups of depths overlap
    faces = np.concatenate([[[0, 1, 2], [0, 2, 3]] + 4 * np.array(k) for k in range(count)])
    glass = e3d.Material(color=e3d.linear(0.5, 0.5, 0.5, 0.01), alpha_mode="blend")
    mesh = e3d.Mesh(corners, faces, materials=[glass])
    before = _resident()
    color = draw([mesh], e3d.backends()[-1], size=(256, 256), threads=1).color
    assert _resident() - before < 64e6
    assert (abs(color[..., :3].astype(int) - 127) <= 3).all()


def _resident():
    with open("/proc/self/statm", encoding="ascii") as numbers:
        return int(numbers.read().split()[1]) * 4096
