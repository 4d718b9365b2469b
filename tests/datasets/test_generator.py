"""Numbers that follow from a seed: always the same ones, and evenly distributed."""

import hashlib
import subprocess
import sys

import numpy as np
import pytest

import engine3d as e3d
from engine3d.datasets import Generator


def test_the_numbers_stay_the_same():
    # Whatever changes these changes every data set that was ever made.
    generator = Generator(7)
    assert [generator.integer(0, 1000) for _ in range(5)] == [907, 220, 804, 217, 919]
    assert generator.uniform().hex() == "0x1.5619d1517e2d6p-2"
    assert Generator(7, "light").uniform().hex() == "0x1.1baa9bca9c13cp-1"


def test_another_process_gets_the_same():
    code = (
        "from engine3d.datasets import Generator; g = Generator(3, 'a', 4);"
        "print(g.direction().tobytes().hex(), g.rotation().tobytes().hex())"
    )
    told = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True).stdout
    generator = Generator(3).fork("a").fork(4)
    assert told.split() == [
        generator.direction().tobytes().hex(),
        generator.rotation().tobytes().hex(),
    ]


def test_forks_do_not_depend_on_what_was_asked_before():
    one, other = Generator(5), Generator(5)
    one.uniform(0, 1, 100)
    assert one.fork("camera").uniform() == other.fork("camera").uniform()
    first = {Generator(5).fork(name).uniform() for name in ("a", "b", 0, "0", 1)}
    assert len(first) == 5


def test_numbers_are_even():
    generator = Generator(11)
    values = generator.uniform(-2.0, 6.0, 20000)
    assert values.min() >= -2.0 and values.max() < 6.0
    assert np.histogram(values, 8, (-2, 6))[0].min() > 2300
    whole = generator.integers(-3, 4, (50, 100))
    assert whole.shape == (50, 100) and set(whole.ravel().tolist()) == set(range(-3, 4))
    assert np.bincount(whole.ravel() + 3).min() > 600
    singles = [generator.integer(0, 3) for _ in range(900)]
    assert min(map(singles.count, range(3))) > 240
    assert 0.2 < np.mean([generator.chance(0.25) for _ in range(2000)]) < 0.3


def test_directions_and_rotations_are_even():
    generator = Generator(2)
    directions = np.array([generator.direction() for _ in range(2000)])
    np.testing.assert_allclose(np.linalg.norm(directions, axis=1), 1.0, atol=1e-14)
    assert np.abs(directions.mean(axis=0)).max() < 0.05
    turns = np.array([generator.rotation() for _ in range(1000)])
    np.testing.assert_allclose(np.linalg.norm(turns, axis=1), 1.0, atol=1e-14)
    x_axes = e3d.linalg.quaternion_to_matrix(turns)[:, :3, 0]
    assert np.abs(x_axes.mean(axis=0)).max() < 0.07


def test_choices():
    generator = Generator(9)
    assert sorted(generator.sample("abcde", 5)) == list("abcde")
    assert {generator.choice("xyz") for _ in range(60)} == set("xyz")


@pytest.mark.parametrize(
    "make",
    [
        lambda: Generator(1.5),
        lambda: Generator(True),
        lambda: Generator(1, 2.5),
        lambda: Generator(1).integer(3, 3),
        lambda: Generator(1).integers(0, 2**33, 4),
        lambda: Generator(1).sample("ab", 3),
        lambda: Generator(1).uniform(0.0, float("inf")),
    ],
)
def test_what_is_no_seed_or_range_is_an_error(make):
    with pytest.raises(e3d.InvalidArgumentError):
        make()


def test_random_objects_stay_the_same():
    from engine3d.datasets import random_camera, random_light, random_pose, random_texture, scatter

    scene = e3d.Scene()
    scene.add(e3d.box())
    camera, pose = random_camera(Generator(1), scene)
    light = random_light(Generator(2))
    held = [pose, random_pose(Generator(3), (0, 0, 0), (1, 2, 3)), light.direction]
    held += [np.array([camera.yfov, camera.znear, camera.zfar, light.intensity])]
    held += [random_texture(Generator(4), 32, one).pixels for one in ("checker", "stripes")]
    held += [random_texture(Generator(5), 32, one).pixels for one in ("dots", "noise")]
    held += [np.array(scatter(Generator(6), [0.5, 0.4, 0.3], 2.0))]
    digest = hashlib.sha256(b"".join(np.ascontiguousarray(one).tobytes() for one in held))
    assert digest.hexdigest()[:16] == "58fa9b1a1830dcf7"


def test_scattered_discs_keep_apart():
    from engine3d.datasets import scatter

    radii = [0.6] * 12
    places = scatter(Generator(8), radii, 2.0)
    found = np.array([place for place in places if place is not None])
    assert 4 < len(found) <= 12 and np.abs(found).max() <= 1.4
    apart = np.linalg.norm(found[:, None] - found[None], axis=2)[~np.eye(len(found), dtype=bool)]
    assert apart.min() >= 1.2
    assert scatter(Generator(8), [3.0], 2.0) == [None]


def test_a_random_camera_sees_the_scene():
    from engine3d.datasets import random_camera

    scene = e3d.Scene(background=None)
    scene.add(e3d.icosphere(1.0, 2), translation=(5, 1, 0))
    for seed in range(4):
        frame = e3d.render(scene, random_camera(Generator(seed), scene), size=(24, 24))
        shown = frame.color[..., 3] > 0
        assert shown.any() and not shown[[0, -1]].any() and not shown[:, [0, -1]].any()
