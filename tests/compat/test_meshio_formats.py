"""``meshio.read`` of files that engine3d reads and meshio does not."""

import numpy as np
import pytest

import engine3d as e3d

meshio = pytest.importorskip("meshio", exc_type=ImportError)

from engine3d.compat import meshio as door  # noqa: E402


def test_a_file_of_gltf_is_read_with_its_numbers(tmp_path):
    mesh = e3d.icosphere(1)
    mesh.values["_heat"] = np.arange(len(mesh.positions), dtype=np.float32)
    e3d.save_mesh(mesh, tmp_path / "ball.glb")
    read = meshio.read(tmp_path / "ball.glb")
    whole = e3d.load_mesh(tmp_path / "ball.glb")
    assert np.allclose(read.points, whole.positions)
    assert np.array_equal(read.cells_dict["triangle"], whole.faces)
    assert np.array_equal(read.point_data["_heat"], whole.values["_heat"])
    meshio.write(tmp_path / "ball.vtk", read)
    assert len(meshio.read(tmp_path / "ball.vtk").cells_dict["triangle"]) == len(whole.faces)


def test_lines_points_and_numbers_of_cells():
    places = np.arange(12.0).reshape(4, 3)
    mesh = e3d.Mesh(places, [[0, 1, 2]], lines=[[2, 3]], points=[0, 3])
    mesh.values["of faces"] = e3d.Values([7.0], on="faces")
    mesh.values["of points"] = e3d.Values([[1, 2], [3, 4]], on="points")
    made = door.mesh_of(mesh)
    assert [block.type for block in made.cells] == ["triangle", "line", "vertex"]
    assert made.cell_data["of faces"][0].tolist() == [7.0]
    assert np.isnan(made.cell_data["of faces"][1]).all()
    assert made.cell_data["of points"][2].tolist() == [[1, 2], [3, 4]]


def test_formats_of_meshio_stay_its_own():
    assert door.register() == []
    from meshio._helpers import extension_to_filetypes

    assert extension_to_filetypes[".stl"] == ["stl"]
    assert extension_to_filetypes[".glb"][0].startswith("engine3d-")


def test_damaged_files_raise_errors_of_engine3d(tmp_path):
    (tmp_path / "bad.glb").write_bytes(b"glTF no")
    with pytest.raises(e3d.FileFormatError, match="bad.glb"):
        meshio.read(tmp_path / "bad.glb")
