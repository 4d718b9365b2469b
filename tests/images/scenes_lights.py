"""Lights of every kind, falloff and range; clamps; highlights; emission; the headlight."""

import math

import numpy as np
from images.objects import CORAL, camera_at, floor, with_material
from images.picture import Picture, picture, variant

import engine3d as e3d


def stage(*, light_clamp=None, ambient=e3d.linear(0.03, 0.03, 0.04), **material):
    """A plain floor with a sphere on it, without lights."""
    scene = e3d.Scene(background=(8, 8, 12), ambient=ambient, light_clamp=light_clamp)
    material = material or {"color": e3d.linear(0.8, 0.8, 0.8)}
    scene.add(floor(4.0, **material))
    scene.add(with_material(e3d.icosphere(0.5, 4), **material), translation=(0, 0.5, 0))
    return scene


def seen(scene, **options):
    return Picture(scene, camera_at((0.8, 1.6, 2.8), (0, 0.3, 0)), options=options)


def point_lights(falloff, reach, light_clamp=None, shading="deferred"):
    scene = stage(light_clamp=light_clamp)
    lamps = [
        ((-1, 0.8, 0.6), e3d.linear(1, 0.3, 0.2)),
        ((1, 0.6, 0.7), e3d.linear(0.2, 1, 0.3)),
        ((0, 1.4, -1), e3d.linear(0.3, 0.4, 1)),
    ]
    for position, color in lamps:
        lamp = e3d.PointLight(color=color, intensity=0.8 * math.pi, range=reach, falloff=falloff)
        scene.add(lamp, translation=position)
    return seen(scene, shading=shading)


variant("point_lights", point_lights, "inverse_square", math.inf)
variant("point_lights_range", point_lights, "inverse_square", 1.0)
variant("point_lights_window", point_lights, "window", 1.6)
variant("point_lights_clamped", point_lights, "inverse_square", math.inf, (0.1, 1.0))
variant("point_lights_forward", point_lights, "window", 2.5, None, "forward")


@picture
def directional_lights():
    """Three coloured suns; where they meet it is white."""
    scene = stage()
    for direction, color in [
        ((-1, -1, -0.5), (1, 0, 0)),
        ((1, -1, -0.5), (0, 1, 0)),
        ((0, -1, 1), (0, 0, 1)),
    ]:
        scene.add(e3d.DirectionalLight(direction, color=color, intensity=0.9 * math.pi))
    return seen(scene)


@picture
def light_clamp_low_and_high():
    scene = stage(light_clamp=(0.3, 0.6))
    scene.add(e3d.DirectionalLight((-1, -0.6, -0.4), intensity=1.5 * math.pi))
    return seen(scene)


@picture
def overexposed():
    """More light than can be shown: clamped at the end, not wrapped round."""
    scene = stage(color=e3d.linear(0.9, 0.6, 0.3))
    scene.add(e3d.PointLight(intensity=30.0 * math.pi), translation=(0.6, 1.1, 0.8))
    return seen(scene)


def highlights(samples=1, shading="deferred"):
    """Shininess from dull to mirror-like, from left to right; coloured highlights below."""
    scene = e3d.Scene(background=(20, 22, 30), ambient=e3d.linear(0.05, 0.05, 0.05))
    for row, specular in enumerate(map(e3d.linear, [(0.7, 0.7, 0.7), (0.9, 0.6, 0.1)])):
        for column, shininess in enumerate([1.0, 5.0, 25.0, 125.0, 1000.0]):
            ball = with_material(
                e3d.icosphere(0.22, 3),
                color=e3d.linear(0.25, 0.05, 0.1),
                specular=specular,
                shininess=shininess,
            )
            scene.add(ball, translation=(0.5 * column - 1, 0.25 - 0.5 * row, 0))
    scene.add(e3d.DirectionalLight((-0.5, -0.7, -0.8), intensity=0.8 * math.pi))
    scene.add(
        e3d.PointLight(color=e3d.linear(0.5, 0.7, 1), intensity=2.0 * math.pi),
        translation=(1.5, 1, 2),
    )
    camera = camera_at((0, 0, 3), (0, 0, 0))
    return Picture(scene, camera, samples=samples, options={"shading": shading})


variant("specular", highlights)
variant("specular_samples_4", highlights, 4)
variant("specular_forward", highlights, 1, "forward")


@picture
def specular_orthographic():
    """The eye is infinitely far away: the view direction is the same everywhere."""
    scene = stage(
        color=e3d.linear(0.2, 0.2, 0.25), specular=e3d.linear(0.8, 0.8, 0.8), shininess=20.0
    )
    scene.add(e3d.DirectionalLight((-0.5, -0.8, -0.4)))
    pose = e3d.look_at((1, 1.5, 2.5), (0, 0.3, 0))
    return Picture(scene, (e3d.OrthographicCamera(1.2, znear=0.1, zfar=9), pose))


@picture
def emissive():
    """Glowing spheres in a dark room: nothing else gives light."""
    scene = stage(ambient=e3d.linear(0.01, 0.01, 0.01))
    for x, color in ((-0.9, e3d.linear(0.9, 0.2, 0.1)), (0.9, e3d.linear(0.1, 0.4, 0.9))):
        glow = with_material(e3d.icosphere(0.2, 2), color=(0, 0, 0), emissive=color)
        scene.add(glow, translation=(x, 0.2, 0.6))
    scene.add(e3d.PointLight(intensity=0.05 * math.pi), translation=(0, 1, 1))
    return seen(scene)


@picture
def headlight():
    """Without lights in the scene one shines from the camera."""
    return seen(stage(color=CORAL))


@picture
def light_on_a_surface():
    """Lights at a vertex and inside the sphere: no division by zero shows."""
    scene = stage()
    scene.add(e3d.PointLight(intensity=0.02 * math.pi), translation=(0, 1.0, 0))
    scene.add(e3d.PointLight(intensity=0.3 * math.pi), translation=(0, 0.5, 0))
    scene.add(
        e3d.PointLight(color=e3d.linear(1, 0.5, 0), intensity=0.01 * math.pi),
        translation=(0.5, 0.0, 1.0),
    )
    return seen(scene)


@picture
def ambient_only():
    scene = stage(ambient=e3d.linear(0.6, 0.5, 0.4))
    scene.add(e3d.DirectionalLight(intensity=0.0))
    return seen(scene)


@picture
def many_lights():
    """Forty small lamps over a floor."""
    scene = stage()
    rng = np.random.default_rng(2)
    for _ in range(40):
        x, z = rng.uniform(-1.8, 1.8, 2)
        lamp = e3d.PointLight(
            color=e3d.linear(rng.uniform(0.1, 1, 3)), intensity=0.05 * math.pi, range=0.9
        )
        scene.add(lamp, translation=(x, 0.2, z))
    return seen(scene)
