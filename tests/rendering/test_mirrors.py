"""Mirrors: what they show is what stands mirrored behind a hole; depth, limits, warnings."""

import itertools
import warnings

import numpy as np
import pytest
from plain_picture import Renderer

import engine3d as e3d
from engine3d import linalg

UPRIGHT = linalg.rotation_x(np.pi / 2)  # a plane that faces +Z
REFLECTED = np.diag([1.0, 1.0, -1.0, 1.0])
SIZE = (256, 192)
CAMERA = e3d.PerspectiveCamera(0.8)
POSE = linalg.look_at((0.5, 0.9, 2.4), (0, 0.5, 0))


def matter(mesh, **material):
    mesh.materials = [e3d.Material(**material)]
    return mesh


def things():
    yield (
        matter(e3d.uv_sphere(0.3, (32, 16)), color=(220, 60, 40)),
        linalg.translation((-0.5, 0.3, 0.6)),
    )
    brushed = matter(e3d.box(0.4), color=(250, 200, 80), metallic=0.2, roughness=0.6)
    yield brushed, linalg.translation((0.4, 0.2, 0.5)) @ linalg.rotation_y(0.4)
    floor = matter(e3d.plane((3, 2), (6, 4)), color=(150, 160, 150))
    yield floor, linalg.translation((0, 0, 1.0))


def wall_with_hole():
    """Four boxes around a hole of 1.4 x 1.0 in the plane z = 0, which hide all that is behind."""
    dark = {"color": (60, 70, 90)}
    yield matter(e3d.box((3, 4, 0.02)), **dark), linalg.translation((-2.2, 0.6, 0.011))
    yield matter(e3d.box((3, 4, 0.02)), **dark), linalg.translation((2.2, 0.6, 0.011))
    yield matter(e3d.box((1.4, 3, 0.02)), **dark), linalg.translation((0, 2.6, 0.011))
    yield matter(e3d.box((1.4, 3, 0.02)), **dark), linalg.translation((0, -1.4, 0.011))


def room(surroundings, light=None):
    scene = e3d.Scene(**surroundings)
    for mesh, pose in (*things(), *wall_with_hole()):
        scene.add(mesh, pose=pose)
    if light is not None:
        scene.add(light)
    return scene


def mirrored_by(surroundings, light=None, **look):
    scene = room(surroundings, light)
    pane = matter(e3d.plane((1.4, 1.0)), **{"mirror": 1.0, **look})
    scene.add(pane, pose=linalg.translation((0, 0.6, 0)) @ UPRIGHT)
    return scene


def mirrored_behind(surroundings, light=None):
    """The same without a mirror: copies of all things stand behind the hole."""
    scene = room(surroundings, light)
    for mesh, pose in (*things(), *wall_with_hole()):
        scene.add(mesh, pose=REFLECTED @ pose)
    return scene


def draw(scene, size=SIZE, samples=1, antialiasing="ssaa", **options):
    with Renderer(size, samples=samples, antialiasing=antialiasing) as renderer:
        return renderer.render(scene, (CAMERA, POSE), **options)


#: Light that looks the same in the mirror: from all around, or along its plane.
SIDEWAYS = e3d.DirectionalLight((-0.5, -1.0, 0.0), intensity=np.pi)
FLAT = {"ambient": e3d.linear(1, 1, 1), "background": (40, 90, 160)}
LIT = {"ambient": e3d.linear(0.2, 0.2, 0.2), "background": (40, 90, 160)}


@pytest.mark.parametrize("light", [None, SIDEWAYS], ids=["ambient", "sun"])
@pytest.mark.parametrize("tone_mapping", ["none", "agx"])
def test_a_mirror_shows_what_stands_mirrored_behind_a_hole(light, tone_mapping):
    surroundings = FLAT if light is None else LIT
    mirror = draw(mirrored_by(surroundings, light), tone_mapping=tone_mapping).color
    behind = draw(mirrored_behind(surroundings, light), tone_mapping=tone_mapping).color
    without = draw(mirrored_by(surroundings, light), mirror_depth=0).color
    assert (mirror != without).any(axis=2).sum() > 4000
    differs = np.abs(mirror.astype(int) - behind).max(axis=2)
    assert (differs > 0).sum() <= 10  # pixels whose centres an edge passes within a rounding


