"""Soft shadows of maps: how wide penumbrae are, and what never changes."""

import math

import numpy as np
import pytest
from plain_picture import Renderer

import engine3d as e3d

LAMP = (-1.0, 4.0, 0.0)
SUN = (1.0, -1.0, 0.0)
SIDE = 320  # pixels of a picture
GREATEST = 0.687  # a tenth of a disc is farther than this many radii to one side
HALF = 0.5  # of what a picture of an edge shows


def stage(light, height):
    """A floor, seen from above, under a plate whose edge along z is at x = 0."""
    scene = e3d.Scene(background=(0, 0, 0), ambient=e3d.linear(0.0, 0.0, 0.0))
    scene.add(e3d.plane((8.0, 8.0)))
    scene.add(e3d.box((3.0, 0.01, 6.0)), translation=(-1.5, height + 0.005, 0.0), name="plate")
    lamp = scene.add(light)
    if isinstance(light, e3d.PointLight):
        lamp.translation = LAMP
    elif isinstance(light, e3d.SpotLight):
        lamp.pose = e3d.look_at(LAMP, (LAMP[0], 0, LAMP[2]), (0, 0, -1))
    return scene


def light_of(kind, softness, **options):
    given = {"shadow": "map", "shadow_softness": softness, **options}
    if kind == "sun":
        return e3d.DirectionalLight(SUN, intensity=2.0, shadow_cascades=1, **given)
    if kind == "spot":
        return e3d.SpotLight(intensity=20.0, outer_cone_angle=0.9, inner_cone_angle=0.8, **given)
    return e3d.PointLight(intensity=20.0, **given)


def from_above(scene, middle=0.0, half=4.0, **options):
    """The radiance of a square around a place on the x axis."""
    camera = e3d.OrthographicCamera(half, znear=0.0, zfar=20.0)
    pose = e3d.look_at((middle, 10, 0), (middle, 0, 0), (0, 0, -1))
    with Renderer((SIDE, SIDE), color_space="linear", **options) as renderer:
        return renderer.render(scene, (camera, pose), outputs=("radiance",)).radiance


def edge(kind, softness, height):
    """The places along x around the edge of the plate's shadow, and the light's shares there."""
    if kind == "sun":
        middle = height
    else:  # the lamp is a unit to the left of the edge
        middle = height / (LAMP[1] - height)
    scene = stage(light_of(kind, softness), height)
    at = middle + ((np.arange(SIDE) + 0.5) / SIDE * 2.0 - 1.0) * HALF
    shadowed = from_above(scene, middle, HALF)[SIDE // 2, :, 1]
    next(node for node in scene.nodes if node.name == "plate").visible = False
    share = shadowed / from_above(scene, middle, HALF)[SIDE // 2, :, 1]
    return at[at > 0.02] - middle, share[at > 0.02]  # what is not below the plate


@pytest.mark.parametrize("height", [0.5, 1.0, 2.0])
@pytest.mark.parametrize("kind", ["sun", "spot", "point"])
def test_penumbrae_are_as_wide_as_the_light_makes_them(kind, height):
    if kind == "sun":
        size = 0.2
        radius = 2.0 * height * math.tan(0.5 * size)  # rays and their cuts with the floor: √2 each
    else:
        size = 0.15
        radius = size * height / (LAMP[1] - height)
    at, share = edge(kind, size, height)
    assert share[0] < 0.01 and share[-1] > 0.99
    assert np.diff(share).min() > -0.004  # without steps back
    assert np.diff(share).max() < 0.75 * (at[1] - at[0]) / radius + 0.01
    low, middle, high = np.interp([0.1, 0.5, 0.9], np.maximum.accumulate(share), at)
    assert abs(middle) < 0.1 * radius + 0.02  # samples move two texels along their normals
    assert high - low == pytest.approx(2.0 * GREATEST * radius, rel=0.15)


@pytest.mark.parametrize("kind", ["sun", "spot", "point"])
def test_no_softness_is_the_shadow_of_before(kind):
    """To the bit, and other softness changes it."""
    soft, hard, given = (
        from_above(stage(light_of(kind, *softness), 1.0)) for softness in ((0.1,), (0.0,), (0,))
    )
    assert np.array_equal(hard, given)
    assert not np.array_equal(soft, hard)


@pytest.mark.parametrize("size", [0.0093, 0.2, 1.0])
@pytest.mark.parametrize("kind", ["sun", "spot", "point"])
def test_surfaces_hide_no_light_from_themselves(kind, size):
    """On planes at any angle to the light, and on a ball, no more is dark than in hard shadows."""
    for tilt in (-1.5, -0.9, -0.3, 0.3, 0.7):
        free, hard, soft = (
            from_above(tilted(light_of(kind, softness, shadow=shadow), tilt))
            for shadow, softness in (("none", 0.0), ("map", 0.0), ("map", size))
        )
        changed = [int((picture != free).any(axis=2).sum()) for picture in (hard, soft)]
        assert free.max() > 0.1
        assert changed[1] <= changed[0] < 0.002 * SIDE**2


def tilted(light, tilt):
    """A plane, and a ball that none of its shadows reaches."""
    scene = e3d.Scene(background=(0, 0, 0), ambient=e3d.linear(0.0, 0.0, 0.0))
    scene.add(e3d.plane((3.0, 3.0)), euler=(0, 0, tilt))
    scene.add(e3d.icosphere(0.4, 4), translation=(3.0, 0.0, 3.0))
    pose = e3d.look_at(LAMP, (0, 0, 0.5))
    scene.add(light, pose=None if isinstance(light, e3d.DirectionalLight) else pose)
    return scene


def test_shadows_begin_where_things_touch():
    """Beside a box on the floor, away from the sun, the light is kept off right from its foot."""
    scene = stage(light_of("sun", 0.0093), 1.0)
    plate = next(node for node in scene.nodes if node.name == "plate")
    scene.remove(plate)
    scene.add(e3d.box((1.0, 1.0, 6.0)), translation=(-0.5, 0.5, 0.0))
    row = from_above(scene, samples=1)[SIDE // 2, :, 1]
    foot = SIDE // 2
    assert row[foot : foot + 35].max() == 0.0
    assert row[foot + 45] > 0.1


@pytest.mark.parametrize("kind", ["sun", "spot", "point"])
def test_kept_maps_show_what_new_ones_would(kind):
    """Their ranges change no pixel, nor does what was drawn before."""
    light = light_of(kind, 0.2, shadow_map_size=256)
    scene = stage(light, 1.0)
    camera = e3d.PerspectiveCamera(0.8), e3d.look_at((3, 4, 6), (0, 0.5, 0))
    with Renderer((80, 60)) as renderer:
        for softness in (0.2, 0.03, 0.0, 0.5):
            light.shadow_softness = softness
            with Renderer((80, 60)) as other:
                expected = other.render(scene, camera).color
            for _ in range(3):
                assert np.array_equal(renderer.render(scene, camera).color, expected)


@pytest.mark.parametrize("value", [-0.1, math.nan, "soft", 2.0])
def test_softness_is_an_angle(value):
    with pytest.raises(e3d.InvalidArgumentError, match="shadow_softness"):
        e3d.DirectionalLight(shadow_softness=value)
