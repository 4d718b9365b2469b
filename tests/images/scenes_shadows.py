"""Shadows from maps: every kind of light, cascades, comparisons, seams, holes, switches."""

import math

import numpy as np
from images.objects import CORAL, SAND, TEAL, camera_at, checkerboard, floor, with_material
from images.picture import Picture, picture, variant

import engine3d as e3d

SUN = (-0.6, -1.0, -0.45)


def stage(size=6.0, **scene_options):
    """A floor, and on it a ball, a box that is turned, and a ring that stands."""
    options = {"background": (24, 28, 36), "ambient": e3d.linear(0.2, 0.2, 0.22), **scene_options}
    scene = e3d.Scene(**options)
    scene.add(floor(size, color=e3d.linear(0.8, 0.8, 0.78)), name="floor")
    ball = with_material(e3d.icosphere(0.4, 3), color=CORAL, specular=e3d.linear(0.4, 0.4, 0.4))
    scene.add(ball, name="ball", translation=(-0.6, 0.4, 0.2))
    box = with_material(e3d.box(0.7), color=SAND)
    scene.add(box, name="box", translation=(0.5, 0.35, -0.5), euler=(0, 0.6, 0))
    ring = with_material(e3d.torus(0.4, 0.12, (32, 16)), color=TEAL)
    scene.add(ring, name="ring", translation=(0.6, 0.5, 0.8), euler=(math.pi / 2, 0, 0.5))
    return scene


def seen(scene, eye=(2.2, 2.0, 3.2), target=(0, 0.3, 0), **how):
    lens = {"zfar": how.pop("zfar", 50.0)}
    names = ("samples", "color_space", "size")
    settings = {name: how.pop(name) for name in names if name in how}
    return Picture(scene, camera_at(eye, target, **lens), options=how, **settings)


def sun(samples=1, shading="deferred", **options):
    scene = stage()
    options = {"shadow_map_size": 256, "shadow": "map", **options}
    scene.add(e3d.DirectionalLight(SUN, intensity=0.8 * math.pi, **options))
    return seen(scene, samples=samples, shading=shading)


variant("shadow_sun", sun)
variant("shadow_sun_one_tap", sun, shadow_taps=1)
variant("shadow_sun_five_taps", sun, shadow_taps=5)
variant("shadow_sun_wide", sun, shadow_taps=3, shadow_radius=2.6)
variant("shadow_sun_biased", sun, shadow_bias=0.01, shadow_normal_bias=-0.02)
variant("shadow_sun_soft", sun, shadow_softness=0.12)
variant("shadow_sun_soft_forward", sun, shading="forward", shadow_softness=0.03, shadow_taps=5)
variant("shadow_sun_soft_samples_4", sun, samples=4, shadow_softness=0.3)
variant("shadow_sun_samples_4", sun, samples=4)
variant("shadow_sun_forward", sun, shading="forward")


@picture
def shadow_cascades():
    """Columns in rows to far away: four maps, the finest near the camera."""
    scene = e3d.Scene(background=(120, 140, 170), ambient=e3d.linear(0.25, 0.25, 0.3))
    scene.add(floor(120.0, color=e3d.linear(0.7, 0.7, 0.66)))
    column = with_material(e3d.cylinder(0.3, 2.0, 12), color=SAND)
    for row in range(24):
        for side in (-1.2, 1.4):
            scene.add(column, translation=(side, 1.0, -2.0 * row))
    light = e3d.DirectionalLight(SUN, shadow="map", shadow_map_size=128, intensity=0.75 * math.pi)
    scene.add(light)
    return seen(scene, (0.2, 1.6, 3.0), (0, 0.9, -6), zfar=200.0)


