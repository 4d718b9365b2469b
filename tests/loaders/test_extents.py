"""Models too far away for 32-bit floats: warned of once, by every loader. None is too small."""

import warnings

import numpy as np
import pytest
from plain_picture import render

import engine3d as e3d

BALL = e3d.uv_sphere(0.5, (32, 16))
UTM = (500_000.0, 4_649_776.0, 0.0)


def written(path, positions):
    """A file of text with all digits: ASC, OBJ, OFF, PLY or STL."""
    rows = [" ".join(map(repr, row)) for row in positions.tolist()]
    faces = BALL.faces.tolist()
    if path.suffix == ".obj":
        lines = [f"v {row}" for row in rows]
        lines += ["f " + " ".join(str(i + 1) for i in face) for face in faces]
    elif path.suffix == ".off":
        lines = ["OFF", f"{len(rows)} {len(faces)} 0", *rows]
        lines += ["3 " + " ".join(map(str, face)) for face in faces]
    elif path.suffix == ".ply":
        lines = ["ply", "format ascii 1.0", f"element vertex {len(rows)}"]
        lines += [f"property double {axis}" for axis in "xyz"]
        lines += [f"element face {len(faces)}", "property list uchar int vertex_indices"]
        lines += ["end_header", *rows, *("3 " + " ".join(map(str, face)) for face in faces)]
    elif path.suffix == ".asc":
        lines = ['Named object: "Ball"', f"Tri-mesh, Vertices: {len(rows)} Faces: {len(faces)}"]
        lines += ["Vertex list:"]
        lines += [
            f"Vertex {k}: X:{x!r} Y:{y!r} Z:{z!r}" for k, (x, y, z) in enumerate(positions.tolist())
        ]
        lines += ["Face list:"]
        lines += [f"Face {k}: A:{a} B:{b} C:{c}" for k, (a, b, c) in enumerate(faces)]
    else:
        lines = ["solid ball"]
        for face in faces:
            lines += ["facet normal 0 0 0", "outer loop", *(f"vertex {rows[i]}" for i in face)]
            lines += ["endloop", "endfacet"]
        lines += ["endsolid ball"]
    path.write_text("\n".join(lines) + "\n")
    return path


def ball(scale=1.0, offset=(0.0, 0.0, 0.0)):
    return BALL.positions.astype(np.float64) * scale + offset


@pytest.mark.parametrize("suffix", [".asc", ".obj", ".off", ".ply", ".stl"])
def test_it_is_warned_of(tmp_path, suffix):
    path = written(tmp_path / f"model{suffix}", ball(100.0, UTM))
    with pytest.warns(e3d.Engine3DWarning, match="0.5 apart.*100 across") as seen:
        mesh = e3d.load_mesh(path)
    assert len(seen) == 1 and len(mesh.warnings) == 1
    assert str(seen[0].message) == mesh.warnings[0]


@pytest.mark.parametrize("suffix", [".asc", ".obj", ".off", ".ply", ".stl"])
def test_scenes_keep_the_distance_in_their_nodes(tmp_path, suffix):
    path = written(tmp_path / f"model{suffix}", ball(100.0, UTM))
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        scene = e3d.load_scene(path)
    assert not scene.warnings


def covered(mesh):
    scene = e3d.Scene()
    scene.add(mesh)
    return int((render(scene, size=(320, 240), outputs=("object_id",)).object_id >= 0).sum())


@pytest.mark.parametrize("scale", [1e-20, 1e-8, 1e-5, 1.0, 1e6, 1e30])
def test_models_of_any_size_are_drawn_whole(tmp_path, scale):
    path = written(tmp_path / "model.obj", ball(scale))
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        mesh = e3d.load_mesh(path)
    assert covered(mesh) == covered(BALL)


@pytest.mark.parametrize("size", [10_000.0, 3_000.0])
def test_a_large_model_far_away_is_fine(tmp_path, size):
    path = written(tmp_path / "model.obj", ball(size, UTM))
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        e3d.load_mesh(path)


@pytest.mark.parametrize("text", ["v 1e7 0 0\np 1\n", "v 0 0 0\nv 0 0 0\nl 1 2\n"])
def test_a_point_has_no_size(tmp_path, text):
    path = tmp_path / "model.obj"
    path.write_text(text)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        e3d.load_mesh(path)
