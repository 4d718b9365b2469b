"""Ambient occlusion of whole pictures: flat things, corners against integrals, cameras, frames."""

import dataclasses

import numpy as np
import pytest
from plain_picture import Renderer, render

import engine3d as e3d
from engine3d import linalg

SIZE = (320, 240)


def visible(scene, camera, size=SIZE, radius=None, **options):
    """What of white ambient light each pixel shows: its red in linear light, 8 bits."""
    with Renderer(size, color_space="linear") as renderer:
        frame = renderer.render(
            scene, camera, ambient_occlusion=True, ambient_occlusion_radius=radius, **options
        )
    return frame.color[..., 0]


def white_scene(**options):
    scene = e3d.Scene(ambient=(1.0, 1.0, 1.0), **options)
    dark = e3d.DirectionalLight(intensity=0.0)  # so that there is no headlight
    scene.add(dark)
    return scene


def corner(height=1.0):
    """A floor at y = 0 and a wall at z = 0, which begins at the floor."""
    scene = white_scene()
    scene.add(e3d.box((4, 0.02, 4)), translation=(0, -0.01, 2))
    scene.add(e3d.box((4, height, 0.02)), translation=(0, height / 2, -0.01))
    return scene


CAMERAS = {
    "perspective": (e3d.PerspectiveCamera(0.6), e3d.look_at((0, 3, 4), (0, 0, 0.6))),
    "orthographic": (e3d.OrthographicCamera(1.2), e3d.look_at((0, 3, 4), (0, 0, 0.6))),
}


@pytest.mark.parametrize("name", CAMERAS)
@pytest.mark.parametrize("axis", range(3))
def test_what_is_flat_gets_all_light(name, axis):
    scene = white_scene()
    size = np.full(3, 40.0)
    size[axis] = 1e-3
    scene.add(e3d.box(size))
    camera, pose = CAMERAS[name]
    for turn in (0.0, 0.3, 1.1):
        turned = linalg.rotation_y(turn) @ linalg.rotation_x(0.2 * turn) @ pose
        with Renderer(SIZE) as renderer:
            depth = renderer.render(scene, (camera, turned), outputs=("depth",)).depth
        shown = visible(scene, (camera, turned), radius=0.7)
        inside = depth != 0.0
        for step in (-1, 1):  # at the edges of the box there are two faces
            inside &= np.roll(inside, step, 0) & np.roll(inside, step, 1)
        if axis == 1:
            assert inside.mean() > 0.5
        assert (shown[inside] == 255).all()


def hidden_by_wall(distance, height, radius, rays=100_000):
    """The cosine-weighted share of light at a floor that a wall takes, by rays; far parts less."""
    random = np.random.default_rng(4)
    u, angle = random.random(rays), 2 * np.pi * random.random(rays)
    towards, up = np.sqrt(u) * np.cos(angle), np.sqrt(1 - u)
    with np.errstate(divide="ignore"):
        reach = np.where(towards > 0, distance / towards, np.inf)
    hit = reach * up < height
    near = np.clip(2 - 2 * (np.where(hit, reach, 0) / radius) ** 2, 0, 1)
    return (hit * near).mean()


@pytest.mark.parametrize("name", CAMERAS)
@pytest.mark.parametrize("radius", [0.25, 0.5])
def test_a_corner_is_as_dark_as_the_integral(name, radius):
    scene = corner()
    with Renderer((640, 480)) as renderer:
        outputs = ("world_position", "world_normal")
        frame = renderer.render(scene, CAMERAS[name], outputs=outputs)
    shown = visible(scene, CAMERAS[name], (640, 480), radius)[:, 320] / 255.0
    place, normal = frame.world_position[:, 320], frame.world_normal[:, 320]
    tried = 0
    for distance in (0.05, 0.1, 0.2, 0.3, 0.5, 0.8):
        away = np.where(normal[:, 1] > 0.99, np.abs(place[:, 2] - distance), np.inf)
        pixel = int(np.argmin(away))
        if away[pixel] > 0.01:
            continue
        expected = 1 - hidden_by_wall(float(place[pixel, 2]), 1.0, radius)
        least = 0.075 if distance < 0.25 * radius else 0.145  # few places are looked at far away
        assert shown[pixel] == pytest.approx(expected, abs=least), distance
        tried += 1
    assert tried >= 5


