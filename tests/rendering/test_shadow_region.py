"""The region of a map that is drawn alone: it holds all lookups, and pictures keep their bytes."""

import itertools
import math

import numpy as np
import pytest
from plain_picture import Renderer

import engine3d as e3d
from engine3d.rendering._view import View
from engine3d.rendering.passes import shadow_maps
from engine3d.rendering.passes.shadow_region import lookups_of, region_of
from engine3d.rendering.passes.shadow_views import VIEWS, sight_of


def some_view(rng, bounds):
    """A camera inside or outside of a box, with or without perspective."""
    size = np.ptp(bounds, axis=0)
    eye = bounds.mean(0) + rng.normal(size=3) * size * rng.choice([0.3, 1.0, 3.0])
    target = bounds.mean(0) + rng.normal(size=3) * size * 0.3
    camera = e3d.PerspectiveCamera(rng.uniform(0.1, 2.2), znear=0.01, zfar=1000.0)
    if rng.random() < 0.3:
        camera = e3d.OrthographicCamera(rng.uniform(0.2, 4.0), znear=0.0, zfar=100.0)
    return View(camera, e3d.look_at(eye, target, rng.normal(size=3)), 640, 360)


def places(clip_from_world, points):
    return points @ clip_from_world[:, :3].T + clip_from_world[:, 3]


def are_inside(clip):
    return (np.abs(clip[:, :2]) <= clip[:, 3:]).all(axis=1)


def test_a_region_holds_what_the_camera_sees_and_its_surroundings():
    rng, found, shares = np.random.default_rng(20), 0, []
    for _ in range(120):
        low = rng.uniform(-5.0, 0.0, 3) * 10.0 ** rng.uniform(-1.0, 1.0, 3)
        bounds = np.stack([low, low + rng.uniform(0.1, 10.0, 3)])
        view = some_view(rng, bounds)
        to_light = rng.normal(size=3)
        to_light /= np.linalg.norm(to_light)
        count = int(rng.integers(1, 5))
        light = e3d.DirectionalLight(-to_light, shadow="map", shadow_cascades=count)
        pose = tuple(to_light.tolist()), None
        views = VIEWS["cascades"](light, pose, bounds, sight_of(view, bounds, count))
        points = rng.uniform(bounds[0], bounds[1], (2000, 3))
        seen = are_inside(places(view.clip_from_world, points))
        for one, lookups in zip(views.maps, lookups_of(light, views, view, bounds), strict=True):
            region = region_of(lookups, one.clip_from_world)
            if region is None:
                continue
            clip = places(one.clip_from_world, points)
            shown = are_inside(clip)
            around, angles = clip[seen & shown], rng.uniform(0.0, 2.0 * math.pi, len(points))
            shift = np.stack([np.cos(angles), np.sin(angles)], -1)[: len(around)]
            around[:, :2] += 0.99 * lookups.margin * shift
            assert are_inside(around @ np.linalg.inv(one.clip_from_world).T @ region.T).all()
            shares.append((are_inside(places(region, points)) & shown).sum() / shown.sum())
            found += 1
    assert found > 20
    assert np.mean(shares) < 0.6


@pytest.fixture
def regions(monkeypatch):
    """The regions that are drawn: those of small scenes, too."""
    found = []

    def noted(lookups, clip_from_world):
        found.append(region_of(lookups, clip_from_world))
        return found[-1]

    monkeypatch.setattr(shadow_maps, "_MANY_FACES", 1)
    monkeypatch.setattr(shadow_maps, "region_of", noted)
    return found


def town(rng, **light_options):
    """Boxes on a plane, and a sun."""
    scene = e3d.Scene(ambient=e3d.linear(0.25, 0.25, 0.25))
    scene.add(e3d.plane((40.0, 40.0)))
    for x, z in itertools.product(range(-18, 19, 4), repeat=2):
        box = e3d.box((1.5, rng.uniform(0.5, 6.0), 1.5))
        scene.add(box, translation=(x + rng.uniform(-1, 1), 1.0, z + rng.uniform(-1, 1)))
    light = e3d.DirectionalLight((1, -1, 0), shadow="map", shadow_map_size=512, **light_options)
    scene.add(light)
    return scene, light


@pytest.mark.parametrize("backend", [name for name in e3d.backends() if name != "scalar"])
@pytest.mark.parametrize("light_options", [{}, {"shadow_cascades": 1, "shadow_taps": 5}])
def test_pictures_do_not_depend_on_what_was_drawn_of_a_map(regions, backend, light_options):
    """The sun turns for some frames, then stands still while the camera goes on."""
    rng = np.random.default_rng(7)
    scene, light = town(rng, **light_options)
    camera = e3d.PerspectiveCamera(0.9, znear=0.1, zfar=200.0)
    drawn = []
    with Renderer((96, 64), backend=backend) as renderer:
        for step in range(9):
            if step < 5:
                light.direction = (1.0, -1.0, 0.02 * step)
            eye = np.array([rng.uniform(-20, 20), rng.uniform(0.5, 4), rng.uniform(-20, 20)])
            pose = e3d.look_at(eye, eye + rng.normal(size=3) * (1, 0.2, 1))
            frame = renderer.render(scene, (camera, pose))
            drawn.append(frame.stats["shadow_maps_drawn"])
            with Renderer((96, 64), backend=backend) as fresh:
                alone = fresh.render(scene, (camera, pose))
            assert np.array_equal(frame.color, alone.color), step
    assert sum(region is not None for region in regions) >= 2
    if "shadow_cascades" in light_options:  # the whole map once, for any camera
        assert drawn[5:] == [1, 0, 0, 0] or drawn[5:] == [0, 0, 0, 0]


def test_a_map_of_a_region_serves_the_camera_that_stands_still(regions):
    scene, light = town(np.random.default_rng(3), shadow_cascades=1)
    camera = e3d.PerspectiveCamera(0.6, znear=0.1, zfar=200.0), e3d.look_at((0, 2, 0), (5, 1, 0))
    drawn = []
    with Renderer((64, 48)) as renderer:
        for step in range(6):
            light.direction = (1.0, -1.0, 0.02 * min(step, 3))
            drawn.append(renderer.render(scene, camera).stats["shadow_maps_drawn"])
    assert regions[-1] is not None
    assert drawn == [1, 1, 1, 1, 0, 0]


def test_receivers_that_move_are_looked_up_in_a_map_of_their_own_region(regions):
    """A node that casts no shadow changes no map, but the box around what is lit."""
    scene, light = town(np.random.default_rng(5), shadow_cascades=1)
    kite = scene.add(e3d.plane((2.0, 2.0)), translation=(0, 3, 0), cast_shadows=False)
    camera = e3d.PerspectiveCamera(0.6, znear=0.1, zfar=200.0), e3d.look_at((0, 2, 0), (5, 4, 0))
    with Renderer((96, 64)) as renderer:
        for step in range(8):
            light.direction = (1.0, -1.0, 0.02 * min(step, 3))
            kite.translation = (0.3 * step, 3.0 + 2.0 * max(step - 3, 0), 0.0)
            frame = renderer.render(scene, camera)
            with Renderer((96, 64)) as fresh:
                assert np.array_equal(frame.color, fresh.render(scene, camera).color), step
    assert any(region is not None for region in regions)
