"""Every OBJ and MTL file of the corpus has its expected outcome."""

import numpy as np
import pytest
from shared_corpus import CONFORMANCE, cases_of, needs_conformance

from engine3d.errors import Engine3DError
from engine3d.loaders import load_document, load_mesh
from engine3d.model.geometry.normals import face_area_vectors

pytestmark = [needs_conformance, pytest.mark.filterwarnings("ignore::UserWarning")]

_COUNTS = {
    "v": "vertices",
    "vt": "uvs",
    "vn": "normals",
    "faces": "faces",
    "tris": "triangles",
    "lines": "lines",
    "points": "points",
}


@pytest.mark.parametrize("case", cases_of("obj"))
def test_obj(case):
    path = CONFORMANCE / case["file"]
    if case["expect"] == "error":
        with pytest.raises(Engine3DError, match=path.name) as caught:
            load_mesh(path)
        assert "\n" not in str(caught.value)
        return
    try:
        mesh = load_mesh(path)
        document = load_document(path)
    except Engine3DError as error:
        assert case["expect"] == "ok_or_error"
        assert path.name in str(error)
        return
    _check_mesh(mesh)
    assert sum(len(entry.mesh.faces) for entry in document.objects) == len(mesh.faces)
    if case["expect"] == "ok":
        _check_figures(mesh, document, case)


def _check_mesh(mesh):
    assert np.isfinite(mesh.normals).all()
    assert mesh.edges().shape[1] == 2
    assert len(mesh.face_normals) == len(mesh.faces)


def _check_figures(mesh, document, case):
    for figure, name in _COUNTS.items():
        if case.get(figure) is not None:
            assert document.counts[name] == case[figure], name
    assert len(mesh.faces) == case["tris"]
    if case.get("area") is not None:
        assert _area(mesh) == pytest.approx(case["area"], rel=1e-4)
    if case.get("bbox") is not None and _used_positions(mesh) == case.get("v"):
        assert np.allclose(mesh.bounds, case["bbox"], rtol=1e-5, atol=1e-6)


def _used_positions(mesh):
    """The box of the table is that of all vertices; a mesh keeps those in use."""
    if mesh.position_ids is None:
        return len(mesh.positions)
    return len(np.unique(mesh.position_ids))


def _area(mesh):
    vectors = face_area_vectors(mesh.positions, mesh.faces)
    return np.sqrt((vectors * vectors).sum(axis=1)).sum() / 2


@pytest.mark.parametrize("case", cases_of("mtl"))
def test_mtl(case, tmp_path):
    library = (CONFORMANCE / case["file"]).read_bytes()
    (tmp_path / "library.mtl").write_bytes(library)
    model = tmp_path / "model.obj"
    model.write_text("mtllib library.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl a\nf 1 2 3\n")
    assert len(load_mesh(model).faces) == 1
