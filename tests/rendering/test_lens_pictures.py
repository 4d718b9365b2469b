"""Pictures through lenses: against rays through the pixels, against pinholes, on all backends."""

import math
import warnings

import numpy as np
import pytest

import engine3d as e3d
from engine3d import linalg

SIZE = (160, 120)
IDS = ("object_id", "instance_id", "face_id")
LENSES = {
    "fisheye": e3d.FisheyeCamera(42, 42, 80, 60, (-0.01, 0.0, 0.0, 0.0), max_angle=1.9),
    "barrel": e3d.BrownConradyCamera(90, 90, 80, 60, (-0.25, 0.06, 0.002, -0.001)),
    "double sphere": e3d.DoubleSphereCamera(50, 50, 80, 60, -0.2, 0.6, znear=1e-3, zfar=math.inf),
    "equirectangular": e3d.EquirectangularCamera(),
    "cylindrical": e3d.CylindricalCamera(xfov=5.0, yfov=1.6),
}
POSE = e3d.look_at((0.1, 0.2, 0.3), (0.4, 0.0, -3.0), (0.1, 1.0, 0.0))


def things(seed=0, count=40):
    """A scene of shapes all around, near and far, one of them many times."""
    rng = np.random.default_rng(seed)
    scene = e3d.Scene(background=(30, 60, 90), ambient=(0.3, 0.3, 0.3))
    scene.add(e3d.DirectionalLight(direction=(0.3, -1.0, -0.4)))
    shapes = [e3d.box(), e3d.uv_sphere(0.5), e3d.torus(0.5, 0.2), e3d.cylinder(0.3, 1.0)]
    for number in range(count):
        way = rng.normal(size=3)
        place = way / np.linalg.norm(way) * rng.uniform(1.5, 6.0)
        rotation = rng.normal(size=4)
        mesh = shapes[number % len(shapes)]
        scene.add(mesh, translation=place, rotation=rotation / np.linalg.norm(rotation), scale=0.7)
    poses = np.column_stack([rng.uniform(-5, 5, (30, 3)), rng.uniform(0.1, 0.3, 30)])
    scene.add(e3d.InstancedMesh(e3d.box(), poses))
    return scene


def rays_of(camera, pose, size=SIZE):
    grid = np.meshgrid(np.arange(size[0]) + 0.5, np.arange(size[1]) + 0.5)
    rays = camera.rays(np.stack(grid, axis=-1).reshape(-1, 2), size)
    return rays, linalg.transform_directions(pose, rays)


def differing(scene, camera, pose, size=SIZE, **options):
    """The share of pixels whose identities are not those of their rays, and the greatest error
    of depth of the others."""
    frame = e3d.render(
        scene, (camera, pose), size=size, look="plain", outputs=(*IDS, "depth"), **options
    )
    rays, ways = rays_of(camera, pose, size)
    seen = np.isfinite(rays[:, 0])
    hits = scene.raycast_many(pose[:3, 3], ways[seen])
    wrong = np.zeros(seen.sum(), bool)
    for name in IDS:
        wrong |= getattr(frame, name).reshape(-1)[seen] != getattr(hits, name)
    away = np.where(np.isfinite(hits.distance), hits.distance, 0.0)
    if camera.depth_along == "axis":
        away = away * -rays[seen][:, 2]
    depth = frame.depth.reshape(-1)[seen]
    for name in IDS:
        assert (getattr(frame, name).reshape(-1)[~seen] == -1).all()
    assert not frame.depth.reshape(-1)[~seen].any()
    return wrong.mean(), np.abs(depth - away)[~wrong].max()


@pytest.mark.parametrize("lens", LENSES)
@pytest.mark.parametrize("seed", range(2))
def test_identities_are_those_of_rays(lens, seed):
    wrong, error = differing(things(seed), LENSES[lens], POSE)
    assert wrong <= 2e-4
    assert error < 1e-5


def test_fine_meshes_are_those_of_rays():
    scene = e3d.Scene()
    scene.add(e3d.uv_sphere(1.0, (120, 80)), translation=(0, 0, -2.5))
    scene.add(e3d.torus(2.0, 0.05), translation=(0, 0, -3))
    for lens in ("fisheye", "barrel"):
        wrong, _ = differing(scene, LENSES[lens], np.eye(4))
        assert wrong <= 5e-4


