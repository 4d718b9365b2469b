"""To trimesh and back, and the formats that it reads."""

import subprocess
import sys
from types import SimpleNamespace

import numpy as np
import pytest

import engine3d as e3d
from engine3d.apps.cli.commands.info import describe
from engine3d.errors import FileFormatError, InvalidArgumentError
from engine3d.io.formats.trimesh_formats import read_here
from engine3d.io.reading.sources import read_source
from engine3d.io.trimesh_conversion import scene_parts
from engine3d.loaders import load_document, load_mesh
from engine3d.model.geometry.posing import posed_mesh

trimesh = pytest.importorskip("trimesh")

GREY = np.full((2, 2, 4), 128, np.uint8)


def same(a, b):
    return a is b is None or np.array_equal(a, b)


@pytest.mark.parametrize("make", [e3d.box, e3d.torus, e3d.icosphere])
def test_there_and_back(make):
    mesh = make()
    mesh.materials = [e3d.Material(color=(1.0, 0.0, 0.0), texture=e3d.Texture(GREY))]
    again = e3d.Mesh.from_trimesh(mesh.to_trimesh())
    for name in ("positions", "faces", "uvs", "colors"):
        assert same(getattr(mesh, name), getattr(again, name)), name
    assert np.allclose(mesh.normals, again.normals, atol=1e-6)
    assert again.materials[0].color == (1, 0, 0)
    assert np.array_equal(again.materials[0].texture.pixels, GREY)


def test_colors():
    triangle = e3d.Mesh(np.eye(3), [[0, 1, 2]], colors=np.arange(12, dtype=np.uint8).reshape(3, 4))
    assert same(e3d.Mesh.from_trimesh(triangle.to_trimesh()).colors, triangle.colors)
    linear = e3d.Mesh(np.eye(3), [[0, 1, 2]], colors=e3d.linear(np.full((3, 4), 0.5, np.float32)))
    assert e3d.Mesh.from_trimesh(linear.to_trimesh()).colors[0].tolist() == [188, 188, 188, 128]
    box = trimesh.creation.box()
    box.visual.face_colors = np.arange(48, dtype=np.uint8).reshape(12, 4)
    mesh = e3d.Mesh.from_trimesh(box)
    assert (mesh.colors[mesh.faces] == box.visual.face_colors[:, np.newaxis]).all()
    assert np.array_equal(mesh.positions[mesh.faces], box.triangles.astype(np.float32))


def test_points_and_paths():
    cloud = e3d.Mesh(np.eye(3), points=[0, 2])
    assert e3d.Mesh.from_trimesh(cloud.to_trimesh()).positions.tolist() == [[1, 0, 0], [0, 0, 1]]
    ends = np.array([[0, 0, 0], [1, 0, 0], [5, 5, 5], [6, 5, 5]], float)
    runs = [SimpleNamespace(discrete=lambda v, scale, k=k: v[k : k + 2]) for k in (0, 2)]
    path = SimpleNamespace(vertices=ends, entities=runs)
    mesh = e3d.Mesh.from_trimesh(path)
    ends = mesh.positions[mesh.lines]
    assert np.sort(ends[:, 0, 0]).tolist() == [0, 5]
    assert (ends[:, 1] - ends[:, 0]).tolist() == [[1, 0, 0]] * 2


def test_several_materials_are_a_scene():
    mesh = e3d.Mesh(
        np.eye(4, 3),
        [[0, 1, 2], [0, 2, 3]],
        materials=[e3d.Material(name="a", color=(1.0, 0.0, 0.0)), e3d.Material(name="b")],
        material_ids=[0, 1],
    )
    scene = mesh.to_trimesh()
    assert sorted(scene.geometry) == ["a", "b"]
    assert len(e3d.Mesh.from_trimesh(scene).faces) == 2


def test_a_mirroring_pose_turns_faces_over():
    mesh = e3d.box()
    posed = posed_mesh(mesh, np.diag([-1.0, 2.0, 1.0, 1.0]))
    outward = posed.face_normals * posed.positions[posed.faces].mean(axis=1)
    assert (outward.sum(axis=1) > 0).all()
    assert np.allclose((posed.normals**2).sum(axis=1), 1)
    assert len(posed.edges()) == len(mesh.edges())


