"""Pictures of pyrender itself, recorded with Mesa's llvmpipe and one sample: ours are the same."""

import importlib.util
import os
from pathlib import Path

import numpy as np
import pytest

import engine3d.compat.pyrender as pyrender

_NEIGHBOUR = Path(__file__).resolve().parents[2].parent / "shared"
_FOLDER = Path(os.environ.get("ENGINE3D_SHARED") or _NEIGHBOUR) / "pyrender"
_WIRES = ("wire", "flat_wire_rgba")  # where lines cross, either may win

pytest.importorskip("trimesh")
pytestmark = pytest.mark.skipif(
    not (_FOLDER / "make_ref.py").is_file(),
    reason="needs the pictures of pyrender in ../shared (or ENGINE3D_SHARED)",
)


@pytest.fixture(scope="module")
def pictures():
    spec = importlib.util.spec_from_file_location("make_ref", _FOLDER / "make_ref.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    before = pyrender.settings.samples, pyrender.settings.orthographic_depth
    pyrender.settings.samples, pyrender.settings.orthographic_depth = 1, "pyrender"
    try:
        yield [(name, color, depth) for name, color, depth, _ in module.draw(pyrender)]
    finally:
        pyrender.settings.samples, pyrender.settings.orthographic_depth = before


def _inside(covered):
    """Pixels whose neighbours are covered as well."""
    padded = np.pad(covered, 1, constant_values=True)
    height, width = covered.shape
    shifts = [padded[y : y + height, x : x + width] for y in range(3) for x in range(3)]
    return np.all(shifts, axis=0)


def test_pictures_are_pyrenders(pictures):
    assert len(pictures) == 28
    for name, color, depth in pictures:
        truth = np.load(_FOLDER / "reference" / "center" / f"{name}.depth.npy")
        assert ((depth > 0) != (truth > 0)).sum() <= 2, name
        both = (depth > 0) & (truth > 0)
        slope = np.maximum(*np.abs(np.gradient(truth.astype(float))))
        inside = _inside(both)
        error = np.abs(depth - truth)[inside] / truth[inside]
        assert error[slope[inside] < 0.05].max(initial=0) <= 1e-4, name
        if not name.endswith(_WIRES):
            assert error.max(initial=0) <= 1e-3, name
        if color is not None:
            other = np.load(_FOLDER / "reference" / "center" / f"{name}.color.npy").astype(int)
            difference = np.abs(color - other).max(axis=-1)
            limit = 0 if name.startswith("s09") else 2
            assert difference[inside & (slope < 0.05)].max(initial=0) <= limit, name
            assert (difference[~both] > 2).sum() <= 2, name