@pytest.mark.parametrize("lens", ["fisheye", "barrel"])
def test_every_backend_and_number_of_threads_gives_the_same_bytes(lens):
    scene, outputs = things(count=16), ("color", "depth", *IDS, "normal", "barycentric")
    found = set()
    for backend in e3d.backends():
        for threads in (1, 3):
            with e3d.Renderer(
                (96, 72), look="plain", backend=backend, threads=threads, samples=4
            ) as renderer:
                camera = LENSES[lens]
                frame = renderer.render(scene, (camera, POSE), outputs=outputs)
                again = renderer.render(scene, (camera, POSE), outputs=outputs)
                found |= {
                    tuple(getattr(one, name).tobytes() for name in outputs)
                    for one in (frame, again)
                }
    assert len(found) == 1


def test_no_output_changes_another():
    scene, camera = things(), LENSES["fisheye"]
    names = ("color", "depth", *IDS, "normal", "barycentric", "position", "uv", "albedo")
    every = e3d.render(scene, (camera, POSE), size=SIZE, look="plain", outputs=names)
    for name in names:
        alone = e3d.render(scene, (camera, POSE), size=SIZE, look="plain", outputs=(name,))
        assert getattr(alone, name).tobytes() == getattr(every, name).tobytes(), name


def test_without_distortion_the_picture_is_a_pinholes():
    scene, outputs = things(), ("color", "depth", *IDS, "normal", "uv")
    lens, pinhole = e3d.BrownConradyCamera(90, 90, 81.3, 59), e3d.IntrinsicsCamera(90, 90, 81.3, 59)
    one, two = (
        e3d.render(scene, (camera, POSE), size=SIZE, look="plain", outputs=outputs)
        for camera in (lens, pinhole)
    )
    for name in ("color", *IDS):
        differ = getattr(one, name) != getattr(two, name)
        assert differ.mean() < 1e-3, name
    same = one.face_id == two.face_id
    np.testing.assert_allclose(one.depth[same], two.depth[same], rtol=2e-3)
    np.testing.assert_allclose(one.normal[same], two.normal[same], atol=1e-5)


def test_a_lens_shows_what_remapping_a_pinhole_shows():
    cv2 = pytest.importorskip("cv2", exc_type=ImportError)
    scene, camera = things(), LENSES["barrel"]
    frame = e3d.render(scene, (camera, POSE), size=SIZE, look="plain")
    fine = e3d.IntrinsicsCamera(360, 360, 480, 360)
    wide = e3d.render(scene, (fine, POSE), size=(960, 720), look="plain")
    places = fine.project(rays_of(camera, POSE)[0]).reshape(*SIZE[::-1], 2).astype(np.float32)
    small = cv2.remap(
        cv2.blur(wide.color, (4, 4)), places[..., 0] - 0.5, places[..., 1] - 0.5, cv2.INTER_LINEAR
    )
    differ = np.abs(frame.color.astype(int) - small.astype(int))[..., :3]
    assert differ.mean() < 3.0


def test_values_are_in_the_axes_of_the_camera():
    scene, camera = things(), LENSES["fisheye"]
    outputs = ("normal", "world_normal", "position", "world_position", "object_id")
    frame = e3d.render(scene, (camera, POSE), size=SIZE, look="plain", outputs=outputs)
    shown = frame.object_id >= 0
    turned = linalg.transform_directions(POSE, frame.normal[shown])
    np.testing.assert_allclose(turned, frame.world_normal[shown], atol=1e-5)
    moved = linalg.transform_points(POSE, frame.position[shown])
    np.testing.assert_allclose(moved, frame.world_position[shown], atol=1e-5)
    places, _ = frame.project(frame.world_position[shown])
    rows, columns = np.nonzero(shown)
    np.testing.assert_allclose(places, np.stack([columns, rows], axis=-1) + 0.5, atol=1e-3)
    for name in ("normal", "position"):
        assert not getattr(frame, name)[~shown].any()


