"""What a format holds comes back; what it does not hold is named; what others wrote stays."""

import os
import re
import warnings

import numpy as np
import pytest
from plain_picture import render

import engine3d as e3d
from engine3d.apps.cli import main

QUAD = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)]
HALVES = [(0, 1, 2), (0, 2, 3)]
#: The diagonal does not show: the two triangles are one polygon.
DIAGONAL = [(True, True, False), (False, True, True)]


def polygon(**options):
    return e3d.Mesh(QUAD, HALVES, edge_visible=DIAGONAL, **options)


def said_of(mesh, path, **options):
    """Save a mesh; returns the warnings."""
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        mesh.save(path, **options)
    texts = [str(warning.message) for warning in caught]
    assert all(text.startswith(f"{path}: ") for text in texts)
    return [text.removeprefix(f"{path}: ") for text in texts]


def loaded(path):
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        return e3d.load_mesh(path)


def image(seed, **options):
    pixels = np.random.default_rng(seed).integers(0, 255, (2, 3, 4), np.uint8)
    return e3d.Texture(pixels, **options)


def red(**options):
    return e3d.Material(name="red", color=(1.0, 0.0, 0.0), **options)


# ---- polygons ----


def test_triangles_of_one_polygon_keep_their_materials(tmp_path):
    path = tmp_path / "a.obj"
    mesh = polygon(materials=[red(), e3d.Material(name="blue", color=(0.0, 0.0, 1.0))])
    mesh.material_ids = [0, 1]
    said = said_of(mesh, path)
    assert said == ["obj files do not hold the hidden edges of 2 triangles"]
    again = loaded(path)
    assert np.array_equal(again.faces, mesh.faces)
    assert [again.materials[k].name for k in again.material_ids] == ["red", "blue"]


def test_triangles_of_one_polygon_keep_their_groups(tmp_path):
    mesh = polygon()
    mesh.groups = {"left": np.array([1]), "all": np.array([0, 1])}
    assert len(said_of(mesh, tmp_path / "a.obj")) == 1
    again = loaded(tmp_path / "a.obj")
    assert {name: faces.tolist() for name, faces in again.groups.items()} == {
        "all": [0, 1],
        "left": [1],
    }


def test_polygons_of_one_material_stay_whole(tmp_path):
    """Beside one that falls apart."""
    flags = np.array(DIAGONAL * 3)
    faces = (np.arange(0, 12, 4)[:, None, None] + HALVES).reshape(-1, 3)
    mesh = e3d.Mesh(QUAD * 3, faces, edge_visible=flags)
    mesh.materials = [red(), e3d.Material(name="blue")]
    mesh.material_ids = [0, 0, 0, 1, 1, 1]
    said_of(mesh, tmp_path / "a.obj")
    lines = (tmp_path / "a.obj").read_text().splitlines()
    assert [len(line.split()) - 1 for line in lines if line.startswith("f ")] == [4, 3, 3, 4]
    again = loaded(tmp_path / "a.obj")
    assert np.array_equal(again.material_ids, mesh.material_ids)
    assert np.array_equal(again.positions[again.faces], mesh.positions[mesh.faces])


# ---- materials ----


