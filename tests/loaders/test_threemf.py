"""3MF: what is placed where, colours and textures, units, and packages that mean harm."""

import io
import re
import warnings
import zipfile

import numpy as np
import pytest
from loaders.seeds import THREEMF, THREEMF_MODEL, THREEMF_RELATIONS, threemf_package

import engine3d as e3d
from engine3d.apps.cli.commands.info import describe
from engine3d.errors import FileFormatError
from engine3d.io.formats.threemf import threemf
from engine3d.io.formats.threemf.threemf_blocks import cut_lists
from engine3d.io.loaders import load_document, load_mesh
from engine3d.io.reading import sources
from engine3d.stage.open_model import open_model

CORE = "http://schemas.microsoft.com/3dmanufacturing/core/2015/02"
PRODUCTION = "http://schemas.microsoft.com/3dmanufacturing/production/2015/06"
CORNER = (
    '<mesh><vertices><vertex x="0" y="0" z="0"/><vertex x="1" y="0" z="0"/>'
    '<vertex x="0" y="1" z="0"/></vertices><triangles><triangle v1="0" v2="1" v3="2"/>'
    "</triangles></mesh>"
)


def model(resources, build='<item objectid="1"/>', unit="millimeter", more=""):
    return (
        f'<model unit="{unit}" xmlns="{CORE}" xmlns:p="{PRODUCTION}" {more}>'
        f"<resources>{resources}</resources><build>{build}</build></model>"
    ).encode()


def package(xml, **others):
    parts = {"_rels/.rels": THREEMF_RELATIONS, "3D/model.model": xml}
    return threemf_package(parts | {f"3D/{name}": content for name, content in others.items()})


def quietly(load, *arguments, **options):
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        return load(*arguments, **options)


def test_what_the_build_places(write):
    path = write("a.3mf", threemf_package(THREEMF))
    with pytest.warns(e3d.Engine3DWarning) as told:
        document = load_document(path)
    assert [str(one.message).removeprefix(f"{path}: ") for one in told] == [
        "beams are drawn as lines, whatever their radius",
        "of properties in several layers the texture is drawn alone",
    ]
    assert [entry.name for entry in document.objects] == ["roof"] * 3
    assert len({id(entry.mesh) for entry in document.objects}) == 1
    places = [entry.pose @ (2, 0, 0, 1) for entry in document.objects]
    assert np.array(places)[:, :3].tolist() == [[0, 2, 5], [0, 12, 5], [2, 0, 0]]
    assert document.objects[0].mesh.lines.shape == (1, 2)
    whole = quietly(load_mesh, path)
    assert len(whole.faces) == 15
    assert whole.bounds.tolist() == [[-2.5, 0, 0], [2, 12, 15]]
    report = describe(path)
    assert (report["format"], report["unit"], report["triangles"]) == ("3mf", "in", 15)
    assert quietly(open_model, path).up == "+Z"
    assert len(quietly(load_mesh, path.read_bytes()).faces) == 15  # known without its name


def test_colours_and_textures_of_triangles(write):
    mesh = quietly(load_document, write("a.3mf", threemf_package(THREEMF))).objects[0].mesh
    first, colored, textured, mixed, layered = (
        mesh.materials[number] for number in mesh.material_ids.tolist()
    )
    assert (first.name, first.color, first.alpha_mode) == ("glass", (0, 128, 255, 128), "blend")
    assert colored.texture is None and colored.alpha_mode == "opaque"
    corners = mesh.colors[mesh.faces[1]]
    assert corners.tolist() == [[0, 255, 0, 255], [0, 0, 255, 255], [0, 0, 255, 255]]
    assert (mesh.colors[mesh.faces[[0, 2, 3, 4]]] == 255).all()
    assert textured.texture.side_wraps == ("mirror", "repeat") and layered is textured
    assert mesh.uvs[mesh.faces[2]].tolist() == [[0, 0], [1, 0.5], [0, 0]]
    assert mesh.uvs[mesh.faces[4]].tolist() == [[1, 0.5]] * 3
    assert mixed.color == (188, 92, 188, 192)  # halfway in linear light


def test_what_programs_write_besides(write):
    base = '<basematerials id="2"><base name="x" displaycolor="#CAD1EE00"/></basematerials>'
    triangle = '<triangle v1="0" v2="1" v3="2" s:paint_color="8"/>'
    corner = CORNER.replace('<triangle v1="0" v2="1" v3="2"/>', triangle)
    text = f'{base}<object id="1" pid="2" pindex="0">{corner}</object><s:slicestack id="9"/>'
    path = write("a.3mf", package(model(text, build="", more='xmlns:s="http://slicer"')))
    with pytest.warns(e3d.Engine3DWarning) as told:
        mesh = load_mesh(path)
    assert [str(one.message).removeprefix(f"{path}: ") for one in told] == [
        "material 'x', which would not show, is drawn opaque",
        "'paint_color' of triangles is left out",
        "'slicestack' is left out",
    ]
    assert mesh.materials[0].color == (0xCA, 0xD1, 0xEE, 255)