def test_the_rays_of_a_frame_lead_back():
    scene = things()
    for camera in (LENSES["fisheye"], e3d.PerspectiveCamera(1.0), e3d.OrthographicCamera(2.0)):
        frame = e3d.render(scene, (camera, POSE), size=SIZE, look="plain")
        places = np.array([(80.5, 60.5), (70.25, 40.0)])
        origins, ways = frame.rays(places)
        back, _ = frame.project(origins + 3.0 * ways)
        np.testing.assert_allclose(back, places, atol=1e-9)


def test_picks_are_those_of_the_picture():
    scene, camera = things(), LENSES["fisheye"]
    for outputs in (("color",), IDS):
        frame = e3d.render(scene, (camera, POSE), size=SIZE, look="plain", outputs=outputs)
        ids = e3d.render(scene, (camera, POSE), size=SIZE, look="plain", outputs=("object_id",))
        for y in range(5, 120, 23):
            for x in range(5, 160, 19):
                hit = scene.pick(frame, x, y)
                assert (-1 if hit is None else hit.object_id) == ids.object_id[y, x]


def test_what_the_lens_does_not_see_is_black_or_transparent():
    scene, camera = things(), LENSES["fisheye"]
    outside = ~camera.mask(SIZE)
    assert outside.any()
    frame = e3d.render(scene, (camera, POSE), size=SIZE, look="plain")
    assert (frame.color[outside] == (0, 0, 0, 255)).all()
    scene.background = None
    frame = e3d.render(scene, (camera, POSE), size=SIZE, look="plain")
    assert not frame.color[outside].any()
    assert set(np.unique(frame.color[~outside][:, 3])) >= {0, 255}


def test_a_gradient_goes_with_the_rows():
    scene = e3d.Scene(background=e3d.Gradient((255, 0, 0), (0, 0, 255)))
    lens = e3d.render(scene, (LENSES["equirectangular"], POSE), size=SIZE)
    pinhole = e3d.render(scene, (e3d.PerspectiveCamera(), POSE), size=SIZE)
    assert lens.color.tobytes() == pinhole.color.tobytes()


def test_a_plain_background_has_its_bytes():
    scene = e3d.Scene(background=(12, 200, 77))
    frame = e3d.render(scene, (LENSES["equirectangular"], POSE), size=SIZE)
    assert (frame.color == (12, 200, 77, 255)).all()


def test_an_environment_has_no_seams():
    pixels = np.linspace(0.1, 0.9, 64)[:, np.newaxis, np.newaxis] * np.ones((64, 128, 3))
    scene = e3d.Scene(background=e3d.Environment(pixels))
    frame = e3d.render(scene, (e3d.EquirectangularCamera(), np.eye(4)), size=(256, 128))
    rows = frame.color[..., 0].astype(int)
    assert (np.ptp(rows, axis=1) <= 3).all()
    assert np.abs(np.diff(rows[:, 0])).max() <= 6


def test_modes_show_the_lenss_own_values():
    scene, camera = things(), LENSES["fisheye"]
    frame = e3d.render(
        scene, (camera, POSE), size=SIZE, look="plain", mode="normal", outputs=("color", "normal")
    )
    shown = np.abs(frame.normal).sum(axis=-1) > 0
    colors = np.rint(255 * (frame.normal[shown] * 0.5 + 0.5))
    assert np.abs(frame.color[shown][:, :3] - colors).max() <= 1
    depth = e3d.render(
        scene, (camera, POSE), size=SIZE, look="plain", mode="depth", outputs=("color", "depth")
    )
    near, far = depth.depth[shown].argmin(), depth.depth[shown].argmax()
    assert depth.color[shown][near, 0] > depth.color[shown][far, 0]


def test_masks_lines_and_points_are_drawn():
    scene = e3d.Scene(background=(0, 0, 0), ambient=(1, 1, 1))
    holes = np.full((8, 8, 4), 255, np.uint8)
    holes[::2, ::2, 3] = 0
    cut = e3d.Material(
        texture=e3d.Texture(holes, filter="nearest"), alpha_mode="mask", two_sided=True
    )
    leaf = e3d.plane(2, 2)
    leaf.materials[:] = [cut]
    upright = linalg.quaternion_from_axis_angle((1, 0, 0), math.pi / 2)
    scene.add(leaf, translation=(0, 0, -1.5), rotation=upright)
    behind = scene.add(e3d.box((8, 8, 0.1)), translation=(0, 0, -4))
    line = e3d.Mesh([(-2, 1, -2), (2, 1, -2)], np.zeros((0, 3), int), lines=[(0, 1)])
    drawn = scene.add(line)
    camera = e3d.FisheyeCamera(60, 60, 80, 60)
    frame = e3d.render(
        scene, (camera, np.eye(4)), size=SIZE, look="plain", outputs=IDS, line_width=3
    )
    ids = frame.object_id[30:90, 50:110]
    assert (ids == behind.id).any()  # through the holes
    assert (ids == 0).any()
    assert (frame.object_id == drawn.id).any()
    assert (frame.face_id[frame.object_id == drawn.id] == -1).all()