def vertical_corner():
    """Two walls that meet in the line x = z = 0, seen so that it leans on the screen."""
    scene = white_scene()
    scene.add(e3d.box((6, 6, 0.02)), translation=(3, 0, -0.01))
    scene.add(e3d.box((0.02, 6, 6)), translation=(-0.01, 0, 3))
    return scene, (e3d.PerspectiveCamera(0.6), e3d.look_at((2.6, 0.5, 4.0), (0.5, 0, 0.5)))


def test_a_crease_has_no_dashes_and_no_bright_line():
    scene, view = vertical_corner()
    with Renderer(SIZE) as renderer:
        place = renderer.render(scene, view, outputs=("world_position",)).world_position
    shown = visible(scene, view, radius=0.4).astype(int)
    distance = np.maximum(place[..., 0], place[..., 2])
    columns = np.arange(SIZE[0])
    line = [int(columns[np.argmin(row)]) for row in distance]
    rows = range(20, SIZE[1] - 20)
    for aside in (-3, -1, 0, 1, 3):
        along = np.array([shown[y, line[y] + aside] for y in rows])
        assert np.ptp(along) < 32, aside  # dashes were 100 and more
    middle = np.array([shown[y, line[y]] for y in rows])
    beside = np.array([(shown[y, line[y] - 8] + shown[y, line[y] + 8]) / 2 for y in rows])
    assert (middle < beside + 4).all()


@pytest.mark.parametrize("mesh", [e3d.uv_sphere(0.5, (12, 6)), e3d.icosphere(0.5, 1)])
def test_smooth_coarse_meshes_do_not_hide_themselves(mesh):
    scene = white_scene()
    scene.add(mesh)
    camera = e3d.PerspectiveCamera(0.6), e3d.look_at((0.3, 0.5, 2.5), (0, 0, 0))
    shown = visible(scene, camera, radius=0.5)
    with Renderer(SIZE) as renderer:
        inside = renderer.render(scene, camera, outputs=("depth",)).depth > 0
    assert (shown[inside] >= 254).mean() > 0.98 and shown[inside].min() > 240


def test_faces_of_a_smooth_bowl_do_not_show():
    """From inside, a coarse bowl is as dark as the smooth one within two percent."""
    camera = e3d.PerspectiveCamera(0.9), e3d.look_at((0, 1.2, 0.1), (0, -1, 0))
    means = []
    for sides in ((24, 12), (192, 96)):
        scene = white_scene()
        bowl = e3d.uv_sphere(1.0, sides)
        bowl.faces, bowl.normals = bowl.faces[:, ::-1], -bowl.normals
        scene.add(bowl)
        means.append(visible(scene, camera, radius=0.8).astype(float))
    inside = np.s_[60:180, 100:220]
    assert np.abs(means[0] - means[1])[inside].mean() < 5.0


def rays_of(scene, place, normal, radius, count=256):
    """The visibility of places by rays: directions by the cosine, what they meet by distance."""
    random = np.random.default_rng(7)
    u, turn = random.random((len(place), count)), 2 * np.pi * random.random((len(place), count))
    directions = np.stack([np.sqrt(u) * np.cos(turn), np.sqrt(u) * np.sin(turn)], axis=-1)
    aside = np.where(np.abs(normal[:, :1]) < 0.9, [[1.0, 0, 0]], [[0, 1.0, 0]])
    tangent = np.cross(aside, normal)
    tangent /= np.linalg.norm(tangent, axis=1, keepdims=True)
    axes = np.stack([tangent, np.cross(normal, tangent)], axis=1)
    cast = directions @ axes + np.sqrt(1 - u)[..., None] * normal[:, None]
    start = (place + 1e-3 * radius * normal)[:, None] + 0 * cast
    hits = scene.raycast_many(start.reshape(-1, 3), cast.reshape(-1, 3), max_distance=radius)
    near = np.clip(2 - 2 * (hits.distance / radius) ** 2, 0, 1)
    return 1 - near.reshape(len(place), count).mean(axis=1)