def test_metals(write):
    m = 'xmlns:m="http://schemas.microsoft.com/3dmanufacturing/material/2015/02"'
    text = (
        '<m:pbmetallicdisplayproperties id="3"><m:pbmetallic name="gold" metallicness="1" '
        'roughness="0.25"/></m:pbmetallicdisplayproperties><basematerials id="2" '
        'displaypropertiesid="3"><base name="gold" displaycolor="#FFD700"/></basematerials>'
        f'<object id="1" pid="2">{CORNER}</object>'
    )
    (material,) = load_mesh(write("a.3mf", package(model(text, more=m)))).materials
    assert (material.metallic, material.roughness) == (1.0, 0.25)


def test_parts_of_another_unit_are_scaled(write):
    placed = (
        '<object id="1"><components><component objectid="5" p:path="/3D/b.model" '
        'transform="1 0 0 0 1 0 0 0 1 2 0 0"/></components></object>'
    )
    other = model(f'<object id="5">{CORNER}</object>', build="", unit="centimeter")
    data = package(model(placed), **{"b.model": other})
    assert load_mesh(write("a.3mf", data)).bounds.tolist() == [[2, 0, 0], [12, 10, 0]]


def test_far_from_the_origin(write):
    far = CORNER.replace('x="0"', 'x="5000000"').replace('x="1"', 'x="5000001"')
    data = package(model(f'<object id="1">{far}</object>'))
    (entry,) = load_document(write("a.3mf", data)).objects
    assert abs(entry.mesh.positions).max() < 8 and entry.pose[0, 3] > 4e6


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ('v1="0" v2="2" v3="1"', 'v1="0" v2="2" v3="4"', r"vertex 4 where there are 4"),
        ('v1="0" v2="2" v3="1"', 'v1="0" v2="2"', r"'v3' is missing"),
        ('v1="0" v2="2" v3="1"', 'v1="0" v2="2" v3="-1"', r"'v3' is no index: '-1'"),
        ('x="2" y="0" z="0"', 'x="2" y="0"', r"3D/model.model:\d+: a vertex without 'z'"),
        ('x="2" y="0" z="0"', 'x="2" y="a" z="0"', r"a vertex of no numbers"),
        ('objectid="7"/></build>', 'objectid="9"/></build>', r"there is no object 9"),
        ("1 0 0 0 1 0 0 0 1 10 0 0", "1 0 0", r"a transform is twelve numbers: '1 0 0'"),
        ('id="8"', 'id="7"', r"id 7 is given twice"),
        ("inch", "furlong", r"unit is none of micron, .*: 'furlong'"),
        ("</model>", "", r"no well-formed XML: no element found"),
        ("<model", "<!DOCTYPE a [<!ENTITY b 'c'>]><model", r"a document type is not allowed"),
        ("<metadata", "<metadata>" * 80 + "<metadata", r"nested more than 64 deep"),
        ('encoding="UTF-8"', 'encoding="klingon"', r"no readable XML: its encoding is not known"),
        ('objectid="7" transform', 'objectid="8" transform', r"nested more than 32 deep"),
    ],
)
def test_what_is_wrong(write, old, new, message):
    xml = THREEMF_MODEL.decode()
    assert old in xml
    path = write("a.3mf", package(xml.replace(old, new, 1).encode(), **{"house.tga": b"x"}))
    with pytest.raises(FileFormatError, match=f"^{re.escape(str(path))}: .*{message}"):
        quietly(load_mesh, path)


def test_a_texture_that_is_missing_is_left_out(write):
    path = write("a.3mf", package(THREEMF_MODEL))
    with pytest.warns(e3d.Engine3DWarning, match=r"texture '/3D/house.tga' is left out: .* not in"):
        mesh = load_mesh(path)
    assert all(material.texture is None for material in mesh.materials)


