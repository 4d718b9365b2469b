"""COLLADA: geometry in all its primitives, nodes, units, materials, and what is refused."""

import numpy as np
import pytest

import engine3d as e3d

pytestmark = pytest.mark.filterwarnings("ignore::engine3d.Engine3DWarning")

CORNERS = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1)]


def words(values):
    return " ".join(f"{value:g}" for value in np.ravel(values))


def source(name, rows, width=3, stride=None, offset=0):
    rows = np.asarray(rows, float)
    stride = stride or width
    padded = np.full((len(rows), stride), 9.0)
    padded[:, :width] = rows
    numbers = [*[7.0] * offset, *padded.ravel()]
    return (
        f'<source id="{name}"><float_array id="{name}-a" count="{len(numbers)}">{words(numbers)}'
        f'</float_array><technique_common><accessor source="#{name}-a" count="{len(rows)}" '
        f'stride="{stride}" offset="{offset}"/></technique_common></source>'
    )


def mesh(primitives, *sources):
    return (
        f'<library_geometries><geometry id="g" name="shape"><mesh>{source("p", CORNERS)}'
        f'{"".join(sources)}<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>'
        f"{primitives}</mesh></geometry></library_geometries>"
    )


NODE = '<node name="n"><instance_geometry url="#g"/></node>'


def dae(library, nodes=NODE, asset="", more=""):
    return (
        f'<?xml version="1.0"?><COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" '
        f'version="1.4.1"><asset>{asset}</asset>{more}{library}<library_visual_scenes>'
        f'<visual_scene id="s">{nodes}</visual_scene></library_visual_scenes>'
        '<scene><instance_visual_scene url="#s"/></scene></COLLADA>'
    ).encode()


VERTEX = '<input semantic="VERTEX" source="#v" offset="0"/>'
TRIANGLE = f'<triangles count="1">{VERTEX}<p>0 1 2</p></triangles>'


def load(data, **options):
    return e3d.load_mesh(data, format="dae", **options)


def area(mesh):
    corners = mesh.positions[mesh.faces].astype(float)
    crossed = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    return crossed.sum(axis=0) / 2


@pytest.mark.parametrize(
    "primitive, faces, total",
    [
        (TRIANGLE, 1, (0, 0, 0.5)),
        (f"<triangles>{VERTEX}<p>0 1 2 0 2 3</p></triangles>", 2, (0, 0, 1)),
        (f"<polylist>{VERTEX}<vcount>4 3</vcount><p>0 1 2 3 0 1 4</p></polylist>", 3, (0, -0.5, 1)),
        (f"<polygons>{VERTEX}<p>0 1 2 3</p><p>0 1 4</p></polygons>", 3, (0, -0.5, 1)),
        (f"<polygons>{VERTEX}<ph><p>0 1 2 3</p><h>4 4 4</h></ph></polygons>", 2, (0, 0, 1)),
        (f"<tristrips>{VERTEX}<p>0 1 3 2</p></tristrips>", 2, (0, 0, 1)),
        (f"<trifans>{VERTEX}<p>0 1 2 3</p></trifans>", 2, (0, 0, 1)),
        (TRIANGLE + f"<polygons>{VERTEX}<p>0 1 4</p></polygons>", 2, (0, -0.5, 0.5)),
    ],
)
def test_every_primitive_gives_its_triangles(primitive, faces, total):
    made = load(dae(mesh(primitive)))
    assert len(made.faces) == faces
    np.testing.assert_allclose(area(made), total, atol=1e-7)
    assert made.name == "shape"


def test_lines_are_drawn_as_lines():
    made = load(dae(mesh(f"<linestrips>{VERTEX}<p>0 1 2</p><p>3 4</p></linestrips>")))
    assert len(made.lines) == 3 and len(made.faces) == 0
    assert len(load(dae(mesh(f"<lines>{VERTEX}<p>0 1 2 3</p></lines>"))).lines) == 2


@pytest.mark.parametrize("stride, offset", [(None, 0), (5, 0), (3, 2), (4, 7)])
def test_corners_have_their_own_normals_and_coordinates(stride, offset):
    normals = source("n", [(0, 0, 1), (0, 1, 0)], 3, stride, offset)
    uvs = source("t", [(0, 0), (1, 0), (0.25, 0.75)], 2, stride, offset)
    primitive = (
        f'<triangles count="1">{VERTEX}<input semantic="TEXCOORD" source="#t" offset="2" set="0"/>'
        '<input semantic="TEXCOORD" source="#p" offset="2" set="1"/>'
        '<input semantic="NORMAL" source="#n" offset="1"/><p>0 0 0 1 1 1 2 0 2</p></triangles>'
    )
    made = load(dae(mesh(primitive, normals, uvs)))
    np.testing.assert_allclose(made.uvs, [(0, 0), (1, 0), (0.25, 0.75)])
    np.testing.assert_allclose(made.normals, [(0, 0, 1), (0, 1, 0), (0, 0, 1)])


