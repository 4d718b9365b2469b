"""Models of BOP data sets: the format's rules, and that models, poses and pictures agree."""

import json
import shutil

import numpy as np
import pytest
from datasets.conftest import HEIGHT, WIDTH, sample

import engine3d as e3d
from engine3d.apps.datasets.bop_models import STORE, diameter, shape_of, write_models
from engine3d.apps.datasets.samples import Thing
from engine3d.batch import read_manifest, run
from engine3d.datasets import BopWriter, write_dataset

BOP = {"depth_scale": 0.5, "categories": ["ball", "box", "pair"]}
SCRIPT = """
import engine3d as e3d

def build(scene, generator, size=0.3):
    ring = scene.add(e3d.torus(size, 0.1), translation=(generator.uniform(-0.2, 0.2), 0, 0))
    return {"labels": {ring: "ring"}}
"""


@pytest.fixture(scope="module")
def bop(tmp_path_factory):
    """A data set of two pictures, whose balls have two sizes."""
    folder, writer = tmp_path_factory.mktemp("bop"), BopWriter(**BOP)
    with e3d.Renderer((WIDTH, HEIGHT), samples=1, threads=1) as renderer:
        samples = [sample(renderer, writer.outputs, index) for index in range(2)]
        with pytest.warns(e3d.Engine3DWarning, match="things of 'ball' have several shapes each"):
            return folder, write_dataset(folder, writer, samples)


def read_ply(path):
    """As bop_toolkit reads it: of text, triangles, types of a few names."""
    head, _, body = path.read_text("ascii").partition("end_header\n")
    lines = head.splitlines()
    assert lines[:2] == ["ply", "format ascii 1.0"]
    counts = [int(line.split()[-1]) for line in lines if line.startswith("element")]
    names = [line.split()[-1] for line in lines if line.startswith("property float")]
    assert names == ["x", "y", "z", "nx", "ny", "nz"]
    assert "property list uchar int vertex_indices" in lines
    rows = body.splitlines()
    assert len(rows) == sum(counts)
    vertices = np.array([row.split() for row in rows[: counts[0]]], float)
    faces = np.array([row.split() for row in rows[counts[0] :]], int)
    assert (faces[:, 0] == 3).all() and faces.shape[1] == 4
    return vertices[:, :3], vertices[:, 3:], faces[:, 1:]


def test_each_object_with_one_shape_has_a_model(bop):
    folder, written = bop
    files = ["models_info.json", "obj_000002.ply", "obj_000003.ply"]
    files = [f"{place}/{name}" for place in ("models", "models_eval") for name in files]
    assert sorted(path for path in written if path.startswith("models")) == files
    for name in ("models_info.json", "obj_000002.ply", "obj_000003.ply"):
        one, other = (folder / place / name for place in ("models", "models_eval"))
        assert one.read_bytes() == other.read_bytes()
    infos = json.loads((folder / "models" / "models_info.json").read_text())
    assert list(infos) == ["2", "3"]
    for number, info in infos.items():
        points, normals, faces = read_ply(folder / "models" / f"obj_{int(number):06d}.ply")
        apart = points[:, np.newaxis] - points
        assert info["diameter"] == pytest.approx(np.linalg.norm(apart, axis=2).max(), abs=1e-9)
        for axis, name in enumerate("xyz"):
            assert info[f"min_{name}"] == points[:, axis].min()
            assert info[f"size_{name}"] == np.ptp(points[:, axis])
        np.testing.assert_allclose(np.linalg.norm(normals, axis=1), 1.0, atol=1e-6)
        # Faces are wound so that their normals are those of the vertices.
        a, b, c = (points[faces[:, k]] for k in range(3))
        assert ((np.cross(b - a, c - a) * normals[faces[:, 0]]).sum(axis=1) > 0).all()
    assert infos["2"]["size_x"] == pytest.approx(800.0)  # a box of 0.8 metres
    assert infos["3"]["size_y"] == pytest.approx(400.0)  # two boxes, one moved by 0.2 metres


