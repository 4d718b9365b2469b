"""Every filter with every wrap, near and towards the horizon; texture sizes and colour spaces."""

import itertools

import numpy as np
from images.objects import camera_at, checkerboard, clip_camera, with_material
from images.picture import Picture, picture, variant

import engine3d as e3d
from engine3d._native.rasterizer import FILTERS, WRAPS


def floor_and_wall(filter_name, wrap):
    """A floor to the horizon, and a wall that shows coordinates from -1 to 2 magnified."""
    scene = e3d.Scene(background=(90, 120, 160))
    texture = checkerboard(filter=filter_name, wrap=wrap)
    ground = e3d.plane((60, 60), 3)
    ground.uvs = ground.uvs * 40 - 20
    wall = e3d.primitives.quad((-0.9, 0, 0), (0.9, 0, 0), (0.9, 1.2, 0), (-0.9, 1.2, 0))
    wall.uvs = wall.uvs * 3 - 1
    for mesh in (ground, wall):
        scene.add(with_material(mesh, texture=texture))
    return Picture(scene, camera_at((0.5, 0.8, 2.0), (0, 0.4, 0)), options={"mode": "unlit"})


for _filter in FILTERS:
    for _wrap in WRAPS:
        variant(f"texture_{_filter}_{_wrap}", floor_and_wall, _filter, _wrap)


#: Along u and along v.
MIXED = list(itertools.permutations(WRAPS, 2))
for _number, _filter in enumerate(FILTERS):
    for _pair in (MIXED[_number], MIXED[-1 - _number]):
        variant(f"texture_{_filter}_{'_'.join(_pair)}", floor_and_wall, _filter, _pair)


def one_to_one(filter_name, color_space):
    """A texture with every 8-bit value, drawn one texel a pixel: the picture is the texture."""
    codes = np.arange(64 * 48) * 5 % 256
    pixels = np.stack([codes, 255 - codes, codes * 7 % 256], axis=-1).reshape(48, 64, 3)
    wall = e3d.primitives.quad((-1, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0))
    scene = e3d.Scene()
    texture = e3d.Texture(pixels.astype(np.uint8), filter=filter_name)
    scene.add(with_material(wall, texture=texture))
    options = {"mode": "unlit"}
    return Picture(scene, clip_camera(), (64, 48), color_space=color_space, options=options)


variant("texture_one_to_one", one_to_one, "trilinear", "srgb")
variant("texture_one_to_one_linear", one_to_one, "bilinear", "linear")


def sizes(wrap):
    """Textures of awkward sizes side by side, drawn larger and smaller."""
    rng = np.random.default_rng(1)
    scene = e3d.Scene(background=(40, 40, 40))
    for k, (width, height) in enumerate([(1, 1), (3, 2), (5, 64), (200, 7), (37, 41)]):
        pixels = rng.integers(0, 256, (height, width, 4)).astype(np.uint8)
        x = -1 + 0.4 * k
        wall = e3d.primitives.quad(
            (x, -0.9, 0), (x + 0.35, -0.9, 0), (x + 0.35, 0.9, 0), (x, 0.9, 0)
        )
        wall.uvs = wall.uvs * (1.5, 2.5)
        scene.add(with_material(wall, texture=e3d.Texture(pixels, wrap=wrap)))
    return Picture(scene, clip_camera(), options={"mode": "unlit"})


for _wrap in WRAPS:
    variant(f"texture_sizes_{_wrap}", sizes, _wrap)
for _pair in MIXED:
    variant(f"texture_sizes_{'_'.join(_pair)}", sizes, _pair)


@picture
def texture_of_linear_data():
    """A texture whose bytes are linear beside the same as sRGB."""
    scene = e3d.Scene()
    ramp = np.repeat(np.arange(0, 256, 8, np.uint8), 3).reshape(1, 32, 3)
    for k, space in enumerate(("srgb", "linear")):
        wall = e3d.primitives.quad((-1, k - 1, 0), (1, k - 1, 0), (1, k, 0), (-1, k, 0))
        texture = e3d.Texture(ramp, color_space=space, filter="bilinear", wrap="clamp")
        scene.add(with_material(wall, texture=texture))
    return Picture(scene, clip_camera(), options={"mode": "unlit"})


@picture
def texture_times_colors():
    """Texture, material, vertex and instance colours are factors of one product."""
    wall = e3d.Mesh(
        [(-0.5, -0.5, 0), (0.5, -0.5, 0), (0.5, 0.5, 0), (-0.5, 0.5, 0)],
        [[0, 1, 2], [0, 2, 3]],
        uvs=[(0, 0), (1, 0), (1, 1), (0, 1)],
        colors=np.array([[255, 255, 255], [255, 80, 80], [80, 255, 80], [80, 80, 255]], np.uint8),
        materials=[e3d.Material(texture=checkerboard(), color=e3d.linear(1.0, 0.9, 0.7))],
    )
    poses = [[-0.6, 0, 0, 0.9], [0.6, 0, 0, 0.9]]
    colors = np.array([[255, 255, 255], [255, 200, 90]], np.uint8)
    scene = e3d.Scene(background=(20, 20, 20))
    scene.add(e3d.InstancedMesh(wall, poses, colors=colors))
    return Picture(scene, camera_at((0.3, 0.3, 2.2), (0, 0, 0)), options={"mode": "unlit"})


@picture
def texture_on_a_sphere_samples_4():
    scene = e3d.Scene(background=(40, 44, 60))
    scene.add(with_material(e3d.uv_sphere(0.8, (32, 16)), texture=checkerboard(64, 8)))
    return Picture(scene, camera_at((0.4, 1.2, 2.0), (0, 0, 0)), samples=4)
