"""The `Visualizer` against Open3D's own: silhouettes, edges, depths, colours, views."""

import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

pytest.importorskip("open3d", exc_type=ImportError)
from compat import open3d_scenes as of

from engine3d.compat.open3d import Visualizer

#: Names of scenes of lines and points, which cover too little for shares of a silhouette.
THIN = (
    "points",
    "uncoloured points",
    "lit points",
    "points by normal",
    "lines",
    "boxes",
    "tetrahedra",
    "together",
)


@pytest.fixture(scope="module")
def real(tmp_path_factory):
    """What Open3D draws, in a process of its own: it needs EGL and a driver, as Mesa's."""
    path = tmp_path_factory.mktemp("open3d") / "real.npz"
    script = Path(of.__file__)
    done = subprocess.run([sys.executable, script, path], capture_output=True, text=True)
    if done.returncode:
        pytest.skip(f"Open3D itself draws nothing here: {done.stderr.strip()[-200:]}")
    with np.load(path) as rows:
        return dict(rows)


@pytest.fixture(scope="module")
def drawn():
    return {name: of.draw(Visualizer, *rest) for name, *rest in of.scenes()}


@pytest.mark.parametrize(("number", "name"), enumerate(of.NAMES))
def test_pictures_are_open3ds(real, drawn, number, name):
    color, depth = drawn[name]
    expected, far = real[f"color{number}"], real[f"depth{number}"]
    ours, theirs = depth > 0, far > 0
    both = ours & theirs
    assert both.sum() >= (0.95 if name in THIN else 0.999) * (ours | theirs).sum() > 0
    apart = abs(depth - far)[both] / far[both]
    assert np.quantile(apart, 0.97 if name in THIN else 0.999) < 1e-3
    codes = abs(color.astype(int) - expected).max(axis=2)
    assert np.mean(codes > 2) < (0.02 if name in THIN else 0.002)
    assert codes.mean() < 1.0


def test_views_are_open3ds(real):
    """After random calls: position, zoom, lens, both matrices; and read back from them."""
    ours = of.states(Visualizer)
    assert ours.shape == real["states"].shape
    assert np.allclose(ours, real["states"], rtol=1e-9, atol=1e-9, equal_nan=True)
