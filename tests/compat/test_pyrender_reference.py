"""Pictures of pyrender itself, recorded with Mesa's llvmpipe: ours are the same.

With one sample and with four.
"""

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


#: Of each folder of pictures: the settings with which ours are drawn.
_WAYS = {
    "center": {"samples": 1, "orthographic_depth": "pyrender"},
    "msaa": {"samples": 4, "orthographic_depth": "pyrender", "depth_place": "pyrender"},
}


@pytest.fixture(scope="module")
def draw():
    spec = importlib.util.spec_from_file_location("make_ref", _FOLDER / "make_ref.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module.draw


def _inside(covered):
    """Pixels whose neighbours are covered as well."""
    padded = np.pad(covered, 1, constant_values=True)
    height, width = covered.shape
    shifts = [padded[y : y + height, x : x + width] for y in range(3) for x in range(3)]
    return np.all(shifts, axis=0)


@pytest.mark.parametrize("folder", _WAYS)
def test_pictures_are_pyrenders(draw, folder, monkeypatch):
    for name, value in _WAYS[folder].items():
        monkeypatch.setattr(pyrender.settings, name, value)
    count = 0
    for name, color, depth, _ in draw(pyrender):
        count += 1
        compare(_FOLDER / "reference" / folder, name, color, depth)
    assert count == 28


def compare(folder, name, color, depth):
    wires, smooths = name.endswith(_WIRES), folder.name == "msaa"
    truth = np.load(folder / f"{name}.depth.npy")
    assert ((depth > 0) != (truth > 0)).sum() <= (4 if wires and smooths else 2), name
    both = (depth > 0) & (truth > 0)
    slope = np.maximum(*np.abs(np.gradient(truth.astype(float))))
    inside = _inside(both)
    error = np.abs(depth - truth)[inside] / truth[inside]
    assert error[slope[inside] < 0.05].max(initial=0) <= 1e-4, name
    if not wires:
        assert error.max(initial=0) <= 1e-3, name
    if color is None:
        return
    other = np.load(folder / f"{name}.color.npy").astype(int)
    difference = np.abs(color - other).max(axis=-1)
    limit = 0 if name.startswith("s09") else 2
    assert difference[inside & (slope < 0.05)].max(initial=0) <= limit, name
    if smooths and not wires:
        assert difference.max() <= 3, name  # at edges, too
    elif not smooths:
        assert (difference[~both] > 2).sum() <= 2, name
