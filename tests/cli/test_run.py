"""``engine3d run``: turntables without a screen, a dummy window, the scenes that it knows."""

import numpy as np
import pytest
from cli.conftest import SMALL, pixels
from PIL import Image

import engine3d as e3d
from engine3d.apps.cli import main
from engine3d.apps.scenes.crowds import parcels

pytestmark = pytest.mark.usefixtures("no_screen")


def test_run_without_a_screen_says_so_and_writes_a_turntable(model, tmp_path, capsys):
    command = ["run", str(model), *SMALL, "--cull", "none"]
    assert main([*command, "--frames", "3"]) == 0
    out, err = capsys.readouterr()
    assert err.count("\n") == 1
    assert "no screen" in err and "square-turntable-001.gif" in err
    with Image.open(tmp_path / "square-turntable-001.gif") as image:
        assert image.n_frames == 3
    assert main([*command, "--frames", "2"]) == 0
    assert (tmp_path / "square-turntable-002.gif").exists()


def test_run_headless_writes_what_it_is_told(model, tmp_path, capsys):
    headless = ["run", str(model), *SMALL, "--headless", "--cull", "none"]
    assert main([*headless, "--frames", "4", "-o", "out.webp"]) == 0
    with Image.open(tmp_path / "out.webp") as image:
        assert image.n_frames == 4
    assert main([*headless, "--frames", "1", "-o", "out.png"]) == 0
    assert pixels(tmp_path / "out.png").shape == (32, 48, 4)
    assert capsys.readouterr().err == ""


def test_run_in_a_dummy_window_stops_after_its_frames(model, monkeypatch, capsys, tmp_path):
    monkeypatch.setenv("SDL_VIDEODRIVER", "dummy")
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path))
    arguments = ["--animate", "--fps", "--no-vsync", "--frames", "3", "--camera", "fps"]
    assert main(["run", str(model), *SMALL, *arguments]) == 0
    assert capsys.readouterr() == ("", "")


@pytest.mark.parametrize(
    "scene",
    [
        *("default", "vertices", "edges", "faces", "cube", "shapes", "textured", "asc", "city"),
        *("solar", "spheres", "lod", "parcels"),
    ],
)
def test_every_scene_draws_something_that_moves(scene, tmp_path):
    path = tmp_path / "out.webp"
    arguments = ["--headless", "--frames", "3", "-o", str(path)]
    assert main(["run", "--scene", scene, "--size", "96x64", *arguments]) == 0
    with Image.open(path) as image:
        assert image.n_frames == 3
        first = np.asarray(image.convert("RGB")).astype(int)
        image.seek(1)
        second = np.asarray(image.convert("RGB")).astype(int)
    assert np.ptp(first) > 100
    assert abs(first - second).max() > 30


def test_the_size_of_the_city_scene(capsys):
    arguments = ["--triangles", "30000", *SMALL, "-o", "out.png", "--verbose"]
    assert main(["render", "--scene", "city", *arguments]) == 0
    assert "triangles" in "".join(capsys.readouterr())


def test_a_walk_without_a_screen(tmp_path):
    command = ["run", "--scene", "city", "--triangles", "30000", "--camera", "fps", "--headless"]
    assert main([*command, *SMALL, "--frames", "3", "-o", "walk.gif"]) == 0
    with Image.open(tmp_path / "walk.gif") as image:
        assert image.n_frames == 3
    assert main([*command, *SMALL, "--frames", "1", "-o", "first.png"]) == 0
    assert main([*command[:-3], "--headless", *SMALL, "--frames", "1", "-o", "above.png"]) == 0
    assert not np.array_equal(pixels(tmp_path / "first.png"), pixels(tmp_path / "above.png"))


def test_parcels_are_drawn_block_by_block():
    viewed = parcels()
    frame = e3d.render(viewed.scene, size=(64, 48), mode="unlit")
    assert frame.stats["draws"] == frame.stats["nodes_in_frustum"] == 25
    blocks = [node.object for node in viewed.scene.nodes if node.object is not None]
    meshes = [mesh for mesh in blocks if isinstance(mesh, e3d.Mesh)]
    assert len(meshes) == 25
    assert len({material for mesh in meshes for material in mesh.materials}) == 3
    land = np.concatenate([mesh.positions[mesh.faces[mesh.material_ids == 0]] for mesh in meshes])
    assert len(land) == 2 * 1600  # two triangles a parcel
    assert len(np.unique(land.reshape(1600, -1).round(3), axis=0)) == 1600
    low, high = viewed.scene.bounds
    assert high[0] - low[0] > 470 and high[2] - low[2] > 470
