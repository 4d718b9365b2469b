"""MTL: keywords in any letters, options on both sides of names, and what is not understood."""

import itertools
import warnings

import pytest
from PIL import Image

from engine3d.io.formats.obj.mtl_statements import COLORS, SCALARS, parse_map
from engine3d.loaders import load_mesh

MODEL = "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nusemtl m\nf 1/1 2/2 3/3\n"
BARE = MODEL.replace("usemtl m\n", "")
STATEMENTS = {
    **dict.fromkeys(COLORS, "0.25 0.5 0.75"),
    **dict.fromkeys(SCALARS, "0.5"),
    "illum": "2",
    "Ns": "40",
    **dict.fromkeys(("map_Kd", "map_Ks", "map_d", "map_Bump", "norm", "map_Pr"), "a.png"),
    **dict.fromkeys(("map_Pm", "map_Ke", "map_ORM", "map_opacity", "disp", "refl"), "a.png"),
}


@pytest.fixture
def load(tmp_path):
    """``load(library, model)``: the mesh, its warnings in ``mesh.warnings``."""
    Image.new("RGB", (4, 4), (90, 120, 250)).save(tmp_path / "a.png")

    def load(library, model=MODEL):
        (tmp_path / "m.mtl").write_text(library)
        (tmp_path / "a.obj").write_text(model)
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            return load_mesh(tmp_path / "a.obj")

    return load


def state(material):
    """Everything that a material holds, textures by their pixels."""
    held = {}
    for key, value in vars(material).items():
        pixels = getattr(getattr(value, "texture", value), "pixels", None)
        held[key] = value if pixels is None else pixels.tobytes()
    return held


@pytest.mark.parametrize("keyword", sorted(STATEMENTS))
def test_keywords_in_any_letters(load, keyword):
    value = STATEMENTS[keyword]
    expected = load(f"newmtl m\n{keyword} {value}\n")
    for other in {keyword.lower(), keyword.upper(), keyword.swapcase(), keyword.title()}:
        mesh = load(f"NEWMTL m\n{other} {value}\n")
        found, wanted = state(mesh.materials[0]), state(expected.materials[0])
        for held in (found, wanted):  # spellings that are known keep theirs
            maps = held["extras"].get("maps", {})
            held["extras"] = {k: v for k, v in held["extras"].items() if k != "maps"}
            held["maps"] = {key.lower(): entry for key, entry in maps.items()}
            del held["version"]
        assert found == wanted and mesh.warnings == expected.warnings


OPTIONS = [
    "-s 2 3",
    "-o 0.5 0.25 0",
    "-clamp on",
    "-bm 0.3",
    "-blendu off",
    "-mm 0 1",
    "-imfchan r",
]


@pytest.mark.parametrize("name", ["a.png", "my a.png", "a -s b.png", "a-s 2.png", "-a.png"])
def test_options_on_both_sides_of_a_name(name):
    for count in (0, 1, 2, 3):
        for chosen in itertools.permutations(OPTIONS, count):
            entry = parse_map(" ".join([*chosen, name]))
            assert entry["name"] == name
            for before in range(count):
                parts = [*chosen[:before], name, *chosen[before:]]
                assert parse_map(" ".join(parts)) == entry
                assert parse_map("\t ".join(parts).upper())["name"].upper() == name.upper()


@pytest.mark.parametrize(
    "statement",
    ["Kx 1 0 0", "diffuse 1 0 0", "Color 1 0 0", "map_diffuse a.png", "map_Foo a.png", "alpha 0.5"]
    + ["transparency 0.5", "texture a.png", "MapKd a.png", "albedo 1 1 1", "emission 1 1 1"],
)
def test_what_looks_like_a_look_is_told_once(load, statement):
    mesh = load(f"newmtl m\n{statement}\n{statement}\nnewmtl n\n{statement}\n")
    keyword = statement.split()[0]
    (message,) = mesh.warnings
    assert message.endswith(f"m.mtl:2: {keyword!r} is not understood, and not drawn")


