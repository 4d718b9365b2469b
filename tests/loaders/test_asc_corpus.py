"""Every 3D Studio ASCII file of the corpus has its expected outcome."""

import numpy as np
import pytest
from shared_corpus import CONFORMANCE, cases_of, needs_conformance

from engine3d.errors import FileFormatError
from engine3d.loaders import load_document, load_mesh

pytestmark = [needs_conformance, pytest.mark.filterwarnings("ignore::UserWarning")]


@pytest.mark.parametrize("case", cases_of("asc"))
def test_asc(case):
    path = CONFORMANCE / case["file"]
    if case["expect"] == "error":
        with pytest.raises(FileFormatError, match=path.name):
            load_document(path)
        return
    try:
        document = load_document(path)
    except FileFormatError:
        assert case["expect"] == "ok_or_error"
        return
    mesh = load_mesh(path)
    assert np.isfinite(mesh.normals).all()
    if case["expect"] == "ok":
        _check_figures(mesh, document, case)


def _check_figures(mesh, document, case):
    counts = document.counts
    assert counts["vertices"] == case["v"]
    assert counts["triangles"] == case["tris"] == len(mesh.faces)
    assert len(counts["objects"]) == case["objects"] == len(document.objects)
    if case.get("names"):
        assert counts["objects"] == case["names"]
        assert sorted(counts["materials"]) == sorted(case["materials"])
        assert len(document.cameras) == case["cameras"]
        assert sum(light.kind != "ambient" for light in document.lights) == case["lights"]
    if case.get("per_object"):
        faces = [len(entry.mesh.faces) for entry in document.objects]
        assert faces == [triangles for _, triangles in case["per_object"]]
    if case.get("bbox"):
        assert np.allclose(mesh.bounds, case["bbox"], rtol=1e-6, atol=1e-6)
