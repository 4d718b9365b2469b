"""Optical flow: against vertices posed by plain arithmetic, homographies, rays and pictures."""

import copy

import numpy as np
import pytest
from sensors import flow_rules as rules
from sensors.moving_scene import LENS, SIZE, MovingScene, moment, points_of, project, view_at

import engine3d as e3d
from engine3d.sensors import Flow, Moment

STILL = (LENS, e3d.look_at((0, 1, 5), (0, 0, 0)))


@pytest.fixture(scope="module")
def pair():
    """A moment, a later one, and the vertices of both."""
    moving = MovingScene()
    before, vertices = moment(moving, 0.0), moving.vertices()
    after = moment(moving, 0.35)
    return moving, before, after, vertices, moving.vertices()


def faces_of(moving):
    meshes = {node.id: node.object for node in moving.scene.nodes if node.object is not None}
    return {key: getattr(one, "mesh", one).faces for key, one in meshes.items()}


@pytest.mark.parametrize("way", ["forward", "backward"])
def test_flow_is_that_of_each_points_own_triangle(pair, way):
    moving, *moments, early, late = pair
    if way == "backward":
        moments, early, late = moments[::-1], late, early
    flow = moments[0].flow_to(moments[1])
    frame, faces = moments[0].frame, faces_of(moving)
    views = [view_at(0.0), view_at(0.35)][:: 1 if way == "forward" else -1]
    places = [
        project(*view, SIZE, points_of(frame, vertices, faces))
        for view, vertices in zip(views, (early, late), strict=True)
    ]
    shown = frame.face_id >= 0
    assert len(np.unique(frame.object_id)) == 7  # all six things, and the background
    assert np.array_equal(flow.known, shown)
    assert np.abs(flow.vectors - (places[1] - places[0]))[shown].max() < 2e-3
    assert np.abs(flow.vectors).max() > 3
    assert not flow.vectors[~shown].any()
    centres = np.stack(np.meshgrid(*(np.arange(side) + 0.5 for side in SIZE)), axis=-1)
    assert np.abs(places[0] - centres)[shown].max() < 5e-3


FLAT = e3d.OrthographicCamera(2.2, znear=0.1, zfar=60.0), e3d.look_at((1, 2, 6), (0, 0, 0))


@pytest.mark.parametrize("views", [(0.0, 0.7), (0.7, 0.2), (0.1, FLAT), (FLAT, 0.6)])
def test_the_core_follows_the_rules_to_the_bit(views):
    """Everything moves, and is seen by other cameras, one without perspective."""
    times = [view if isinstance(view, float) else 0.9 for view in views]
    (lens, pose), (other_lens, other_pose) = (
        view_at(view) if isinstance(view, float) else view for view in views
    )
    moving = MovingScene()
    first = moment(moving, times[0], view=(lens, pose))
    here = rules.points(first.frame, rules.corners(first.frame, moving.scene, pose))
    second = moment(moving, times[1], view=(other_lens, other_pose))
    own = rules.corners(first.frame, moving.scene, other_pose)
    other = rules.corners(second.frame, moving.scene, other_pose)
    there = rules.points(first.frame, own)
    begin, end = rules.places(lens, SIZE, here), rules.places(other_lens, SIZE, there)
    known = np.isfinite(end - begin).all(axis=-1)
    vectors = np.where(known[..., np.newaxis], end - begin, 0).astype(np.float32)
    flow = first.flow_to(second)
    assert np.array_equal(flow.known, known)
    assert np.array_equal(flow.vectors.view(np.uint32), vectors.view(np.uint32))
    is_near = isinstance(other_lens, e3d.PerspectiveCamera)
    shows = rules.visible(first.frame, second.frame, own, other, there, end, is_near)
    assert np.array_equal(flow.visible, shows)
    assert flow.occluded.any() and shows.any()


def test_what_stands_still_has_no_flow():
    moving = MovingScene()
    first, second = moment(moving, 0.2), moment(moving, 0.2)
    flow = first.flow_to(second)
    assert not flow.vectors.any()
    assert np.array_equal(flow.visible, flow.known) and flow.known.any()