def lamp(taps=3, radius=1.0, samples=1, softness=0.0):
    """Twigs all around a lamp, so that shadows cross the seams of its cube."""
    scene = stage(ambient=e3d.linear(0.05, 0.05, 0.06))
    wall = floor(6.0, color=e3d.linear(0.7, 0.72, 0.8))
    scene.add(wall, translation=(-1.6, 0, 0), euler=(0, 0, -math.pi / 2))
    scene.add(wall, translation=(0, 0, -1.6), euler=(math.pi / 2, 0, 0))
    twig = with_material(e3d.box((0.03, 1.2, 0.03)), color=SAND)
    for turn in np.arange(6) * (math.pi / 6):
        scene.add(twig, translation=(-0.2, 0.9, 0.4), euler=(0.6, 0, turn))
    light = e3d.PointLight(
        intensity=1.6 * math.pi,
        shadow="map",
        shadow_map_size=128,
        shadow_taps=taps,
        shadow_radius=radius,
        shadow_softness=softness,
    )
    scene.add(light, translation=(-0.1, 1.3, 0.5))
    return seen(scene, samples=samples)


variant("shadow_lamp", lamp)
variant("shadow_lamp_five_taps", lamp, 5)
variant("shadow_lamp_wide", lamp, 5, 3.3)
variant("shadow_lamp_soft", lamp, softness=0.1)


def spot(angle, taps, reach=math.inf, softness=0.0):
    scene = stage(ambient=e3d.linear(0.06, 0.06, 0.08))
    light = e3d.SpotLight(
        intensity=14.0 * math.pi,
        range=reach,
        outer_cone_angle=angle,
        shadow="map",
        shadow_map_size=192,
        shadow_taps=taps,
        shadow_softness=softness,
    )
    scene.add(light, pose=e3d.look_at((1.8, 2.4, 1.2), (0, 0.2, 0)))
    return seen(scene)


variant("shadow_spot", spot, 0.6, 3)
variant("shadow_spot_as_wide_as_can_be", spot, math.pi / 2, 5)
variant("shadow_spot_range", spot, 0.7, 1, 3.2)
variant("shadow_spot_soft", spot, 0.6, 3, softness=0.15)


@picture
def shadow_of_holes():
    """A masked leaf throws a shadow with holes, one that is blended where it is half opaque."""
    scene = stage()
    v, u = np.mgrid[0:32, 0:32] / 31.0
    ring = np.abs(np.hypot(u - 0.5, v - 0.5) - 0.3) < 0.12
    leaf = np.zeros((32, 32, 4), np.uint8)
    leaf[..., :3] = (90, 200, 70)
    leaf[..., 3] = np.where(ring, 255, 40)
    texture = e3d.Texture(leaf, filter="bilinear")
    for mode, x in (("mask", -0.6), ("blend", 0.6)):
        material = {"texture": texture, "alpha_mode": mode, "two_sided": True}
        scene.add(floor(1.0, **material), translation=(x, 1.3, 0.1), euler=(0.3, 0, 0))
    scene.add(e3d.DirectionalLight(SUN, intensity=0.8 * math.pi, shadow="map", shadow_map_size=256))
    return seen(scene)


def physical(samples=1):
    """Physically based: with a coat and normal maps, in an environment, under two lights."""
    scene = e3d.Scene(background=(20, 20, 26), ambient=e3d.linear(0.02, 0.02, 0.02))
    scene.environment = e3d.Environment.studio()
    scene.environment_intensity = 0.25
    rng = np.random.default_rng(3)
    bumps = np.full((16, 16, 3), 255, np.uint8)
    bumps[..., :2] = rng.integers(70, 186, (16, 16, 2))
    bumps = e3d.Texture(bumps, color_space="linear")
    plate = {"roughness": 0.7, "metallic": 0.0, "normal_texture": bumps}
    scene.add(floor(6.0, color=e3d.linear(0.7, 0.7, 0.7), **plate))
    coat = {"clearcoat": 1.0, "clearcoat_roughness": 0.1, "roughness": 0.4, "metallic": 0.2}
    ball = with_material(
        e3d.icosphere(0.5, 3), color=CORAL, sheen_color=e3d.linear(0.2, 0.2, 0.1), **coat
    )
    scene.add(ball, translation=(-0.3, 0.5, 0))
    scene.add(with_material(e3d.box(0.6), color=TEAL, **plate), translation=(0.7, 0.3, -0.4))
    maps = {"shadow": "map", "shadow_map_size": 128}
    scene.add(e3d.DirectionalLight(SUN, intensity=2.0, **maps))
    scene.add(e3d.PointLight(intensity=3.0, **maps), translation=(1.2, 1.4, 0.9))
    return seen(scene, samples=samples)


