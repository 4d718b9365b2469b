"""Where links of robots are, beside yourdfpy and PyBullet; needs pybullet_data's robots."""

import logging
import warnings

import numpy as np
import pytest
from loaders.robots import pose

import engine3d as e3d

pybullet_data = pytest.importorskip("pybullet_data", exc_type=ImportError)

FOLDER = pybullet_data.getDataPath()
NAMES = (
    *("r2d2.urdf", "kuka_iiwa/model.urdf", "humanoid/humanoid.urdf", "laikago/laikago.urdf"),
    *("franka_panda/panda.urdf", "racecar/racecar.urdf", "quadruped/minitaur.urdf"),
    *("pr2_gripper.urdf", "bicycle/bike.urdf", "table/table.urdf", "cartpole.urdf"),
    *("a1/a1.urdf", "mini_cheetah/mini_cheetah.urdf", "xarm/xarm6_robot.urdf"),
)
SINGLE = ("revolute", "continuous", "prismatic")


@pytest.fixture(params=NAMES)
def moved(request):
    """A robot of pybullet_data with joints at random values within their limits."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", e3d.Engine3DWarning)
        (robot,) = e3d.load_scene(f"{FOLDER}/{request.param}").robots.values()
    random = np.random.default_rng(len(request.param))
    values = {}
    for name, joint in robot.joints.items():
        if name in robot.values and joint.kind in SINGLE:
            low, high = joint.limits or (-2.0, 2.0)
            values[name] = float(random.uniform(max(low, -2.0), min(high, 2.0)))
    robot.set_joints(values)
    return request.param, robot


def test_links_are_where_yourdfpy_has_them(moved):
    yourdfpy = pytest.importorskip("yourdfpy", exc_type=ImportError)
    logging.getLogger("yourdfpy").setLevel(logging.ERROR)
    name, robot = moved
    try:
        other = yourdfpy.URDF.load(
            f"{FOLDER}/{name}", load_meshes=False, load_collision_meshes=False
        )
        joints = other.actuated_joint_names
        other.update_cfg({one: robot.joints[one].value for one in joints})
    except Exception as error:
        pytest.skip(f"yourdfpy does not read it: {error}")
    for link in robot.links:
        there = other.get_transform(link, other.base_link)
        np.testing.assert_allclose(robot.link_pose(link), there, atol=1e-12)


def test_links_are_where_pybullet_has_them(moved):
    pybullet = pytest.importorskip("pybullet", exc_type=ImportError)
    name, robot = moved
    client = pybullet.connect(pybullet.DIRECT)
    try:
        body = pybullet.loadURDF(f"{FOLDER}/{name}", useFixedBase=True, physicsClientId=client)
        infos = [
            pybullet.getJointInfo(body, number, physicsClientId=client)
            for number in range(pybullet.getNumJoints(body, physicsClientId=client))
        ]
        for info in infos:
            joint = robot.joints.get(info[1].decode())
            if joint is not None and joint.kind in SINGLE:
                pybullet.resetJointState(body, info[0], joint.value, physicsClientId=client)
        base = robot.link_pose(pybullet.getBodyInfo(body, physicsClientId=client)[0].decode())
        place = pybullet.getBasePositionAndOrientation(body, physicsClientId=client)
        inertial = pybullet.getDynamicsInfo(body, -1, physicsClientId=client)[3:5]
        root = _pose(pybullet, *place) @ np.linalg.inv(_pose(pybullet, *inertial))
        for info in infos:
            state = pybullet.getLinkState(body, info[0], 0, 1, physicsClientId=client)
            here = np.linalg.inv(base) @ robot.link_pose(info[12].decode())
            there = np.linalg.inv(root) @ _pose(pybullet, *state[4:6])
            np.testing.assert_allclose(here, there, atol=2e-6)
    finally:
        pybullet.disconnect(client)


def _pose(pybullet, where, turned):
    return pose(where, np.reshape(pybullet.getMatrixFromQuaternion(turned), (3, 3)))