@pytest.mark.parametrize(
    "camera",
    [
        e3d.OrthographicCamera(1.0),
        e3d.PerspectiveCamera(0.8, reversed_depth=True, znear=1e-3),
        e3d.IntrinsicsCamera(200, 200, 128, 96),
    ],
    ids=["orthographic", "reversed depth", "intrinsics"],
)
@pytest.mark.parametrize("options", [{}, {"culling": "always"}, {"shading": "forward"}])
def test_cameras_and_ways_of_drawing(camera, options):
    pictures = []
    for scene in (mirrored_by(LIT, SIDEWAYS), mirrored_behind(LIT, SIDEWAYS)):
        with Renderer(SIZE) as renderer:
            pictures.append(renderer.render(scene, (camera, POSE), **options).color)
    assert (pictures[0] != pictures[1]).any(axis=2).sum() <= 10


def test_a_far_plane_cuts_nothing_off_in_mirrors():
    near = e3d.PerspectiveCamera(0.8, zfar=2.6), POSE
    with Renderer(SIZE) as renderer:
        shown = renderer.render(mirrored_by(FLAT), near).color
        whole = renderer.render(mirrored_by(FLAT), (CAMERA, POSE)).color
    assert (shown == whole).all(axis=2).mean() > 0.9


def test_a_floor_mirrors():
    scene = e3d.Scene(ambient=e3d.linear(1, 1, 1), background=(0, 0, 255))
    scene.add(matter(e3d.plane((4, 4)), color=(0, 0, 0), mirror=1.0))
    scene.add(matter(e3d.box(1.0), color=(255, 0, 0)), translation=(0, 1.0, 0))
    camera = e3d.OrthographicCamera(2), linalg.look_at((0, 2, 3), (0, 0, 0))
    with Renderer((64, 64)) as renderer:
        color = renderer.render(scene, camera).color
    floor = color[34:44, 30:34]  # in front of the box, which hangs above: its image hangs below
    assert (floor == (255, 0, 0, 255)).all()
    assert (color[56, 30:34] == (0, 0, 255, 255)).all()  # the background, mirrored


def test_a_far_thing_takes_nothing_out_of_a_mirror():
    """What stands on a mirror is reflected down to it, however large the scene is."""
    camera = e3d.PerspectiveCamera(0.3), linalg.look_at((0, 0.3, 1), (0, 0, 0))
    pictures = []
    for far in (10.0, 1e5):
        scene = e3d.Scene(background=(0, 0, 0), ambient=e3d.linear(1, 1, 1))
        scene.add(matter(e3d.plane((4, 4)), color=(0, 0, 0), mirror=1.0))
        stands = matter(e3d.box(0.1), color=(255, 0, 0), unlit=True)
        scene.add(stands, translation=(0, 0.05, 0))
        scene.add(e3d.box(0.1), translation=(far, 0, 0))
        with Renderer((64, 64)) as renderer:
            pictures.append(renderer.render(scene, camera).color)
    assert np.array_equal(*pictures)


def test_a_mirror_far_from_the_origin_of_its_mesh_is_flat():
    """The rounding of coordinates that the pose takes back is the mirror's own."""
    turn = linalg.rotation_y(0.3) @ linalg.rotation_x(0.2) @ UPRIGHT
    pane, away = e3d.plane((1.4, 1.0)), np.array((9000.0, 5000.0, 7000.0))
    corners = linalg.transform_points(turn, pane.positions.astype(np.float64)) + away
    near = e3d.Mesh((corners - away).astype(np.float32), pane.faces)
    apart = e3d.Mesh(corners.astype(np.float32), pane.faces)
    shown = []
    for mesh, origin in ((near, np.zeros(3)), (apart, away)):
        scene = room(FLAT)
        scene.add(matter(mesh, color=(0, 0, 0), mirror=1.0), translation=(0, 0.6, 0) - origin)
        shown.append((draw(scene).color != draw(scene, mirror_depth=0).color).any(axis=2).sum())
    assert 0.95 * shown[0] < shown[1] < 1.05 * shown[0]


