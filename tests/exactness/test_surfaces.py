"""Single rules of docs/exactness, from surfaces to bytes, by oracles of their own.

A square that fills the image exactly, seen without perspective, makes every pixel's place on the
surface known. Expected values come from the sRGB formula in float64 and from integers, not from the
core's tables.
"""

import math

import numpy as np
import pytest
from plain_picture import Renderer, render

import engine3d as e3d


@pytest.fixture(params=e3d.backends())
def backend(request):
    return request.param


CAMERA = (e3d.OrthographicCamera(1.0, xmag=1.0, znear=-1, zfar=1), np.eye(4))
CORNERS = [(-1, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0)]
UVS = np.array([(0, 0), (1, 0), (1, 1), (0, 1)], np.float64)
TOWARDS_VIEWER = [(0, 0, 1)] * 4


def square(z=0.0, *, uv_scale=1.0, **material):
    """Two triangles over the whole image, at a height above z = 0."""
    return e3d.Mesh(
        np.array(CORNERS) + (0, 0, z),
        [[0, 1, 2], [0, 2, 3]],
        uvs=UVS * uv_scale,
        normals=TOWARDS_VIEWER,
        materials=[e3d.Material(**material)],
    )


def draw(things, size, backend, *, scene=None, color_space="srgb", samples=1, **options):
    scene = e3d.Scene() if scene is None else scene
    for thing in things:
        scene.add(thing)
    options = {"mode": "unlit", **options}
    settings = {"backend": backend, "color_space": color_space, "samples": samples}
    return render(scene, CAMERA, size=size, **settings, **options)


def srgb_decode(code):
    encoded = code / 255
    return encoded / 12.92 if encoded <= 0.04045 else ((encoded + 0.055) / 1.055) ** 2.4


def srgb_encode(linear):
    """The code as a real number."""
    return 255 * (12.92 * linear if linear <= 0.0031308 else 1.055 * linear ** (1 / 2.4) - 0.055)


# R28: 15 bits of linear light for each 8-bit code.
LINEAR16 = np.array([round(65535 * srgb_decode(code)) for code in range(256)])
LINEAR15 = (LINEAR16 * 32767 + 32767) // 65535
UNORM15 = np.float32(1) / np.float32(32767)


def all_codes(width, height):
    """Pixels that hold every 8-bit code in every channel if there are 256 of them."""
    codes = np.arange(width * height) % 256
    pixels = np.stack([codes, 255 - codes, codes * 7 % 256, np.full_like(codes, 255)], axis=-1)
    return pixels.reshape(height, width, 4).astype(np.uint8)


@pytest.mark.parametrize("filter_name", ["nearest", "bilinear", "trilinear"])
@pytest.mark.parametrize("color_space", ["srgb", "linear"])
@pytest.mark.parametrize("size", [(16, 16), (37, 23), (1, 256), (1, 1)])
def test_a_texture_drawn_one_to_one_gives_its_bytes_back(backend, filter_name, color_space, size):
    pixels = all_codes(*size)
    for wrap in ("repeat", "clamp", "mirror"):
        mesh = square(texture=e3d.Texture(pixels, filter=filter_name, wrap=wrap))
        frame = draw([mesh], size, backend, color_space=color_space)
        assert np.array_equal(frame.color, pixels)


def test_encode_is_the_nearest_srgb_code(backend):
    """Linear vertex colours along a ramp: the formula rounds to the code, to a 22nd of one."""
    width = 4096
    mesh = e3d.Mesh(
        CORNERS,
        [[0, 1, 2], [0, 2, 3]],
        colors=np.array([(0, 0, 0, 1), (1, 0.1, 0.01, 1), (1, 0.1, 0.01, 1), (0, 0, 0, 1)], float),
    )
    frame = draw([mesh], (width, 1), backend, outputs=("color", "albedo"))
    for channel in range(3):
        values = frame.albedo[0, :, channel].astype(np.float64)
        exact = np.array([srgb_encode(value) for value in values])
        assert np.abs(frame.color[0, :, channel] - exact).max() < 0.5 + 1 / 22
        assert (np.diff(frame.color[0, :, channel].astype(int)) >= 0).all()


@pytest.mark.parametrize("color_space", ["srgb", "linear"])
def test_eight_bit_colors_come_back(backend, color_space):
    """Encode undoes decode for backgrounds and vertex colours of every code."""
    renderer = Renderer((1, 1), backend=backend, threads=1, color_space=color_space)
    for code in range(2, 256):
        color = np.array([code, 255 - code, 77, 255], np.uint8)
        scene = e3d.Scene(background=tuple(int(c) for c in color[:3]))
        frame = renderer.render(scene, CAMERA, mode="unlit")
        assert np.array_equal(frame.color[0, 0], color)
        scene.add(e3d.Mesh(CORNERS, [[0, 1, 2], [0, 2, 3]], colors=np.tile(color, (4, 1))))
        frame = renderer.render(scene, CAMERA, mode="unlit")
        assert np.array_equal(frame.color[0, 0], color)


