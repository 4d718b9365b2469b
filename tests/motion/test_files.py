"""Animated files of the corpus stand at each time where an independent reader has them."""

import json

import numpy as np
import pytest
from shared_corpus import SHARED

import engine3d as e3d
from engine3d import linalg
from engine3d.model.scene.instances import instance_matrices
from engine3d.model.scene.shown import placing_pose, shown_object

MOVING = ("animation_list", "skin_list", "morph_targets")
GLTF = SHARED / "gltf"


def animated():
    """Files with animations, and those with skins or morph targets at rest."""
    try:
        cases = json.loads((GLTF / "expected.json").read_text())
    except FileNotFoundError:
        return []
    return [
        pytest.param(case, id=case["file"])
        for case in cases
        if case.get("outcome") == "ok"
        and "anim_pointer" not in case.get("features", ())
        and case.get("expect", {}).get("bbox_rest")
        and any(case["expect"].get(key) for key in MOVING)
    ]


def box_of(scene):
    """The box of all vertices that faces, lines or points use, in the world."""
    scene.data.update()
    low, high = np.full(3, np.inf), np.full(3, -np.inf)
    for node in scene.nodes:
        obj = shown_object(node)
        if isinstance(obj, e3d.InstancedMesh):
            mesh = obj.mesh
            poses = linalg.multiply(node.world_pose, instance_matrices(obj.poses))
        elif isinstance(obj, e3d.Mesh):
            mesh, poses = obj, [placing_pose(node)]
        else:
            continue
        for pose in poses:
            points = linalg.transform_points(pose, mesh.positions)
            low = np.minimum(low, points.min(axis=0, initial=np.inf))
            high = np.maximum(high, points.max(axis=0, initial=-np.inf))
    return np.array([low, high])


def agree(found, expected):
    expected = np.array(expected)
    size = max(np.abs(expected[1] - expected[0]).max(), np.abs(expected).max())
    return np.abs(found - expected).max() <= 1e-5 * size


@pytest.mark.parametrize("case", animated())
def test_files_move_as_expected(case):
    scene = e3d.load_scene(GLTF / case["file"])
    expect = case["expect"]
    assert agree(box_of(scene), expect["bbox_rest"])
    clips = list(scene.animations.values())
    assert len(clips) == len(expect.get("animation_list", ()))
    for clip, told in zip(clips, expect.get("animation_list", ()), strict=True):
        assert np.isclose(clip.duration, told["duration"], rtol=1e-6)
        player = e3d.AnimationPlayer(scene)
        player.loop = "once"
        player.play(clip)
        for share, (time, box) in zip((0.0, 0.25, 0.5, 1.0), told["bbox_at"], strict=True):
            assert abs(time - share * clip.duration) < 1e-5
            player.seek(share * clip.duration)
            if share == 1.0 and "STEP" in told["interpolations"]:
                continue  # the reader of the corpus has the key before the last there
            assert agree(box_of(scene), box), (told["name"], time)
        player.stop()
        assert agree(box_of(scene), expect["bbox_rest"])
