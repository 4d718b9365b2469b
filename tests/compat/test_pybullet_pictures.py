"""Camera images beside those of PyBullet's own TinyRenderer, of the same scenes, as they change."""

import functools
import inspect
import itertools
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest

pybullet = pytest.importorskip("pybullet", exc_type=ImportError)
pybullet_data = pytest.importorskip("pybullet_data", exc_type=ImportError)

import engine3d as e3d  # noqa: E402
from engine3d.compat.pybullet import install  # noqa: E402

TINY = pybullet.getCameraImage
LINKS = pybullet.ER_SEGMENTATION_MASK_OBJECT_AND_LINKINDEX
SIZE = (160, 120)
MODELS = (
    *("plane.urdf", "r2d2.urdf", "kuka_iiwa/model.urdf", "husky/husky.urdf", "duck_vhacd.urdf"),
    *("humanoid/humanoid.urdf", "laikago/laikago.urdf", "cube.urdf", "table/table.urdf"),
    *("soccerball.urdf", "franka_panda/panda.urdf", "racecar/racecar.urdf", "block.urdf"),
    *("quadruped/minitaur.urdf", "table_square/table_square.urdf", "random_urdfs/000/000.urdf"),
)
WAYS = ((1.0, 0.8, 0.6), (-0.4, 1.0, 0.3), (0.2, -0.3, 1.0))


@pytest.fixture(scope="module", autouse=True)
def _installed():
    saved = {name: getattr(pybullet, name) for name in dir(pybullet)}
    install()
    yield
    for name, value in saved.items():
        setattr(pybullet, name, value)


@pytest.fixture
def bullet():
    client = pybullet.connect(pybullet.DIRECT)
    pybullet.setAdditionalSearchPath(pybullet_data.getDataPath())
    assert client == 0
    yield pybullet
    pybullet.disconnect()


def camera(eye=(2, 2, 1.5), target=(0.3, 0, 0.5), size=SIZE, near=0.1, far=10.0):
    return (
        pybullet.computeViewMatrix(list(map(float, eye)), list(map(float, target)), [0, 0, 1]),
        pybullet.computeProjectionMatrixFOV(60, size[0] / size[1], near, far),
    )


def arrays(result):
    """Return colours, depths and masks; PyBullet built without NumPy gives tuples."""
    width, height, colors, depths, masks = result
    return (
        np.reshape(colors, (height, width, 4)).astype(np.uint8),
        np.reshape(depths, (height, width)).astype(np.float32),
        np.reshape(masks, (height, width)).astype(np.int32),
    )


def compare(*matrices, size=SIZE, color=0.5, **options):
    """Draw both pictures, and check how far they may differ; return this engine's masks."""
    matrices = matrices or camera(size=size)
    tiny = arrays(
        TINY(*size, *matrices, flags=LINKS, renderer=pybullet.ER_TINY_RENDERER, **options)
    )
    here = pybullet.getCameraImage(*size, *matrices, flags=LINKS, **options)
    assert here[:2] == size
    colors, depths, masks = here[2:]
    assert (colors.dtype, depths.dtype, masks.dtype) == (np.uint8, np.float32, np.int32)
    assert (colors.shape, depths.shape) == ((*masks.shape, 4), masks.shape[::1])
    same = tiny[2] == masks
    assert np.mean(~same) <= 0.005
    assert np.abs(tiny[1] - depths)[same].mean() < 1e-4
    assert np.abs(tiny[0].astype(int) - colors)[same].mean() <= color
    return masks


@pytest.mark.parametrize("model", MODELS)
def test_models_look_the_same(bullet, model):
    body = bullet.loadURDF(model)
    boxes = [bullet.getAABB(body, link) for link in range(-1, bullet.getNumJoints(body))]
    low, high = np.min([b[0] for b in boxes], axis=0), np.max([b[1] for b in boxes], axis=0)
    if model == "plane.urdf":
        low, high = np.array([-1.0, -1, 0]), np.array([1.0, 1, 0])
    reach = float(np.clip(np.linalg.norm(high - low), 0.05, 8))
    if model != "plane.urdf":
        bullet.loadURDF("plane.urdf", [0, 0, float(low[2]) - 0.01])
    for number, way in enumerate(WAYS):
        middle = (low + high) / 2
        size = ((160, 120), (84, 84), (200, 90))[number]
        matrices = camera(
            middle + np.array(way) * reach * 0.9, middle, size, 0.05 * reach, 20 * reach
        )
        masks = compare(*matrices, size=size, shadow=number == 1)
        assert (masks & 0xFFFFFF == body)[masks >= 0].any()