def halved(texels):
    """R28: the next mip level of (H, W, C) integers with even sides."""
    total = texels[0::2, 0::2] + texels[0::2, 1::2] + texels[1::2, 0::2] + texels[1::2, 1::2]
    return (total + 2) >> 2


@pytest.mark.parametrize("level", [0, 1, 2, 3, 4])
def test_minified_by_a_power_of_two_shows_the_mip_level(backend, level):
    size = 16
    pixels = np.random.default_rng(0).integers(0, 256, (size, size, 4)).astype(np.uint8)
    texels = LINEAR15[pixels[..., :3]]
    for _ in range(level):
        texels = halved(texels)
    side = size >> level
    mesh = square(texture=e3d.Texture(pixels, filter="trilinear"))
    frame = draw([mesh], (side, side), backend, outputs=("albedo",))
    assert np.array_equal(frame.albedo, texels.astype(np.float32) * UNORM15)


def test_bilinear_halfway_between_texels_is_the_average(backend):
    """One pixel over 2 x 2 texels: weights of 128/256 each, those below each other rounded."""
    pixels = np.array(
        [[[0, 9, 255, 255], [3, 10, 255, 255]], [[200, 11, 0, 255], [1, 12, 254, 255]]]
    )
    mesh = square(texture=e3d.Texture(pixels.astype(np.uint8), filter="bilinear", wrap="clamp"))
    frame = draw([mesh], (1, 1), backend, outputs=("albedo",))
    columns = (LINEAR15[pixels[..., :3]].sum(axis=0) + 1) >> 1
    expected = (columns.sum(axis=0) * 128).astype(np.float32) * (UNORM15 / np.float32(256))
    assert np.array_equal(frame.albedo[0, 0], expected)


@pytest.mark.parametrize(
    ("wrap", "columns"),
    [("repeat", [0, 1, 2, 0, 1, 2]), ("clamp", [0, 1, 2, 2, 2, 2]), ("mirror", [0, 1, 2, 2, 1, 0])],
)
def test_wraps(backend, wrap, columns):
    pixels = all_codes(3, 3)
    texture = e3d.Texture(pixels, filter="nearest", wrap=wrap)
    frame = draw([square(uv_scale=2.0, texture=texture)], (6, 6), backend)
    rows = [2 - columns[5 - row] for row in range(6)]  # t = 1 - v counts down from the top
    assert np.array_equal(frame.color, pixels[np.ix_(rows, columns)])


@pytest.mark.parametrize("wrap", [("repeat", "clamp"), ("clamp", "repeat")])
def test_each_coordinate_has_its_own_wrap(backend, wrap):
    """Coordinates from -1/4 to 5/4: one texel more on each side of the image."""
    pixels = all_codes(4, 4)
    mesh = square(uv_scale=1.5, texture=e3d.Texture(pixels, filter="nearest", wrap=wrap))
    mesh.uvs = mesh.uvs - 0.25
    shown = {"repeat": [3, 0, 1, 2, 3, 0], "clamp": [0, 0, 1, 2, 3, 3]}
    frame = draw([mesh], (6, 6), backend)
    assert np.array_equal(frame.color, pixels[np.ix_(shown[wrap[1]], shown[wrap[0]])])


def test_uv_is_perspective_correct(backend):
    """A floor seen at an angle: uv of each pixel is where its ray meets the floor."""
    size, focal = 64, 60.0
    camera = e3d.IntrinsicsCamera(focal, focal, size / 2, size / 2, znear=0.1, zfar=100)
    floor = e3d.Mesh(
        [(-8, -1, 0.5), (8, -1, 0.5), (8, -1, -20), (-8, -1, -20)],
        [[0, 1, 2], [0, 2, 3]],
        uvs=UVS,
    )
    scene = e3d.Scene()
    scene.add(floor)
    outputs = ("uv", "depth", "face_id", "world_position")
    frame = render(scene, (camera, np.eye(4)), size=(size, size), backend=backend, outputs=outputs)
    rows, columns = np.nonzero(frame.face_id >= 0)
    assert len(rows) > size * size / 3
    distance = focal / (rows + 0.5 - size / 2)  # to the floor, 1 below the eye
    x = distance * (columns + 0.5 - size / 2) / focal
    expected = np.stack([(x + 8) / 16, (0.5 + distance) / 20.5], axis=-1)
    # Snapping moves vertices by up to 1/512 pixel, which counts for more towards the horizon.
    tolerance = (0.01 / (rows + 0.5 - size / 2)) * distance
    assert (np.abs(frame.uv[rows, columns] - expected).max(axis=-1) < tolerance + 1e-4).all()
    assert (np.abs(frame.depth[rows, columns] - distance) < 20 * tolerance + 1e-3).all()
    position = np.stack([x, np.full_like(x, -1), -distance], axis=-1)
    error = np.abs(frame.world_position[rows, columns] - position).max(axis=-1)
    assert (error < 20 * tolerance + 1e-3).all()


