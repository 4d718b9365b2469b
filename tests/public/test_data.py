"""The models of engine3d.data: they load cleanly, are well made, and come out of their scripts."""

import subprocess
import sys
from importlib import resources
from pathlib import Path

import numpy as np
import pytest
from patience import HUNG
from PIL import Image

import engine3d as e3d
from engine3d import loaders

SCRIPTS = Path(__file__).parents[2] / "data" / "scripts"
MODELS = ("teapot.obj", "island.obj", "globe.obj", "nautilus.obj", "train.asc")
# What the scripts make in a few seconds: all geometry, and the smallest texture.
REMADE = (*MODELS, "teapot.mtl", "island.mtl", "globe.mtl", "nautilus.mtl", "globe_stand.webp")


def folder():
    return resources.files("engine3d.data") / "models"


def need(name):
    if not (folder() / name).is_file():
        pytest.skip("this model is in the source, but not in the wheel")


@pytest.fixture(params=MODELS)
def mesh(request):
    need(request.param)
    with resources.as_file(folder() / request.param) as path:
        return e3d.load_mesh(path)


def face_normals(mesh):
    a, b, c = mesh.positions[mesh.faces].astype(np.float64).transpose(1, 0, 2)
    return np.cross(b - a, c - a)


def test_models_load_without_warnings(mesh):
    assert mesh.warnings == []
    assert 2_000 <= len(mesh.faces) <= 30_000
    assert np.isfinite(mesh.positions).all()


def test_models_have_texture_coordinates_normals_and_hidden_diagonals(mesh):
    assert mesh.uvs is not None and mesh.edge_visible is not None
    assert not mesh.edge_visible.all()
    lengths = np.linalg.norm(mesh.normals, axis=1)
    np.testing.assert_allclose(lengths, 1.0, atol=2e-3)


def test_normals_stand_on_the_front_of_their_faces(mesh):
    directions = face_normals(mesh)
    areas = np.linalg.norm(directions, axis=1)
    corner_normals = mesh.normals[mesh.faces].astype(np.float64).sum(axis=1)
    agreeing = np.sum(directions * corner_normals, axis=1) > 0.0
    assert areas[agreeing].sum() > 0.999 * areas.sum()


def test_models_lie_near_the_origin(mesh):
    low, high = mesh.bounds
    assert np.all(low < high)
    assert np.abs(0.5 * (low + high)).max() < 0.55 * np.max(high - low)


@pytest.mark.parametrize("name", [model for model in MODELS if model.endswith(".obj")])
def test_every_texture_of_a_material_library_is_found(name):
    need(name)
    with resources.as_file(folder()) as path:
        mesh = e3d.load_mesh(path / name)
        library = (path / name).with_suffix(".mtl").read_text("ascii")
    textured = [material for material in mesh.materials if material.texture is not None]
    assert len(textured) == library.count("map_Kd") >= 1
    for material in textured:
        height, width = material.texture.pixels.shape[:2]
        assert (height & (height - 1), width & (width - 1)) == (0, 0)


def test_the_train_has_objects_lights_and_a_camera():
    with resources.as_file(folder() / "train.asc") as path:
        document = loaders.load_document(path)
    names = [name for name, *_ in document.objects]
    assert len(names) == len(set(names)) >= 20 and {"Boiler", "Cab", "Tender"} <= set(names)
    assert all(len(name) <= 10 for name in names)
    assert len([light for light in document.lights if light.kind != "ambient"]) == 2
    assert len(document.cameras) == 1


def test_the_data_stays_small():
    sizes = [path.stat().st_size for path in Path(str(folder())).iterdir()]
    assert sum(sizes) < 12_000_000


def test_scripts_reproduce_the_files(tmp_path):
    if not SCRIPTS.is_dir():
        pytest.skip("the scripts are in the source tree only")
    command = [sys.executable, str(SCRIPTS / "make.py"), "--output", str(tmp_path), *REMADE]
    subprocess.run(command, check=True, capture_output=True, timeout=HUNG)
    for name in REMADE:
        made, kept = tmp_path / name, SCRIPTS.parent / "models" / name
        if name.endswith(".webp"):  # another Pillow might compress otherwise
            np.testing.assert_array_equal(
                np.asarray(Image.open(made)), np.asarray(Image.open(kept))
            )
        else:
            assert made.read_bytes() == kept.read_bytes(), f"{name} differs from what make.py makes"
