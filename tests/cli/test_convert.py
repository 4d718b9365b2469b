"""``engine3d convert`` and ``engine3d city``: the models that they write."""

import pytest

import engine3d as e3d
from engine3d.apps.cli import main

pytestmark = pytest.mark.usefixtures("no_screen")


def test_convert(model, tmp_path, capfd):
    assert main(["convert", str(model), "out.ply"]) == 0
    mesh = e3d.load_mesh("out.ply")
    assert mesh.faces.tolist() == [[0, 1, 2], [0, 2, 3]]
    assert main(["convert", "out.ply", "out.stl", "--ascii"]) == 0
    assert "do not hold texture coordinates" in capfd.readouterr().err
    assert (tmp_path / "out.stl").read_text().count("vertex") == 6
    assert main(["convert", "out.stl", "out.stl/out.obj"]) == 1


@pytest.mark.parametrize("name", ["out.obj", "out.ply", "out.stl"])
def test_convert_keeps_coordinates_whichever_axis_is_up(model, name):
    assert main(["convert", str(model), name]) == 0
    assert {tuple(corner) for corner in e3d.load_mesh(name).positions.tolist()} == {
        tuple(corner) for corner in e3d.load_mesh(model).positions.tolist()
    }


@pytest.mark.parametrize("arguments", [["out.png"], ["out"], ["out.obj", "--ascii"]])
def test_convert_refuses_what_it_cannot_write(model, capfd, arguments):
    assert main(["convert", str(model), *arguments]) == 2
    assert "engine3d: error:" in capfd.readouterr().err


def test_city_writes_a_model(tmp_path, capfd):
    assert main(["city", "town.stl", "--triangles", "20000", "--seed", "4"]) == 0
    assert len(e3d.load_mesh("town.stl").faces) == e3d.worlds.city(20_000, seed=4).triangles
    assert main(["city", "town.obj", "--triangles", "3"]) == 2
    assert "'3' is not a whole number from 20,000 to 50,000,000" in capfd.readouterr().err
    assert not (tmp_path / "town.obj").exists()