def furnished_corner():
    scene = corner(2.0)
    scene.add(e3d.box(0.4), translation=(0.3, 0.2, 0.4))
    scene.add(e3d.uv_sphere(0.3, (64, 32)), translation=(-0.5, 0.3, 0.5))
    return scene


def two_cubes():
    scene = white_scene()
    scene.add(e3d.box((8, 0.02, 8)), translation=(0, -0.01, 0))
    scene.add(e3d.box(0.8), translation=(-0.2, 0.4, 0))
    scene.add(e3d.box(0.6), translation=(0.5, 0.3, 0.2))
    return scene


@pytest.mark.parametrize("make, most", [(furnished_corner, 0.021), (two_cubes, 0.0055)])
def test_scenes_are_as_dark_as_rays_say(make, most):
    """On average; horizons found from depths alone were farther off than that."""
    scene, view, radius = make(), CAMERAS["perspective"], 0.5
    with Renderer((640, 480)) as renderer:
        outputs = ("depth", "world_position", "world_normal")
        frame = renderer.render(scene, view, outputs=outputs)
    shown = visible(scene, view, (640, 480), radius) / 255.0
    drawn = np.argwhere(frame.depth > 0)
    at = tuple(np.random.default_rng(2).permutation(drawn)[:600].T)
    place, normal = (getattr(frame, name)[at].astype(float) for name in outputs[1:])
    off = np.abs(shown[at] - rays_of(scene, place, normal, radius))
    assert off.mean() < most and np.quantile(off, 0.95) < 8 * most


def test_more_distance_and_less_radius_are_lighter():
    scene = corner()
    middle = [
        visible(scene, CAMERAS["perspective"], radius=radius).astype(int)
        for radius in (0.05, 0.2, 0.8)
    ]
    sums = [picture.sum() for picture in middle]
    assert sums[0] > sums[1] > sums[2]


def test_the_edge_of_the_picture_is_not_darker():
    scene = white_scene()
    scene.add(e3d.box((40, 0.02, 40)))
    shown = visible(scene, CAMERAS["perspective"], radius=1.0)
    assert (shown[-1] == 255).all() and (shown[100:, 0] == 255).all()


def test_far_things_behind_a_silhouette_have_no_halo():
    scene = white_scene()
    scene.add(e3d.box((40, 40, 0.02)), translation=(0, 0, -5))
    scene.add(e3d.box((0.5, 0.5, 0.01)), translation=(0, 0, 0))
    camera = e3d.PerspectiveCamera(0.6), e3d.look_at((0, 0, 3), (0, 0, 0))
    assert (visible(scene, camera, radius=1.0) == 255).all()


def test_a_mirrored_camera_sees_the_mirrored_picture():
    """But for the pattern of sites, which isn't mirrored: a few codes, but on strips of a pixel."""
    scene = corner()
    scene.add(e3d.box(0.4), translation=(0.3, 0.2, 0.4))
    camera, pose = CAMERAS["perspective"]
    there = visible(scene, (camera, pose), radius=0.5).astype(int)
    mirrored = visible(scene, (camera, pose @ np.diag([-1.0, 1, 1, 1])), radius=0.5).astype(int)
    difference = np.abs(mirrored[:, ::-1] - there)
    assert np.median(difference) == 0 and (difference > 12).mean() < 0.015


def test_a_scaled_camera_does_not_change_the_radius():
    scene = corner()
    camera, pose = CAMERAS["orthographic"]
    whole = visible(scene, (camera, pose), radius=0.5)
    half = e3d.OrthographicCamera(camera.ymag * 2.0)
    scaled = visible(scene, (half, pose @ np.diag([0.5, 0.5, 0.5, 1.0])), radius=0.5)
    assert np.abs(scaled.astype(int) - whole).max() <= 3


