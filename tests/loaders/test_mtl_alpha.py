"""The alpha of MTL: ``d``, ``Tr``, opacity maps, and images that have alpha."""

import numpy as np
import pytest
from PIL import Image

from engine3d.io.writers import save_mesh
from engine3d.loaders import load_mesh

MODEL = (
    "mtllib model.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nusemtl m\nf 1/1 2/2 3/3\n"
)
CUT = np.array([[0, 255], [255, 0]], np.uint8)
SMOOTH = np.array([[0, 90], [160, 255]], np.uint8)


@pytest.fixture
def folder(tmp_path):
    Image.new("RGB", (4, 4), (10, 200, 30)).save(tmp_path / "leaf.png")
    Image.fromarray(CUT, "L").save(tmp_path / "cut.png")
    Image.fromarray(SMOOTH, "L").save(tmp_path / "smooth.png")
    for name, alpha in (("cut_alpha.png", CUT), ("smooth_alpha.png", SMOOTH)):
        image = Image.new("RGBA", (2, 2), (10, 200, 30, 0))
        image.putalpha(Image.fromarray(alpha, "L"))
        image.save(tmp_path / name)
    return tmp_path


@pytest.fixture
def material(folder):
    """``material(mtl_text) -> Material``"""

    def read(text):
        (folder / "model.mtl").write_text("newmtl m\n" + text)
        (folder / "model.obj").write_text(MODEL)
        mesh = load_mesh(folder / "model.obj")
        assert mesh.warnings == []
        return mesh.materials[0]

    return read


@pytest.mark.parametrize(
    ("text", "mode", "alpha"),
    [
        ("Kd 1 0 0\n", "opaque", 1),
        ("d 1\n", "opaque", 1),
        ("d 0.25\n", "blend", 0.25),
        ("Tr 0.25\n", "blend", 0.75),
        ("d 0.5\nTr 0.25\n", "blend", 0.5),
        ("d 7\n", "opaque", 1),
        ("d -1\n", "blend", 0),
        ("map_Kd leaf.png\n", "opaque", 1),
        ("map_Kd cut_alpha.png\n", "mask", 1),
        ("map_Kd cut_alpha.png\nd 0.5\n", "blend", 0.5),
        ("map_Kd smooth_alpha.png\n", "opaque", 1),
        ("map_Kd leaf.png\nmap_d cut.png\n", "mask", 1),
        ("map_Kd leaf.png\nmap_d smooth.png\n", "blend", 1),
        ("map_Kd smooth_alpha.png\nmap_d smooth_alpha.png\n", "blend", 1),
        ("map_d cut.png\nd 0.5\n", "blend", 0.5),
    ],
)
def test_modes(material, text, mode, alpha):
    read = material(text)
    assert (read.alpha_mode, read.alpha) == (mode, alpha)


def test_an_opacity_map_becomes_the_alpha_of_the_image(material):
    texture = material("map_Kd leaf.png\nmap_d cut.png\n").texture
    assert np.array_equal(texture.pixels[..., 3], CUT.repeat(2, 0).repeat(2, 1))
    assert (texture.pixels[..., :3] == (10, 200, 30)).all()


def test_a_map_of_transparency_is_turned_round(material):
    texture = material("map_Kd leaf.png\nmap_Tr cut.png\n").texture
    assert np.array_equal(texture.pixels[..., 3], 255 - CUT.repeat(2, 0).repeat(2, 1))


def test_an_opacity_map_alone_cuts_white(material):
    texture = material("Kd 1 0 0\nmap_d cut.png\n").texture
    assert np.array_equal(texture.pixels[..., 3], CUT)
    assert (texture.pixels[..., :3] == 255).all()


@pytest.mark.parametrize(
    "text", ["map_Kd leaf.png\nmap_d cut.png\n", "d 0.25\n", "map_d smooth.png\n"]
)
def test_saved_alpha_comes_back(material, folder, text):
    first = material(text)
    save_mesh(load_mesh(folder / "model.obj"), folder / "again.obj")
    again = load_mesh(folder / "again.obj").materials[0]
    assert (again.alpha_mode, again.alpha) == (first.alpha_mode, first.alpha)
    if first.texture is not None:
        assert np.array_equal(again.texture.pixels, first.texture.pixels)