def test_the_same_bytes_on_every_backend_with_any_threads(monkeypatch):
    moving, results = MovingScene(), set()
    for backend in e3d.backends():
        for threads in (1, 3):
            monkeypatch.setenv("ENGINE3D_THREADS", str(threads))
            renderer = e3d.Renderer(SIZE, backend=backend)
            a = moment(moving, 0.0, renderer=renderer)
            b = moment(moving, 0.3, renderer=renderer)
            flow = a.flow_to(b)
            results.add((flow.vectors.tobytes(), flow.known.tobytes(), flow.visible.tobytes()))
    assert len(results) == 1


def test_a_turning_camera_gives_a_homography():
    sky = e3d.Environment(np.full((2, 4, 3), 0.5, np.float32))
    scene = e3d.Scene(background=sky)
    scene.add(e3d.uv_sphere(1.0), translation=(0.3, 0.1, -4.0))
    lens = e3d.IntrinsicsCamera(110.0, 100.0, 55.0, 50.0, znear=0.1, zfar=50.0)
    turn = e3d.linalg.rotation_y(0.1) @ e3d.linalg.rotation_x(0.05)
    with e3d.Renderer(SIZE) as renderer:
        a, b = (
            Moment(renderer.render(scene, (lens, pose), outputs=Moment.OUTPUTS), scene)
            for pose in (np.eye(4), turn)
        )
    flow = a.flow_to(b)
    k = np.array([(110.0, 0.0, -55.0), (0.0, -100.0, -50.0), (0.0, 0.0, -1.0)])  # along -Z
    homography = k @ turn[:3, :3].T @ np.linalg.inv(k)
    x, y = np.meshgrid(np.arange(SIZE[0]) + 0.5, np.arange(SIZE[1]) + 0.5)
    ahead = np.stack([x, y, np.ones_like(x)], axis=-1) @ homography.T
    expected = ahead[..., :2] / ahead[..., 2:] - np.stack([x, y], axis=-1)
    assert flow.known.all() and (a.frame.object_id < 0).any()
    assert np.abs(flow.vectors - expected).max() < 1e-3
    ends = np.stack([x, y], axis=-1) + flow.vectors
    inside = ((ends >= 0) & (ends < SIZE)).all(axis=-1)
    assert not flow.visible[~inside].any()
    assert flow.visible[inside].mean() > 0.99  # but for the ball's edge


def test_the_other_picture_warped_is_this_picture():
    noise = np.random.default_rng(3).integers(60, 200, (32, 32, 3), np.uint8)
    material = e3d.Material(texture=e3d.Texture(noise), unlit=True)
    scene = e3d.Scene(background=(0, 0, 0))
    wall, plate = e3d.plane(12.0), e3d.box(1.2)
    wall.materials = plate.materials = [material]
    scene.add(wall, rotation=e3d.linalg.euler_to_quaternion((np.pi / 2, 0, 0)))
    thing = scene.add(plate, translation=(0, 0, 1))
    frames, moments = [], []
    with e3d.Renderer((320, 240), samples=16, antialiasing="ssaa") as renderer:
        for time in (0.0, 1.0):
            thing.translation = (-0.2 * time, 0.1 * time, 1.0)
            pose = e3d.look_at((0.3 * time, 0, 6), (0.3 * time, 0, 0))
            frame = renderer.render(scene, (LENS, pose), outputs=("color", *Moment.OUTPUTS))
            frames.append(frame.color[..., :3].astype(float))
            moments.append(Moment(frame, scene))
    flow = moments[0].flow_to(moments[1])
    apart = np.abs(flow.warp(frames[1]) - frames[0]).max(axis=-1)
    assert np.percentile(apart[flow.visible], 97) < 8
    assert np.abs(frames[1] - frames[0]).max(axis=-1)[flow.visible].mean() > 20
    assert 0.01 < flow.occluded.mean() < 0.2


