"""Multisampling (section 18 of docs/exactness): coverage by integers at the exact positions.

Triangles are in clip space with w = 1; white on black in the linear space, so that a pixel tells
how many of its samples are covered.
"""

import numpy as np
import pytest
from images.objects import clip_camera
from images.scenes import SCENES
from plain_picture import Renderer

import engine3d as e3d

SIZE = (37, 29)
# In 1/16 pixel: the standard patterns of Direct3D 11.
PATTERNS = {
    2: [(4, 4), (-4, -4)],
    4: [(-2, -6), (6, -2), (-6, 2), (2, 6)],
    8: [(1, -3), (-1, 3), (5, 1), (-3, -5), (-5, 5), (-7, -1), (3, 7), (7, -7)],
    16: [(1, 1), (-1, -3), (-3, 2), (4, -1), (-5, -2), (2, 5), (5, 3), (3, -5)]
    + [(-2, 6), (0, -7), (-4, -6), (-6, 4), (-8, 0), (7, -4), (6, 7), (-7, -8)],
}


BACKENDS = ("scalar", "avx2", "avx512", "neon")


@pytest.fixture(params=[name for name in BACKENDS if name in e3d.backends()])
def backend(request):
    return request.param


def snapped(corners):
    """R8, of (n, 3, 2) float32 corners in clip space: columns and rows in 1/256 pixel."""
    half = np.float32(128) * np.array(SIZE, np.float32)
    x = np.rint(corners[..., 0] * half[0] + half[0]).astype(np.int64)
    y = np.rint(half[1] - corners[..., 1] * half[1]).astype(np.int64)
    return x, y


def covered(x, y, offset):
    """R12 at one sample of every pixel: (height, width) bool."""
    if (x[1] - x[0]) * (y[2] - y[0]) - (x[2] - x[0]) * (y[1] - y[0]) < 0:
        x, y = x[[0, 2, 1]], y[[0, 2, 1]]
    at_x = 256 * np.arange(SIZE[0]) + 128 + 16 * offset[0]
    at_y = (256 * np.arange(SIZE[1]) + 128 + 16 * offset[1])[:, None]
    inside = np.ones(SIZE[::-1], bool)
    for k in range(3):
        i, j = (k + 1) % 3, (k + 2) % 3
        a, b = y[i] - y[j], x[j] - x[i]
        e = a * (at_x - x[i]) + b * (at_y - y[i])
        inside &= (e > 0) | ((e == 0) & (a > 0 or (a == 0 and b > 0)))
    return inside


def draw(corners, samples, backend, colors=None, **options):
    """Triangles, each of one colour, in front of black; later ones nearer."""
    depth = np.linspace(0.5, -0.5, len(corners), dtype=np.float32)
    points = np.concatenate(
        [corners, np.broadcast_to(depth[:, None, None], (*corners.shape[:2], 1))], -1
    )
    colors = np.ones((len(corners), 4), np.float32) if colors is None else colors
    mesh = e3d.Mesh(
        points.reshape(-1, 3),
        np.arange(3 * len(corners)).reshape(-1, 3),
        colors=np.repeat(colors, 3, axis=0),
        materials=[e3d.Material(two_sided=True)],
    )
    scene = e3d.Scene(background=(0, 0, 0))
    scene.add(mesh)
    with Renderer(
        SIZE, backend=backend, color_space="linear", samples=samples, antialiasing="msaa"
    ) as renderer:
        return renderer.render(scene, clip_camera(), mode="unlit", **options).color


def triangles(rng, count):
    """Large, small and tiny ones, some with corners on samples."""
    size = rng.choice([2.0, 0.3, 0.05, 0.02], (count, 1, 1))
    corners = rng.uniform(-1.1, 1.1, (count, 1, 2)) + size * rng.uniform(-1, 1, (count, 3, 2))
    grid = 16 * np.array(SIZE) / 2
    on_grid = rng.random((count, 1, 1)) < 0.5
    return np.where(on_grid, np.rint(corners * grid) / grid, corners).astype(np.float32)


@pytest.mark.parametrize("samples", PATTERNS)
def test_each_pixel_counts_its_covered_samples(samples, backend):
    rng = np.random.default_rng(samples)
    for _ in range(12):
        corners = triangles(rng, 9)
        x, y = snapped(corners)
        count = sum(
            np.any([covered(x[n], y[n], offset) for n in range(len(corners))], axis=0)
            for offset in PATTERNS[samples]
        )
        color = draw(corners, samples, backend)
        assert np.array_equal(color[..., 0], np.rint(255 * (count / samples)).astype(np.uint8))
        assert (color[..., 3] == 255).all()


