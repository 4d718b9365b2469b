"""Files with coordinates of maps, in the viewer: looked at from near the origin."""

import numpy as np
import pytest

import engine3d as e3d
from engine3d.apps.cli import main
from engine3d.model.primitives import icosphere
from engine3d.stage.near_origin import from_file
from engine3d.stage.open_models import open_models
from engine3d.stage.overlays.selection_outline import selection_lines

UTM = np.array([500_000.0, 4_649_776.0, 120.0])


@pytest.fixture
def paths(tmp_path):
    ball = icosphere(0.5, 2)
    for name, offset in (("near.obj", 0.0), ("far.obj", UTM)):
        lines = ["v {!r} {!r} {!r}".format(*row) for row in (ball.positions + offset).tolist()]
        lines += ["f {} {} {}".format(*row) for row in (ball.faces + 1).tolist()]
        (tmp_path / name).write_text("\n".join(lines) + "\n")
    return [tmp_path / "near.obj", tmp_path / "far.obj"]


def test_the_scene_is_near_and_knows_its_place(paths):
    near, far = (open_models([path]) for path in paths)
    assert near.origin == (0, 0, 0)
    assert far.scene.bounds + far.origin == pytest.approx(near.scene.bounds + UTM, abs=1e-6)
    assert (np.abs(far.scene.bounds) < 2).all()
    assert from_file(far, UTM) == pytest.approx(UTM - far.origin)


def test_a_click_tells_the_place_in_the_file(paths):
    far = open_models(paths[1:])
    hit = far.scene.raycast((0.3, 0.2, 9), (0, 0, -1)) or far.scene.raycast(
        np.append(far.scene.bounds.mean(axis=0)[:2], 9), (0, 0, -1)
    )
    line = selection_lines(hit, far.origin)[-1]
    assert [float(part) for part in line.removeprefix("at ").split(",")] == pytest.approx(
        hit.position + far.origin, abs=1e-3
    )


def test_pictures_are_those_of_a_model_at_the_origin(paths, tmp_path):
    where = {paths[0]: np.zeros(3), paths[1]: UTM}
    outputs = []
    for path, offset in where.items():
        output = tmp_path / f"{path.stem}.png"
        options = ["--camera-position=" + ",".join(map(repr, (offset + (1, 1, 2)).tolist()))]
        options += ["--camera-focal-point=" + ",".join(map(repr, offset.tolist()))]
        options += ["--size", "120x90", "--quiet"]
        assert main(["render", str(path), "-o", str(output), *options]) == 0
        outputs.append(e3d.load_texture(output).pixels.astype(int))
    assert (np.abs(outputs[0] - outputs[1]).max(axis=2) > 2).mean() < 2e-3


def test_several_models_keep_their_distance(paths):
    both = open_models([*paths])
    assert both.origin == (0, 0, 0)
    assert both.scene.bounds[1] - both.scene.bounds[0] == pytest.approx(UTM + 1, rel=1e-6)