def edges_of(frame):
    """Pixels with another thing beside them."""
    ids = np.pad(frame.object_id * 16 + frame.instance_id, 1, mode="edge")
    rows, columns = frame.object_id.shape
    around = [
        ids[1 + i : 1 + i + rows, 1 + j : 1 + j + columns] for i in (-1, 0, 1) for j in (-1, 0, 1)
    ]
    return np.ptp(np.stack(around), axis=0) > 0


@pytest.mark.parametrize(("begin", "end"), [(0.0, 0.6), (0.6, 0.0), (0.0, 1.3), (1.3, 0.4)])
def test_occlusion_is_what_rays_say(begin, end):
    moving = MovingScene()
    first, second = moment(moving, begin), moment(moving, end)
    flow, faces = first.flow_to(second), faces_of(moving)
    points = points_of(first.frame, moving.vertices(), faces)  # at the end
    pose = view_at(end)[1]
    places = project(LENS, pose, SIZE, points)
    known = np.argwhere(flow.known)
    eye = pose[:3, 3]
    ways = points[tuple(known.T)] - eye
    hits = moving.scene.raycast_many(eye, ways)
    reached = hits.distance > np.linalg.norm(ways, axis=1) * (1 - 1e-4)
    x, y = places[tuple(known.T)].T
    inside = (x >= 0) & (y >= 0) & (x < SIZE[0]) & (y < SIZE[1])
    marked = flow.visible[tuple(known.T)]
    assert not marked[~inside].any()
    edges = edges_of(second.frame)[
        np.clip(y, 0, SIZE[1] - 1).astype(int), np.clip(x, 0, SIZE[0] - 1).astype(int)
    ]
    sure = inside & ~edges
    assert 0.01 < (~reached[inside]).mean() < 0.5
    assert (marked != reached)[sure].mean() < 0.004
    assert (marked != reached)[inside].mean() < 0.03


def test_cameras_and_sizes_may_differ():
    moving = MovingScene().at(0.0)
    flat = e3d.OrthographicCamera(2.5, znear=0.1, zfar=50.0)
    pose = e3d.look_at((1, 2, 5), (0, 0, 0))
    small = e3d.Renderer((50, 64), samples=1)
    first = moment(moving, 0.0)
    second = moment(moving, 0.0, renderer=small, view=(flat, pose))
    flow, faces = first.flow_to(second), faces_of(moving)
    points = points_of(first.frame, moving.vertices(), faces)
    begin = project(*view_at(0.0), SIZE, points)
    end = project(flat, pose, (50, 64), points)
    assert np.abs(flow.vectors - (end - begin))[flow.known].max() < 2e-3
    back = second.flow_to(first)
    assert back.vectors.shape == (64, 50, 2) and back.visible.any() and back.occluded.any()


def test_what_is_gone_or_another_mesh_or_behind_is_not_known():
    moving = MovingScene()
    first = moment(moving, 0.0)
    moving.ball.visible = False
    moving.floor.object = e3d.box(9.0)
    second = moment(moving, 0.0)
    flow = first.flow_to(second)
    ids = first.frame.object_id
    assert not flow.known[(ids == moving.ball.id) | (ids == moving.floor.id)].any()
    assert flow.known[ids == moving.boxes.id].all()
    away = (LENS, e3d.look_at((0, 0, 5), (0, 0, 10)))
    flow = first.flow_to(moment(moving, 0.0, view=away))
    assert not flow.known.any() and not flow.visible.any()


def test_a_new_mesh_with_the_same_faces_is_the_same_thing():
    scene = e3d.Scene()
    node = scene.add(e3d.box())
    with e3d.Renderer(SIZE) as renderer:
        moments = []
        for place in (0.0, 0.1):
            node.object = e3d.box()
            node.translation = (place, 0, 0)
            frame = renderer.render(scene, STILL, outputs=Moment.OUTPUTS)
            moments.append(Moment(frame, scene))
    flow = moments[0].flow_to(moments[1])
    assert flow.known.any() and (flow.vectors[flow.known][:, 0] > 1).all()


