"""Culling leaves out what nobody sees and nothing else: every output, with it and without."""

import numpy as np
import pytest
from plain_picture import Renderer

import engine3d as e3d

OUTPUTS = ("color", "depth", "ndc_depth", "object_id", "instance_id", "face_id", "barycentric")
EYES = [(0.5, 0.3, 9), (6, 5, 7), (0.2, 0.1, 0.4), (-3, 0, -2), (0, 14, 0.1)]


def crowd():
    """Spheres in a grid, walls between them, lines and points at the picture's edge."""
    scene = e3d.Scene(background=(10, 20, 30))
    axis = np.arange(-2.0, 2.5)
    places = np.stack(np.meshgrid(axis, axis, axis), -1).reshape(-1, 3)
    poses = np.c_[places, np.full(len(places), 0.45)].astype(np.float32)
    scene.add(e3d.InstancedMesh(e3d.uv_sphere(1.0, (24, 16)), poses))
    for x in (-1.5, 1.5):
        scene.add(e3d.box((0.05, 4, 4)), translation=(x, 0, 0))
    corners = np.float32([[-9, 0, 0], [9, 0.1, 0], [0, -9, 0], [0, 9, 0]])
    scene.add(e3d.Mesh(corners, np.empty((0, 3), int), lines=[[0, 1], [2, 3]], points=[0, 1, 2, 3]))
    return scene


def pictures(renderer, scene, eye, **options):
    camera = e3d.PerspectiveCamera(yfov=0.9, znear=0.05, zfar=60)
    pose = e3d.look_at(eye, (0, 0, 0), (0, 1, 0.01))
    frame = renderer.render(
        scene, (camera, pose), outputs=OUTPUTS, line_width=9, point_size=30, **options
    )
    return frame.stats, [getattr(frame, name).tobytes() for name in OUTPUTS]


@pytest.mark.parametrize("samples", [1, 4])
@pytest.mark.parametrize("threads", [1, 2, 3])
def test_no_culling_changes_a_byte(samples, threads):
    scene = crowd()
    with Renderer((200, 150), threads=threads, samples=samples) as renderer:
        for eye in EYES:
            stats, expected = pictures(renderer, scene, eye, culling="none")
            assert stats["clusters_culled"] == stats["clusters_occluded"] == 0
            for culling in ("tree", "frustum", "all", "always", "always"):  # the last remembers
                stats, got = pictures(renderer, scene, eye, culling=culling)
                assert got == expected, culling
                assert (stats["rounds"] > 1) >= (culling == "always")


def test_a_turning_camera_loses_nothing():
    """What the last frame showed is drawn first, and is not what this one shows."""
    scene = crowd()
    with Renderer((160, 120)) as renderer:
        for angle in np.linspace(0, 6, 25):
            eye = (5 * np.sin(angle), np.cos(3 * angle), 5 * np.cos(angle))
            _, expected = pictures(renderer, scene, eye, culling="none")
            assert pictures(renderer, scene, eye, culling="always")[1] == expected


@pytest.mark.parametrize("threads", [1, 2])
def test_tiles_that_are_drawn_twice(threads):
    """Most tiles are finished with what the last frame showed; to which more comes count once."""
    scene = e3d.Scene(background=(10, 20, 30))
    axis = np.arange(-4.0, 4.5)
    places = np.stack(np.meshgrid(axis, axis, axis), -1).reshape(-1, 3)
    scene.add(e3d.InstancedMesh(e3d.uv_sphere(0.3, (24, 16)), np.c_[places, np.ones(len(places))]))
    door = scene.add(e3d.primitives.quad(), translation=(1, 0, 6), scale=2)
    eyes = [(0.5, 0.5, 9)] * 4 + [(0.52, 0.5, 8.9), (0.54, 0.51, 8.8), (9, 0.5, 0.5), (9, 0.5, 0.6)]
    with Renderer((520, 390), threads=threads) as renderer:
        for number, eye in enumerate(eyes):
            door.visible = number % 3 != 2  # it hides much, and then no more
            stats, got = pictures(renderer, scene, eye, culling="always")
            everything, expected = pictures(renderer, scene, eye, culling="none")
            assert got == expected, number
            assert stats["pixels_shaded"] == everything["pixels_shaded"] > 0
            assert stats["rounds"] == (2 if number else 5)