@pytest.mark.parametrize(
    ("hidden_surfaces", "winner"), [("zbuffer", 0), ("painter", 2), ("none", 2)]
)
def test_ties_between_nodes(backend, hidden_surfaces, winner):
    """Equal depths: the first node by depth, the last by the painter or without either."""
    outputs = ("object_id",)
    things = [square(), square(), square()]
    frame = draw(things, (5, 4), backend, hidden_surfaces=hidden_surfaces, outputs=outputs)
    assert (frame.object_id == winner).all()


def test_the_painter_draws_from_far_to_near(backend):
    things = [square(0.5), square(-0.5), square(0.0)]  # the nearest first
    for hidden_surfaces, winner in [("zbuffer", 0), ("painter", 0), ("none", 2)]:
        frame = draw(
            things, (5, 4), backend, hidden_surfaces=hidden_surfaces, outputs=("object_id",)
        )
        assert (frame.object_id == winner).all()


def test_overdraw_counts_layers(backend):
    """Sixteen layers: a different colour for each up to fifteen, then the same."""
    colors = []
    for count in range(17):
        frame = draw([square(0.01 * n) for n in range(count)], (3, 2), backend, mode="overdraw")
        assert (frame.color == frame.color[0, 0]).all()
        colors.append(tuple(frame.color[0, 0]))
    assert len(set(colors[:16])) == 16 and colors[16] == colors[15]


def test_lines_and_points_cover_whole_pixels(backend):
    """Ends on centres: the first centre is in and the last out, like left and right edges."""
    size = 8

    def at(x, y):
        return 2 * x / size - 1, 1 - 2 * y / size, 0

    mesh = e3d.Mesh([at(1.5, 2.5), at(6.5, 2.5), at(4.5, 5.5)], lines=[(0, 1)], points=[2])
    frame = draw([mesh], (size, size), backend, point_size=3.0)
    expected = np.zeros((size, size), bool)
    expected[2, 1:6] = True
    expected[4:7, 3:6] = True
    assert np.array_equal(frame.color[..., 0] == 255, expected)


def test_samples_are_averaged_in_linear_light(backend):
    """White over half a pixel: linear 0.5, which is 188 in sRGB, and half the alpha."""
    half = e3d.Mesh([(-1, -1, 0), (0, -1, 0), (0, 1, 0), (-1, 1, 0)], [[0, 1, 2], [0, 2, 3]])
    for samples in (4, 16):
        frame = draw([half], (1, 1), backend, samples=samples)
        assert frame.color[0, 0].tolist() == [188, 188, 188, 255]
        empty = e3d.Scene(background=None)
        frame = draw([half], (1, 1), backend, samples=samples, scene=empty)
        assert frame.color[0, 0].tolist() == [255, 255, 255, 128]


@pytest.mark.parametrize(("distance", "lit"), [(0.49, True), (0.5, False), (0.51, False)])
@pytest.mark.parametrize("falloff", ["inverse_square", "window"])
def test_a_point_light_ends_at_its_range(backend, falloff, distance, lit):
    scene = e3d.Scene(ambient=e3d.linear(0.25, 0.25, 0.25))
    light = e3d.PointLight(intensity=100.0 * math.pi, range=0.5, falloff=falloff)
    scene.add(light, translation=(0, 0, distance))
    frame = draw([square(color=(1.0, 1.0, 1.0))], (1, 1), backend, scene=scene, mode="lit")
    ambient = math.floor(srgb_encode(0.25) + 0.5)
    assert (frame.color[0, 0, 0] > ambient) == lit
    assert lit or frame.color[0, 0, 0] == ambient


@pytest.mark.parametrize("shininess", [1.0, 5.5, 32.0, 200.0])
def test_light_follows_the_formula(backend, shininess):
    """Diffuse and Blinn-Phong light of a tilted direction, against float64."""
    towards = np.array([0.48, 0.6, 0.64])
    scene = e3d.Scene(ambient=e3d.linear(0.02, 0.02, 0.02))
    scene.add(
        e3d.DirectionalLight(
            direction=-towards, color=e3d.linear(0.9, 0.5, 0.2), intensity=0.5 * math.pi
        )
    )
    mesh = square(
        color=e3d.linear(0.3, 0.6, 0.9), specular=e3d.linear(0.2, 0.4, 0.8), shininess=shininess
    )
    frame = draw([mesh], (2, 2), backend, scene=scene, mode="lit")
    half = (towards + (0, 0, 1)) / np.linalg.norm(towards + (0, 0, 1))
    light = np.array([0.9, 0.5, 0.2]) * 0.5
    diffuse = np.array([0.3, 0.6, 0.9]) * (0.02 + light * towards[2])
    expected = diffuse + np.array([0.2, 0.4, 0.8]) * light * half[2] ** shininess
    exact = [srgb_encode(value) for value in expected]
    assert np.abs(frame.color[..., :3] - exact).max() < 0.5 + 1e-3