@pytest.mark.parametrize("samples", PATTERNS)
def test_the_nearest_shows_at_each_sample(samples, backend):
    rng = np.random.default_rng(10 + samples)
    corners, colors = triangles(rng, 12), rng.integers(0, 2, (12, 4)).astype(np.float32)
    x, y = snapped(corners)
    total = np.zeros((*SIZE[::-1], 3))
    for offset in PATTERNS[samples]:
        shown = np.zeros((*SIZE[::-1], 3))
        for n in range(len(corners)):
            shown[covered(x[n], y[n], offset)] = colors[n, :3]
        total += shown
    assert np.array_equal(
        draw(corners, samples, backend, colors)[..., :3], np.rint(255 * (total / samples))
    )


def test_no_colour_is_extrapolated(backend):
    """A triangle as thin as a sample has no colour that its corners don't hold."""
    rng = np.random.default_rng(5)
    corners = triangles(rng, 1)
    for _ in range(60):
        corners = triangles(rng, 1)
        mesh = e3d.Mesh(
            np.concatenate([corners[0], np.zeros((3, 1), np.float32)], 1),
            [[0, 1, 2]],
            colors=np.array([(1, 0.5, 0.5, 1)] * 3, np.float32),
            uvs=[(0.4, 0.5), (0.6, 0.5), (0.5, 0.6)],
            materials=[e3d.Material(two_sided=True, texture=middle())],
        )
        scene = e3d.Scene(background=(0, 0, 0))
        scene.add(mesh)
        with Renderer(
            SIZE, backend=backend, color_space="linear", samples=8, antialiasing="msaa"
        ) as renderer:
            color = renderer.render(scene, clip_camera(), mode="unlit").color
        assert not color[..., 1].any()  # green lies outside the corners' coordinates


def middle():
    """Red where coordinates are from 0.4 to 0.6, green around."""
    pixels = np.zeros((40, 40, 4), np.uint8)
    pixels[..., 1], pixels[..., 3] = 255, 255
    pixels[15:25, 15:25] = 255, 0, 0, 255
    return e3d.Texture(pixels, filter="nearest")


@pytest.mark.parametrize("name", ["mode_lit", "alpha_mode_lit", "mode_overdraw"])
def test_other_outputs_and_overdraw_are_those_of_one_sample(name, backend):
    plain, many = SCENES[name](), SCENES[f"msaa_4_{name}"]()
    one, four = plain.draw(backend), many.draw(backend)
    for output in one.outputs:
        same = np.array_equal(getattr(one, output), getattr(four, output))
        assert same or (output == "color" and name != "mode_overdraw")
    assert np.array_equal(many.draw(backend, 2, ("color",)).color, four.color)


def test_inside_a_surface_a_pixel_is_that_of_one_sample(backend):
    corners = np.array([[(-3, -3), (3, -3), (0, 4)]], np.float32)
    colors = np.random.default_rng(2).random((1, 4)).astype(np.float32)
    assert np.array_equal(draw(corners, 16, backend, colors), draw(corners, 1, backend, colors))


def checkered(**options):
    """A scene of one textured quad over all pixels, texels of 5.3 x 4.7 pixels; its texels."""
    texels = np.random.default_rng(5).integers(0, 2, (7, 7, 1), np.uint8) * np.uint8([255] * 4)
    texels[..., 3] = 255
    uvs = np.float32([[0, 0], [SIZE[0] / 37.1, 0], [SIZE[0] / 37.1, SIZE[1] / 32.9]])
    uvs = np.concatenate([uvs, [[0, SIZE[1] / 32.9]]]).astype(np.float32)
    points = np.float32([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]])
    texture = e3d.Texture(texels, color_space="linear", filter="nearest")
    material = e3d.Material(texture=texture, two_sided=True, **options)
    mesh = e3d.Mesh(points, [[0, 1, 2], [0, 2, 3]], uvs=uvs, materials=[material])
    scene = e3d.Scene(background=(0, 0, 0))
    scene.add(mesh)
    return scene, texels[..., 0] // 255


