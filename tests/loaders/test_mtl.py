"""MTL, textures that files name, and the image that bears a model's name."""

import os
import time

import numpy as np
import pytest
from PIL import Image
from plain_picture import render

import engine3d as e3d
from engine3d import linear
from engine3d.errors import Engine3DWarning
from engine3d.loaders import companion_texture, load_mesh
from engine3d.model.materials.material import Material

MODEL = (
    "mtllib model.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nusemtl m\nf 1/1 2/2 3/3\n"
)
PLAIN = MODEL.partition("\n")[2].replace("usemtl m\n", "")


@pytest.fixture
def image(tmp_path):
    def write_image(name, color=(255, 0, 0)):
        path = tmp_path / name
        path.parent.mkdir(parents=True, exist_ok=True)
        Image.new("RGB", (2, 2), color).save(path)
        return path

    return write_image


@pytest.fixture
def material(write, obj_mesh):
    """``material(mtl_text) -> Material`` of a model that uses ``m``."""

    def read_material(text):
        write("model.mtl", "newmtl m\n" + text)
        return obj_mesh(MODEL).materials[0]

    return read_material


def test_colors_and_numbers(material):
    read = material("Ka .1 .1 .1\nKd .5 .25 0\nKs 1 1 1\nKe 0 0 .5\nNs 90\nd .5\nillum 2\nNi 1.5\n")
    assert read.name == "m"
    assert read.color == (0.5, 0.25, 0, 0.5)
    assert read.specular == (1, 1, 1)
    assert read.emissive == (0, 0, 0.5)
    assert read.shininess == 90
    assert read.extras["Ka"] == (0.1, 0.1, 0.1)
    assert read.extras["opacity"] == 0.5
    assert read.extras["Ni"] == 1.5


@pytest.mark.parametrize("keyword", ["maps", "opacity"])
def test_statements_that_bear_the_name_of_our_own_keys(write, obj_mesh, keyword):
    write("model.mtl", f"newmtl m\n{keyword} nonsense\nmap_Ka a.png\nd .5\n")
    mesh = obj_mesh(MODEL)
    assert f"{keyword} is left out" in mesh.warnings[0]
    assert mesh.materials[0].extras["opacity"] == 0.5
    assert mesh.materials[0].extras["maps"] == {"map_Ka": {"name": "a.png"}}
    write("model.mtl", f"newmtl m\n{keyword} nonsense\n")
    assert obj_mesh(MODEL).materials[0].extras == {}


def test_one_number_is_grey(material):
    assert material("Kd .5\n").color == (0.5, 0.5, 0.5)


def test_transparency_is_one_minus_opacity(material):
    assert material("Tr .25\n").extras["opacity"] == 0.75
    assert material("d .5\nTr .25\n").extras["opacity"] == 0.5
    assert material("d -halo .5\n").extras["opacity"] == 0.5


def test_illumination_without_highlight(material):
    assert material("Ks 1 1 1\nillum 1\n").specular == (0, 0, 0)
    assert material("Ks 1 1 1\nNs 0\n").specular == (0, 0, 0)


def test_physically_based_keys_are_kept(material):
    extras = material("Pr .3\nPm 1\nPs .1\nnorm bumps.png\nmap_Pr -bm 2 rough.png\n").extras
    assert (extras["Pr"], extras["Pm"], extras["Ps"]) == (0.3, 1, 0.1)
    assert extras["maps"]["norm"] == {"name": "bumps.png"}
    assert extras["maps"]["map_Pr"] == {"bm": ["2"], "name": "rough.png"}


@pytest.mark.parametrize(
    "line", ["Kd nan 0 0", "Kd 1e999 0 0", "Kd a b c", "Kd spectral x.rfl", "Kd", "Ns x", "Ns"]
)
def test_a_line_without_sense_is_a_warning(write, line):
    write("model.mtl", f"newmtl m\n{line}\n")
    with pytest.warns(Engine3DWarning, match=r"model\.mtl:2: "):
        mesh = load_mesh(write("model.obj", MODEL))
    assert mesh.materials[0].color == (1, 1, 1)


def test_texture(image, material):
    image("wood.png")
    read = material("Kd .5 .5 .5\nmap_Kd wood.png\n")
    assert read.texture.pixels[0, 0].tolist() == [255, 0, 0, 255]
    assert read.texture.name == "wood.png"
    assert read.texture.wrap == "repeat"
    assert read.color == (0.5, 0.5, 0.5)


def test_black_beside_a_texture_is_taken_as_white(image, material):
    image("wood.png")
    assert material("Kd 0 0 0\nmap_Kd wood.png\n").color == (1, 1, 1)


