"""Depth far away, models that are tiny, and models far from the origin."""

import math

import numpy as np
import pytest
from plain_picture import Renderer, render

import engine3d as e3d
from engine3d import linalg
from engine3d.io.reading.far_coordinates import origin_near
from engine3d.model.primitives import icosphere, plane


def camera_at(*place, target=(0, 0, 0), up=(0, 1, 0), **options):
    return e3d.PerspectiveCamera(0.7, **options), linalg.look_at(place, target, up)


def marks(height):
    """A road, and marks that lie a little above it."""
    scene = e3d.Scene()
    scene.add(plane((400, 400)), name="road").object.materials = [e3d.Material(color=(0.1,) * 3)]
    mark = plane((3, 12))
    mark.materials = [e3d.Material(color=(1.0, 1.0, 1.0))]
    poses = np.tile(np.eye(4), (400, 1, 1))
    poses[:, 0, 3] = np.arange(400) % 20 * 16 - 152
    poses[:, 2, 3] = np.arange(400) // 20 * 16 - 152
    poses[:, 1, 3] = height
    scene.add(e3d.InstancedMesh(mark, poses))
    return scene


def torn(scene, camera, truth):
    pictures = [render(scene, one, size=(320, 240), mode="unlit").color for one in (camera, truth)]
    return (pictures[0] != pictures[1]).any(axis=2).mean()


def test_marks_on_a_road_from_far_above():
    scene = marks(0.02)
    places = {"target": (0, 0, 1)}
    truth = camera_at(0, 500, 0, znear=400.0, zfar=600.0, **places)
    near = {"znear": 0.1, "zfar": 1251.0}
    assert torn(scene, camera_at(0, 500, 0, **near, **places), truth) > 0.01
    assert torn(scene, camera_at(0, 500, 0, **near, reversed_depth=True, **places), truth) < 1e-4


@pytest.mark.parametrize("backend", e3d.backends())
def test_reversed_depth_on_every_backend(backend):
    scene = marks(1.0)
    camera = camera_at(30, 20, 90, znear=0.1, zfar=500.0, reversed_depth=True)
    frames = [
        render(scene, camera, size=(160, 120), backend=one, outputs=("color", "ndc_depth"))
        for one in ("scalar", backend)
    ]
    assert (frames[0].color == frames[1].color).all()
    assert frames[0].ndc_depth.tobytes() == frames[1].ndc_depth.tobytes()


@pytest.mark.parametrize("zfar", [100.0, math.inf])
def test_the_planes_of_reversed_depth(zfar):
    matrix = e3d.PerspectiveCamera(znear=0.5, zfar=zfar, reversed_depth=True).projection((4, 3))
    usual = e3d.PerspectiveCamera(znear=0.5, zfar=zfar).projection((4, 3))
    assert (matrix[[0, 1, 3]] == usual[[0, 1, 3]]).all()
    at = [matrix @ (0, 0, -distance, 1) for distance in (0.5, min(zfar, 1e30))]
    assert [z / w for _, _, z, w in at] == pytest.approx([-1, 0], abs=1e-12)


def test_what_sees_the_far_plane_sees_it_there():
    scene = e3d.Scene(background=e3d.Environment.hall())
    scene.add(icosphere(0.2, 1), translation=(0.3, 0.1, 0))
    usual, turned = (
        camera_at(1, 1, 3, znear=0.1, zfar=100.0, reversed_depth=flag) for flag in (False, True)
    )
    outputs = ("color", "depth", "object_id", "instance_id", "face_id")
    with Renderer((96, 64)) as renderer:
        frames = [renderer.render(scene, one, outputs=outputs) for one in (usual, turned)]
        assert np.abs(frames[0].color.astype(int) - frames[1].color).max() <= 1
        y, x = np.argwhere(frames[0].object_id >= 0)[5].tolist()
        hits = [scene.pick(frame, x, y) for frame in frames]
    assert hits[0].face_id == hits[1].face_id
    assert hits[0].position == pytest.approx(hits[1].position, abs=1e-9)


def test_reversed_depth_is_saved(tmp_path):
    scene = e3d.Scene()
    scene.add(e3d.PerspectiveCamera(reversed_depth=True))
    scene.save(tmp_path / "a.e3d.json")
    camera = e3d.load_scene(tmp_path / "a.e3d.json").nodes[0].object
    assert camera.reversed_depth
    assert repr(camera).endswith("reversed_depth=True)")