def test_what_is_hidden_is_left_out():
    """Behind a wall that fills the view almost nothing is set up."""
    scene = crowd()
    scene.add(e3d.primitives.quad(), translation=(0, 0, 5), scale=40)
    with Renderer((320, 240)) as renderer:
        stats, _ = pictures(renderer, scene, EYES[0], culling="none")
        for _ in range(2):
            fewer, _ = pictures(renderer, scene, EYES[0], culling="always")
        assert fewer["clusters_occluded"] > 0.9 * stats["clusters"]
        assert fewer["triangles_setup"] < 0.05 * stats["triangles_setup"]


def test_equal_depths_go_to_the_first_in_order():
    """What was not there last time lies in one plane with what is drawn first, and wins."""
    scene = e3d.Scene()
    first = scene.add(e3d.primitives.quad(), scale=0.7)
    places = np.stack(np.meshgrid(*[np.linspace(-3, 3, 7)] * 2), -1).reshape(-1, 2)
    poses = np.c_[places, np.zeros(len(places)), np.full(len(places), 1)].astype(np.float32)
    scene.add(e3d.InstancedMesh(e3d.primitives.quad(), poses))
    rng = np.random.default_rng(0)
    with Renderer((160, 120)) as renderer:
        for _ in range(40):
            camera = e3d.PerspectiveCamera(yfov=0.8, znear=rng.uniform(0.01, 1), zfar=50)
            view = camera, e3d.look_at((0, 0, rng.uniform(2, 9)), (0, 0, 0), (0, 1, 0))
            for first.visible in (False, True):
                frame = renderer.render(scene, view, outputs=("object_id",), culling="always")
            assert frame.stats["rounds"] == 2
            expected = renderer.render(scene, view, outputs=("object_id",), culling="none")
            assert np.array_equal(frame.object_id, expected.object_id)
            assert (frame.object_id == first.id).any()


def test_culling_camera_leaves_out_what_is_not_in_its_frustum():
    scene = e3d.Scene()
    seen = scene.add(e3d.icosphere(), translation=(0, 0, -6))
    scene.add(e3d.icosphere(), translation=(0, 0, 6))
    above = e3d.PerspectiveCamera(yfov=1.0), e3d.look_at((0, 25, 0.1), (0, 0, 0), (0, 1, 0))
    ahead = e3d.PerspectiveCamera(yfov=1.0), e3d.look_at((0, 0, 0), (0, 0, -1), (0, 1, 0))
    with Renderer((100, 100)) as renderer:
        everything = renderer.render(scene, above, outputs=("object_id",)).object_id
        frozen = renderer.render(scene, above, outputs=("object_id",), culling_camera=ahead)
    assert len(np.unique(everything)) == 3
    assert np.array_equal(frozen.object_id, np.where(everything == seen.id, seen.id, -1))


# ---- clusters that face away ----


def compare(renderer, scene, view, **options):
    """All ways to cull give the same bytes; returns how many clusters are left out one by one."""
    frames = {}
    for culling in ("none", "tree", "frustum", "all", "always", "always"):
        frame = renderer.render(scene, view, outputs=OUTPUTS, culling=culling, **options)
        frames[culling] = [getattr(frame, name).tobytes() for name in OUTPUTS], frame.stats
        assert frames[culling][0] == frames["none"][0], culling
    return frames["all"][1]["clusters_culled"]


def random_rotation(rng):
    quaternion = rng.normal(size=4)
    return np.asarray(e3d.linalg.quaternion_to_matrix(quaternion))[:3, :3]


def relief(rng, side, height):
    """A square of two units with bumps: open, so that nothing hides the faces that look away."""
    x, y = np.meshgrid(*[np.linspace(-1, 1, side)] * 2)
    at = np.arange(side * side).reshape(side, side)
    a, b, c, d = at[:-1, :-1], at[:-1, 1:], at[1:, 1:], at[1:, :-1]
    faces = np.concatenate([np.stack(t, -1).reshape(-1, 3) for t in ((a, b, c), (a, c, d))])
    return e3d.Mesh(np.stack([x, y, rng.normal(0, height, x.shape)], -1).reshape(-1, 3), faces)