variant("shadow_physical", physical)


@picture
def shadow_on_mapped_normals():
    """Not physically based, with a normal map: the sample moves along the normal before that."""
    scene = stage()
    bumps = np.full((8, 8, 3), 255, np.uint8)
    bumps[..., :2] = np.random.default_rng(5).integers(40, 216, (8, 8, 2))
    normals = e3d.Texture(bumps, color_space="linear")
    tiles = {
        "texture": checkerboard(),
        "normal_texture": normals,
        "specular": e3d.linear(0.3, 0.3, 0.3),
    }
    scene.add(floor(5.0, **tiles), translation=(0, 0.01, 0))
    scene.add(e3d.DirectionalLight(SUN, intensity=0.8 * math.pi, shadow="map", shadow_map_size=256))
    return seen(scene)


@picture
def shadow_switches():
    """Nodes of one mesh, with and without each switch; lines and points have no shadows."""
    scene = e3d.Scene(background=(24, 28, 36), ambient=e3d.linear(0.2, 0.2, 0.2))
    scene.add(floor(6.0, color=e3d.linear(0.8, 0.8, 0.8)))
    post = with_material(e3d.box((0.3, 1.2, 0.3)), color=SAND)
    for number in range(4):
        cast, receive = number % 2 == 0, number // 2 == 0
        place = (-1.2 + 0.7 * number, 0.6, 0.5 - 0.3 * number)
        scene.add(post, translation=place, cast_shadows=cast, receive_shadows=receive)
    roof = with_material(e3d.plane((3.0, 0.5)), color=TEAL, two_sided=True)
    scene.add(roof, translation=(0.3, 1.6, 0.9))
    lines = e3d.Mesh(np.array([[-1.5, 2, 0.0], [1.5, 2, 0]]), lines=[[0, 1]], points=[0, 1])
    scene.add(lines)
    scene.add(e3d.DirectionalLight((-0.2, -1, -0.6), shadow="map", shadow_map_size=256))
    return seen(scene)


@picture
def shadows_of_many_lights():
    """Six lights, some with shadows: shading chooses the lights of each batch."""
    scene = stage(ambient=e3d.linear(0.05, 0.05, 0.05))
    colors = [(1, 0.3, 0.2), (0.3, 1, 0.3), (0.3, 0.4, 1), (1, 1, 0.3), (0.3, 1, 1), (1, 0.4, 1)]
    for number, color in enumerate(map(e3d.linear, colors)):
        angle = number * math.pi / 3
        light = e3d.PointLight(
            color,
            0.7 * math.pi,
            range=4.0,
            shadow="none" if number % 2 else "map",
            shadow_map_size=64,
            shadow_taps=3,
        )
        scene.add(light, translation=(1.5 * math.cos(angle), 1.3, 1.5 * math.sin(angle)))
    return seen(scene)


@picture
def shadow_on_glass():
    """Blended surfaces receive shadows, too, and instances cast them."""
    scene = stage()
    pane = {"color": e3d.linear(0.6, 0.8, 1.0, 0.5), "alpha_mode": "blend", "two_sided": True}
    scene.add(floor(1.6, **pane), translation=(0.4, 0.15, 0.6))
    poses = np.tile(np.eye(4), (3, 1, 1))
    poses[:, :3, 3] = [(-0.4, 1.3, 0.9), (0.3, 1.4, 0.7), (1.0, 1.2, 0.5)]
    scene.add(e3d.InstancedMesh(with_material(e3d.icosphere(0.18, 2), color=CORAL), poses))
    scene.add(e3d.DirectionalLight(SUN, intensity=0.8 * math.pi, shadow="map", shadow_map_size=256))
    return seen(scene)
