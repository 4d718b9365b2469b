"""Physical materials, environments and shadows of plotters: what VTK's formulas say of a pixel."""

import math
import warnings

import numpy as np
import pytest
from compat.plotters import SIZE, plane_plotter, plotter, without_opengl

import engine3d as e3d

pv = pytest.importorskip("pyvista", exc_type=ImportError)
if not hasattr(pv, "register_plotter_component"):
    pytest.skip("components of plotters came with PyVista 0.48", allow_module_level=True)

ROUGH = {"pbr": True, "metallic": 0.3, "roughness": 0.6, "color": (200, 120, 60)}
#: The directions of cube maps' faces for VTK, which looks up -z in OpenGL's.
WAYS = ((1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, -1), (0, 0, 1))
UPS = ((0, 0, 1), (0, 0, 1), (1, 0, 0), (1, 0, 0), (0, 1, 0), (0, 1, 0))


@pytest.fixture(autouse=True)
def drawn_without_opengl():
    without_opengl()
    import engine3d.compat.pyvista  # noqa: F401


def flat_texture(*code, is_srgb=False):
    texture = pv.Texture(np.full((4, 4, 3), code, np.uint8))
    texture.SetUseSRGBColorSpace(is_srgb)
    return texture


def lit_plane(**options):
    """A square that faces the camera and one light, and its actor."""
    pl = plotter(lighting="none")
    pl.add_light(pv.Light(light_type="headlight", intensity=0.2))
    actor = pl.add_mesh(pv.Plane(i_resolution=1, j_resolution=1), **options)
    pl.enable_parallel_projection()
    pl.view_xy()
    return pl, actor