@pytest.mark.parametrize("background", [None, (90, 110, 150), "gradient", "sky"])
def test_what_lies_beyond(background):
    named = {"gradient": e3d.Gradient((255, 0, 0), (0, 0, 255)), "sky": e3d.Environment.sky()}
    scene = e3d.Scene(ambient=e3d.linear(1, 1, 1), background=named.get(background, background))
    scene.add(matter(e3d.plane((4, 4)), color=(0, 0, 0), mirror=1.0), pose=UPRIGHT)
    scene.add(e3d.box(0.1), translation=(0, 5, 5))
    with Renderer((40, 30)) as renderer:
        for mapping in ("none", "neutral", "aces", "agx"):
            frame = renderer.render(scene, (CAMERA, POSE), tone_mapping=mapping)
            seen = frame.color[15, 20].astype(int)
            if background is None:
                assert (seen == (0, 0, 0, 255)).all()
            elif isinstance(background, tuple):
                assert np.abs(seen[:3] - background).max() <= 1
            else:
                assert seen[:3].max() > 40


def test_mirrors_in_mirrors():
    scene = mirrored_by(LIT, SIDEWAYS)
    other = matter(e3d.plane((3, 3)), color=(0, 255, 0), mirror=0.9)
    scene.add(other, pose=linalg.translation((0, 0.6, 3.0)) @ linalg.rotation_x(-np.pi / 2))
    pictures = [draw(scene, mirror_depth=depth).color for depth in range(5)]
    changes = [(one != next).any(axis=2).sum() for one, next in itertools.pairwise(pictures)]
    assert changes[0] > changes[1] > changes[2] > 0
    assert (draw(scene).color == pictures[2]).all()  # by default


def test_a_mirror_seen_from_behind_shows_nothing():
    scene = e3d.Scene(ambient=e3d.linear(1, 1, 1))
    scene.add(matter(e3d.box(1.0), color=(200, 200, 200), mirror=1.0))
    scene.add(matter(e3d.box(0.3), color=(255, 0, 0)), translation=(0, 0, -2.0))
    with Renderer((32, 32)) as renderer:
        camera = CAMERA, linalg.look_at((0, 0, 3.0), (0, 0, 0))
        assert (renderer.render(scene, camera).color[..., 1:3] == 0)[8:24, 8:24].all()


def test_bytes_do_not_depend_on_history_or_threads():
    scene = mirrored_by(LIT, SIDEWAYS)
    poses = [linalg.look_at((x, 0.9, 2.4), (0, 0.5, 0)) for x in (0.5, -0.4, 1.2)]
    fresh = []
    for pose in poses:
        with Renderer((130, 70), threads=1) as renderer:
            fresh.append(renderer.render(scene, (CAMERA, pose), ambient_occlusion=True).color)
    with Renderer((130, 70), threads=3) as renderer:
        for _ in range(2):
            for pose, color in zip(poses, fresh, strict=True):
                kept = renderer.render(scene, (CAMERA, pose), ambient_occlusion=True).color
                assert np.array_equal(kept, color)


@pytest.mark.parametrize(
    "how", [{"samples": 4}, {"samples": 4, "antialiasing": "msaa"}], ids=["ssaa", "msaa"]
)
def test_samples_smooth_reflections(how):
    scene = mirrored_by(FLAT)
    rough = draw(mirrored_by(FLAT)).color
    smooth = draw(scene, **how).color
    behind = draw(mirrored_behind(FLAT), **how).color
    error = np.abs(smooth.astype(int) - behind)
    assert error.mean() < 0.5 * np.abs(rough.astype(int) - behind).mean()
    if "antialiasing" not in how:
        assert (error.max(axis=2) > 1).mean() < 0.001


def test_without_mirrors_nothing_is_planned():
    assert "reflects" not in draw(room(LIT)).stats["plan"]
    assert "reflects" in draw(mirrored_by(LIT)).stats["plan"]
    assert "reflects" not in draw(mirrored_by(LIT), mode="unlit").stats["plan"]
    assert "reflects" not in draw(mirrored_by(LIT), mirror_depth=0).stats["plan"]


def test_what_is_left_out_is_said():
    scene = e3d.Scene()
    scene.add(matter(e3d.uv_sphere(), name="chrome", mirror=1.0))
    with pytest.warns(e3d.errors.Engine3DWarning, match="not flat .*materials: chrome"):
        draw(scene, size=(16, 16))
    scene = e3d.Scene()
    for k in range(10):
        scene.add(matter(e3d.plane(), mirror=1.0), translation=(0, -k * 0.1, 0))
    with pytest.warns(e3d.errors.Engine3DWarning, match="8 mirrors, not 10"):
        draw(scene, size=(16, 16))
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        draw(mirrored_by(LIT), size=(16, 16))