@pytest.mark.parametrize("seed", range(6))
def test_scenes_of_all_kinds_of_shapes_look_the_same(bullet, seed):
    random = np.random.default_rng(seed)
    for _ in range(8):
        kind = random.choice(
            [bullet.GEOM_BOX, bullet.GEOM_SPHERE, bullet.GEOM_CAPSULE, bullet.GEOM_CYLINDER]
        )
        sizes = {"halfExtents": random.uniform(0.05, 0.5, 3).tolist()}
        if kind != bullet.GEOM_BOX:
            sizes = {"radius": random.uniform(0.05, 0.4), "length": random.uniform(0.1, 0.9)}
        frame = random.normal(size=4)
        shape = bullet.createVisualShape(
            int(kind),
            **sizes,
            rgbaColor=[*random.uniform(0, 1, 3), 1],
            visualFramePosition=random.normal(scale=0.2, size=3).tolist(),
            visualFrameOrientation=(frame / np.linalg.norm(frame)).tolist(),
        )
        turn = random.normal(size=4)
        bullet.createMultiBody(
            1.0,
            -1,
            shape,
            random.normal(scale=0.8, size=3).tolist(),
            (turn / np.linalg.norm(turn)).tolist(),
            baseInertialFramePosition=random.normal(scale=0.2, size=3).tolist(),
        )
    light = {
        "lightDirection": random.normal(size=3).tolist(),
        "lightColor": random.uniform(0, 1.5, 3).tolist(),
        "lightDistance": random.uniform(1, 8),
        "lightAmbientCoeff": random.uniform(0, 1),
        "lightDiffuseCoeff": random.uniform(0, 1),
        "lightSpecularCoeff": random.uniform(0, 1),
        "shadow": int(random.integers(2)),
    }
    matrices = camera(random.normal(size=3) * 3, random.normal(scale=0.2, size=3), near=0.05)
    compare(*matrices, color=1.0, **light)
    compare(*matrices, color=1.0)  # the light holds


def test_bodies_that_move_are_where_they_are(bullet):
    bullet.setGravity(0, 0, -9.8)
    bullet.loadURDF("plane.urdf")
    robot = bullet.loadURDF("r2d2.urdf", [0, 0, 1])
    arm = bullet.loadURDF("kuka_iiwa/model.urdf", [1, 0, 0], useFixedBase=True)
    first = compare()
    for joint in range(7):
        bullet.resetJointState(arm, joint, 0.5)
    assert (compare() != first).any()
    for steps in (1, 30, 60):
        for _ in range(steps):
            bullet.stepSimulation()
        compare()
    bullet.resetBasePositionAndOrientation(robot, [0, 0.5, 0.6], [0.1, 0.2, 0.3, 0.9])
    compare()
    state = bullet.saveState()
    bullet.stepSimulation()
    bullet.restoreState(state)
    compare()


def test_pictures_change_nothing_of_the_simulation(bullet):
    ends = []
    for draws in (False, True):
        bullet.resetSimulation()
        bullet.setGravity(0, 0, -9.8)
        bullet.loadURDF("plane.urdf")
        robot = bullet.loadURDF("r2d2.urdf", [0, 0, 0.8])
        for _ in range(60):
            bullet.stepSimulation()
            if draws:
                bullet.getCameraImage(8, 8, *camera(size=(8, 8)))
        joints = bullet.getJointStates(robot, range(bullet.getNumJoints(robot)))
        ends.append((bullet.getBasePositionAndOrientation(robot), [j[:2] for j in joints]))
    assert ends[0] == ends[1]


