"""Anisotropic and biased textures in every slot; round lines and points, sizes by the picture."""

import numpy as np
from images.objects import camera_at, checkerboard, clip_camera, with_material
from images.picture import Picture, picture, variant

import engine3d as e3d


def receding_floor(wrap="repeat", **sampling):
    """A floor to the horizon, rolled, so that no axis of a footprint is one of the texture's."""
    scene = e3d.Scene(background=(90, 120, 160))
    ground = e3d.plane((60, 60), 3)
    ground.uvs = ground.uvs * 40 - 20
    scene.add(with_material(ground, texture=checkerboard(wrap=wrap, **sampling)))
    roll = camera_at((0.5, 0.8, 2.0), (0.2, 0.4, 0))
    roll = (roll[0], roll[1] @ e3d.linalg.rotation_z(0.5))
    return Picture(scene, roll, options={"mode": "unlit"})


for _most in (2, 5, 16):
    variant(f"anisotropic_{_most}", receding_floor, anisotropy=_most)
for _wrap in ("clamp", "mirror"):
    variant(f"anisotropic_{_wrap}", receding_floor, _wrap, anisotropy=16)
for _name, _bias in (("sharper", -1.0), ("blurred", 0.7)):
    variant(f"lod_bias_{_name}", receding_floor, lod_bias=_bias)
variant("lod_bias_of_anisotropic", receding_floor, anisotropy=8, lod_bias=-0.5)


@picture
def anisotropic_maps():
    """Every kind of map, some with other numbers of probes at the same coordinates."""
    rng = np.random.default_rng(7)
    pixels = rng.integers(0, 256, (48, 64, 4)).astype(np.uint8)
    pixels[..., 2] = pixels[..., 2] // 2 + 128

    def of(anisotropy, bias=0.0):
        return e3d.Texture(pixels, color_space="linear", anisotropy=anisotropy, lod_bias=bias)

    material = e3d.Material(
        metallic=0.6,
        roughness=0.9,
        texture=checkerboard(anisotropy=16),
        metallic_roughness_texture=of(4),
        normal_texture=of(8, -0.5),
        emissive=e3d.linear(0.2, 0.2, 0.2),
        emissive_texture=e3d.PlacedTexture(of(16), scale=(2.0, 3.0), rotation=0.4),
        occlusion_texture=of(1),
    )
    ground = e3d.plane((20, 20), 2)
    ground.uvs = ground.uvs * 10
    ground.materials = [material]
    scene = e3d.Scene(background=(30, 40, 60))
    scene.add(ground)
    scene.add(e3d.DirectionalLight((-0.3, -1, -0.6), e3d.linear(1, 0.95, 0.9), 2.0))
    return Picture(scene, camera_at((0.5, 0.8, 3.0), (0, 0, 0)))


def cut_out(alpha_mode):
    """Alphas of an anisotropic texture, cut and laid over."""
    pixels = np.full((32, 32, 4), 255, np.uint8)
    y, x = np.mgrid[:32, :32]
    pixels[..., 3] = np.where((x // 8 + y // 8) % 2, 230, 40)
    texture = e3d.Texture(pixels, anisotropy=16)
    ground = e3d.plane((20, 20), 2)
    ground.uvs = ground.uvs * 8
    ground.materials = [e3d.Material(texture=texture, alpha_mode=alpha_mode)]
    scene = e3d.Scene(background=(90, 30, 40))
    scene.add(ground)
    return Picture(scene, camera_at((0.5, 0.8, 3.0), (0, 0, 0)))


variant("anisotropic_mask", cut_out, "mask")
variant("anisotropic_blend", cut_out, "blend")


def star(width, samples=1, **options):
    """Lines of all angles, and one that is a dot."""
    ends, colors = [], []
    for k in range(16):
        across = np.array([np.cos(k * np.pi / 8), np.sin(k * np.pi / 8), 0.0])
        ends += [0.3 * across, 0.9 * across]
        colors += [(255, 255, 255), (255 - 12 * k, 100, 15 * k)]
    ends += [(0, 0, 0), (0, 0, 0.5)]
    colors += [(90, 200, 90)] * 2
    lines = np.arange(len(ends)).reshape(-1, 2)
    scene = e3d.Scene(background=(20, 24, 30))
    scene.add(e3d.Mesh(ends, lines=lines, colors=np.array(colors, np.uint8)))
    options = {"line_width": width, "line_shape": "round", "mode": "unlit", **options}
    return Picture(scene, clip_camera(), (160, 120), samples=samples, options=options)


for _width in (0.5, 1.0, 3.0, 20.0):
    variant(f"round_lines_{_width:g}", star, _width)
variant("round_lines_samples_16", star, 4.0, 16)
variant("round_lines_painter", star, 6.0, hidden_surfaces="painter")
variant("lines_in_shares_of_the_picture", star, 25.0, size_unit="picture")


@picture
def round_lines_cut_by_the_near_plane():
    """Lines through the eye's plane, behind and in front of a wall, and blended."""
    rng = np.random.default_rng(3)
    ends = rng.uniform(-2, 2, (40, 3))
    lines = np.arange(40).reshape(-1, 2)
    material = e3d.Material(color=(1, 1, 1, 0.5), alpha_mode="blend")
    scene = e3d.Scene(background=(20, 24, 30))
    scene.add(e3d.Mesh(ends, lines=lines, materials=[material]))
    scene.add(with_material(e3d.plane((2, 2)), color=e3d.linear(0.3, 0.5, 0.4)))
    options = {"line_width": 7.0, "line_shape": "round"}
    return Picture(scene, camera_at((0.3, 0.6, 1.0), (0, 0, 0)), options=options)


@picture
def round_wireframe():
    scene = e3d.Scene(background=(40, 44, 60))
    scene.add(e3d.box((1, 1, 1)))
    options = {"wireframe": "overlay", "line_width": 5.0, "line_shape": "round"}
    options |= {"line_color": (250, 220, 90)}
    return Picture(scene, camera_at((1.2, 1.0, 1.6), (0, 0, 0)), samples=4, options=options)


def cloud(size, samples=1, **options):
    rng = np.random.default_rng(5)
    places = rng.uniform(-0.9, 0.9, (120, 3))
    colors = rng.integers(60, 256, (120, 3)).astype(np.uint8)
    scene = e3d.Scene(background=(20, 24, 30))
    scene.add(e3d.Mesh(places, points=np.arange(120), colors=colors))
    options = {"point_size": size, "point_shape": "round", "mode": "unlit", **options}
    return Picture(scene, clip_camera(), (160, 120), samples=samples, options=options)


for _size in (1.0, 1.5, 4.0, 31.0):
    variant(f"round_points_{_size:g}", cloud, _size)
variant("round_points_samples_4", cloud, 3.0, 4)
variant("points_in_shares_of_the_picture", cloud, 60.0, size_unit="picture")