def test_what_is_far_from_the_origin_stands_near_one_of_its_own():
    far = np.array([500_000.0, 4_649_776.0, 0.0])
    box = trimesh.creation.box((3, 1, 1))
    points = trimesh.PointCloud(np.array([(0, 0, 0.1), (1, 0, 0)]) + far)
    box.apply_translation(far + 1 / 64)
    parts = scene_parts(trimesh.Scene({"box": box, "points": points}), near=True)
    assert all(abs(part.mesh.positions).max() < 8 for part in parts)
    again = parts[0].mesh.positions @ parts[0].pose[:3, :3].T + parts[0].pose[:3, 3]
    assert (np.ptp(again, axis=0) == (3, 1, 1)).all()
    assert (again.min(axis=0) == far + 1 / 64 - (1.5, 0.5, 0.5)).all()
    assert (scene_parts(trimesh.Scene(box))[0].pose == np.eye(4)).all()


def test_what_is_no_geometry():
    with pytest.raises(InvalidArgumentError, match="geometry must be one of trimesh, not 3"):
        e3d.Mesh.from_trimesh(3)


def test_binary_gltf(tmp_path):
    scene = trimesh.Scene()
    pose = np.eye(4)
    pose[:3, 3] = 7, 0, 0
    scene.add_geometry(trimesh.creation.box(), node_name="left")
    scene.add_geometry(
        trimesh.creation.icosphere(subdivisions=1), node_name="right", transform=pose
    )
    path = tmp_path / "two.glb"
    path.write_bytes(scene.export(file_type="glb"))
    document = load_document(path)
    assert sorted(entry.name for entry in document.objects) == ["left", "right"]
    assert document.format == "glb"
    assert describe(path)["bounds"][1][0] == 8
    mesh = load_mesh(path.read_bytes())
    assert mesh.bounds[:, 0].tolist() == [-0.5, 8]
    assert len(mesh.faces) == 12 + 80


def test_textures_come_along(tmp_path):
    mesh = e3d.primitives.quad((0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0))
    mesh.materials = [e3d.Material(texture=e3d.Texture(GREY))]
    path = tmp_path / "a.glb"
    path.write_bytes(mesh.to_trimesh().export(file_type="glb"))
    again = load_mesh(path)
    assert np.array_equal(again.materials[0].texture.pixels, GREY)
    assert np.allclose(again.uvs[again.faces], mesh.uvs[mesh.faces])


@pytest.mark.parametrize("name", ["a.dxf", "a.xyz"])
@pytest.mark.parametrize("content", [b"", b"{}", b"nonsense"])
def test_damaged_files_are_our_own_errors(write, name, content):
    with pytest.raises(FileFormatError, match=name.replace(".", r"\.")) as caught:
        load_mesh(write(name, content))
    assert "\n" not in str(caught.value)


def test_without_trimesh(write):
    path = write("a.xyz", b"0 0 0")
    code = (
        "import sys; sys.modules['trimesh'] = None\n"
        "import engine3d as e3d\n"
        f"try: e3d.load_mesh({str(path)!r})\n"
        "except e3d.FileFormatError as error: print(error)\n"
        "try: e3d.box().to_trimesh()\n"
        "except ImportError as error: print(error)\n"
    )
    found = subprocess.run([sys.executable, "-c", code], check=True, capture_output=True, text=True)
    lines = found.stdout.splitlines()
    assert "a.xyz: .xyz files need the package trimesh" in lines[0]
    assert "engine3d[formats]" in lines[1]


@pytest.mark.parametrize(
    ("name", "content", "message"),
    [
        ("a.dae", b"{}", "not a dae file"),
        ("a.3mf", b"<a/>", "not a 3mf file"),
        ("a.3mf", b"PK", "damaged archive"),
    ],
)
def test_what_is_no_such_file_at_all_is_told(tmp_path, name, content, message):
    (tmp_path / name).write_bytes(content)
    with pytest.raises(FileFormatError, match=rf"{name}: {message}") as caught:
        load_mesh(tmp_path / name)
    assert "\n" not in str(caught.value)


def test_packages_that_trimesh_lacks_are_told(write, monkeypatch):
    source = read_source(write("a.dae", b"<COLLADA/>"))
    monkeypatch.setattr(trimesh, "available_formats", lambda: {"glb"})
    with pytest.raises(FileFormatError, match=r"a.dae: trimesh needs further packages for dae"):
        read_here(source, split=False)