def coverage(scale):
    scene = e3d.Scene()
    scene.add(icosphere(1.0, 3), scale=scale)
    return render(scene, size=(160, 120), outputs=("face_id", "color"))


@pytest.mark.parametrize("scale", [2.0**-18, 2.0**-27, 2.0**-60, 2.0**-90])
def test_tiny_models_are_drawn_as_others(scale):
    tiny, usual = coverage(scale), coverage(1.0)
    assert (tiny.face_id == usual.face_id).all()
    assert np.abs(tiny.color.astype(int) - usual.color).max() <= 1


UTM = (500_000.0, 4_649_776.0, 120.0)


def test_where_origins_are():
    low, high = np.array(UTM), np.array(UTM) + (3.0, 2.0, 1.0)
    origin = origin_near(low, high)
    assert (origin % 4 == 0).all()
    assert (np.abs(origin - low) <= 4).all()
    assert origin_near(low, low) is None
    assert origin_near(low, low + 1e5) is None
    assert origin_near(low * np.inf, high) is None


def text_of(kind, positions, faces):
    rows = [" ".join(map(repr, row)) for row in positions.tolist()]
    if kind == "obj":
        return "\n".join([f"v {r}" for r in rows] + ["f {} {} {}".format(*(f + 1)) for f in faces])
    if kind == "off":
        cells = ["3 {} {} {}".format(*f) for f in faces]
        return "\n".join(["OFF", f"{len(rows)} {len(faces)} 0", *rows, *cells])
    if kind == "ply":
        head = ["ply", "format ascii 1.0", f"element vertex {len(rows)}"]
        head += [f"property double {axis}" for axis in "xyz"]
        head += [f"element face {len(faces)}", "property list uchar int vertex_indices"]
        cells = ["3 {} {} {}".format(*f) for f in faces]
        return "\n".join([*head, "end_header", *rows, *cells])
    lines = ["solid a"]
    for face in faces:
        lines += ["facet normal 0 0 0", "outer loop", *(f"vertex {rows[i]}" for i in face)]
        lines += ["endloop", "endfacet"]
    return "\n".join([*lines, "endsolid a"])


@pytest.mark.parametrize("kind", ["obj", "off", "ply", "stl"])
def test_models_of_maps(tmp_path, kind, recwarn):
    ball = icosphere(0.5, 2)
    places, faces = np.unique(
        ball.positions[ball.faces].reshape(-1, 3), axis=0, return_inverse=True
    )
    places, faces = places.astype(np.float64), faces.reshape(-1, 3)
    paths = tmp_path / f"near.{kind}", tmp_path / f"far.{kind}"
    for path, offset in zip(paths, (0.0, UTM), strict=True):
        path.write_text(text_of(kind, places + offset, faces) + "\n")
    near, far = (e3d.load_scene(path) for path in paths)
    assert not recwarn.list
    assert far.bounds == pytest.approx(near.bounds + UTM, abs=1e-6)
    assert (np.abs(far.nodes[0].object.positions) < 2).all()
    pictures = []
    for scene in (near, far):
        frame = render(scene, size=(160, 120), outputs=("face_id",))
        pictures.append(frame.face_id)
    assert (pictures[0] != pictures[1]).mean() < 2e-3
    # One mesh is in the file's coordinates, as coarse as they are.
    with pytest.warns(e3d.Engine3DWarning, match="coarse"):
        assert e3d.load_mesh(paths[1]).bounds == pytest.approx(far.bounds, abs=0.5)


def test_a_scene_file_keeps_the_place(tmp_path):
    ball = icosphere(0.5, 1)
    path = tmp_path / "far.obj"
    path.write_text(text_of("obj", ball.positions.astype(np.float64) + UTM, ball.faces))
    scene = e3d.load_scene(path)
    scene.save(tmp_path / "s.e3d.json")
    again = e3d.load_scene(tmp_path / "s.e3d.json")
    assert (again.bounds == scene.bounds).all()
    assert (again.nodes[0].object.positions == scene.nodes[0].object.positions).all()