def middle(pl):
    return pl.engine3d.screenshot()[SIZE[1] // 2, SIZE[0] // 2 + 3]


@pytest.mark.parametrize("seed", range(4))
def test_maps_multiply_the_numbers_of_a_material(seed):
    rng = np.random.default_rng(seed)
    occlusion, roughness, metallic = rng.integers(130, 256, 3).tolist()
    strength, given = rng.uniform(0.2, 1.0), {"roughness": 0.9, "metallic": 0.8}
    mapped, actor = lit_plane(**ROUGH | given)
    actor.prop.SetORMTexture(flat_texture(occlusion, roughness, metallic))
    actor.prop.SetOcclusionStrength(strength)
    told = {"roughness": 0.9 * roughness / 255, "metallic": 0.8 * metallic / 255}
    plain, _ = lit_plane(**ROUGH | told)
    light = (middle(plain) / 255.0) ** 2.2 * (1 - strength + strength * occlusion / 255)
    assert np.allclose(middle(mapped), 255 * light ** (1 / 2.2), atol=1.5)


def test_a_map_adds_light_of_its_own():
    shining, actor = lit_plane(**ROUGH)
    actor.prop.SetEmissiveTexture(flat_texture(90, 140, 30, is_srgb=True))
    actor.prop.SetEmissiveFactor(0.5, 1.0, 0.25)
    plain, _ = lit_plane(**ROUGH)
    added = ((np.array([90, 140, 30]) / 255 + 0.055) / 1.055) ** 2.4
    light = (middle(plain) / 255.0) ** 2.2 + np.array([0.5, 1.0, 0.25]) * added
    assert np.allclose(middle(shining), 255 * light ** (1 / 2.2), atol=1.5)


@pytest.mark.parametrize("strength", [0.25, 1.0])
def test_a_coat_lies_over_the_material(strength):
    """All angles are 0 here, so that a distribution of roughness r peaks at 1 / (pi r**4)."""
    roughness, ior, tint = 0.5, 1.8, np.array([0.9, 0.6, 0.3])
    coated, actor = lit_plane(**ROUGH)
    actor.prop.SetCoatStrength(strength)
    actor.prop.SetCoatRoughness(roughness)
    actor.prop.SetCoatIOR(ior)
    actor.prop.SetCoatColor(tint)
    color = np.array(ROUGH["color"]) / 255
    base, metal = 0.04 * 0.7 + color * 0.3, ROUGH["metallic"]
    lost = strength * ((ior - 1) / (ior + 1)) ** 2
    mirrored = base / (4 * math.pi * ROUGH["roughness"] ** 4) * (1 - lost) ** 2
    scattered = (1 - metal) * (1 - base) * color / math.pi * (1 - lost)
    light = (mirrored + scattered) * (1 - strength + strength * tint)
    light += lost / (4 * math.pi * roughness**4)
    expected = 255 * np.minimum(0.2 * light, 1.0) ** (1 / 2.2)
    assert np.allclose(middle(coated), expected, atol=2)


@pytest.mark.parametrize("face", range(6))
@pytest.mark.parametrize("is_cube", [True, False])
def test_a_mirror_shows_what_lies_behind_the_viewer(face, is_cube):
    codes = np.repeat([40, 250], 3)[:, None] + np.concatenate([np.eye(3), -np.eye(3)]) * 150
    texture = pv.Texture()
    if is_cube:
        texture.cube_map = True
        for k, code in enumerate(codes):
            image = pv.ImageData(dimensions=(16, 16, 1))
            image.point_data["rgb"] = np.full((256, 3), code, np.uint8)
            texture.SetInputDataObject(k, image)
    else:
        y, x = np.mgrid[:64, :128]
        yaw, pitch = 2 * np.pi * ((x + 0.5) / 128 - 0.5), np.pi * (0.5 - (y + 0.5) / 64)
        level = np.cos(pitch)
        ways = np.stack([level * np.cos(yaw), np.sin(pitch), level * np.sin(yaw)], -1)
        texture = pv.Texture(codes[(ways @ np.transpose(WAYS)).argmax(-1)].astype(np.uint8))
    pl = plotter(lighting="none")
    plane = pv.Plane(direction=WAYS[face], i_resolution=1, j_resolution=1)
    pl.add_mesh(plane, pbr=True, metallic=1.0, roughness=0.0, color="white")
    pl.set_environment_texture(texture)
    pl.enable_parallel_projection()
    pl.camera_position = [WAYS[face], (0, 0, 0), UPS[face]]
    pl.reset_camera()
    expected = 255 * (codes[face] / 255) ** (1 / 2.2)
    assert np.allclose(middle(pl), expected, atol=3)


@pytest.mark.parametrize("seed", range(3))
def test_maps_count_for_light_of_surroundings(seed):
    roughness, metallic = np.random.default_rng(seed).integers(40, 256, 2).tolist()

    def drawn(texture, **options):
        pl = plotter(lighting="none")
        actor = pl.add_mesh(pv.Plane(), pbr=True, color=(200, 120, 60), **options)
        if texture is not None:
            actor.prop.SetORMTexture(texture)
        pl.set_environment_texture(flat_texture(200, 180, 90))
        pl.view_xy()
        return middle(pl)

    mapped = drawn(flat_texture(255, roughness, metallic), roughness=1.0, metallic=1.0)
    plain = drawn(None, roughness=roughness / 255, metallic=metallic / 255)
    assert np.allclose(mapped, plain, atol=1)


def test_white_surroundings_show_a_white_ball_white():
    pl = plotter(lighting="none")
    pl.add_mesh(pv.Sphere(), pbr=True, metallic=1.0, roughness=0.3, color="white")
    pl.set_environment_texture(flat_texture(255, 255, 255), show_background=False)
    pl.set_background("black")
    picture = pl.engine3d.screenshot()
    assert (picture[picture[..., 0] > 0] >= 250).mean() > 0.9


@pytest.mark.parametrize("look", [{}, {"specular": 0.4}, {"pbr": True}])
@pytest.mark.parametrize("positional", [True, False])
def test_shadows_fall_where_the_light_is_hidden(look, positional):
    def drawn(shadows, light_type="scene light"):
        pl = plotter(lighting="none")
        where = {"position": (6, 0, 6), "focal_point": (0, 0, 0), "light_type": light_type}
        pl.add_light(pv.Light(**where, positional=positional, cone_angle=40))
        pl.add_mesh(pv.Plane(i_size=6, j_size=6), color="white", **look)
        pl.add_mesh(pv.Sphere(radius=0.5, center=(0, 0, 1.5)), color="red", **look)
        if shadows:
            pl.enable_shadows()
        pl.camera_position = [(0, 0, 20), (0, 0, 0), (0, 1, 0)]
        return pl.engine3d.screenshot().astype(int)

    bare, shadowed = drawn(False), drawn(True)
    scale = SIZE[1] / (2 * 20 * math.tan(math.radians(15)))  # pixels of a unit on the plane
    y, x = np.mgrid[: SIZE[1], : SIZE[0]] + 0.5
    x, y = (x - SIZE[0] / 2) / scale, (SIZE[1] / 2 - y) / scale
    places = np.stack([x, y, 0 * x], -1)
    to_light = (
        (np.array([6.0, 0, 6.0]) - places)
        if positional
        else np.broadcast_to((1.0, 0, 1.0), places.shape)
    )
    to_light = to_light / np.linalg.norm(to_light, axis=-1, keepdims=True)
    away = np.array([0, 0, 1.5]) - places
    along = (away * to_light).sum(-1)
    gap = np.sqrt((away * away).sum(-1) - along**2)
    on_plane = (np.abs(x) < 2.9) & (np.abs(y) < 2.9) & (np.hypot(x, y) > 0.7)
    inside, outside = on_plane & (gap < 0.42), on_plane & (gap > 0.58)
    assert inside.sum() > 30
    assert (shadowed[inside] == 0).all()
    assert (shadowed[outside] == bare[outside]).all()
    assert (bare[inside] > 20).all()
    assert np.array_equal(drawn(True, "headlight"), drawn(False, "headlight"))


@pytest.mark.parametrize("name", ["anisotropy", "normal maps", "splats"])
def test_what_is_not_drawn_of_a_look_is_named(name):
    ball = pv.Sphere()
    ball.texture_map_to_sphere(inplace=True)
    ball.point_data["Tangents"] = np.tile([1.0, 0.0, 0.0], (ball.n_points, 1))
    ball.GetPointData().SetActiveTangents("Tangents")
    pl = plotter()
    if name == "splats":
        pl.add_mesh(ball, style="points_gaussian")
    else:
        prop = pl.add_mesh(ball, pbr=True).prop
        if name == "anisotropy":
            prop.SetAnisotropy(0.5)
        else:
            prop.SetNormalTexture(flat_texture(128, 128, 255))
    with pytest.warns(e3d.Engine3DWarning, match=name):
        pl.engine3d.screenshot()


def test_what_is_drawn_gives_no_warning():
    pl = plane_plotter(pbr=True)
    pl.set_environment_texture(flat_texture(9, 9, 9))
    pl.enable_shadows()
    with warnings.catch_warnings():
        warnings.simplefilter("error", e3d.Engine3DWarning)
        pl.engine3d.screenshot()


def test_a_scene_keeps_coats_maps_environments_and_shadows():
    ball = pv.Sphere()
    ball.texture_map_to_sphere(inplace=True)
    pl = plotter(lighting="none")
    pl.add_light(pv.Light(light_type="scene light", position=(3, 3, 3)))
    prop = pl.add_mesh(ball, pbr=True, metallic=0.5, roughness=0.5).prop
    prop.SetCoatStrength(0.75)
    prop.SetORMTexture(flat_texture(10, 20, 30))
    prop.SetEmissiveTexture(flat_texture(40, 50, 60, is_srgb=True))
    pl.set_environment_texture(flat_texture(90, 80, 70))
    pl.enable_shadows()
    scene = pl.engine3d.scene()
    mesh = next(n.object for n in scene.nodes if isinstance(n.object, e3d.Mesh))
    material = mesh.materials[0]
    assert material.clearcoat == 0.75 and mesh.uvs is not None
    assert material.metallic_roughness_texture.pixels[0, 0, :3].tolist() == [10, 20, 30]
    assert material.occlusion_texture.pixels[0, 0, :3].tolist() == [10, 20, 30]
    assert material.emissive_texture.pixels[0, 0, :3].tolist() == [40, 50, 60]
    assert np.allclose(scene.environment.pixels[0, 0], np.array([90, 80, 70]) / 255)
    lights = [n.object for n in scene.nodes if isinstance(n.object, e3d.DirectionalLight)]
    assert [light.shadow for light in lights] == ["exact"]
