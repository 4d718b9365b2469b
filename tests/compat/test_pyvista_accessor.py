"""``dataset.engine3d`` of PyVista: found by its entry point, upright, drawn as `render` draws."""

import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import engine3d as e3d

pyvista = pytest.importorskip("pyvista", exc_type=ImportError)
if not hasattr(pyvista, "register_dataset_accessor"):
    pytest.skip("accessors came with PyVista 0.48", allow_module_level=True)

ROOT = Path(__file__).resolve().parents[2]


@pytest.fixture(autouse=True)
def registered():
    from engine3d.compat import pyvista as accessors

    return accessors


def cone():
    return pyvista.Cone(direction=(0, 0, 1), center=(0, 0, 1), height=2.0)


def test_a_data_set_stands_upright():
    assert np.allclose(cone().engine3d.scene().bounds[:, 1], (0, 2))
    blocks = pyvista.MultiBlock({"a": cone(), "b": pyvista.Cube()})
    assert [node.name for node in blocks.engine3d.scene().nodes] == ["a", "b", "upright"]


def test_it_is_drawn_as_render_draws():
    thing = cone()
    thing["height"] = thing.points[:, 2]
    options = {"size": (48, 36), "color_by": "height", "bar": True}
    drawn = thing.engine3d.render(**options).color
    assert np.array_equal(drawn, e3d.render(thing.engine3d.scene(), **options).color)
    assert not np.array_equal(drawn, thing.engine3d.render(size=(48, 36)).color)


def test_what_cannot_be_drawn_is_told():
    table = pyvista.Table(np.zeros((2, 2)))
    with pytest.raises(e3d.InvalidArgumentError, match="a Table without points cannot be drawn"):
        table.engine3d.render()
    for empty in (pyvista.PolyData(), pyvista.UnstructuredGrid(), pyvista.MultiBlock()):
        with pytest.raises(e3d.InvalidArgumentError, match="without points cannot be drawn"):
            empty.engine3d.render()


def test_pyvista_finds_the_entry_point(tmp_path):
    """By the line of pyproject.toml, in metadata as pip writes it."""
    line = 'engine3d = "engine3d.compat.pyvista"'
    group = '[project.entry-points."pyvista.accessors"]'
    assert f"{group}\n{line}\n" in (ROOT / "pyproject.toml").read_text("utf-8")
    metadata = tmp_path / "accessor-1.0.dist-info"
    metadata.mkdir()
    (metadata / "METADATA").write_text("Metadata-Version: 2.1\nName: accessor\nVersion: 1.0\n")
    points = f"[pyvista.accessors]\n{line}\n".replace('"', "")
    (metadata / "entry_points.txt").write_text(points)
    code = (
        f"import sys; sys.path.insert(0, {str(tmp_path)!r}); import pyvista; "
        "print(pyvista.Sphere().engine3d.render(size=(8, 6)).size, 'engine3d' in sys.modules)"
    )
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert run.stdout == "(8, 6) True\n"


@pytest.mark.parametrize("name", ["", ".", "/"])
def test_a_screenshot_needs_the_name_of_a_file(name):
    plotter = pyvista.Plotter(off_screen=True)
    plotter.add_mesh(pyvista.Sphere())
    with pytest.raises(e3d.InvalidArgumentError, match="filename must be the name of a file"):
        plotter.engine3d.screenshot(name)