@pytest.mark.parametrize("name", ["old wood.png", "maps/wood.png", "maps\\wood.png", "WOOD.PNG"])
def test_texture_names(image, material, name):
    image({"WOOD.PNG": "wood.png"}.get(name, name.replace("\\", "/")))
    assert material(f"map_Kd {name}\n").texture is not None


def test_texture_options(image, write, obj_mesh):
    image("wood.png")
    write("model.mtl", "newmtl m\nmap_Kd -clamp on -s 2 3 -o .5 .25 0 -mm 0 1 wood.png\n")
    mesh = obj_mesh(MODEL)
    assert mesh.materials[0].texture.wrap == "clamp"
    assert sorted(mesh.uvs.tolist()) == [[0.5, 0.25], [0.5, 3.25], [2.5, 0.25]]


def test_transformed_uvs_leave_those_of_other_materials_alone(image, write, obj_mesh):
    image("wood.png")
    write("model.mtl", "newmtl m\nmap_Kd -s 2 2 2 wood.png\nnewmtl n\nmap_Kd wood.png\n")
    mesh = obj_mesh(MODEL + "usemtl n\nf 1/1 2/2 3/3\n")
    assert mesh.uvs[mesh.faces[0]].max() == 2
    assert mesh.uvs[mesh.faces[1]].max() == 1
    assert mesh.materials[0].texture is mesh.materials[1].texture


@pytest.mark.parametrize(
    ("name", "reason"),
    [
        ("none.png", "not found"),
        ("/etc/passwd", "absolute path"),
        ("C:\\windows\\x.png", "absolute path"),
        ("../outside.png", "leaves the model's folder"),
        ("folder", "not a regular file"),
        ("fifo", "not a regular file"),
        ("link.png", "leaves the model's folder"),
        ("broken.png", "damaged|not an image"),
    ],
)
def test_textures_that_are_not_read(tmp_path, image, name, reason):
    model = tmp_path / "model"
    (model / "folder").mkdir(parents=True)
    os.mkfifo(model / "fifo")
    outside = image("outside.png")
    (model / "link.png").symlink_to(outside)
    (model / "broken.png").write_bytes(b"\x89PNG\r\n\x1a\n broken")
    (model / "model.mtl").write_text(f"newmtl m\nmap_Kd {name}\n")
    (model / "model.obj").write_text(MODEL)
    with pytest.warns(Engine3DWarning, match=reason):
        mesh = load_mesh(model / "model.obj")
    assert len(mesh.faces) == 1
    assert mesh.materials[0].texture is None


def test_an_image_named_by_another_machines_path_is_found_beside_the_model(image, write):
    image("wood.png")
    write("model.mtl", "newmtl m\nmap_Kd C:\\art\\wood.png\n")
    with pytest.warns(Engine3DWarning, match=r"absolute path is refused; .*wood\.png is used"):
        mesh = load_mesh(write("model.obj", MODEL))
    assert mesh.materials[0].texture is not None


@pytest.mark.parametrize(
    "library", ["none.mtl", "../model.mtl", "/dev/zero", "folder", "model.obj", ""]
)
def test_a_library_that_is_not_read_is_a_warning(write, tmp_path, library):
    (tmp_path / "a" / "folder").mkdir(parents=True)
    write("model.mtl", "newmtl m\nKd 1 0 0\n")
    path = write("a/model.obj", MODEL.replace("model.mtl", library))
    with pytest.warns(Engine3DWarning, match=r"model\.obj:"):
        mesh = load_mesh(path)
    assert len(mesh.faces) == 1
    assert mesh.materials[0].color == (1, 1, 1)


def test_libraries_with_blanks_and_several_on_a_line(write, obj_mesh):
    write("my library.mtl", "newmtl m\nKd 1 0 0\n")
    write("b.mtl", "newmtl n\nKd 0 1 0\nnewmtl m\nKd 0 0 1\n")
    text = (
        MODEL.replace("model.mtl", "my library.mtl") + "mtllib none.mtl b.mtl\nusemtl n\nf 1 2 3\n"
    )
    mesh = obj_mesh(text)
    assert [m.color for m in mesh.materials] == [(1, 0, 0), (0, 1, 0)]
    assert mesh.material_ids.tolist() == [0, 1]


def test_names_with_blanks_and_other_encodings(write, obj_mesh):
    write("model.mtl", b"newmtl   dark red # not bright\nKd 1 0 0\nnewmtl caf\xe9#1\nKd 0 0 1\n")
    text = MODEL.encode().replace(b"usemtl m", b"usemtl dark red\t")
    mesh = obj_mesh(text + b"usemtl caf\xe9#1\nf 1 2 3\n")
    assert [m.name for m in mesh.materials] == ["dark red", "caf\xe9#1"]
    assert [m.color for m in mesh.materials] == [(1, 0, 0), (0, 0, 1)]


