"""The scene ``city``: by day and at dusk; no lamp that pops, no tower cut, no torn markings."""

import math

import numpy as np
import pytest
from plain_picture import Renderer

import engine3d as e3d
from engine3d.apps.scenes import load_demo
from engine3d.model.scene.lights import LIGHTS
from engine3d.stage.stage_settings import Settings
from engine3d.stage.view_renderer import ViewRenderer
from engine3d.stage.views.walking import controller

SIZE = (480, 270)


@pytest.fixture(scope="module")
def view_renderer():
    with ViewRenderer(load_demo("city", dusk=True), Settings({}), SIZE) as view_renderer:
        yield view_renderer


def view_from(view_renderer, elevation, distance):
    view = view_renderer.view()
    view.elevation = math.radians(elevation)
    view.distance *= distance
    return view


def draw(view_renderer, view, znear=None, outputs=("color",)):
    camera = view_renderer.camera(view)
    if znear is not None:
        camera = e3d.PerspectiveCamera(view.yfov, znear=znear, zfar=camera.zfar)
    with Renderer(SIZE) as renderer:
        return renderer.render(view_renderer.viewed.scene, (camera, view.pose()), outputs=outputs)


@pytest.mark.parametrize("triangles", [20_000, 100_000, 400_000])
def test_at_least_256_lights_at_dusk_in_cities_of_all_sizes(triangles):
    scene = load_demo("city", triangles=triangles, dusk=True).scene
    lights = [node for node in scene.nodes if isinstance(node.object, e3d.PointLight)]
    assert 256 <= len(lights) <= 512
    assert sum(node.shown for node in lights) > 100


def test_by_day_the_sun_shines_alone():
    scene = load_demo("city", triangles=20_000).scene
    (light,) = [node for node in scene.nodes if isinstance(node.object, LIGHTS)]
    assert light.name == "sun"
    assert isinstance(scene.background, e3d.Environment)


def test_the_first_view_cuts_no_tower(view_renderer):
    view = view_renderer.view()
    ids = draw(view_renderer, view, outputs=("object_id",)).object_id
    assert (ids[0] < 0).all()


def test_the_city_stands_still_until_it_is_played(view_renderer):
    assert not view_renderer.viewed.plays and view_renderer.viewed.update is not None


@pytest.mark.parametrize(("elevation", "distance"), [(24, 1.0), (40, 1.5), (60, 1.0), (90, 1.5)])
def test_markings_are_whole_from_above(view_renderer, elevation, distance):
    """What shows is what shows where depths are told apart far better than they need be."""
    view = view_from(view_renderer, elevation, distance)
    outputs = ("face_id", "object_id", "depth")
    seen = draw(view_renderer, view, outputs=outputs)
    nearest = float(seen.depth[seen.depth > 0].min())
    exact = draw(view_renderer, view, znear=0.99 * nearest, outputs=outputs)
    differs = (seen.face_id != exact.face_id) | (seen.object_id != exact.object_id)
    assert differs.mean() < 2e-4


def test_the_near_plane_cuts_nothing_off(view_renderer):
    """Wherever one flies, over the roofs and among them."""
    random = np.random.default_rng(0)
    far = 0
    for _ in range(40):
        view = view_from(view_renderer, random.uniform(2, 90), random.uniform(0.05, 1.2))
        view.azimuth = random.uniform(-math.pi, math.pi)
        view.target = view.target + random.uniform(-150, 150, 3) * (1, 0, 1)
        znear = view_renderer.camera(view).znear
        depth = draw(view_renderer, view, znear=0.05, outputs=("depth",)).depth
        assert depth[depth > 0].min() >= znear or znear <= 0.1
        far += znear > 20.0
    assert far > 10


def step_of_lamps(view_renderer, view, other):
    """The most that a pixel of the other view changes by the lamps that shine there."""
    pictures = []
    for eye in (view, other):
        view_renderer.viewed.follow(eye.position())
        pictures.append(draw(view_renderer, other).color.astype(int))
    return int(abs(pictures[1] - pictures[0]).max())


def test_lamps_do_not_pop(view_renderer):
    """Round the whole city all lamps shine; nearer, a degree changes pixels by little."""
    for distance, most in ((1.0, 0), (0.35, 16)):
        view, worst = view_from(view_renderer, 24, distance), 0
        for _ in range(12):
            turned = view.copy()
            turned.azimuth += math.radians(1.0)
            worst = max(worst, step_of_lamps(view_renderer, view, turned))
            view = turned
        assert worst <= most


def test_lamps_do_not_pop_on_the_way_up(view_renderer):
    view, changes = view_from(view_renderer, 24, 0.05), []
    for _ in range(40):
        higher = view.copy()
        higher.distance *= 1.05
        changes.append(step_of_lamps(view_renderer, view, higher))
        view = higher
    assert 0 < max(changes) <= 24


def test_what_shines_depends_on_the_place_alone(view_renderer):
    eyes = [view_from(view_renderer, 24, distance).position() for distance in (0.3, 0.6, 0.3)]
    found = []
    for eye in eyes:
        view_renderer.viewed.follow(eye)
        lights = [
            n for n in view_renderer.viewed.scene.nodes if isinstance(n.object, e3d.PointLight)
        ]
        found.append([(*node.world_pose[:3, 3], node.object.intensity) for node in lights])
    assert found[0] == found[2] != found[1]


def test_one_who_walks_sees_what_is_near(view_renderer):
    view = view_renderer.view()
    controller(view_renderer, view).place(view)
    assert view_renderer.camera(view).znear == 0.1