def test_what_is_changed_about_shapes_shows(bullet):
    bullet.loadURDF("plane.urdf")
    robot = bullet.loadURDF("r2d2.urdf", [0, 0, 0.5])
    texture = bullet.loadTexture("tex256.png")
    cube = bullet.loadURDF("cube.urdf", [0, -1, 0.5])
    before = bullet.getCameraImage(*SIZE, *camera())[2]
    changes = (
        (robot, -1, {"rgbaColor": [1, 0, 0, 1]}),
        (robot, 2, {"rgbaColor": [1, 0, 0, 0]}),
        (robot, 2, {"rgbaColor": [0, 1, 0, 0.5]}),
        (cube, -1, {"textureUniqueId": texture}),
        (cube, -1, {"textureUniqueId": -1}),
        (cube, -1, {"textureUniqueId": texture, "rgbaColor": [0.2, 1, 0.5, 1]}),
    )
    for body, link, change in changes:
        bullet.changeVisualShape(body, link, **change)
        compare()
        compare(shadow=1)
        compare(shadow=0)
        now = bullet.getCameraImage(*SIZE, *camera())[2]
        assert (now != before).any()
        before = now


def test_one_shape_of_a_link_is_painted_alone(bullet):
    kinds = [bullet.GEOM_BOX, bullet.GEOM_CAPSULE, bullet.GEOM_SPHERE]
    shapes = bullet.createVisualShapeArray(
        kinds,
        halfExtents=[[0.1, 0.2, 0.3], [0, 0, 0], [0, 0, 0]],
        radii=[0, 0.2, 0.15],
        lengths=[0, 0.5, 0],
        rgbaColors=[[1, 0, 0, 1], [0, 1, 0, 1], [0, 0, 1, 1]],
        visualFramePositions=[[0, 0, 0], [0, 0, 1], [0.5, 0, 0]],
    )
    body = bullet.createMultiBody(
        1,
        -1,
        shapes,
        [0, 0.7, 0.5],
        [0.1, 0.2, 0.3, 0.9],
        baseInertialFramePosition=[0.1, 0.2, 0.1],
    )
    bullet.changeVisualShape(body, -1, shapeIndex=1, rgbaColor=[1, 1, 0, 1])  # before any picture
    compare()
    texture = bullet.loadTexture("tex256.png")
    bullet.changeVisualShape(body, -1, shapeIndex=2, textureUniqueId=texture)
    compare()
    bullet.changeVisualShape(body, -1, rgbaColor=[0.5, 0.5, 1, 1])
    compare()


def test_meshes_of_vertices_and_files_and_links(bullet):
    tent = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]
    faces = [0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3]
    given = bullet.createVisualShape(
        bullet.GEOM_MESH, vertices=tent, indices=faces, meshScale=[0.5, 0.6, 0.7]
    )
    duck = bullet.createVisualShape(
        bullet.GEOM_MESH,
        fileName="duck.obj",
        meshScale=[0.1, 0.2, 0.1],
        visualFramePosition=[0.1, 0, 0],
        visualFrameOrientation=[0.7, 0, 0, 0.7],
    )
    bullet.createMultiBody(1, -1, duck, baseInertialFramePosition=[0.1, 0.2, 0.3])
    bullet.createMultiBody(baseVisualShapeIndex=given, basePosition=[0.5, -0.5, 0.2])
    cylinder = bullet.createCollisionShape(bullet.GEOM_CYLINDER, radius=0.2, height=0.6)
    body = bullet.createMultiBody(
        1,
        cylinder,
        -1,
        [0.6, 0.2, 0.8],
        linkMasses=[1, 1],
        linkCollisionShapeIndices=[-1, -1],
        linkVisualShapeIndices=[duck, given],
        linkPositions=[[0, 0.3, 0], [0, 0, 0.4]],
        linkOrientations=[[0, 0, 0, 1]] * 2,
        linkInertialFramePositions=[[0.1, 0, 0], [0, 0.1, 0]],
        linkInertialFrameOrientations=[[0, 0, 0, 1]] * 2,
        linkParentIndices=[0, 1],
        linkJointTypes=[bullet.JOINT_REVOLUTE, bullet.JOINT_PRISMATIC],
        linkJointAxis=[[0, 0, 1]] * 2,
    )
    masks = compare()
    assert set(np.unique(masks)) >= {0, 1, 2, 2 + (1 << 24), 2 + (2 << 24)}
    bullet.resetJointState(body, 0, 1.0)
    bullet.resetJointState(body, 1, 0.2)
    assert (compare() != masks).any()