def test_lines_and_points_have_no_flow():
    scene = e3d.Scene()
    scene.add(e3d.Mesh([(-1, 0, 0), (1, 0, 0), (0, 1, 0)], lines=[(0, 1)], points=[2]))
    frame = e3d.Renderer(SIZE).render(scene, STILL, outputs=Moment.OUTPUTS)
    one = Moment(frame, scene)
    assert (frame.object_id >= 0).any() and not one.flow_to(one).known.any()


def test_one_surface_bent_either_way_hides_nothing_of_itself():
    y, x = np.meshgrid(np.linspace(-1, 1, 41), np.linspace(-1, 1, 41))
    waves = np.stack([x, y, 0.12 * np.sin(9 * x) * np.cos(7 * y)], axis=-1).reshape(-1, 3)
    first = (np.arange(40)[:, np.newaxis] * 41 + np.arange(40)).reshape(-1, 1)
    faces = np.concatenate([first + (0, 41, 42), first + (0, 42, 1)])
    scene = e3d.Scene()
    scene.add(e3d.Mesh(waves, faces, materials=[e3d.Material(two_sided=True)]))
    with e3d.Renderer((90, 90)) as renderer:
        a, b = (
            Moment(
                renderer.render(
                    scene, (LENS, e3d.look_at((x, 0.1, 3), (0, 0, 0))), outputs=Moment.OUTPUTS
                ),
                scene,
            )
            for x in (0.0, 0.4)
        )
    for flow in (a.flow_to(b), b.flow_to(a)):
        assert flow.known.sum() > 3000
        assert flow.occluded.sum() <= 0.01 * flow.known.sum()


def test_moments_say_what_is_missing():
    scene = e3d.Scene()
    scene.add(e3d.box())
    frame = e3d.Renderer(SIZE).render(scene, STILL, outputs=("color", "face_id"))
    with pytest.raises(e3d.errors.MissingOutputError, match="object_id, instance_id, barycentric"):
        Moment(frame, scene)
    with pytest.raises(e3d.InvalidArgumentError, match="scene"):
        Moment(frame, "scene")
    whole = e3d.Renderer(SIZE).render(scene, STILL, outputs=Moment.OUTPUTS)
    with pytest.raises(e3d.InvalidArgumentError, match="other"):
        Moment(whole, scene).flow_to(whole)
    with pytest.raises(e3d.InvalidArgumentError, match="not drawn by a Renderer"):
        Moment(copy.deepcopy(e3d.Frame(SIZE, dict(whole._outputs))), scene)


def test_colours_tell_directions():
    vectors = np.zeros((1, 6, 2), np.float32)
    vectors[0, 1:5] = [(1, 0), (0, 1), (-1, 0), (0, -1)]
    known = np.array([[True] * 5 + [False]])
    flow = Flow(vectors, known, known)
    still, right, down, left, up, unknown = flow.colors()[0].astype(int)
    assert still.tolist() == [255, 255, 255] and unknown.tolist() == [0, 0, 0]
    assert right.tolist() == [255, 0, 0]
    assert down[0] > 200 and down[1] > 200 and down[2] < 60  # yellow
    assert left[0] < 60 and left[1] > 150 and left[2] > 150  # cyan to blue
    assert up[2] > 200 and up[1] < 60
    paler = flow.colors(largest=4.0)[0, 1].astype(int)
    assert paler[0] == 255 and 150 < paler[1] < 255
    with pytest.raises(e3d.InvalidArgumentError, match="largest"):
        flow.colors(largest=-1.0)


def test_warp_takes_pictures_of_numbers_only():
    flow = Flow(np.zeros((2, 3, 2), np.float32), np.ones((2, 3), bool), np.ones((2, 3), bool))
    assert np.array_equal(flow.warp([[1, 2, 3], [4, 5, 6]]), [[1, 2, 3], [4, 5, 6]])
    for wrong in (np.zeros(3), "picture", np.zeros((0, 3)), np.zeros((2, 2), complex)):
        with pytest.raises(e3d.InvalidArgumentError, match="picture"):
            flow.warp(wrong)