@pytest.mark.parametrize("samples", PATTERNS)
@pytest.mark.parametrize("mode", ["opaque", "blend"])
def test_samples_that_are_shaded_alone_show_what_lies_at_each(samples, mode, backend):
    """R195: a pixel is the mean of the texels at its samples, of what is kept and of fragments."""
    scene, texels = checkered(alpha_mode=mode)
    counts, sure = np.zeros(SIZE[::-1]), np.ones(SIZE[::-1], bool)
    for offset in PATTERNS[samples]:
        u = (np.arange(SIZE[0]) + 0.5 + offset[0] / 16) / 5.3
        v = (SIZE[1] - (np.arange(SIZE[1]) + 0.5 + offset[1] / 16)) / 4.7
        counts += texels[::-1][np.ix_(v.astype(int), u.astype(int))]
        for near in (np.abs(u - np.rint(u)) < 1e-3, (np.abs(v - np.rint(v)) < 1e-3)[:, None]):
            sure &= ~near  # where rounding may decide
    how = {"color_space": "linear", "samples": samples, "antialiasing": "msaa"}
    pictures = []
    for alone in (False, True):
        with Renderer(SIZE, backend=backend, **how) as renderer:
            frame = renderer.render(scene, clip_camera(), mode="unlit", sample_shading=alone)
            pictures.append(frame.color[..., 0].copy())
    expected = np.floor(255 * counts / samples + 0.5)
    assert (pictures[1] == expected)[sure].all()
    assert sure.mean() > 0.9 and (counts[sure] % samples).any()
    assert set(np.unique(pictures[0])) == {0, 255}  # one colour in a pixel


def masked(points, cutoff=0.5, **arrays):
    """Two triangles between four points of clip space, masked, white and unlit."""
    material = e3d.Material(
        color=arrays.pop("color", (1.0, 1.0, 1.0, 1.0)),
        texture=arrays.pop("texture", None),
        alpha_mode="mask",
        alpha_cutoff=cutoff,
        two_sided=True,
        unlit=True,
    )
    scene = e3d.Scene(background=(0, 0, 0))
    points = np.concatenate([np.float32(points), np.zeros((4, 1), np.float32)], 1)
    scene.add(e3d.Mesh(points, [[0, 1, 2], [0, 2, 3]], materials=[material], **arrays))
    return scene


def shares(scene, backend, samples, **options):
    """The share of each pixel's samples that is white."""
    with Renderer(
        SIZE, backend=backend, color_space="linear", samples=samples, antialiasing="msaa"
    ) as renderer:
        color = renderer.render(scene, clip_camera(), mode="unlit", **options).color
    return np.rint(color[..., 0] * (samples / 255))


def test_an_alpha_that_is_the_same_all_over_covers_all_or_nothing(backend):
    corners = [(-3, -3), (3, -3), (3, 3), (-3, 3)]
    for alpha, share in ((0.0, 0), (0.39, 0), (0.4, 4), (0.41, 4), (1.0, 4)):
        scene = masked(corners, 0.4, color=(1.0, 1.0, 1.0, alpha))
        assert (shares(scene, backend, 4) == share).all()
        assert (shares(scene, backend, 4, alpha_to_coverage=False) == share).all()


@pytest.mark.parametrize("samples", [4, 16])
@pytest.mark.parametrize("slope", [0.03, 0.1, 0.2])
def test_an_edge_of_a_mask_is_a_pixel_wide(samples, slope, backend):
    """R190: a band whose alpha rises from 0 to 1, along a slanted line and by so much a pixel."""
    cutoff, way = 0.3, np.array([0.8, 0.6])
    middle = np.array(SIZE) / 2  # in pixels, Y down: where alpha is the cutoff
    along = np.array([-cutoff, 1 - cutoff, 1 - cutoff, -cutoff]) / slope
    across = np.array([-1, -1, 1, 1])[:, None] * 100 * way[::-1] * (-1, 1)
    corners = middle + along[:, None] * way + across
    points = corners * 2 / SIZE - 1
    colors = np.array([(1, 1, 1, alpha) for alpha in (0, 1, 1, 0)], np.float32)
    got = shares(masked(points * (1, -1), cutoff, colors=colors), backend, samples)

    def centred(x, y):
        alpha = cutoff + slope * ((x - middle[0]) * way[0] + (y - middle[1]) * way[1])
        above = 0.5 + 0.5 * (alpha - cutoff) / (1 - cutoff)
        return np.where(alpha < cutoff, 0.5 * alpha / cutoff, above)

    column, row = np.meshgrid(np.arange(SIZE[0]) + 0.5, np.arange(SIZE[1]) + 0.5)
    distance = (column - middle[0]) * way[0] + (row - middle[1]) * way[1]
    inside = (distance > -cutoff / slope + 0.5) & (distance < (1 - cutoff) / slope - 2)
    side = (corners[2] - corners[0]) / np.linalg.norm(corners[2] - corners[0])
    inside &= np.abs((column - corners[0, 0]) * side[1] - (row - corners[0, 1]) * side[0]) > 1.5
    h = centred(column, row)
    turn = np.hypot(centred(column + 1, row) - h, centred(column, row + 1) - h)
    exact = ((h - 0.5) / turn + 0.5) * samples
    sure = inside & (np.abs(exact + 0.5 - np.rint(exact + 0.5)) > 0.08)  # corners are snapped (R8)
    assert np.array_equal(got[sure], np.floor(np.clip(exact, 0, samples) + 0.5)[sure])
    partial = (got > 0) & (got < samples) & inside
    assert partial.any()
    assert np.abs(distance[partial]).max() < 1.5
    hard = shares(
        masked(points * (1, -1), cutoff, colors=colors), backend, samples, alpha_to_coverage=False
    )
    assert np.isin(hard[inside], (0, samples)).all()