TENT = [[-0.5, -0.5, 0], [0.5, -0.5, 0], [0.5, 0.5, 0], [-0.5, 0.5, 0], [0, 0, 1]]
SIDES = [0, 1, 2, 0, 2, 3, 0, 1, 4, 1, 2, 4, 2, 3, 4, 3, 0, 4]


def test_meshes_of_vertices_may_be_given_by_position(bullet):
    usual = (0.5, [1, 1, 1], 1.0, "", [1, 1, 1], [0, 0, 1], 0, [1, 0, 0, 1], [1, 1, 1])
    still = ([0, 0, 0], [0, 0, 0, 1])
    shape = bullet.createVisualShape(bullet.GEOM_MESH, *usual, *still, TENT, SIDES)
    body = bullet.createMultiBody(
        *(1, -1, -1, [0, 0, 0], [0, 0, 0, 1], [0, 0, 0], [0, 0, 0, 1]),
        *([1], [-1], [shape], [[0, 0, 0.1]], [[0, 0, 0, 1]], [[0, 0, 0]], [[0, 0, 0, 1]]),
        *([0], [bullet.JOINT_FIXED], [[0, 0, 1]]),
    )
    assert set(np.unique(compare())) == {-1, body + (1 << 24)}


@pytest.mark.filterwarnings("error")
def test_vertices_of_collision_shapes_are_not_seen(bullet):
    for faces in ({"indices": SIDES}, {}):
        hull = bullet.createCollisionShape(bullet.GEOM_MESH, vertices=TENT, **faces)
        body = bullet.createMultiBody(1, hull)
        assert (compare() == -1).all()
        bullet.removeBody(body)
    box = bullet.createCollisionShape(bullet.GEOM_BOX, halfExtents=[0.2, 0.3, 0.4])
    body = bullet.createMultiBody(1, box)
    assert set(np.unique(compare())) == {-1, body}


def test_files_are_those_of_the_folder_that_bullet_looked_in(bullet, tmp_path):
    for folder, side in (("large", 1.0), ("small", 0.3)):
        (tmp_path / folder).mkdir()
        corners = f"v 0 0 0\nv {side} 0 0\nv 0 {side} 0\n"
        (tmp_path / folder / "flag.obj").write_text(f"{corners}f 1 2 3\nf 3 2 1\n")
    # Bullet has one folder for all clients, and reads files when bodies are made.
    bullet.setAdditionalSearchPath(str(tmp_path / "large"))
    flag = bullet.createVisualShape(bullet.GEOM_MESH, fileName="flag.obj")
    bullet.createMultiBody(1, -1, flag)
    other = bullet.connect(bullet.DIRECT)
    bullet.setAdditionalSearchPath(str(tmp_path / "small"), other)
    bullet.disconnect(other)
    compare()
    bullet.resetSimulation()
    flag = bullet.createVisualShape(bullet.GEOM_MESH, fileName="flag.obj")
    bullet.createMultiBody(1, -1, flag)
    compare()
    bullet.setAdditionalSearchPath(str(tmp_path))
    bullet.createMultiBody(1, -1, flag)
    with pytest.warns(e3d.Engine3DWarning, match="no such file"):
        compare()


def test_bodies_go_and_their_numbers_come_again(bullet):
    one, two = (bullet.loadURDF("cube.urdf", [0, y, 0.5]) for y in (-1.0, 1.0))
    assert {one, two} <= set(np.unique(compare()))
    bullet.removeBody(one)
    assert one not in np.unique(compare())
    for model in ("husky/husky.urdf", "duck_vhacd.urdf", "cube.urdf"):
        bullet.resetSimulation()
        assert (compare() == -1).all()
        assert bullet.loadURDF(model, [0, 0, 0.3], globalScaling=1.5) == 0
        assert (compare() != -1).any()
    bullet.changeVisualShape(0, -1, rgbaColor=[1, 0, 0, 1])
    bullet.resetSimulation()
    bullet.loadURDF("cube.urdf", [0, 0, 0.3])
    compare()