def cloud(rng, unit, centre):
    """Spheres and reliefs of all sizes from less than a sample on, turned, stretched, mirrored."""
    scene = e3d.Scene()
    at = np.eye(4)
    at[:3, 3] = centre
    for mesh in (e3d.uv_sphere(1.0, (24, 16)), relief(rng, 20, 0.02), relief(rng, 9, 0.5)):
        poses = np.tile(np.eye(4), (40, 1, 1))
        for pose in poses:
            sizes = unit * 10 ** rng.uniform(-3.5, 0) * rng.uniform(0.2, 1, 3)
            pose[:3, :3] = random_rotation(rng) * (sizes * rng.choice([-1, 1], 3))
            pose[:3, 3] = unit * rng.normal(0, 1.5, 3)
        scene.add(e3d.InstancedMesh(mesh, poses.astype(np.float32)), pose=at)
    two = [e3d.Material(color=(1, 0, 0), two_sided=True), e3d.Material()]
    side = relief(rng, 20, 0.1)
    side = e3d.Mesh(
        side.positions, side.faces, materials=two, material_ids=np.arange(len(side.faces)) % 2
    )
    scene.add(side, translation=centre, scale=unit)
    return scene


def cameras(unit, width, height):
    yield e3d.PerspectiveCamera(yfov=0.9, znear=0.01 * unit, zfar=100 * unit)
    yield e3d.PerspectiveCamera(yfov=2.6, znear=1.5 * unit, zfar=9 * unit)  # cuts much
    yield e3d.OrthographicCamera(ymag=2 * unit, znear=0.01 * unit, zfar=100 * unit)
    yield e3d.IntrinsicsCamera(
        fx=3 * width,
        fy=0.4 * height,
        cx=-0.3 * width,
        cy=1.2 * height,
        znear=0.1 * unit,
        zfar=99 * unit,
    )


@pytest.mark.parametrize("cull", ["back", "front", "none"])
@pytest.mark.parametrize(("unit", "far"), [(1, 0), (1, 1e6), (1e-6, 0), (1e4, 3)])
def test_facing_changes_no_byte(cull, unit, far):
    rng = np.random.default_rng(int(unit) + int(far))
    centre = np.array([1, -0.5, 0.25]) * far
    scene, culled = cloud(rng, unit, centre), 0
    for number, (width, height) in enumerate([(64, 48), (131, 97), (256, 192)]):
        with Renderer((width, height), threads=1 + number % 2) as renderer:
            for camera in cameras(unit, width, height):
                eye = centre + unit * rng.normal(0, 1, 3) * rng.choice([0.5, 4])
                pose = e3d.look_at(eye, centre, (0, 1, 0.1))
                culled += compare(renderer, scene, (camera, pose), cull=cull)
    assert culled > 0


def test_what_faces_away_is_left_out():
    """About half of a large sphere in view; none where both sides show."""
    scene = e3d.Scene()
    scene.add(e3d.uv_sphere(1.0, (96, 64)))
    view = e3d.PerspectiveCamera(yfov=0.6), e3d.look_at((0, 0, 4), (0, 0, 0), (0, 1, 0))
    with Renderer((640, 480)) as renderer:
        both = renderer.render(scene, view, cull="none").stats
        for cull in ("back", "front"):
            stats = renderer.render(scene, view, cull=cull).stats
            assert both["clusters_culled"] == 0
            assert 0.1 < stats["clusters_culled"] / stats["clusters"] < 0.5


def slivers(rng, size):
    """A strip of long triangles about as thin as what snapping moves, in units of 1/size."""
    count = int(rng.integers(33, 500))
    x = np.arange(count + 1) + rng.uniform(-0.3, 0.3, count + 1)
    x = x * 10 ** rng.uniform(-2.5, -0.5) * 0.03  # a sample is 0.03 wide
    corners = np.concatenate([np.stack([x, np.full_like(x, y), 0 * x], -1) for y in (-1, 1)])
    a, b = np.arange(count), np.arange(count) + count + 1
    faces = np.concatenate([np.stack([a, a + 1, b + 1], -1), np.stack([a, b + 1, b], -1)])
    return e3d.Mesh((corners / size).astype(np.float32), faces)


@pytest.mark.parametrize("size", [1.0, 1e13])
def test_slivers_that_snapping_turns(size):
    """In tiny coordinates, too, with poses that make them large: products that float32 lacks."""
    view = e3d.PerspectiveCamera(yfov=0.9), e3d.look_at((0, 0, 6), (0, 0, 0), (0, 1, 0))
    culled = 0
    with Renderer((256, 192), threads=1) as renderer:
        for seed in range(30):
            rng = np.random.default_rng(seed)
            poses = np.tile(np.eye(4), (20, 1, 1))
            for pose in poses:
                pose[:3, :3] = random_rotation(rng) * size * rng.uniform(0.1, 1)
                pose[:3, 3] = rng.normal(0, 1.2, 3)
            scene = e3d.Scene()
            scene.add(e3d.InstancedMesh(slivers(rng, size), poses.astype(np.float32)))
            for cull in ("back", "front"):
                culled += compare(renderer, scene, view, cull=cull)
    assert culled > 0