@pytest.mark.parametrize("shape", [(3, 3), (2, 9), (9, 2), (1, 1, 3)])
def test_warp_refuses_a_picture_that_visible_pixels_leave(shape):
    vectors = np.zeros((6, 8, 2), np.float32)
    everywhere = np.ones((6, 8), bool)
    with pytest.raises(e3d.InvalidArgumentError, match="that of the other moment"):
        Flow(vectors, everywhere, everywhere).warp(np.zeros(shape))
    hidden = Flow(vectors, everywhere, ~everywhere).warp(np.zeros(shape))
    assert hidden.shape == (6, 8, *shape[2:])


def test_levels_of_detail_are_known_while_they_stay():
    fine, coarse = e3d.icosphere(0.5, 3), e3d.icosphere(0.5, 1)
    levels = [(fine, 0.0), (coarse, 0.05)]
    meshes = e3d.detail.DetailedMeshes([((mesh,), error) for mesh, error in levels])
    crowd = e3d.detail.DetailedInstances(levels, [(2, 0, 0, 1), (2, 1, -20, 1)])
    scene = e3d.Scene(ambient=(1, 1, 1))
    place, many = meshes.add_to(scene).children[0], crowd.add_to(scene)
    found = []
    with e3d.Renderer(SIZE) as renderer:
        for away in (5.0, 5.5, 40.0):
            pose = e3d.look_at((1, 0, away), (1, 0, 0))
            meshes.update(LENS, pose, SIZE)
            crowd.update(LENS, pose, SIZE)
            frame = renderer.render(scene, (LENS, pose), outputs=Moment.OUTPUTS)
            found.append(Moment(frame, scene))
    ids = found[0].frame.object_id
    assert (ids == place.id).any() and (ids == many.id).any()
    assert meshes.level[0] == 1  # at last
    flow = found[0].flow_to(found[1])
    assert flow.known[ids == place.id].all() and not flow.known[ids == many.id].any()
    assert not found[0].flow_to(found[2]).known[ids == place.id].any()


def test_frames_that_were_written_to_do_no_harm():
    moving, random = MovingScene(), np.random.default_rng(5)
    first, second = moment(moving, 0.0), moment(moving, 0.4)
    for one in (first, second):
        for name in ("object_id", "instance_id", "face_id"):
            array = getattr(one.frame, name)
            places = random.random(array.shape) < 0.3
            array[places] = random.integers(-(2**31), 2**31, places.sum(), np.int32)
            places = random.random(array.shape) < 0.3
            array[places] = random.integers(-2, 9, places.sum(), np.int32)
        weights = one.frame.barycentric
        weights[random.random(weights.shape[:2]) < 0.2] = (np.nan, np.inf, 1e38)
    for flow in (first.flow_to(second), second.flow_to(first)):
        assert np.isfinite(flow.vectors).all() and not flow.vectors[~flow.known].any()


LENSES = [
    e3d.FisheyeCamera(60.0, 60.0, SIZE[0] / 2, SIZE[1] / 2, (0.02, -0.01, 0.0, 0.0)),
    e3d.BrownConradyCamera(90.0, 90.0, SIZE[0] / 2, SIZE[1] / 2, (-0.1, 0.02, 0.001, 0.001)),
    e3d.EquirectangularCamera(),
]


@pytest.mark.parametrize("lens", LENSES, ids=lambda lens: type(lens).__name__)
def test_flow_through_a_lens_is_between_its_own_pixels(lens):
    moving = MovingScene()
    moving.at(0.2)
    outputs = ("world_position", *Moment.OUTPUTS)
    poses = [e3d.look_at(eye, (0, 0, 0)) for eye in ((0.4, 0.7, 5.0), (0.5, 0.7, 4.9))]
    with e3d.Renderer(SIZE, samples=1) as renderer:
        first, second = (
            renderer.render(moving.scene, (lens, pose), outputs=outputs) for pose in poses
        )
        flow = Moment(first, moving.scene).flow_to(Moment(second, moving.scene))
    shown = first.object_id >= 0
    points = first.world_position[shown]
    moved = second.project(points)[0] - first.project(points)[0]
    assert shown.sum() > 1000
    assert np.abs(moved - flow.vectors[shown]).max() < 1e-5