def test_a_body_that_replaces_another_has_nothing_of_it(bullet):
    texture = bullet.loadTexture("tex256.png")
    tent = {"vertices": [[0, -0.1, 0], [1, 0, 0], [0, 0, 1]], "indices": [0, 1, 2, 0, 2, 1]}
    for _ in range(3):
        body = bullet.loadURDF("cube.urdf", [0, 0, 0.5])
        compare()
        bullet.changeVisualShape(body, -1, textureUniqueId=texture, rgbaColor=[1, 0.5, 1, 1])
        compare()
        bullet.removeBody(body)
        shape = bullet.createVisualShape(bullet.GEOM_MESH, **tent)
        body = bullet.createMultiBody(1, -1, shape)
        compare()
        bullet.removeBody(bodyUniqueId=body)
        tent["vertices"][1][0] += 0.5
    bullet.loadURDF("cube.urdf", [0, 0, 0.5])
    bullet.resetSimulation(0, 0)
    bullet.loadURDF("cube.urdf", [0, 0, 0.5])
    compare()


def test_scenes_begin_anew_after_many_bodies(bullet, monkeypatch):
    from engine3d.compat.pybullet import _world

    monkeypatch.setattr(_world, "_MOST_ID", 6)
    texture = bullet.loadTexture("tex256.png")
    kept = bullet.loadURDF("cube.urdf", [0, 0, 0.5])
    bullet.changeVisualShape(kept, -1, textureUniqueId=texture)
    for number in range(12):
        body = bullet.loadURDF("r2d2.urdf", [0, 1, 0.1 * number])
        compare(shadow=number % 2)
        bullet.removeBody(body)
        if number == 6:
            bullet.changeVisualShape(kept, -1, rgbaColor=[1, 0.5, 0.5, 1])
    assert set(np.unique(compare())) == {-1, kept}


def test_clients_are_apart_and_their_objects_draw_too(bullet):
    client_module = pytest.importorskip("pybullet_utils.bullet_client", exc_type=ImportError)
    bullet.loadURDF("cube.urdf", [0, 0, 0.5])
    client = client_module.BulletClient(bullet.DIRECT)
    client.setAdditionalSearchPath(pybullet_data.getDataPath())
    assert inspect.isbuiltin(bullet.getCameraImage)
    client.loadURDF("duck_vhacd.urdf", globalScaling=10)
    assert isinstance(client.getCameraImage, functools.partial)
    here = client.getCameraImage(*SIZE, *camera())
    tiny = arrays(TINY(*SIZE, *camera(), physicsClientId=client._client))
    assert np.mean(tiny[2] != here[4]) < 0.005
    compare()
    client.disconnect()
    other = bullet.connect(bullet.DIRECT)  # gets the number of the one that left
    assert (bullet.getCameraImage(*SIZE, *camera(), physicsClientId=other)[4] == -1).all()
    bullet.disconnect(other)


def test_masks_tell_bodies_or_bodies_and_links(bullet):
    bullet.loadURDF("cube.urdf", [0, 0, 5])
    robot = bullet.loadURDF("r2d2.urdf", [0, 0, 0.5])
    plain = bullet.getCameraImage(*SIZE, *camera())[4]
    links = bullet.getCameraImage(*SIZE, *camera(), flags=LINKS)[4]
    assert set(np.unique(plain)) == {-1, robot}
    np.testing.assert_array_equal(np.where(links < 0, -1, links & 0xFFFFFF), plain)
    assert len(np.unique(links)) > 5
    none = bullet.getCameraImage(*SIZE, *camera(), flags=bullet.ER_NO_SEGMENTATION_MASK)
    assert none[4].shape == plain.shape and not none[4].any()


def test_without_a_camera_it_is_pybullets_own(bullet):
    bullet.loadURDF("r2d2.urdf", [0, 0, 0.5])
    tiny, here = arrays(TINY(*SIZE)), bullet.getCameraImage(*SIZE)[2:]
    assert np.mean(tiny[2] != here[2]) < 0.005
    compare()
    tiny, here = arrays(TINY(*SIZE)), bullet.getCameraImage(*SIZE)[2:]
    assert np.abs(tiny[1] - here[1]).mean() < 1e-4  # near and far are those of the last camera


