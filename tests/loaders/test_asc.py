"""3D Studio ASCII, feature by feature."""

import math

import numpy as np
import pytest
from PIL import Image

from engine3d.errors import FileFormatError
from engine3d.loaders import load_document, load_mesh

HEADER = "Ambient light color: Red=0.3 Green=0.2 Blue=0.1\n\n"
SQUARE = """Named object: "Square"
Tri-mesh, Vertices: 4     Faces: 2
Vertex list:
Vertex 0:  X:0     Y:0     Z:0
Vertex 1:  X:2     Y:0     Z:0
Vertex 2:  X:2     Y:2     Z:0
Vertex 3:  X:0     Y:2     Z:0
Face list:
Face 0:    A:0 B:1 C:2 AB:1 BC:1 CA:0
Material:"r255g128b0a0"
Smoothing:  1
Face 1:    A:0 B:2 C:3 AB:0 BC:1 CA:1
Material:"BRICK"
Smoothing:  1
"""
ROOF = """Named object: "Roof"
Tri-mesh, Vertices: 4     Faces: 2
Vertex list:
Vertex 0:  X:0 Y:0 Z:1
Vertex 1:  X:1 Y:0 Z:1
Vertex 2:  X:0 Y:1 Z:0
Vertex 3:  X:0 Y:-1 Z:0
Face list:
Face 0:    A:0 B:1 C:2 AB:1 BC:1 CA:1
{0}Face 1:    A:1 B:0 C:3 AB:1 BC:1 CA:1
{1}"""


@pytest.fixture
def document(write):
    return lambda content: load_document(write("model.asc", content))


def test_a_square(document):
    (name, mesh, pose), *others = document(HEADER + SQUARE).objects
    assert (name, pose, others) == ("Square", None, [])
    assert mesh.faces.tolist() == [[0, 1, 2], [0, 2, 3]]
    assert mesh.edge_visible.tolist() == [[True, True, False], [False, True, True]]
    assert mesh.polygons.tolist() == [0, 0]
    assert mesh.uvs is None
    assert (mesh.normals == [0, 0, 1]).all()


def test_materials_are_names_and_some_names_are_colors(document):
    mesh = document(HEADER + SQUARE).objects[0].mesh
    assert [m.name for m in mesh.materials] == ["r255g128b0a0", "BRICK"]
    assert mesh.materials[0].color == (255, 128, 0)
    assert mesh.material_ids.tolist() == [0, 1]


@pytest.mark.parametrize("end", ["\n", "\r\n", "\r"])
def test_line_ends_page_marks_and_control_z(document, end):
    page = "\n\n" + " " * 37 + "Page 1\n\n\f\n"
    text = HEADER + SQUARE.replace("Vertex 2", page + "Vertex 2").replace("Face 1", page + "Face 1")
    data = text.replace("\n", end).encode() + b"\x1a\0\0garbage"
    parsed = document(data)
    assert len(parsed.objects[0].mesh.faces) == 2
    assert parsed.warnings == []


def test_several_objects_are_merged_by_load_mesh(write):
    other = SQUARE.replace("Square", "Other").replace("Z:0", "Z:5")
    mesh = load_mesh(write("model.asc", HEADER + SQUARE + "\n" + other))
    assert len(mesh.faces) == 4
    assert len(mesh.materials) == 2
    assert mesh.bounds[1].tolist() == [2, 2, 5]
    assert mesh.groups["Other"].tolist() == [2, 3]


def test_texture_coordinates(document):
    text = HEADER + SQUARE.replace("Z:0\n", "Z:0     U:0.5     V:0.25\n")
    mesh = document(text.replace("Vertex list", "Mapped\nVertex list")).objects[0].mesh
    assert mesh.uvs.tolist() == [[0.5, 0.25]] * 4


def test_the_image_that_bears_the_models_name(document, tmp_path):
    Image.new("RGB", (1, 1), (1, 2, 3)).save(tmp_path / "model.tga")
    mesh = document(HEADER + SQUARE.replace("Z:0\n", "Z:0 U:0 V:0\n")).objects[0].mesh
    assert all(material.texture is not None for material in mesh.materials)


