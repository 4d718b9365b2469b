"""Area lights: each kind on every kind of material, at horizons, with shadows and ranges, many."""

import math

import numpy as np
from images.objects import SAND, camera_at, floor, with_material
from images.picture import Picture, picture, variant

import engine3d as e3d
from engine3d.lights import DiscLight, RectangleLight, TubeLight

KINDS = {
    "rectangle": lambda **options: RectangleLight((1, 0.9, 0.8), 5.0, 1.6, 0.7, **options),
    "disc": lambda **options: DiscLight((0.8, 0.9, 1), 5.0, 0.6, **options),
    "tube": lambda **options: TubeLight((1, 0.7, 0.8), 6.0, 2.0, 0.08, **options),
}
#: Materials with everything that meets area lights in a way of its own.
MATERIALS = [
    {"metallic": 1.0, "roughness": 0.15},
    {"metallic": 0.0, "roughness": 0.4, "clearcoat": 1.0, "clearcoat_roughness": 0.1},
    {"metallic": 0.0, "roughness": 0.9, "sheen_color": (0.9, 0.6, 0.7), "sheen_roughness": 0.4},
    {"metallic": 1.0, "roughness": 0.5, "anisotropy": 0.8},
    {"metallic": 0.2, "roughness": 0.3, "iridescence": 1.0},
    {"specular": (0.5, 0.5, 0.5), "shininess": 40.0},
]


def room(light, physical_floor=True, **how):
    """Balls before a wall that the light partly lies behind, on a floor that it sinks into."""
    scene = e3d.Scene(background=(12, 14, 18), ambient=e3d.linear(0.03, 0.03, 0.03))
    look = {"metallic": 0.0, "roughness": 0.3} if physical_floor else {}
    ground = with_material(floor(6.0), color=e3d.linear(0.6, 0.6, 0.62), **look)
    scene.add(ground)
    scene.add(ground, translation=(0, 0, -1.7), euler=(math.pi / 2, 0, 0))
    for number, given in enumerate(MATERIALS):
        ball = with_material(e3d.uv_sphere(0.3, (24, 12)), color=SAND, **given)
        scene.add(ball, translation=(-1.75 + 0.7 * number, 0.3, 0.3 * (number % 2)))
    for one, pose in light:
        scene.add(one, pose=pose)
    names = ("samples", "color_space")
    settings = {name: how.pop(name) for name in names if name in how}
    return Picture(scene, camera_at((0.3, 1.6, 3.2), (0, 0.3, 0)), options=how, **settings)


def above(kind, **options):
    """Return a light over the balls, which leans."""
    return KINDS[kind](**options), e3d.look_at((0.4, 1.5, 0.6), (0, 0, 0), (0, 0, -1))


def sunk(kind, **options):
    """Return a light that half lies below the floor and behind the wall."""
    return KINDS[kind](**options), e3d.look_at((-1.4, 0.1, -1.6), (1, 0.6, 1), (0, 1, 0))


def one(place, kind, *, shadow="none", reach=math.inf, **how):
    return room([place(kind, shadow=shadow, shadow_map_size=256, range=reach)], **how)


for name in KINDS:
    variant(f"area_{name}", one, above, name)
    variant(f"area_{name}_sunk", one, sunk, name, physical_floor=False)
    variant(f"area_{name}_shadow", one, above, name, shadow="map")
variant("area_exact_shadow", one, above, "disc", shadow="exact")
variant("area_range", one, above, "rectangle", reach=1.8, physical_floor=False)
variant("area_samples_4", one, above, "tube", samples=4, shadow="map")
variant("area_forward", one, sunk, "rectangle", shading="forward", shadow="map")


@picture
def area_many():
    """More lights than are looked at one by one, most of them with short ranges, and a sun."""
    lights = []
    for number, angle in enumerate(np.arange(300) * 0.7):
        kind = list(KINDS)[number % 3]
        light = KINDS[kind](range=0.5 + number % 5 * 0.1)
        light.intensity = 2.0
        eye = (2 * math.cos(angle), 0.3 + number % 7 * 0.1, 1.5 * math.sin(angle))
        lights.append((light, e3d.look_at(eye, (0, 0, 0))))
    lights.append((e3d.DirectionalLight(intensity=0.4), e3d.look_at((1, 1, 1), (0, 0, 0))))
    return room(lights)