def test_packages_that_mean_harm(write, monkeypatch):
    cases = [
        (b"solid a", "not a 3mf file"),
        (b"PK\3\4 no more", "damaged archive"),
        (threemf_package({"a.txt": b""}), "there is no model in it"),
        (threemf_package({"a.model": b"<html/>"}), "it begins with another element"),
    ]
    for data, message in cases:
        with pytest.raises(FileFormatError, match=message):
            load_mesh(write("a.3mf", data))
    file = io.BytesIO()
    with zipfile.ZipFile(file, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("a.model", b"<!--" + b" " * (1 << 16))
    monkeypatch.setattr(sources, "MAX_UNPACKED_BASE", 1 << 12)
    with pytest.raises(FileFormatError, match="unpacks to more than"):
        load_mesh(write("a.3mf", file.getvalue()))
    damaged = bytearray(threemf_package({"a.model": THREEMF_MODEL}))
    damaged[60:70] = bytes(10)
    with pytest.raises(FileFormatError, match=r"a.3mf: '/a.model' is damaged"):
        load_mesh(write("a.3mf", bytes(damaged)))


@pytest.mark.parametrize("packing", [zipfile.ZIP_LZMA, zipfile.ZIP_BZIP2])
@pytest.mark.parametrize("name", ["a.3mf", "a.zip", "a.xyz"])
def test_parts_are_packed_by_deflate_or_not_at_all(write, packing, name):
    if name == "a.xyz":
        pytest.importorskip("trimesh")
    file = io.BytesIO()
    with zipfile.ZipFile(file, "w", packing) as archive:
        archive.writestr("a.model", THREEMF_MODEL)
    with pytest.raises(FileFormatError, match=r"'a.model' is packed by (LZMA|BZIP2); only Deflate"):
        load_mesh(write(name, file.getvalue()))


def test_components_that_multiply_are_limited(write, monkeypatch):
    levels = [f'<object id="1">{CORNER}</object>']
    for number in range(2, 30):
        twice = f'<component objectid="{number - 1}"/>' * 2
        levels.append(f'<object id="{number}"><components>{twice}</components></object>')
    monkeypatch.setattr(threemf, "_MOST_PLACED", 500)
    path = write("a.3mf", package(model("".join(levels), '<item objectid="29"/>')))
    with pytest.raises(FileFormatError, match="or place more than 500 objects"):
        load_document(path)


@pytest.mark.parametrize(
    "change",
    [
        lambda text: text,
        lambda text: text.replace("/>", " />"),
        lambda text: text.replace('"/>\n', '"/>'),
        lambda text: text.replace('x="2" y="0" z="0"', 'x="2" z="0" y="0"'),
        lambda text: text.replace('x="2" y="0" z="0"', 'y="0" x="2"  z="0"'),
        lambda text: text.replace("<vertices>\n", "<vertices><!-- a comment -->"),
        lambda text: text.replace("<resources>", "<resources><!--<vertices></vertices>-->"),
        lambda text: text.replace('x="2"', 'x="2&#46;0"'),
        lambda text: text.replace('x="2"', "x='2'"),
        lambda text: text.replace('"1e1"', '" 1e1 "'),
    ],
)
def test_lists_at_once_and_element_by_element_are_the_same(write, monkeypatch, change):
    plain = re.sub(r' p\w+="\d+"', "", THREEMF_MODEL.decode())
    path = write("a.3mf", package(change(plain).encode(), **{"house.tga": b"x"}))
    meshes = []
    for at_once in (1 << 20, 0):
        monkeypatch.setattr(threemf, "_AT_ONCE", at_once)
        monkeypatch.setattr(threemf, "_RATIO_AT_ONCE", 0)
        meshes.append(quietly(load_mesh, path))
    first, second = meshes
    assert first.positions.tobytes() == second.positions.tobytes() and len(first.faces) == 15
    assert first.faces.tobytes() == second.faces.tobytes()


@pytest.mark.parametrize(
    "content",
    [
        '<vertex x="1" y="2" z="3"/>4',
        '<vertex x="1 2" y="" z="3"/>',
        '<vertex x="1" y="2" z="3"/><vertex x="1" y="2"/>',
        '<vertex x="1" y="2" z="1e"/>',
        '<vertex x="1" y="2" z="nan"/>',
        'x="1" y="2" z="3"/>',
    ],
)
def test_what_is_no_plain_list_stays(content):
    text = f"<a><vertices>{content}</vertices></a>".encode()
    assert cut_lists(text) == (text, {})


def test_lists_are_cut_out_whole():
    vertex = '\n<vertex x="1" y="-2.5" z="3e0"/>'
    text, lists = cut_lists(f"<a><vertices>{vertex}{vertex}</vertices><triangles>".encode())
    assert text == b"<a><vertices>\n\n</vertices><triangles>"
    assert {place: values.tolist() for place, values in lists.items()} == {3: [[1, -2.5, 3]] * 2}