@pytest.mark.parametrize("statement", ["interpolateMode x", "sharpness 60", "vendor 1", "Tf 1 1 1"])
def test_what_does_not_is_kept_without_a_word(load, statement):
    mesh = load(f"newmtl m\n{statement}\n")
    assert not mesh.warnings and statement.split()[0] in mesh.materials[0].extras


@pytest.mark.parametrize(
    ("text", "alpha", "told"),
    [
        ("Tr 1", 1.0, True),
        ("tr 1.0", 1.0, True),
        ("Tr 1\nd 1", 1.0, False),
        ("Tr 1\nd 0.5", 0.5, False),
        ("Tr 0", 1.0, False),
        ("Tr 0.75", 0.25, False),
        ("d 0", 0.0, False),
    ],
)
def test_transparency_of_1_alone_counts_as_opaque(load, text, alpha, told):
    mesh = load(f"newmtl m\n{text}\n")
    assert mesh.materials[0].alpha == alpha
    assert any("counts as opaque" in line for line in mesh.warnings) == told
    assert (mesh.materials[0].alpha_mode == "opaque") == (alpha == 1)


def test_the_only_material_of_a_library_that_is_not_used(load):
    mesh = load("newmtl x\nKd 0 1 0\nmap_Kd a.png\n", BARE)
    assert [material.name for material in mesh.materials] == ["x"]
    assert mesh.materials[0].texture is not None
    (message,) = mesh.warnings
    assert message.endswith("no usemtl: the only material of the library, 'x', is used")


def test_of_several_materials_none_is_used(load, tmp_path):
    mesh = load("newmtl x\nKd 0 1 0\nnewmtl y\n", BARE)
    assert mesh.materials[0].color == (1, 1, 1)
    (message,) = mesh.warnings
    assert message.endswith("no usemtl: none of the 2 materials of the library is used")


@pytest.mark.parametrize("library", ["newmtl x\nnewmtl y\n", "# nothing\n"])
@pytest.mark.parametrize("model", [BARE, MODEL])
def test_a_library_that_is_not_used_keeps_no_companion_away(load, tmp_path, library, model):
    Image.new("RGB", (2, 2), (9, 9, 9)).save(tmp_path / "a_diffuse.png")
    mesh = load(library, model)
    assert mesh.materials[0].texture is not None
    assert "a_diffuse.png" in mesh.warnings[-1]


def test_names_of_materials_in_other_letters(load):
    mesh = load("newmtl M\nKd 1 0 0\n")
    assert mesh.materials[0].color == (1, 0, 0)
    assert mesh.warnings[0].endswith("material 'm' is in no library; 'M' is used")
    mesh = load("newmtl M\nKd 1 0 0\nnewmtl m\nKd 0 1 0\n")
    assert mesh.materials[0].color == (0, 1, 0) and not mesh.warnings


@pytest.mark.parametrize("statement", ["", "mtllib gone.mtl\n"])
def test_a_library_of_the_models_own_name(load, tmp_path, statement):
    (tmp_path / "a.mtl").write_text("newmtl m\nKd 1 0 0\n")
    mesh = load("", MODEL.replace("mtllib m.mtl\n", statement))
    assert mesh.materials[0].color == (1, 0, 0)
    assert mesh.warnings[-1].endswith("no material library is found: 'a.mtl' is used")


def test_pictures_of_light_are_textures(load, tmp_path):
    """Codes are sRGB where they are colours, and proportional where they are numbers."""
    row = bytes([128, 32, 255, 128])  # 0.5, 0.125, nearly 1
    head = b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 2 +X 2\n"
    (tmp_path / "a.hdr").write_bytes(head + row * 4)
    (material,) = load("newmtl m\nmap_Kd a.hdr\nmap_Pr a.hdr\n").materials
    assert material.texture.pixels[0, 0].tolist() == [188, 99, 255, 255]
    roughness = getattr(material.metallic_roughness_texture, "texture", None)
    roughness = material.metallic_roughness_texture if roughness is None else roughness
    assert roughness.pixels[0, 0, 1] == 128
