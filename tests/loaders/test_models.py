"""Real models and their textures load as their table says, and the project's own without a word."""

import hashlib
import json
import warnings
from importlib.resources import files

import numpy as np
import pytest
from shared_corpus import MODELS, needs_models

from engine3d.loaders import load_document, load_mesh, load_texture


def table():
    try:
        return json.loads((MODELS / "models.json").read_text())
    except FileNotFoundError:
        return []


COMPANIONS = {
    "african_head/african_head.obj": "african_head_diffuse.tga",
    "spot/spot.obj": "spot_texture.png",
}


def own_models():
    folder = files("engine3d.data") / "models"
    return sorted(entry.name for entry in folder.iterdir() if entry.name.endswith((".obj", ".asc")))


@needs_models
@pytest.mark.parametrize("entry", [e for e in table() if "v" in e], ids=lambda e: e["file"])
def test_model(entry):
    document = load_document(MODELS / entry["file"])
    figures = {"v": "vertices", "vt": "uvs", "vn": "normals", "faces": "faces", "tris": "triangles"}
    for figure, name in figures.items():
        assert document.counts[name] == entry.get(figure, 0)
    mesh = document.objects[0].mesh
    assert np.allclose(mesh.bounds, entry["bbox"], atol=1e-5)
    assert np.allclose((mesh.normals.astype(np.float64) ** 2).sum(axis=1), 1, atol=0.01)
    texture = COMPANIONS.get(entry["file"])
    assert len(document.warnings) == (texture is not None)
    assert texture is None or f"{texture!r} beside the model" in document.warnings[0]


@needs_models
@pytest.mark.parametrize(
    "entry", [e for e in table() if "rgba_sha256" in e], ids=lambda e: e["file"]
)
def test_texture(entry):
    pixels = load_texture(MODELS / entry["file"]).pixels
    assert hashlib.sha256(pixels.tobytes()).hexdigest() == entry["rgba_sha256"]


@needs_models
def test_a_watertight_mesh_has_each_edge_in_two_faces():
    mesh = load_mesh(MODELS / "spot/spot.obj")
    assert len(mesh.edges()) * 2 == len(mesh.faces) * 3


@needs_models
def test_a_model_finds_the_texture_that_bears_its_name():
    texture = load_mesh(MODELS / "african_head/african_head.obj").materials[0].texture
    assert texture.name == "african_head_diffuse.tga"


@pytest.mark.parametrize("name", own_models())
def test_own_models_load_without_a_warning(name):
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        mesh = load_mesh(files("engine3d.data") / "models" / name)
    assert len(mesh.faces) > 1000