@pytest.mark.parametrize(
    ("first", "second", "is_shared"),
    [
        ("", "", False),
        ("Smoothing:  1\n", "Smoothing:  1\n", True),
        ("Smoothing:  1\n", "Smoothing:  2\n", False),
        ("Smoothing:  1, 7\n", "Smoothing:  7, 32\n", True),
        ("Smoothing:  1\n", "", False),
    ],
)
def test_faces_are_smooth_where_they_share_a_group(document, first, second, is_shared):
    mesh = document(HEADER + ROOF.format(first, second)).objects[0].mesh
    one, other = mesh.normals[mesh.faces[0, 0]], mesh.normals[mesh.faces[1, 1]]
    assert np.array_equal(one, other) == is_shared
    if not is_shared:
        assert np.allclose(one, np.array([0, 1, 1]) / math.sqrt(2))


def test_lights_and_cameras(document):
    text = """Named object: "Lamp"
Direct light
Position:  X:1 Y:2 Z:3
Light color: Red=1 Green=0.5 Blue=0

Named object: "Spot"
Direct light
Position: X:0	Y:0	Z:9
Spotlight to: X:0	Y:0	Z:0
Hotspot size: 44 degrees
Falloff size: 90 degrees
Light color: Red=1	Green=1	Blue=1

Named object: "Camera"
Camera (50.0mm)
Position:  X:0 Y:-5 Z:1
Target:  X:0 Y:0 Z:0
Bank angle: 180 degrees

"""
    parsed = document(HEADER + text + SQUARE)
    ambient, lamp, spot = parsed.lights
    assert (ambient.kind, ambient.color) == ("ambient", (0.3, 0.2, 0.1))
    assert (lamp.kind, lamp.name, lamp.position) == ("point", "Lamp", (1, 2, 3))
    assert lamp.color == (1, 0.5, 0)
    assert (spot.kind, spot.target) == ("spot", (0, 0, 0))
    assert spot.angle == pytest.approx(math.pi / 2)
    (camera,) = parsed.cameras
    assert (camera.position, camera.target, camera.up) == ((0, -5, 1), (0, 0, 0), (0, 0, 1))
    assert camera.roll == pytest.approx(math.pi)
    width = 2 * math.atan(math.tan(camera.yfov / 2) * 4 / 3)
    assert math.degrees(width) == pytest.approx(46.8, abs=0.1)
    assert parsed.counts["objects"] == ["Square"]
    assert parsed.warnings == []


def test_an_object_without_faces_is_left_out(write):
    text = 'Named object: "Dummy"\nTri-mesh, Vertices: 0     Faces: 0\n'
    with pytest.warns(UserWarning, match="'Dummy' without faces"):
        parsed = load_document(write("model.asc", HEADER + text + SQUARE))
    assert [entry.name for entry in parsed.objects] == ["Square"]


def test_lines_that_are_not_understood_are_warned_of(write):
    path = write("model.asc", HEADER + "Fog settings\n" + SQUARE)
    with pytest.warns(UserWarning, match=r"model\.asc:3: 'Fog settings' is not understood"):
        load_document(path)


@pytest.mark.parametrize(
    ("old", "new", "line", "message"),
    [
        ("Vertices: 4", "Vertices: 3", 9, "more vertices than the 3 announced"),
        ("Vertices: 4", "Vertices: 5", 4, "5 vertices announced for 'Square', 4 are there"),
        ("Vertices: 4", "Vertices: -4", 4, "not a count"),
        ("Faces: 2", "Faces: 4294967295", 4, "faces announced"),
        ("Faces: 2", "Faces: 1", 14, "more faces"),
        ("Vertex 1:", "Vertex 2:", 7, "vertex '2' where vertex 1 is due"),
        ("X:2     Y:0", "X:two     Y:0", 7, "not a number: 'two'"),
        ("X:2     Y:0     Z:0", "X:2", 7, "not a whole vertex"),
        ("C:3", "C:4", 14, "out of range, there are 4"),
        ("C:3", "C:-1", 14, "not a vertex index"),
        ("C:3", "C:4294967296", 14, "out of range"),
        ("Face 1:    A:0 B:2", "Face 1:", 14, "not a whole face"),
        ('Named object: "Square"\nTri-mesh, Vertices: 4     Faces: 2\n', "", 4, "outside a tri-m"),
    ],
)
def test_damaged_files_name_the_line(document, old, new, line, message):
    with pytest.raises(FileFormatError, match=message) as caught:
        document(HEADER + SQUARE.replace(old, new, 1))
    assert caught.value.line == line


@pytest.mark.parametrize("content", [b"", HEADER.encode(), b"-----BEGIN PGP MESSAGE-----\n"])
def test_files_without_a_mesh_are_errors(document, content):
    with pytest.raises(FileFormatError, match=r"model\.asc: no tri-mesh"):
        document(content)
