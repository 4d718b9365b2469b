"""Stereo pairs: disparity against projections of both cameras, masks against flow."""

import numpy as np
import pytest
from sensors.moving_scene import LENS, SIZE, MovingScene

import engine3d as e3d
from engine3d.sensors import Moment, StereoCamera

POSE = e3d.look_at((0.4, 0.7, 5.0), (0, 0, 0))
LENSES = [
    LENS,
    e3d.PerspectiveCamera(0.7, znear=0.2, zfar=np.inf, reversed_depth=True),
    e3d.IntrinsicsCamera(130.0, 110.0, 48.0, 52.0),
]


@pytest.mark.parametrize("lens", LENSES, ids=lambda lens: type(lens).__name__)
def test_disparity_is_the_difference_of_columns(lens):
    moving = MovingScene().at(0.3)
    stereo = StereoCamera(lens, 0.25)
    pair = stereo.render(
        e3d.Renderer(SIZE, samples=1), moving.scene, POSE, outputs=("world_position",)
    )
    left, right = pair.left, pair.right
    shown = left.object_id >= 0
    place, _ = right.project(left.world_position[shown])
    own, _ = left.project(left.world_position[shown])
    assert np.abs(own[:, 0] - place[:, 0] - pair.left_disparity[shown]).max() < 1e-3
    assert np.abs(own[:, 1] - place[:, 1]).max() < 1e-4  # rectified
    assert pair.left_disparity[shown].min() > 0 and not pair.left_disparity[~shown].any()
    back, _ = left.project(right.world_position[right.object_id >= 0])
    own, _ = right.project(right.world_position[right.object_id >= 0])
    apart = back[:, 0] - own[:, 0]
    assert np.abs(apart - pair.right_disparity[right.object_id >= 0]).max() < 1e-3


def test_masks_are_those_of_the_flow_between_the_eyes():
    moving = MovingScene().at(0.0)
    pair = StereoCamera(LENS, 0.4).render(e3d.Renderer(SIZE, samples=1), moving.scene, POSE)
    one, two = Moment(pair.left, moving.scene), Moment(pair.right, moving.scene)
    there, back = one.flow_to(two), two.flow_to(one)
    assert np.array_equal(there.visible, pair.left_visible)
    assert np.array_equal(back.visible, pair.right_visible)
    assert there.occluded.any() and back.occluded.any()
    # what shows in both has about the same disparity in both
    rows, columns = np.nonzero(pair.left_visible)
    others = np.floor(columns + 0.5 - pair.left_disparity[rows, columns]).astype(int)
    apart = pair.left_disparity[rows, columns] - pair.right_disparity[rows, others]
    assert np.percentile(np.abs(apart), 98) < 0.3


def test_outputs_are_those_that_were_asked_for_and_more():
    scene = e3d.Scene()
    scene.add(e3d.box())
    pair = StereoCamera(LENS, 0.1).render(e3d.Renderer(SIZE), scene, POSE, outputs=("normal",))
    assert {"normal", "depth", "object_id"} <= set(pair.left.outputs)
    assert "color" not in pair.left.outputs


def test_a_stereo_camera_is_a_pinhole_camera_with_a_baseline():
    scene, renderer = e3d.Scene(), e3d.Renderer(SIZE)
    flat = StereoCamera(e3d.OrthographicCamera(1.0), 0.1)
    with pytest.raises(e3d.InvalidArgumentError, match="pinhole"):
        flat.render(renderer, scene, POSE)
    with pytest.raises(e3d.InvalidArgumentError, match="pinhole"):
        flat.disparity([1.0], SIZE)
    with pytest.raises(e3d.InvalidArgumentError, match="pinhole camera, whose pair is rectified"):
        StereoCamera(e3d.EquirectangularCamera(), 0.1)
    for baseline in (0.0, -1.0, np.inf, "wide"):
        with pytest.raises(e3d.InvalidArgumentError, match="baseline"):
            StereoCamera(LENS, baseline)
    with pytest.raises(e3d.InvalidArgumentError, match="camera"):
        StereoCamera((LENS, POSE), 0.1)
    with pytest.raises(e3d.InvalidArgumentError, match="scaled"):
        StereoCamera(LENS, 0.1).render(renderer, scene, POSE @ np.diag([2, 2, 2, 1]))
    with pytest.raises(TypeError, match="outputz"):
        StereoCamera(LENS, 0.1).render(renderer, scene, POSE, outputz=("color",))