@pytest.mark.parametrize(
    ("options", "thing"),
    [
        ({"two_sided": True}, "two_sided"),
        ({"flat_shading": True}, "flat_shading"),
        ({"texture": image(0, wrap="mirror")}, "the texture's wrap 'mirror'"),
        ({"texture": image(0, wrap=("clamp", "repeat"))}, "the texture's wrap ('clamp', 'repeat')"),
        ({"texture": image(0, filter="nearest")}, "the texture's filter 'nearest'"),
        ({"texture": image(0, color_space="linear")}, "the texture's colour space 'linear'"),
        ({"specular": (1, 1, 1), "shininess": 0}, "a highlight of no shininess"),
        ({"extras": {"Ka": "much"}}, "extras['Ka']"),
        ({"extras": {"two words": "x"}}, "extras['two words']"),
        ({"extras": {"newmtl": "x"}}, "extras['newmtl']"),
        ({"extras": {"alphaMode": "a\nnewmtl b"}}, "extras['alphaMode']"),
        ({"extras": {"maps": {"map_Ka": "a.png"}}}, "extras['maps']['map_Ka']"),
        ({"extras": {"maps": {"map_Ka": {"name": "a\nb"}}}}, "extras['maps']['map_Ka']"),
        ({"extras": {"maps": {"map_Kd": {"name": "gone.png"}}}}, "map_Kd without its image"),
    ],
)
def test_what_mtl_cannot_say_is_named(tmp_path, options, thing):
    mesh = polygon(materials=[red(**options)], uvs=np.zeros((4, 2)), normals=QUAD)
    assert said_of(mesh, tmp_path / "a.obj") == [f"obj files do not hold {thing} of 'red'"]
    assert [m.name for m in loaded(tmp_path / "a.obj").materials] == ["red"]


def test_a_flood_of_materials_is_cut(tmp_path):
    materials = [e3d.Material(name=f"m{k}", two_sided=True) for k in range(9)]
    said = said_of(polygon(materials=materials), tmp_path / "a.obj")
    assert said == ["obj files do not hold two_sided of 'm0', 'm1', 'm2' and 6 more"]


def test_what_mtl_can_say_comes_back(tmp_path):
    extras = {
        "Pm": 0.25,
        "Ka": (0.5, 0.25, 1.0),
        "illum": 2.0,
        "d": 0.5,
        "opacity": 0.5,
        "Km": "0.3",
        "maps": {"map_Ks": {"bm": ["2"], "mm": ["0", "1"], "name": "my shine.png"}},
    }
    material = red(texture=image(1, wrap="clamp"), specular=(1, 1, 0), extras=extras)
    material.color, material.alpha_mode = (*material.rgb, 0.5), "blend"
    mesh = polygon(materials=[material], uvs=np.zeros((4, 2)))
    said = said_of(mesh, tmp_path / "a.obj")
    assert said == ["images that are named, but not copied: 'my shine.png'"]
    again = loaded(tmp_path / "a.obj").materials[0]
    maps = again.extras["maps"]
    assert maps.pop("map_Kd") == {"clamp": ["on"], "name": "a_0.png"}
    assert maps.pop("map_d") == {"name": "a_0.png"}  # the image has alpha
    assert again.extras == extras
    assert again.texture.wrap == "clamp"
    assert np.array_equal(again.texture.pixels, material.texture.pixels)


def test_options_of_the_texture_come_back(tmp_path):
    (tmp_path / "in.mtl").write_text("newmtl m\nmap_Kd -bm 2 -s 2 2 1 -clamp on a.png\n")
    (tmp_path / "in.obj").write_text(
        "mtllib in.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\n"
        "usemtl m\nf 1/1 2/2 3/3\n"
    )
    render(e3d.Scene(), size=(2, 2)).save(tmp_path / "a.png")
    mesh = e3d.load_mesh(tmp_path / "in.obj")
    assert said_of(mesh, tmp_path / "out.obj") == []
    again = loaded(tmp_path / "out.obj")
    assert again.materials[0].extras["maps"]["map_Kd"]["bm"] == ["2"]
    assert again.materials[0].texture.wrap == "clamp"
    assert np.array_equal(again.uvs, mesh.uvs)


def test_physically_based_numbers_of_gltf_become_those_of_mtl(tmp_path):
    extras = {"metallicFactor": 0.25, "roughnessFactor": 0.5}
    assert said_of(polygon(materials=[red(extras=extras)]), tmp_path / "a.obj") == []
    again = loaded(tmp_path / "a.obj").materials[0].extras
    assert (again["Pm"], again["Pr"]) == (0.25, 0.5)