def test_nodes_turn_move_and_repeat_their_meshes():
    inner = '<library_nodes><node id="twice"><instance_geometry url="#g"/></node></library_nodes>'
    nodes = (
        '<node name="a"><translate>1 2 3</translate><rotate>0 0 1 90</rotate><scale>2 2 2</scale>'
        '<instance_geometry url="#g"/><node name="b"><matrix>1 0 0 5 0 1 0 0 0 0 1 0 0 0 0 1'
        '</matrix><instance_node url="#twice"/></node></node>'
    )
    scene = e3d.load_scene(dae(mesh(TRIANGLE), nodes, more=inner), format="dae")
    meshes = [node.object for node in scene.nodes if node.object is not None]
    assert len(meshes) == 2 and meshes[0] is meshes[1]
    place = scene.find("b").world_pose @ (1, 0, 0, 1)
    np.testing.assert_allclose(place, (1, 2 + 2 * 6, 3, 1), atol=1e-12)
    whole = load(dae(mesh(TRIANGLE), nodes, more=inner))
    np.testing.assert_allclose(whole.bounds, scene.bounds, atol=1e-6)


@pytest.mark.parametrize(
    "asset, up, unit",
    [
        ("", "+Y", "m"),
        ("<up_axis>Z_UP</up_axis>", "+Z", "m"),
        ('<unit meter="0.01" name="cm"/><up_axis>X_UP</up_axis>', "+X", "cm"),
        ('<unit meter="0.0254"/>', "+Y", "in"),
        ('<unit meter="0.37"/><up_axis> Y_UP </up_axis>', "+Y", ""),
    ],
)
def test_files_say_which_way_is_up_and_how_long_a_unit_is(asset, up, unit):
    document = e3d.loaders.load_document(dae(mesh(TRIANGLE), asset=asset), format="dae")
    assert (document.up, document.unit) == (up, unit)
    assert bool(document.warnings) == (not unit)
    metres = {"cm": 0.01, "in": 0.0254}.get(unit, 1.0)
    bounds = e3d.load(dae(mesh(TRIANGLE), asset=asset), format="dae").bounds
    assert np.ptp(bounds, axis=0).max() == pytest.approx(metres)


def effect(shader, params=""):
    return (
        f'<library_effects><effect id="e"><profile_COMMON>{params}<technique sid="c">{shader}'
        "</technique></profile_COMMON></effect></library_effects>"
        '<library_materials><material id="m" name="paint"><instance_effect url="#e"/></material>'
        "</library_materials>"
    )


BOUND = (
    '<node><instance_geometry url="#g"><bind_material><technique_common>'
    '<instance_material symbol="k" target="#m"/></technique_common></bind_material>'
    "</instance_geometry></node>"
)
PAINTED = f'<triangles material="k">{VERTEX}<p>0 1 2</p></triangles>'


@pytest.mark.parametrize(
    "shader, color, mode",
    [
        ("<phong><diffuse><color>1 0 0 1</color></diffuse></phong>", (1, 0, 0), "opaque"),
        (
            "<lambert><diffuse><color>0 1 0 1</color></diffuse><transparency><float>0.25</float>"
            "</transparency></lambert>",
            (0, 1, 0),
            "blend",
        ),
        (
            '<blinn><diffuse><color>0 0 1</color></diffuse><transparent opaque="RGB_ZERO">'
            "<color>.5 .5 .5 1</color></transparent></blinn>",
            (0, 0, 1),
            "blend",
        ),
        (
            "<phong><diffuse><color>1 1 0 1</color></diffuse><transparency><float>0</float>"
            "</transparency></phong>",
            (1, 1, 0),
            "opaque",
        ),
        ("<constant><emission><color>1 0 1 1</color></emission></constant>", (1, 0, 1), "opaque"),
    ],
)
def test_materials_have_the_colors_of_their_effects(shader, color, mode):
    made = load(dae(mesh(PAINTED), BOUND, more=effect(shader)))
    (material,) = made.materials
    assert material.name == "paint" and material.rgb == color and material.alpha_mode == mode
    assert material.unlit == shader.startswith("<constant")


def test_symbols_without_materials_are_plain():
    plain = load(dae(mesh(PAINTED), NODE))
    assert plain.materials[0].name == ""
    two = PAINTED + f'<triangles material="other">{VERTEX}<p>0 1 4</p></triangles>'
    red = effect("<phong><diffuse><color>1 0 0 1</color></diffuse></phong>")
    made = load(dae(mesh(two), BOUND, more=red))
    assert [m.name for m in made.materials] == ["paint", ""]
    assert made.material_ids.tolist() == [0, 1]