def test_bytes_are_the_same_again_and_in_new_clients(bullet):
    pictures = []
    for client in (0, bullet.connect(bullet.DIRECT)):
        bullet.loadURDF("plane.urdf", physicsClientId=client)
        bullet.loadURDF("kuka_iiwa/model.urdf", physicsClientId=client)
        given = {"physicsClientId": client, "lightDistance": 3}
        pictures += [
            bullet.getCameraImage(*SIZE, *camera(), shadow=shadow, **given)[2:]
            for shadow in (1, 0, 1)
        ]
    bullet.disconnect(1)
    for one, other in itertools.combinations([0, 2, 3, 5], 2):
        for a, b in zip(pictures[one], pictures[other], strict=True):
            np.testing.assert_array_equal(a, b)


@pytest.mark.parametrize(
    "wrong, told",
    [
        ({"width": 0}, "width must be from 1 to 16384, not 0"),
        ({"height": 20_000}, "height must be from 1"),
        ({"viewMatrix": [1, 2]}, "viewMatrix must be 16 numbers"),
        ({"projectionMatrix": [np.nan] * 16}, "projectionMatrix must be finite"),
        ({"lightColor": [1, 2]}, "lightColor must be 3 numbers"),
        ({"lightDirection": [1, 2, np.inf]}, "lightDirection must be finite"),
    ],
)
def test_wrong_arguments_are_named(bullet, wrong, told):
    view, projection = camera()
    given = {"width": 8, "height": 8, "viewMatrix": view, "projectionMatrix": projection}
    with pytest.raises(e3d.InvalidArgumentError, match=told):
        bullet.getCameraImage(**{**given, **wrong})


def test_strange_numbers_draw_something(bullet):
    bullet.loadURDF("cube.urdf")
    view, projection = camera()
    for matrix in (np.zeros(16), np.full(16, 1e30), np.eye(4).ravel(), np.ones(16)):
        for shadow in (0, 1):
            assert bullet.getCameraImage(9, 7, matrix, projection, shadow=shadow)[0] == 9
            assert bullet.getCameraImage(9, 7, view, matrix, shadow=shadow)[1] == 7
    for direction in ([0, 0, 0], [0, 0, 1], [1e-30, 0, 0]):
        bullet.getCameraImage(9, 7, view, projection, lightDirection=direction, shadow=1)


def test_what_is_not_connected_is_pybullets_error():
    with pytest.raises(pybullet.error, match="Not connected"):
        pybullet.getCameraImage(8, 8, physicsClientId=5)


def test_soft_bodies_and_unknown_textures_are_warned_of(bullet):
    texture = bullet.loadTexture("tex256.png")
    cube = bullet.loadURDF("cube.urdf")
    from engine3d.compat.pybullet._worlds import client_of

    client_of(0).world.textures.clear()
    with pytest.warns(e3d.Engine3DWarning, match="texture 0 was loaded before install"):
        bullet.changeVisualShape(cube, -1, textureUniqueId=texture)
    bullet.resetSimulation(bullet.RESET_USE_DEFORMABLE_WORLD)
    bullet.loadSoftBody("cube.obj", useMassSpring=1, useNeoHookean=0)
    with pytest.warns(e3d.Engine3DWarning, match="soft bodies of PyBullet are not drawn"):
        bullet.getCameraImage(*SIZE, *camera())


def test_threads_take_turns(bullet):
    """Each thread gets its own camera's picture, whatever the others draw meanwhile."""
    bullet.loadURDF("r2d2.urdf", (0, 0, 0.5))
    cameras = [camera(eye=(2 + 0.2 * number, 2, 1.5)) for number in range(6)]
    alone = [arrays(bullet.getCameraImage(*SIZE, *one)) for one in cameras]

    def drawn(number):
        return arrays(bullet.getCameraImage(*SIZE, *cameras[number]))

    with ThreadPoolExecutor(6) as threads:
        for number, found in enumerate(threads.map(drawn, [0, 1, 2, 3, 4, 5] * 5)):
            for one, expected in zip(found, alone[number % 6], strict=True):
                assert np.array_equal(one, expected)