def test_what_is_hidden_is_known_after_two_frames():
    """The first draws much that it does not know to be hidden, so the second tries all of it."""
    axis = np.arange(12) - 5.5
    places = 2.5 * np.stack(np.meshgrid(axis, axis, axis), -1).reshape(-1, 3)
    scene = e3d.Scene()
    scene.add(e3d.InstancedMesh(e3d.uv_sphere(1.0, (20, 11)), np.c_[places, np.ones(len(places))]))
    view = e3d.PerspectiveCamera(1.0, znear=0.05), e3d.look_at((0, 0, 0), (9, 4, -20))
    with Renderer((640, 360), threads=2) as renderer:
        drawn = [renderer.render(scene, view).stats["clusters_drawn"] for _ in range(9)]
    assert drawn[2:] == drawn[-1:] * 7
    assert drawn[-1] < drawn[0]


def test_occlusion_is_judged_by_what_the_second_frame_finds():
    """Seen from above, blocks of a town hide little of it before the last part is drawn."""
    x, z = np.meshgrid(np.arange(30) - 14.5, np.arange(30) - 14.5)
    poses = np.broadcast_to(np.eye(4), (x.size, 4, 4)).copy()
    poses[:, 0, 3], poses[:, 2, 3], poses[:, 1, 1] = x.ravel(), z.ravel(), 6
    scene = e3d.Scene()
    scene.add(e3d.InstancedMesh(e3d.icosphere(0.8, 3), poses.astype(np.float32)))
    view = e3d.PerspectiveCamera(0.7, znear=0.1), e3d.look_at((30, 30, 30), (0, 0, 0))
    with Renderer((320, 180), threads=1) as renderer:
        stats = [renderer.render(scene, view).stats for _ in range(6)]
    assert [frame["rounds"] for frame in stats] == [5, 2, 2, 2, 2, 2]
    tried = [frame["clusters_drawn"] + frame["clusters_occluded"] for frame in stats]
    assert stats[0]["clusters_occluded"] < 0.3 * tried[0]
    assert stats[2]["clusters_occluded"] > 0.3 * tried[2]


def field(side, spacing):
    """Spheres side by side on a square field."""
    x, z = spacing * (np.indices((side, side)) - (side - 1) / 2)
    poses = np.stack([x, 0 * x, z, 0.5 * spacing + 0 * x], axis=-1).reshape(-1, 4)
    scene = e3d.Scene(ambient=e3d.linear(0.3, 0.3, 0.3))
    scene.add(e3d.InstancedMesh(e3d.uv_sphere(0.9, (16, 9)), poses))
    return scene


def test_occlusion_is_tried_again_in_a_scene_of_many_more_items():
    """They cover hardly more of the picture than the fewer before, which hid little of it."""
    view = e3d.PerspectiveCamera(0.8, znear=0.1, zfar=500.0), e3d.look_at((0, 75, 60), (0, 0, 0))
    few, many = field(28, 2.9), field(40, 2.0)
    with Renderer((320, 180), threads=1) as renderer:
        assert [renderer.render(few, view).stats["rounds"] for _ in range(4)] == [5, 2, 1, 1]
        assert [renderer.render(many, view).stats["rounds"] for _ in range(4)] == [5, 2, 1, 1]


def test_occlusion_is_tried_again_in_another_view():
    """A crowd from above hides nothing of itself; from its edge most of it."""
    scene = field(40, 2.0)
    camera = e3d.PerspectiveCamera(0.8, znear=0.1, zfar=500.0)
    above = camera, e3d.look_at((0, 75, 60), (0, 0, 0))
    along = camera, e3d.look_at((0, 0.5, 44), (0, 0, 0))
    with Renderer((320, 180), threads=1) as renderer:
        assert [renderer.render(scene, above).stats["rounds"] for _ in range(4)] == [5, 2, 1, 1]
        for _ in range(3):
            stats = renderer.render(scene, along).stats
            assert stats["clusters_occluded"] > 5 * stats["clusters_drawn"]
        frame = renderer.render(scene, along)
        assert (frame.color == renderer.render(scene, along, culling="none").color).all()