def test_lines_keep_their_material(tmp_path):
    mesh = e3d.Mesh(QUAD, lines=[(0, 1)], materials=[red()])
    assert said_of(mesh, tmp_path / "a.obj") == []
    assert loaded(tmp_path / "a.obj").materials[0].color == (1, 0, 0)


@pytest.mark.parametrize(
    ("format", "things"),
    [
        ("ply", "materials, groups"),
        ("stl", "texture coordinates, materials, groups, vertex normals, polygons"),
    ],
)
def test_other_formats_name_what_they_lose(tmp_path, format, things):
    for material in (red(), e3d.Material(specular=(1, 1, 1)), e3d.Material(two_sided=True)):
        mesh = polygon(materials=[material], uvs=np.zeros((4, 2)), normals=QUAD)
        mesh.groups = {"a": np.array([0])}
        said = said_of(mesh, tmp_path / f"a.{format}")
        assert said == [f"{format} files do not hold {things}"]


# ---- names ----

ODD = ["a\\", "b\0c", "d\ne", "f\r\nf 1 1 1", "#g", "h #i", " j", "\x1b[2Jk", "\\", "l\u2028m"]


@pytest.mark.parametrize("odd", ODD)
def test_odd_names_are_read_back_and_told(tmp_path, odd):
    materials = [red(), e3d.Material(name=odd, color=(0.0, 0.0, 1.0))]
    mesh = e3d.Mesh(QUAD, HALVES, materials=materials, material_ids=[0, 1], name=odd)
    mesh.groups = {odd: np.array([0]), "x": np.array([1])}
    said = said_of(mesh, tmp_path / "a.obj")
    for kind in ("materials", "groups", "objects"):
        assert sum(f"{kind} that the format cannot name so: {odd!r} is " in s for s in said) == 1
    again = loaded(tmp_path / "a.obj")
    assert np.array_equal(again.faces, mesh.faces)
    assert [m.color for m in again.materials] == [(1, 0, 0), (0, 0, 1)]
    assert [faces.tolist() for faces in again.groups.values()] == [[0], [1]]
    assert f"{odd!r} is {again.materials[1].name!r}" in "".join(said)
    assert f"{odd!r} is {list(again.groups)[0]!r}" in "".join(said)
    assert again.name.isprintable() and again.name


@pytest.mark.parametrize("odd", ODD)
def test_odd_names_of_solids(tmp_path, odd):
    mesh = e3d.Mesh(QUAD, HALVES, name=odd)
    said_of(mesh, tmp_path / "a.stl", ascii=True)
    again = loaded(tmp_path / "a.stl")
    assert len(again.faces) == 2
    assert "".join(again.groups).isprintable()


def test_groups_of_one_name_stay_apart(tmp_path):
    mesh = e3d.Mesh(QUAD, HALVES)
    mesh.groups = {"a b": np.array([0]), "a_b": np.array([1])}
    said_of(mesh, tmp_path / "a.obj")
    assert [faces.tolist() for faces in loaded(tmp_path / "a.obj").groups.values()] == [[0], [1]]


FILES = ["a b", " a", "a  b", "#a", "a #b", "a\\b", "a\nb", "~a", "-clamp on", "C:a", '"a"', "a\\"]
FILES += [
    "\x1b[31mred",
    "größe",
    "名前" * 40,
    b"\xff".decode(errors="surrogateescape"),
    "-s 1",
    "\\",
]
NOT_ON_WINDOWS = re.compile(r'[<>:"/\\|?*\x00-\x1f\udc80-\udcff]')


