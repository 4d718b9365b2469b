"""Anisotropy and bias against 256 samples a pixel, and how round lines and points are."""

import numpy as np
import pytest
from plain_picture import render

import engine3d as e3d
from engine3d.linalg import rotation_z

SIZE = 280, 160
CAMERA = e3d.PerspectiveCamera(0.6, znear=1, zfar=200)
HORIZON = 65  # rows above are not of the floor alone


def floor(**sampling):
    """A floor of squares that recedes, in linear light."""
    y, x = np.mgrid[:64, :64]
    squares = np.where((y // 32 + x // 32) % 2, 220, 60).astype(np.uint8)
    ground = e3d.plane((240, 120))
    ground.uvs = ground.uvs * (96, 48)
    texture = e3d.Texture(squares, color_space="linear", **sampling)
    ground.materials = [e3d.Material(texture=texture)]
    scene = e3d.Scene(background=(30, 33, 40))
    scene.add(ground)
    return scene


def draw(scene, roll, scale=1, samples=1, backend="auto"):
    pose = e3d.look_at((0, 2.2, 30), (4, 0, 8)) @ rotation_z(roll)
    size = SIZE[0] * scale, SIZE[1] * scale
    frame = render(
        scene,
        (CAMERA, pose),
        size=size,
        samples=samples,
        mode="unlit",
        color_space="linear",
        backend=backend,
        outputs=("color", "object_id"),
    )
    return frame.color[..., :3].astype(float), frame.object_id


def truth(roll):
    """256 samples a pixel of the texture itself, and which pixels are well inside the floor."""
    color, objects = draw(floor(filter="bilinear"), roll, 4, 16)
    mean = color.reshape(SIZE[1], 4, SIZE[0], 4, 3).mean(axis=(1, 3))
    whole = (objects >= 0).reshape(SIZE[1], 4, SIZE[0], 4).all(axis=(1, 3))
    inside = whole.copy()
    for shift in (1, 2, 3):
        for axis in (0, 1):
            for sign in (-1, 1):
                inside &= np.roll(whole, sign * shift, axis)
    return mean, inside


def decibels(picture, expected, inside):
    return 10 * np.log10(255**2 / ((picture - expected)[inside] ** 2).mean())


@pytest.mark.parametrize(("roll", "least"), [(0.0, 38), (0.6, 37)])
def test_anisotropic_floors_come_near_to_256_samples(roll, least):
    expected, inside = truth(roll)
    found = [decibels(draw(floor(anisotropy=n), roll)[0], expected, inside) for n in (1, 2, 4, 16)]
    assert found == sorted(found)
    assert found[0] < 33
    assert found[-1] > least
    assert found[-1] > found[0] + 6


def test_bias_sharpens():
    """Differences from pixel to pixel grow with each half of a level."""
    details = []
    for bias in (1.0, 0.5, 0.0, -0.5, -1.0):
        color, _ = draw(floor(lod_bias=bias), 0.0)
        details.append(np.abs(np.diff(color[HORIZON:], axis=0)).mean())
    assert details == sorted(details)
    assert details[-1] > 1.3 * details[0]


def test_a_bias_is_a_factor_on_the_pixel():
    """With log2(3), each third pixel of a picture three times as large is that of the small one."""
    small, _ = draw(floor(), 0.3)
    large, _ = draw(floor(lod_bias=np.log2(3)), 0.3, 3)
    assert np.abs(small - large[1::3, 1::3]).max() <= 2
    assert np.abs(small - draw(floor(), 0.3, 3)[0][1::3, 1::3]).max() > 30


VIEW = e3d.Camera(np.eye(4)), np.eye(4)
SIDE = 128


def shown(mesh, **options):
    scene = e3d.Scene(background=(0, 0, 0))
    scene.add(mesh)
    frame = render(scene, VIEW, size=(SIDE, SIDE), mode="unlit", **options)
    return frame.color[..., 0] > 127


def distances(a, b):
    """Of each pixel's centre from the segment between two places, in pixels."""
    y, x = np.mgrid[:SIDE, :SIDE] + 0.5
    place = np.stack([x, y], axis=-1)
    a, b = ((np.asarray(p)[:2] * (1, -1) + 1) * SIDE / 2 for p in (a, b))
    along = b - a
    t = ((place - a) @ along / max(along @ along, 1e-9)).clip(0, 1)
    return np.linalg.norm(place - (a + t[..., None] * along), axis=-1)


@pytest.mark.parametrize("width", [1.0, 1.7, 5.0, 24.0])
@pytest.mark.parametrize("backend", ["scalar", "auto"])
def test_round_lines_cover_what_is_within_half_their_width(width, backend):
    """A chord parts from its circle by up to 0.16. There are no gaps at joins."""
    rng = np.random.default_rng(4)
    for _ in range(12):
        ends = np.zeros((4, 3))
        ends[:, :2] = rng.uniform(-0.8, 0.8, (4, 2))
        mesh = e3d.Mesh(ends, lines=[(0, 1), (1, 2), (2, 3)])
        covered = shown(mesh, line_width=width, line_shape="round", backend=backend)
        distance = np.min([distances(ends[k], ends[k + 1]) for k in range(3)], axis=0)
        assert covered[distance < width / 2 - 0.2].all()
        assert not covered[distance > width / 2 + 0.03].any()


@pytest.mark.parametrize("size", [2.0, 5.0, 31.0])
def test_round_points_are_discs(size):
    places = np.array([[0.13, 0.2, 0], [-0.5, -0.41, 0]])
    covered = shown(e3d.Mesh(places, points=[0, 1]), point_size=size, point_shape="round")
    distance = np.minimum(*(distances(place, place) for place in places))
    assert covered[distance < size / 2 - 0.2].all()
    assert not covered[distance > size / 2 + 0.03].any()


def test_no_round_point_is_lost():
    rng = np.random.default_rng(6)
    for size in (1.0, 1.2, 1.45, 1.5, 1.55, 1.6):
        for place in rng.uniform(-0.9, 0.9, (40, 3)):
            assert shown(e3d.Mesh([place], points=[0]), point_size=size, point_shape="round").any()


@pytest.mark.parametrize("shapes", [("plain", "square"), ("round", "round")])
def test_sizes_in_shares_of_the_picture_look_alike(shapes):
    """The same share of a small and of a large picture is covered."""
    rng = np.random.default_rng(8)
    mesh = e3d.Mesh(rng.uniform(-0.8, 0.8, (8, 3)), lines=[(0, 1), (2, 3)], points=[4, 5, 6, 7])
    scene = e3d.Scene(background=(0, 0, 0))
    scene.add(mesh)
    options = dict(zip(("line_shape", "point_shape"), shapes, strict=True))
    options |= {"line_width": 20.0, "point_size": 60.0, "size_unit": "picture", "mode": "unlit"}
    shares = [
        (render(scene, VIEW, size=(side, side), **options).color[..., 0] > 127).mean()
        for side in (200, 1000)
    ]
    assert shares[0] == pytest.approx(shares[1], rel=0.04)


def test_thin_lines_hold_together_in_small_pictures():
    """A size in shares of the picture is at least a pixel, and so no row is left out."""
    mesh = e3d.Mesh([(-0.9, 0.21, 0), (0.9, 0.21, 0)], lines=[(0, 1)])
    assert shown(mesh, line_width=1.0, size_unit="picture").sum() > 0.85 * SIDE