def test_an_unknown_material_is_plain_and_warned_of(write):
    write("model.mtl", "newmtl other\n")
    with pytest.warns(Engine3DWarning, match=r"model\.obj:8: material 'm' is in no library"):
        mesh = load_mesh(write("model.obj", MODEL))
    assert mesh.materials[0].name == "m"


def test_faces_before_any_material_get_a_plain_one(write, obj_mesh):
    write("model.mtl", "newmtl m\nKd 1 0 0\n")
    mesh = obj_mesh(MODEL.replace("usemtl m\n", "") + "usemtl m\nf 1 2 3\n")
    assert [mesh.materials[k].color for k in mesh.material_ids] == [(1, 1, 1), (1, 0, 0)]


@pytest.mark.parametrize(
    "name", ["model.tga", "Model.TGA", "model_diffuse.png", "model_texture.JPG", "model_color.bmp"]
)
def test_the_image_that_bears_the_models_name(image, write, name):
    expected = image(name)
    path = write("model.obj", PLAIN)
    with pytest.warns(Engine3DWarning, match=f"no materials: '{name}' beside the model is taken"):
        mesh = load_mesh(path)
    assert mesh.materials[0].texture.name == name
    assert companion_texture(path) == str(expected)


@pytest.mark.parametrize("name", ["model.png", "model.jpg", "model.webp", "model2.tga", "m.tga"])
def test_pictures_of_the_model_and_of_others_are_no_companions(image, write, obj_mesh, name):
    image(name)
    assert companion_texture(write("model.obj", PLAIN)) is None
    assert obj_mesh(PLAIN).materials[0].texture is None


def test_a_picture_that_we_drew_is_no_companion(write, tmp_path):
    scene = e3d.Scene()
    scene.add(e3d.box())
    for name in ("model.tga", "model_diffuse.tga"):
        render(scene, size=(8, 8)).save(tmp_path / name)
    assert companion_texture(write("model.obj", PLAIN)) is None


def test_the_plain_name_comes_first_and_tga_before_png(image, write):
    path = write("model.obj", PLAIN)
    found = []
    for name in ("model_texture.png", "model_diffuse.png", "model_diffuse.tga", "model.tga"):
        image(name)
        found.append(companion_texture(path) == str(path.parent / name))
    assert all(found)
    assert companion_texture(path, lambda p: not p.endswith("l.tga")).endswith("_diffuse.tga")


def test_a_model_with_materials_gets_no_companion(image, material):
    image("model.tga")
    assert material("Kd 1 0 0\n").texture is None


