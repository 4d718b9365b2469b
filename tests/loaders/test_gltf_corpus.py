"""glTF files of other projects, sound, broken and hostile, against what must come out of them."""

import json
import warnings

import numpy as np
import pytest
from shared_corpus import SHARED

from engine3d.errors import Engine3DError
from engine3d.loaders import load_document, load_mesh

GLTF = SHARED / "gltf"
# What there is no reader for.
LACKING = "needs the extension"

pytestmark = pytest.mark.skipif(
    not (GLTF / "expected.json").is_file(),
    reason="needs the glTF corpus in ../shared (or ENGINE3D_SHARED)",
)


def cases(*folders):
    try:
        table = json.loads((GLTF / "expected.json").read_text())
    except FileNotFoundError:
        return []
    return [
        pytest.param(case, id=case["file"])
        for case in table
        if case["file"].split("/")[0] in folders and case["file"].endswith((".glb", ".gltf"))
    ]


def loaded(load, case):
    """What a file gives, or the error of ours that names it; nothing else may come."""
    path = GLTF / case["file"]
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        try:
            return load(path)
        except Engine3DError as error:
            assert str(error).startswith(str(path))
            assert "\n" not in str(error)
            return error


@pytest.mark.parametrize("case", cases("models", "generator", "own"))
def test_sound_files(case):
    mesh = loaded(load_mesh, case)
    expected = case.get("expect")
    if expected is None or isinstance(mesh, Engine3DError) and "of version" in str(mesh):
        return
    drawn = expected["scene_triangles"], expected["scene_line_segments"], expected["scene_points"]
    if isinstance(mesh, Engine3DError):
        assert any("required:" in f for f in case["features"]) or LACKING not in str(mesh)
        assert LACKING in str(mesh) or sum(drawn) == 0 or not expected["vertices"]
        return
    if "EXT_mesh_gpu_instancing" in case["features"]:
        assert any("EXT_mesh_gpu_instancing" in warning for warning in mesh.warnings)
        return
    if "KHR_node_visibility" in case["features"]:
        assert len(mesh.faces) < expected["scene_triangles"]  # which counts hidden nodes, too
        return
    assert (len(mesh.faces), len(mesh.lines), len(mesh.points)) == drawn
    if "morph" not in case["features"]:
        box = expected.get("bbox_rest_unskinned") or expected["bbox_rest"]
        size = np.ptp(box, axis=0).max()
        assert np.allclose(mesh.bounds, box, atol=1e-4 * size + 1e-7, rtol=1e-5)


@pytest.mark.parametrize("case", cases("broken", "hostile", "validator"))
def test_broken_files(case):
    """Those that must be refused are, unless what is broken in them is nothing that we read."""
    found = loaded(load_document, case)
    if case["outcome"] in ("ok", "warn") and isinstance(found, Engine3DError):
        told = str(found)
        assert LACKING in told or "no vertices" in told or "version" in told or "no data" in told
    if case["file"].startswith("hostile/") and case["outcome"] == "warn":
        assert found.warnings
    read = ("glb", "count_", "ref_", "uri_", "sparse", "stride", "cycle", "two_", "version")
    if case["outcome"] == "error" and case["file"].startswith(tuple(f"hostile/{r}" for r in read)):
        assert isinstance(found, Engine3DError)