@pytest.mark.parametrize(
    "params, texture",
    [
        ("", "i"),
        ('<newparam sid="s"><sampler2D><instance_image url="#i"/></sampler2D></newparam>', "s"),
        (
            '<newparam sid="u"><surface type="2D"><init_from>i</init_from></surface></newparam>'
            '<newparam sid="s"><sampler2D><source>u</source></sampler2D></newparam>',
            "s",
        ),
    ],
)
@pytest.mark.parametrize("image", ["wood.png", "<ref>wood.png</ref>", "file:///C:/old/wood.png"])
def test_textures_are_found_by_samplers_surfaces_and_names(tmp_path, params, texture, image):
    from PIL import Image

    Image.new("RGB", (2, 2), (9, 8, 7)).save(tmp_path / "wood.png")
    images = (
        f'<library_images><image id="i"><init_from>{image}</init_from></image></library_images>'
    )
    shader = f'<lambert><diffuse><texture texture="{texture}"/></diffuse></lambert>'
    path = tmp_path / "a.dae"
    path.write_bytes(dae(mesh(PAINTED), BOUND, more=images + effect(shader, params)))
    assert e3d.load_mesh(path).materials[0].texture.pixels[0, 0].tolist() == [9, 8, 7, 255]


@pytest.mark.parametrize(
    "data, told",
    [
        (b"{}", "not a dae file"),
        (b"<robot/>", "not a dae file"),
        (dae(mesh(f"<triangles>{VERTEX}<p>0 1 6</p></triangles>")), "names POSITION 6 of 6"),
        (dae(mesh(f"<triangles>{VERTEX}<p>0 1 -1</p></triangles>")), "is no index"),
        (dae(mesh(f"<triangles>{VERTEX}<p>0 x 1</p></triangles>")), "not a number: 'x'"),
        (dae(mesh(f"<polylist>{VERTEX}<vcount>9</vcount><p>0 1 2</p></polylist>")), "too few"),
        (dae(mesh("<triangles><p>0 1 2</p></triangles>")), "no vertices in this file"),
        (
            dae(mesh('<triangles><input semantic="VERTEX" source="#x"/><p>0 1 2</p></triangles>')),
            "<input> names '#x', which is not there",
        ),
        (dae(mesh(TRIANGLE), '<node><instance_geometry url="#h"/></node>'), "names '#h'"),
        (dae(mesh(TRIANGLE), "<node><matrix>1 2</matrix></node>"), "2 numbers instead of 16"),
        (
            dae(mesh(TRIANGLE), '<node id="me"><instance_node url="#me"/></node>'),
            "nested more than 64 deep",
        ),
        (b"<!DOCTYPE c [<!ENTITY a 'b'>]><COLLADA/>", "a document type is not allowed"),
        (b"<COLLADA><a>", "no well-formed XML"),
        (b"<COLLADA/>", "no vertices in this file"),
    ],
)
def test_what_is_damaged_is_refused(data, told):
    with pytest.raises(e3d.FileFormatError, match=told):
        load(data)


def test_nodes_that_repeat_nodes_end():
    library = "".join(
        f'<node id="l{k}">' + f'<instance_node url="#l{k + 1}"/>' * 10 + "</node>" for k in range(8)
    )
    nodes = '<node><instance_node url="#l0"/></node>'
    more = f'<library_nodes>{library}<node id="l8"/></library_nodes>'
    with pytest.raises(e3d.FileFormatError, match="more than 65536"):
        load(dae(mesh(TRIANGLE), nodes, more=more))


def test_damaged_files_end_in_our_errors():
    random = np.random.default_rng(9)
    whole = dae(
        mesh(PAINTED, source("n", CORNERS)),
        BOUND,
        '<unit meter="0.01"/>',
        effect("<phong><diffuse><color>1 0 0 1</color></diffuse></phong>"),
    )
    for _ in range(300):
        data = bytearray(whole)
        for _ in range(random.integers(1, 5)):
            place = random.integers(len(data))
            data[place : place + random.integers(0, 9)] = random.bytes(random.integers(0, 4))
        try:
            load(bytes(data))
        except e3d.Engine3DError as error:
            assert "\n" not in str(error)


def test_skins_show_as_they_were_bound():
    controller = (
        '<library_controllers><controller id="c"><skin source="#g"/></controller>'
        "</library_controllers>"
    )
    nodes = '<node><instance_controller url="#c"/></node>'
    made = load(dae(mesh(TRIANGLE), nodes, more=controller))
    assert len(made.faces) == 1 and "as it was bound" in made.warnings[0]