def test_what_has_no_triangles_is_told_of(tmp_path):
    cloud = e3d.Scene().add(e3d.Mesh([(0, 0, 0), (1, 0, 0)], points=[0, 1]))
    shape, files = shape_of(Thing(cloud, "cloud", (cloud,)), 1000.0)
    assert shape is None and not files
    with pytest.warns(e3d.Engine3DWarning, match="things of 'cloud' have no triangles") as told:
        assert not list(write_models(tmp_path, {"cloud": 1}, [("cloud", shape)]))
    assert len(told) == 1 and not (tmp_path / "models").exists()


def test_models_in_their_poses_are_what_the_masks_show(bop):
    folder, _ = bop
    scene = folder / "train" / "000000"
    truth, infos, cameras = (
        json.loads((scene / f"{name}.json").read_text())
        for name in ("scene_gt", "scene_gt_info", "scene_camera")
    )
    checked = 0
    for image, entries in truth.items():
        k = np.array(cameras[image]["cam_K"]).reshape(3, 3)
        for entry, info in zip(entries, infos[image], strict=True):
            path = folder / "models" / f"obj_{entry['obj_id']:06d}.ply"
            if not path.exists():
                continue
            rotation = np.array(entry["cam_R_m2c"]).reshape(3, 3)
            u, v, w = k @ (read_ply(path)[0] @ rotation.T + entry["cam_t_m2c"]).T
            x, y, width, height = info["bbox_obj"]
            # Pixels show what their middle is in: corners may end before the next middle.
            low, high = np.array([x, y]), np.array([x + width, y + height])
            beyond = low - ((u / w).min(), (v / w).min()), ((u / w).max(), (v / w).max()) - high
            assert np.min(beyond) >= 0.0 and np.max(beyond) < 1.5
            checked += 1
    assert checked == 4


def test_the_camera_is_that_of_the_pictures(bop):
    folder, written = bop
    assert "camera.json" in written
    said = json.loads((folder / "camera.json").read_text())
    cameras = json.loads((folder / "train" / "000000" / "scene_camera.json").read_text())
    k = np.array(cameras["0"]["cam_K"]).reshape(3, 3)
    assert [said[name] for name in ("fx", "fy", "cx", "cy")] == [*k.diagonal()[:2], *k[:2, 2]]
    assert (said["width"], said["height"], said["depth_scale"]) == (WIDTH, HEIGHT, 0.5)


def test_a_batch_writes_each_shape_once_and_resumes(tmp_path):
    (tmp_path / "script.py").write_text(SCRIPT)
    task = {"script": "script.py", "size": [32, 24], "matrix": {"seed": {"count": 3}}}
    manifest = {"version": 1, "dataset": {"writer": "bop"}, "tasks": [task]}
    (tmp_path / "m.json").write_text(json.dumps(manifest))
    tasks, writer = read_manifest(tmp_path / "m.json")
    out = tmp_path / "out"
    first = run(tasks, out, writer=writer, jobs=1)
    shapes = sorted((out / STORE).iterdir())
    assert len(shapes) == 2 and (out / "models" / "obj_000001.ply").exists()
    assert "  models/models_info.json\n" in (out / "SHA256SUMS").read_text()
    before = [path.stat().st_mtime_ns for path in shapes]
    again = run(tasks, out, writer=writer, jobs=1)
    assert again.hash == first.hash
    assert [path.stat().st_mtime_ns for path in shapes] == before
    assert run(tasks, out, writer=writer, jobs=1, resume=True).done_before == 3
    shutil.rmtree(out / STORE)
    again = run(tasks, out, writer=writer, jobs=1, resume=True)
    assert (again.drawn, again.done_before, again.hash) == (1, 2, first.hash)


@pytest.mark.parametrize("shape", ["ball", "box", "line", "cloud", "point"])
def test_diameters(shape):
    random = np.random.default_rng(3)
    points = random.normal(size=(1500, 3))
    if shape == "ball":
        points /= np.linalg.norm(points, axis=1)[:, np.newaxis]
    elif shape == "box":
        points = random.integers(0, 2, (1500, 3)) * np.array([3.0, 2.0, 1.0])
    elif shape == "line":
        points = points[:, :1] * np.array([[1.0, 2.0, 2.0]])
    elif shape == "point":
        points = points[:1]
    expected = np.linalg.norm(points[:, np.newaxis] - points, axis=2).max()
    assert diameter(points) == pytest.approx(expected, abs=1e-12)