def test_masks_finer_than_pixels_keep_their_share(backend):
    """R190: four levels up, the alpha is nearly the share that is covered."""
    rng = np.random.default_rng(4)
    pixels = np.full((1024, 1024, 4), 255, np.uint8)
    pixels[..., 3] = 255 * (rng.random((1024, 1024)) < 0.3)
    scene = masked(
        [(-1, -1), (1, -1), (1, 1), (-1, 1)],
        texture=e3d.Texture(pixels, filter="trilinear"),
        uvs=np.float32([(0, 0), (1, 0), (1, 1), (0, 1)]),
    )
    assert abs(shares(scene, backend, 16).mean() / 16 - 0.3) < 0.04
    assert not shares(scene, backend, 16, alpha_to_coverage=False).any()


@pytest.mark.parametrize("to_coverage", [False, True])
def test_what_hides_a_part_of_a_pixel_does_not_move_the_alpha_of_what_is_behind(to_coverage):
    """R105, R108: edges of a mask, whose alpha changes within pixels, behind edges of others."""
    rng = np.random.default_rng(0)
    texture = e3d.Texture(rng.integers(0, 256, (16, 16, 4), np.uint8))
    mask = e3d.Material(
        texture=texture, alpha_mode="mask", alpha_cutoff=0.5, two_sided=True, unlit=True
    )
    solid = e3d.Material(color=e3d.linear(0.2, 0.4, 0.6), two_sided=True, unlit=True)
    scene = e3d.Scene(background=(0, 0, 0))
    for depth, material in ((0.0, solid), (0.5, mask)):
        points = np.full((200, 3, 3), depth, np.float32)
        sides = 0.3 * rng.uniform(-1, 1, (200, 3, 2))
        points[..., :2] = rng.uniform(-1, 1, (200, 1, 2)) + sides
        points = points.reshape(-1, 3)
        faces = np.arange(600).reshape(-1, 3)
        scene.add(e3d.Mesh(points, faces, uvs=4 * points[:, :2], materials=[material]))
    pictures = []
    for backend in ("scalar", *e3d.backends()):
        with Renderer((64, 64), backend=backend, samples=16, antialiasing="msaa") as renderer:
            frame = renderer.render(scene, clip_camera(), alpha_to_coverage=to_coverage)
            pictures.append(frame.color)
    assert all(np.array_equal(pictures[0], other) for other in pictures[1:])


def test_numbers_of_samples_that_methods_lack():
    with pytest.raises(e3d.InvalidArgumentError, match="samples"):
        Renderer((8, 8), samples=8)
    with pytest.raises(e3d.InvalidArgumentError, match="antialiasing"):
        Renderer((8, 8), antialiasing="fxaa")
    assert Renderer((8, 8), samples=8, antialiasing="msaa").antialiasing == "msaa"


def crowd():
    """Boxes behind boxes, so that rounds leave some out, some of them blended or masked."""
    scene = e3d.Scene(background=None, ambient=e3d.linear(0.3, 0.3, 0.3))
    rng = np.random.default_rng(3)
    for mode, count in (("opaque", 90), ("mask", 12), ("blend", 12)):
        material = e3d.Material(color=(*rng.random(3), 0.6), alpha_mode=mode)
        boxes = e3d.box(0.4)
        boxes.materials = [material]
        for _ in range(count):
            scene.add(boxes, translation=rng.uniform(-1.5, 1.5, 3), scale=rng.uniform(0.3, 1.5))
    scene.add(e3d.DirectionalLight((-0.4, -0.8, -0.5)))
    return scene


@pytest.mark.parametrize("samples", [2, 4, 16])
def test_what_is_left_out_and_when_changes_nothing(samples, backend):
    scene, size = crowd(), (150, 106)
    with Renderer(size, backend="scalar", samples=samples, antialiasing="msaa") as renderer:
        expected = renderer.render(scene).color.copy()
    for threads in (1, 2, 3):
        with Renderer(
            size, backend=backend, threads=threads, samples=samples, antialiasing="msaa"
        ) as renderer:
            for culling in ("all", "always", "always", "tree", "frustum", "none"):
                assert np.array_equal(renderer.render(scene, culling=culling).color, expected)
            for options in ({"batching": False}, {"shading": "forward"}):
                assert np.array_equal(renderer.render(scene, **options).color, expected)
