"""Programs of PyVista beside the pictures that PyVista itself drew of them."""

import importlib.util
from pathlib import Path

import numpy as np
import pytest
from compat.plotters import without_opengl

pv = pytest.importorskip("pyvista", exc_type=ImportError)
if not hasattr(pv, "register_plotter_component"):
    pytest.skip("components of plotters came with PyVista 0.48", allow_module_level=True)

DOOR = Path(__file__).resolve().parents[3] / "shared" / "doors" / "pyvista"
PROGRAMS = sorted((DOOR / "snippets").glob("*.py"))
if not PROGRAMS:
    pytest.skip("the folder ../shared is not beside the checkout", allow_module_level=True)

#: Least share of pixels that both cover, greatest distance of outlines, and of colours.
FACES = (0.999, 0.05, 1.5)
ROUND = (0.93, 0.7, 12.0)  # balls: VTK's have jagged edges; a line along the edges of pixels
LOOSE = {"s13_point_cloud": ROUND, "s17_add_lines": ROUND}
#: Share of pixels whose depths may differ by a thousandth: of wide lines and balls.
DEEP = {"s11": 0.2, "s13": 0.7, "s17": 0.5, "s32": 0.02}


@pytest.fixture(scope="module")
def compare():
    spec = importlib.util.spec_from_file_location("check", DOOR / "check.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module.compare


@pytest.mark.parametrize("path", PROGRAMS, ids=lambda path: path.stem)
def test_it_looks_as_vtk_draws_it(path, compare):
    without_opengl()
    names = {}
    exec(compile(path.read_text("utf-8"), path.name, "exec"), names)
    import engine3d.compat.pyvista  # noqa: F401

    picture = names["pl"].engine3d.screenshot()
    with np.load(path.with_suffix(".npz")) as reference:
        found = compare(picture, None, reference)
        share, edge, color = LOOSE.get(path.stem, FACES)
        assert found["iou"] >= share
        assert found["edge"] <= edge
        assert found["colour"] <= color
        assert found["whole"] <= 2.0
        depth = reference["depth"]
    if np.isfinite(depth).any() and len(names["pl"].renderers) == 1:
        ours = names["pl"].engine3d.render().depth
        both = np.isfinite(depth) & (ours > 0)
        far = np.abs(ours[both] - depth[both]) > 1e-3 * depth[both]
        assert far.mean() <= DEEP.get(path.stem[:3], 0.01)