def beside_mirrors(count):
    """A mirror that shows red, and smaller ones elsewhere: out of the picture, or in its corner."""
    scene = e3d.Scene(background=(0, 0, 0), ambient=e3d.linear(1, 1, 1))
    for k, x in enumerate([100.0, -2.5][:count] * 9):
        scene.add(matter(e3d.plane((0.2, 0.2)), mirror=1.0), pose=facing(x, 2.0, -0.1 * k))
    scene.add(matter(e3d.plane((1, 1)), color=(0, 0, 0), mirror=1.0), pose=facing(0, 0, -9.0))
    behind = matter(e3d.plane((9, 9)), color=(255, 0, 0), unlit=True)
    scene.add(behind, pose=facing(0, 0, 6.0) @ linalg.rotation_x(np.pi))
    return scene


def facing(x, y, z):
    return linalg.translation((x, y, z)) @ UPRIGHT


AHEAD = e3d.PerspectiveCamera(0.9), linalg.look_at((0, 0, 5), (0, 0, 0))


def test_mirrors_out_of_the_picture_do_not_count():
    with warnings.catch_warnings(), Renderer((64, 48)) as renderer:
        warnings.simplefilter("error")
        color = renderer.render(beside_mirrors(1), AHEAD).color
    assert (color[24, 32] == (255, 0, 0, 255)).all()


def test_of_too_many_mirrors_the_largest_show():
    with Renderer((640, 480)) as renderer, pytest.warns(e3d.errors.Engine3DWarning, match="not 10"):
        color = renderer.render(beside_mirrors(2), AHEAD).color
    assert (color[240, 320] == (255, 0, 0, 255)).all()


@pytest.mark.parametrize("camera", [CAMERA, e3d.FisheyeCamera(20, 20, 32, 24)])
def test_what_is_left_out_is_said_once(camera):
    """Also by the views in mirrors, and by all faces of a lens."""
    scene = e3d.Scene()
    for k in range(10):
        scene.add(matter(e3d.plane(), mirror=1.0), translation=(0, -k * 0.1, 0))
        scene.add(matter(e3d.plane(), mirror=1.0), pose=facing(0, 1, -k * 0.1))
    scene.add(matter(e3d.uv_sphere(), name="chrome", mirror=1.0))
    with warnings.catch_warnings(record=True) as told, Renderer((64, 48)) as renderer:
        warnings.simplefilter("always")
        renderer.render(scene, (camera, POSE), mirror_depth=3)
        renderer.render(scene, (camera, POSE))
    assert sum("8 mirrors, not" in str(one.message) for one in told) == 1
    assert sum("chrome" in str(one.message) for one in told) == 1


def test_a_mirror_of_too_many_samples_is_left_out_and_said(monkeypatch):
    monkeypatch.setattr("engine3d.rendering.passes.mirrors.MAX_SIZE", 60)
    without = draw(mirrored_by(LIT, mirror=0.0), size=(64, 64)).color
    with pytest.warns(e3d.errors.Engine3DWarning, match="64x64 samples .*Material.mirror: .* 60 a"):
        assert np.array_equal(draw(mirrored_by(LIT), size=(64, 64)).color, without)


def test_an_animated_mirror_follows():
    scene = mirrored_by(LIT, SIDEWAYS)
    pane = scene.nodes[-1]
    with Renderer((96, 64)) as renderer:
        for angle in (0.0, 0.1, 0.2):
            pane.pose = linalg.translation((0, 0.6, 0)) @ linalg.rotation_y(angle) @ UPRIGHT
            pane.object.materials[0].mirror = 1.0 - angle
            kept = renderer.render(scene, (CAMERA, POSE)).color
            assert np.array_equal(kept, draw(scene, size=(96, 64)).color)


def test_the_outputs_of_a_mirror_are_its_own():
    names = ("depth", "object_id", "normal", "albedo")
    frame = draw(mirrored_by(LIT), outputs=names)
    without = draw(mirrored_by(LIT, mirror=0.0), outputs=names)
    for name in names:
        assert np.array_equal(getattr(frame, name), getattr(without, name))


def test_size_units_and_lines_in_mirrors():
    scene = mirrored_by(LIT)
    scene.add(e3d.Mesh([(-0.6, 1.0, 0.5), (0.6, 1.0, 0.5)], lines=[(0, 1)]))
    for unit in ("pixels", "picture"):
        wide = draw(scene, line_width=8.0, size_unit=unit).color
        thin = draw(scene, line_width=1.0, size_unit=unit).color
        assert (wide != thin).any()