def test_a_frame_is_drawn_again():
    scene, camera = things(), LENSES["barrel"]
    with e3d.Renderer(SIZE, look="plain") as renderer:
        first = renderer.render(scene, (camera, POSE), outputs=("color", "depth"))
        before = first.color.tobytes(), first.depth.tobytes()
        renderer.render(scene, (LENSES["equirectangular"], POSE), out=first)
        assert first.color.tobytes() != before[0]
        renderer.render(scene, (camera, POSE), out=first)
        assert (first.color.tobytes(), first.depth.tobytes()) == before
        renderer.resize((64, 48))
        assert renderer.render(scene, (camera, POSE)).size == (64, 48)
        assert first.stats["lens_faces"] == 1


def test_a_node_holds_a_lens():
    scene = things()
    scene.add(LENSES["fisheye"], pose=POSE)
    node = e3d.render(scene, size=SIZE, look="plain")
    given = e3d.render(scene, (LENSES["fisheye"], POSE), size=SIZE, look="plain")
    assert node.color.tobytes() == given.color.tobytes()


def test_bloom_and_mirrors_and_glass_are_drawn():
    scene = things(count=12)
    glow = e3d.uv_sphere(0.4)
    glow.materials[0].emissive = e3d.linear(6, 5, 4)
    scene.add(glow, translation=(0, 0, -2))
    plain = e3d.render(scene, (LENSES["fisheye"], np.eye(4)), size=SIZE, look="plain")
    bloom = e3d.render(scene, (LENSES["fisheye"], np.eye(4)), size=SIZE, look="plain", bloom=1.0)
    assert (bloom.color.astype(int) >= plain.color.astype(int)).all()
    assert bloom.color.sum() > plain.color.sum()


