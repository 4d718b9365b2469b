"""Every PLY file of the corpus has its expected outcome, in time."""

import time

import numpy as np
import pytest
from shared_corpus import CONFORMANCE, cases_of, needs_conformance

from engine3d.errors import Engine3DError
from engine3d.loaders import load_document, load_mesh

pytestmark = [needs_conformance, pytest.mark.filterwarnings("ignore::UserWarning")]


@pytest.mark.parametrize("case", cases_of("ply"))
def test_ply(case):
    path = CONFORMANCE / case["file"]
    start = time.process_time()
    if case["expect"] == "error":
        with pytest.raises(Engine3DError, match=path.name) as caught:
            load_mesh(path)
        assert "\n" not in str(caught.value)
    else:
        try:
            _check(case, load_mesh(path), load_document(path))
        except Engine3DError as error:
            assert case["expect"] == "ok_or_error"
            assert path.name in str(error)
    assert time.process_time() - start < (2 if case["size"] < 1 << 20 else 10)


def _check(case, mesh, document):
    assert np.isfinite(mesh.normals).all()
    assert mesh.edges().shape[1] == 2
    if case["expect"] != "ok":
        return
    assert document.counts["vertices"] == case["v"]
    assert document.counts["faces"] == case.get("faces", document.counts["faces"])
    assert len(mesh.faces) == case.get("tris", 0)
    if case.get("bbox") is not None:
        assert np.allclose(mesh.bounds, case["bbox"], rtol=1e-5, atol=1e-6)