def test_a_model_without_uvs_gets_no_companion(image, obj_mesh):
    image("model.tga")
    mesh = obj_mesh("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
    assert mesh.materials[0].texture is None


def test_a_companion_that_leads_out_is_not_followed(image, write, tmp_path):
    outside = image("outside.png")
    path = write("inside/model.obj", PLAIN)
    (tmp_path / "inside" / "model_diffuse.png").symlink_to(outside)
    assert companion_texture(path) is None


def test_a_texture_is_read_once_for_several_materials(image, write, obj_mesh):
    image("wood.png")
    write("model.mtl", "newmtl m\nmap_Kd wood.png\nnewmtl n\nmap_Kd ./wood.png\n")
    mesh = obj_mesh(MODEL + "usemtl n\nf 1 2 3\n")
    assert mesh.materials[0].texture is mesh.materials[1].texture
    assert np.array_equal(mesh.material_ids, [0, 1])


def test_what_is_not_drawn_is_told_once_a_kind(image, write):
    image("a.png")
    write(
        "a.mtl",
        "newmtl a\nd 0.5\nmap_Bump a.png\nPr 0.5\nnewmtl b\nTr 0.25\nbump a.png\n"
        "newmtl c\nmap_d a.png\nnorm a.png\ndisp a.png\nrefl -type sphere a.png\n"
        "newmtl d\nKe 1 1 1\nmap_Ke a.png\nmap_Pr a.png\nmap_Ks a.png\n"
        "newmtl plain\nd 1\nKe 0 1 0\nnewmtl unused\nd 0\n",
    )
    uses = "".join(f"usemtl {name}\nf 1 2 3\n" for name in ("a", "b", "c", "d", "plain"))
    path = write("a.obj", "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\n" + uses)
    with pytest.warns(Engine3DWarning):
        mesh = load_mesh(path)
    told = [warning.removeprefix(f"{path}: ") for warning in mesh.warnings]
    assert [line for line in told if not line.endswith("not found")] == [
        "1 material has a displacement map: drawn without",
        "1 material has a reflection map: drawn without",
        "1 material has a map of its highlight: left out",
    ]
    assert [material.emissive for material in mesh.materials[3:]] == [(0, 0, 0), (0, 1, 0)]


def test_very_many_materials(write):
    """Making one may not take long: a file of eight megabytes may name half a million."""
    lines = "".join(f"usemtl m{k}\nf 1 2 3\n" for k in range(50_000))
    path = write("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n" + lines)
    start = time.process_time()
    mesh = load_mesh(path)
    assert time.process_time() - start < 1.5
    assert [material.name for material in mesh.materials[::49_999]] == ["m0", "m49999"]
    made = Material(name="m0")
    assert {**vars(made), "version": 0} == {**vars(mesh.materials[0]), "version": 0}
    assert mesh.materials[0].extras is not mesh.materials[1].extras


def physical(write, statements):
    """The material of a library in whose folder there are some images."""
    ramp = np.arange(0, 256, 16, dtype=np.uint8)[np.newaxis, :, np.newaxis]
    images = {
        "a.png": np.full((2, 2, 3), 100, np.uint8),
        "b.png": np.full((4, 2, 3), 200, np.uint8),
        "n.png": np.full((4, 4, 3), (128, 128, 255), np.uint8),
        "bumps.png": np.broadcast_to(ramp, (4, 16, 3)),
    }
    for name, pixels in images.items():
        Image.fromarray(np.ascontiguousarray(pixels)).save(write(name, b""))
    write("a.mtl", f"newmtl m\n{statements}")
    path = write("a.obj", "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl m\nf 1 2 3\n")
    return load_mesh(path).materials[0]


def test_numbers_of_physically_based_materials(write):
    material = physical(write, "Pr .3\nPm 1\nPc .5\nPcr .25\nPs .1\nNi 1.7\n")
    assert (material.roughness, material.metallic, material.ior) == (0.3, 1, 1.7)
    assert (material.clearcoat, material.clearcoat_roughness) == (0.5, 0.25)
    assert material.sheen_color == linear(0.1, 0.1, 0.1)
    assert not physical(write, "Ks 1 1 1\nNi 1.7\n").is_physical


def test_maps_of_roughness_and_metal_become_one(write):
    material = physical(write, "map_Pr a.png\nmap_Pm b.png\nmap_Ke a.png\n")
    pixels = material.metallic_roughness_texture.pixels
    assert pixels.shape == (4, 2, 4) and pixels[0, 0].tolist() == [255, 100, 200, 255]
    assert (material.metallic, material.roughness, material.emissive) == (1, 1, (1, 1, 1))
    assert material.emissive_texture.pixels[0, 0, 0] == 100
    only = physical(write, "map_Pr a.png\nPm 0.5\n")
    assert (only.metallic, only.metallic_roughness_texture.pixels[0, 0, 2]) == (0.5, 255)
    packed = physical(write, "map_RMA n.png\n")
    assert packed.metallic_roughness_texture.pixels[0, 0].tolist() == [255, 128, 128, 255]
    assert packed.occlusion_texture is packed.metallic_roughness_texture


def test_normals_are_taken_from_heights_or_as_they_are(write):
    """Heights rise to the right, so normals lean to the left, but where the image begins anew."""
    material = physical(write, "bump -bm 0.5 bumps.png\n")
    assert not material.is_physical and material.normal_scale == 0.5
    normals = material.normal_texture.pixels[0, :, :3].astype(int)
    slope = 16 / 255 / 64 * 16
    expected = 127.5 * np.array([-slope, 0, 1]) / np.hypot(1, slope) + 127.5
    assert np.abs(normals[1:-1] - expected).max() <= 1
    assert normals[0, 0] > 128 and normals[-1, 0] > 128
    for statement in ("norm -bm 2 n.png", "map_Bump -bm 2 n.png"):
        material = physical(write, f"{statement}\n")
        assert material.normal_texture.pixels[0, 0].tolist() == [128, 128, 255, 255]
        assert material.normal_scale == 2


def test_maps_at_a_scale_of_their_own(write):
    """Where the base colour's image is moved, the mesh's coordinates are."""
    text = "map_Kd -s 2 4 -o .5 0 a.png\nnorm -s 2 4 -o .5 0 n.png\nmap_Pr -s 6 4 b.png\n"
    material = physical(write, text)
    assert isinstance(material.normal_texture, e3d.Texture)
    placed = material.metallic_roughness_texture
    u, v = 0.3, 0.8
    moved = placed.matrix @ (2 * u + 0.5, 4 * v, 1)
    assert np.allclose(moved, (6 * u, 4 * v))