@pytest.mark.parametrize("stem", FILES, ids=ascii)
def test_odd_names_of_files(tmp_path, stem):
    if os.name == "nt" and NOT_ON_WINDOWS.search(stem):
        pytest.skip("no file of Windows has such a name")
    mesh = polygon(materials=[red(texture=image(1))], uvs=np.zeros((4, 2)))
    mesh.save(tmp_path / f"{stem}.obj")
    again = loaded(tmp_path / f"{stem}.obj")
    assert again.materials[0].color == (1, 0, 0)
    assert np.array_equal(again.materials[0].texture.pixels, mesh.materials[0].texture.pixels)
    assert again.warnings == []


# ---- files of others ----


def textured(seed):
    material = e3d.Material(name="paint", texture=image(seed))
    return polygon(materials=[material], uvs=np.zeros((4, 2)))


def test_files_of_others_stay(tmp_path):
    path = tmp_path / "new.obj"
    others = {"new.mtl": b"newmtl hand made\n", "new_0.png": b"a photograph"}
    for name, content in others.items():
        (tmp_path / name).write_bytes(content)
    (tmp_path / "new_1.mtl").mkdir()
    for seed in (1, 2):
        said = said_of(textured(seed), path)
        assert said == ["'new.mtl' is not engine3d's to replace: the materials are in 'new_2.mtl'"]
        again = loaded(path).materials[0].texture
        assert np.array_equal(again.pixels, image(seed).pixels)
    for name, content in others.items():
        assert (tmp_path / name).read_bytes() == content
    names = sorted(entry.name for entry in tmp_path.iterdir())
    assert names == ["new.mtl", "new.obj", "new_0.png", "new_1.mtl", "new_1.png", "new_2.mtl"]


def test_files_of_our_own_are_replaced(tmp_path):
    for seed in (1, 2):
        assert said_of(textured(seed), tmp_path / "new.obj") == []
    assert sorted(e.name for e in tmp_path.iterdir()) == ["new.mtl", "new.obj", "new_0.png"]
    again = loaded(tmp_path / "new.obj").materials[0].texture
    assert np.array_equal(again.pixels, image(2).pixels)


@pytest.mark.parametrize("way", ["same", "link", "dots"])
def test_a_model_is_not_converted_to_itself(tmp_path, monkeypatch, capsys, way):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "sub").mkdir()
    (tmp_path / "a.obj").write_bytes(b"# mine\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
    (tmp_path / "link.obj").symlink_to("a.obj")
    before = (tmp_path / "a.obj").read_bytes()
    output = {"same": "a.obj", "link": "link.obj", "dots": "sub/../a.obj"}[way]
    assert main(["convert", "a.obj", output]) == 2
    assert capsys.readouterr().err == f"engine3d: error: {output} is the model itself\n"
    assert (tmp_path / "a.obj").read_bytes() == before


def test_gltf_says_how_textures_are_no_longer_read(tmp_path):
    sharp = image(1, anisotropy=4, lod_bias=-0.5)
    mesh = polygon(uvs=np.zeros((4, 2)))
    mesh.materials = [e3d.Material(texture=sharp), e3d.Material(texture=image(2, anisotropy=2))]
    mesh.material_ids = [0, 1]
    told = said_of(mesh, tmp_path / "a.glb")
    assert "gltf files do not hold anisotropy of 2 textures" in told
    assert "gltf files do not hold lod_bias of 1 texture" in told


OF_SCENES = {
    "ambient": "red",
    "animator": e3d.Animator,
    "background": "red",
    "environment": e3d.Environment.studio(),
    "exposure": 1.0,
    "fog": e3d.Fog("red", 1.0, 9.0),
    "light_clamp": (0.0, 1.0),
}


@pytest.mark.parametrize("name", OF_SCENES)
def test_what_gltf_does_not_hold_of_a_scene_is_told(tmp_path, name):
    scene, value = e3d.Scene(), OF_SCENES[name]
    assert said_of(scene, tmp_path / "usual.glb") == []
    setattr(scene, name, value(scene) if callable(value) else value)
    told = said_of(scene, tmp_path / "a.glb")
    assert told == [f"gltf files do not hold {name.replace('_', ' ')}"]
