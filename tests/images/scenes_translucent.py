"""Leaves, paper and wax: light from behind, from every kind of light, with every kind of shadow."""

import numpy as np
from images.objects import camera_at, floor, with_material
from images.picture import Picture, variant
from images.scenes_physical import ball, bumps, waves

import engine3d as e3d

LEAF = {
    "metallic": 0.0,
    "roughness": 0.5,
    "color": e3d.linear(0.2, 0.5, 0.1),
    "diffuse_transmission": 0.6,
    "diffuse_transmission_color": e3d.linear(0.7, 0.8, 0.1),
    "two_sided": True,
}
WAX = {
    **LEAF,
    "thickness": 0.6,
    "attenuation_color": e3d.linear(0.9, 0.4, 0.2),
    "attenuation_distance": 0.4,
}


def things():
    """One of each kind: (mesh, place)."""
    placed = e3d.PlacedTexture(waves(filter="bilinear"), uv_set=1)
    layers = {"clearcoat": 0.6, "sheen_color": e3d.linear(0.4, 0.3, 0.2), "sheen_roughness": 0.5}
    yield ball(**LEAF), (-0.9, 0.5, 0.3)
    yield ball(**WAX), (-0.3, 0.4, 0.6)
    yield ball(**{**WAX, "transmission": 0.5}), (0.35, 0.45, 0.5)
    yield (
        ball(
            True,
            diffuse_transmission_texture=waves(),
            diffuse_transmission_color_texture=placed,
            thickness_texture=placed,
            normal_texture=bumps(),
            **WAX,
        ),
        (0.9, 0.4, 0.2),
    )
    yield ball(**{**LEAF, "metallic": 0.5, "iridescence": 0.7, **layers}), (-0.8, 1.1, -0.2)
    yield ball(**{**LEAF, "flat_shading": True, "diffuse_transmission": 1.0}), (0, 1.2, 0)
    yield (
        ball(**{**LEAF, "alpha_mode": "blend", "color": e3d.linear(0.1, 0.35, 0.05, 0.6)}),
        (0.7, 1.2, 0.1),
    )


def lantern(shadow="none", softness=0.0, sky=False, samples=1, **options):
    scene = e3d.Scene(background=(30, 38, 54), ambient=e3d.linear(0.05, 0.05, 0.08))
    scene.add(floor(), name="floor")
    for number, (mesh, place) in enumerate(things()):
        scale = (1, 1, 1) if number % 3 else (-1.1, 0.8, 0.9)
        scene.add(mesh, translation=place, scale=scale)
    screen = e3d.Mesh.from_polygons(
        np.array([(-1.2, 0, 0), (-0.5, 0, 0), (-0.5, 0.9, 0), (-1.2, 0.9, 0)], np.float32),
        [(0, 1, 2, 3)],
    )
    scene.add(with_material(screen, **LEAF), translation=(0, 0, 0.9))
    soft = {} if shadow != "map" else {"shadow_softness": softness}
    given = {"shadow": shadow, **soft}
    scene.add(e3d.DirectionalLight((-0.2, -0.5, 1.0), intensity=4.0, **given))
    scene.add(e3d.PointLight(e3d.linear(1.0, 0.6, 0.3), 6.0, **given), translation=(0.2, 0.9, -0.8))
    pose = e3d.look_at((1.6, 1.4, -1.2), (0.2, 0.4, 0.3))
    scene.add(e3d.SpotLight(e3d.linear(0.3, 0.5, 1.0), 9.0, **given), pose=pose)
    if sky:
        y, x = np.mgrid[0:16, 0:32]
        light = np.stack([y / 16, 0.5 + 0.4 * np.sin(x / 5), 1 - y / 16], axis=-1)
        scene.environment = e3d.Environment(light.astype(np.float32))
    return Picture(scene, camera_at(), samples=samples, options=options)


variant("translucent", lantern)
variant("translucent_maps", lantern, "map")
variant("translucent_soft", lantern, "map", 0.2)
variant("translucent_exact", lantern, "exact", samples=4)
variant("translucent_facets", lantern, "exact", normals="facet")
variant("translucent_sky", lantern, "map", sky=True, ambient_occlusion=True)
variant("translucent_unlit", lantern, mode="unlit")