@pytest.mark.parametrize("lens", ["fisheye", "equirectangular"])
def test_mirrors_show_a_gradient(lens):
    """As those of a pinhole do: R215."""
    scene = e3d.Scene(background=e3d.Gradient((200,) * 3, (200,) * 3), ambient=(0.0, 0.0, 0.0))
    scene.add(e3d.DirectionalLight((0, 1, 0), intensity=1e-9))
    mirror = e3d.box((2, 2, 0.1))
    mirror.materials = [e3d.Material(color=(0, 0, 0), mirror=1.0)]
    scene.add(mirror, translation=(0, 0, -2))
    width, height = SIZE
    frame = e3d.render(scene, (LENSES[lens], np.eye(4)), size=SIZE, look="plain")
    off = np.abs(frame.color[height // 2, width // 2, :3].astype(int) - 200)
    assert off.max() <= 1


def test_coloured_glass_before_a_gradient_is_told_of():
    scene = e3d.Scene(background=e3d.Gradient((200,) * 3, (100,) * 3))
    glass = e3d.box((2, 2, 0.1))
    held = {"metallic": 0.0, "roughness": 0.0, "transmission": 1.0}
    glass.materials = [e3d.Material(color=(255, 0, 0), **held)]
    scene.add(glass, translation=(0, 0, -2))
    with pytest.warns(e3d.Engine3DWarning, match="without the glass's colour"):
        e3d.render(scene, (LENSES["fisheye"], np.eye(4)), size=SIZE, look="plain")


def test_what_is_not_drawn_is_named():
    scene = things(count=4)
    scene.fog = e3d.Fog((200, 200, 200), 1.0, 8.0)
    with pytest.warns(e3d.Engine3DWarning, match="fog"):
        e3d.render(scene, (LENSES["equirectangular"], POSE), size=SIZE, look="plain")
    scene.fog = None
    glass = e3d.uv_sphere(0.3)
    glass.materials[:] = [e3d.Material(metallic=0, roughness=0, transmission=1.0, thickness=0.3)]
    bent = scene.add(glass, translation=(0, 0, -1.5))
    with e3d.Renderer(SIZE, look="plain") as renderer:
        with pytest.warns(e3d.Engine3DWarning, match="glass"):
            renderer.render(scene, (LENSES["fisheye"], np.eye(4)))
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            renderer.render(scene, (LENSES["fisheye"], np.eye(4)))  # once
            renderer.render(scene, (LENSES["barrel"], np.eye(4)))  # one face has no borders
            renderer.render(scene, (LENSES["fisheye"], np.eye(4)), refraction=False)
    scene.remove(bent)
    with pytest.warns(e3d.Engine3DWarning, match="ambient occlusion"):
        e3d.render(
            scene, (LENSES["fisheye"], POSE), size=SIZE, look="plain", ambient_occlusion=True
        )
    turning = e3d.FisheyeCamera(60, 60, 80, 60, (-0.2, 0.0, 0.0, 0.0))
    with pytest.warns(e3d.Engine3DWarning, match="no inverse.*turns back at"):
        e3d.render(scene, (turning, POSE), size=SIZE, look="plain")


def test_what_no_lens_has_is_refused():
    scene, camera = things(count=2), LENSES["fisheye"]
    with pytest.raises(e3d.InvalidArgumentError, match="ndc_depth"):
        e3d.render(scene, (camera, POSE), size=SIZE, look="plain", outputs=("ndc_depth",))
    with pytest.raises(e3d.InvalidArgumentError, match="frustum"):
        e3d.render(scene, size=SIZE, look="plain", culling_camera=(camera, POSE))


def test_a_lens_may_see_nothing():
    scene = things(count=3)
    scene.background = e3d.Gradient((255, 0, 0), (0, 0, 255))
    away = e3d.FisheyeCamera(10, 10, 9000, 9000, max_angle=0.5)
    frame = e3d.render(scene, (away, POSE), size=SIZE, outputs=("color", *IDS, "depth", "normal"))
    assert (frame.color == (0, 0, 0, 255)).all()
    assert (frame.object_id == -1).all()
    assert not frame.depth.any()
    assert frame.stats["pixels_shaded"] >= 0


@pytest.mark.parametrize("size", [(1, 1), (3, 200), (300, 2)])
def test_sizes_of_every_kind(size):
    for camera in LENSES.values():
        frame = e3d.render(things(count=4), (camera, POSE), size=size, look="plain")
        assert frame.size == size


@pytest.mark.parametrize("number", range(12))
def test_lenses_without_measure_draw_or_refuse(number):
    rng = np.random.default_rng(number)
    f, c = 10.0 ** rng.uniform(-2, 4, 2), rng.uniform(-300, 300, 2)
    camera = [
        lambda: e3d.FisheyeCamera(*f, *c, rng.normal(size=4)),
        lambda: e3d.BrownConradyCamera(*f, *c, rng.normal(size=[4, 5, 8, 12][number % 4])),
        lambda: e3d.DoubleSphereCamera(*f, *c, rng.uniform(-0.9, 0.9), rng.uniform(0, 1)),
    ][number % 3]()
    with np.errstate(all="raise", under="ignore"), pytest.MonkeyPatch.context():
        frame = _quietly(lambda: e3d.render(things(count=3), (camera, POSE), size=(40, 30)))
    assert frame.color.shape == (30, 40, 4)


def _quietly(draw):
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        return draw()


@pytest.mark.parametrize("k1", [-2.0, -0.5, -0.45])
def test_the_share_of_blind_pixels_is_a_plain_number(k1):
    lens = e3d.BrownConradyCamera(60.0, 60.0, 32.0, 24.0, (k1, 0, 0, 0))
    with pytest.warns(e3d.Engine3DWarning, match=r": \d+(\.\d+)?% of the pixels of 64x48") as told:
        e3d.Renderer((64, 48)).render(e3d.Scene(), (lens, np.eye(4)))
    share = float(str(told[0].message).split(": ")[1].split("%")[0])
    assert abs(share - 100 * (~lens.mask((64, 48))).mean()) <= 0.5