def shelf(**values):
    """A wall, and small things that stand before it."""
    scene = white_scene()
    scene.add(e3d.box((24, 12, 0.1)), translation=(0, 6, -2.5))
    for x in (-1.8, -0.9, 0.0, 0.9, 1.8):
        thing = e3d.uv_sphere(0.25 + 0.05 * x)
        thing.materials = [e3d.Material(metallic=0.0, roughness=0.0, **values)]
        scene.add(thing, translation=(x, 0.5, -1.0 + 0.3 * x))
    return scene, (e3d.PerspectiveCamera(0.4), e3d.look_at((0, 1.2, 7), (0, 0.8, 0)))


def test_a_wall_far_behind_small_things_is_shaded_smoothly():
    """The radius is most of the picture, of which each site looks at ten places."""
    scene, view = shelf()
    shown = visible(scene, view, (640, 480), radius=3.0).astype(float)
    around = sum(np.roll(shown, shift, (0, 1)) for shift in ((8, 0), (-8, 0), (0, 8), (0, -8))) / 4
    above = np.s_[20:200, 20:-20]  # the wall above the things
    assert shown[above].min() < 200 and np.abs(shown - around)[above].mean() < 0.7


def test_what_lets_light_pass_hides_none():
    scene, view = shelf(transmission=1.0)
    bare = white_scene()
    bare.add(e3d.box((24, 12, 0.1)), translation=(0, 6, -2.5))
    assert set(np.unique(visible(bare, view, radius=3.0))) == {0, 255}
    with Renderer(SIZE, color_space="linear") as renderer:
        plain = renderer.render(scene, view).color
        asked = renderer.render(
            scene, view, ambient_occlusion=True, ambient_occlusion_radius=3.0
        ).color
    assert plain.tobytes() == asked.tobytes()


def test_blended_things_and_other_modes_have_none():
    scene = corner()
    plain = render(scene, CAMERAS["perspective"], size=(80, 60), mode="unlit").color
    asked = render(
        scene, CAMERAS["perspective"], size=(80, 60), mode="unlit", ambient_occlusion=True
    ).color
    assert plain.tobytes() == asked.tobytes()
    for node in list(scene.nodes):
        if isinstance(node.object, e3d.Mesh):
            node.object.materials = [e3d.Material(color=(1, 1, 1, 1.0), alpha_mode="blend")]
    assert visible(scene, CAMERAS["perspective"]).max() == 255
    shown = visible(scene, CAMERAS["perspective"])
    assert set(np.unique(shown)) <= {0, 255}


def test_the_same_for_all_samples_culling_and_batching():
    scene = corner()
    scene.add(e3d.box(0.4), translation=(0.3, 0.2, 0.4))
    options = e3d.RenderOptions(ambient_occlusion=True)
    with Renderer((120, 90), samples=4) as renderer:
        first = renderer.render(scene, CAMERAS["perspective"], options=options).color.tobytes()
        for other in ({"culling": "none"}, {"batching": False}, {"shading": "forward"}):
            changed = dataclasses.replace(options, **other)
            frame = renderer.render(scene, CAMERAS["perspective"], options=changed)
            assert frame.color.tobytes() == first


@pytest.mark.parametrize("wrong", [0.0, -1.0, float("nan"), float("inf"), "wide"])
def test_wrong_radii_are_refused(wrong):
    with pytest.raises(e3d.InvalidArgumentError, match="ambient_occlusion_radius"):
        e3d.RenderOptions(ambient_occlusion_radius=wrong)


def test_empty_scenes_and_odd_projections_are_drawn():
    empty = e3d.Scene()
    camera = e3d.PerspectiveCamera(), np.eye(4)
    assert not render(empty, camera, size=(9, 7), ambient_occlusion=True).color[..., :3].any()
    matrix = np.eye(4)
    matrix[0, 0] = 0.0
    odd = e3d.Camera(matrix), np.eye(4)
    render(corner(), odd, size=(9, 7), ambient_occlusion=True)
