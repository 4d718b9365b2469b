"""What is written is read again as the same arrays, and is there whole or not at all."""

import warnings

import numpy as np
import pytest
from shared_corpus import CONFORMANCE, cases_of, needs_conformance

import engine3d as e3d
from engine3d.errors import FileAccessError, InvalidArgumentError
from engine3d.io.formats.obj.mtl_writer import material_names
from engine3d.io.writers import formats
from engine3d.model.materials.colors import linear_color

ARRAYS = ("positions", "faces", "normals", "uvs", "colors", "material_ids", "lines", "points")
ARRAYS += ("edge_visible", "position_ids")
#: What the formats do not hold.
LACKS = {"obj": (), "ply": ("material_ids",), "stl": ()}


def loaded(path):
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        return e3d.load_mesh(path)


def saved(mesh, path, **options):
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        mesh.save(path, **options)
    return loaded(path)


def partition(ids, count):
    """Numbers for points of the surface, whichever numbers they had."""
    return np.arange(count) if ids is None else np.unique(ids, return_inverse=True)[1]


def differences(a, b, lacks=()):
    found = []
    for name in ARRAYS:
        x, y = getattr(a, name), getattr(b, name)
        if name == "position_ids":
            x, y = partition(x, len(a.positions)), partition(y, len(b.positions))
        if name in lacks or (x is None and y is None):
            continue
        same = x is not None and y is not None and x.dtype == y.dtype
        if not same or not np.array_equal(x, y, equal_nan=x.dtype.kind == "f"):
            found.append(name)
    return found


def rich_mesh():
    """Quads, triangles, a concave polygon, lines, materials, seams."""
    house = "o house\nv 0 0 0 .1 .2 .3\nv 1 0 0\nv 1 1 0\nv .5 .2 0\nv 0 1 0\nv .1 .3 7e-9\n"
    house += "vt 0 0\nvt 1 .3333333\nvt .5 1\nvn 0 0 1\nvn 0 1 0\n"
    house += "usemtl a b\ng front all\nf 1/1/1 2/2/1 3/3/1 4/1/1 5/2/1\nusemtl c\ng\n"
    house += "f 1/3/2 2/2/2 6/1/2\ng side\nf 3/1/1 2/1/1 6/1/1 5/1/1\nl 1 6\nl 6 5\np 1 3\n"
    return house


@pytest.fixture
def house(tmp_path):
    (tmp_path / "house.obj").write_text(rich_mesh())
    return loaded(tmp_path / "house.obj")


def test_formats():
    assert [item.name for item in formats()] == ["glb", "gltf", "obj", "ply", "stl"]


def test_obj_keeps_everything(house, tmp_path):
    again = saved(house, tmp_path / "out.obj")
    assert differences(house, again) == []
    assert again.name == "house"
    assert {name: faces.tolist() for name, faces in again.groups.items()} == {
        name: faces.tolist() for name, faces in house.groups.items()
    }
    assert [m.name for m in again.materials] == ["a b", "c"]
    assert (tmp_path / "out.obj").read_text().count("\nf ") == 3


@pytest.mark.parametrize("ascii", [False, True])
def test_ply_keeps_all_but_materials_and_points(house, tmp_path, ascii):
    again = saved(house, tmp_path / "out.ply", ascii=ascii)
    assert differences(house, again, ("material_ids", "points")) == []
    with pytest.warns(e3d.Engine3DWarning, match=r"out\.ply: ply files do not hold points"):
        house.save(tmp_path / "out.ply")


@pytest.mark.parametrize("ascii", [False, True])
def test_stl_keeps_triangles(house, tmp_path, ascii):
    first = saved(house, tmp_path / "one.stl", ascii=ascii)
    again = saved(first, tmp_path / "two.stl", ascii=ascii)
    assert differences(first, again) == []
    assert np.array_equal(first.positions[first.faces], house.positions[house.faces])


@pytest.mark.parametrize("extension", ["obj", "ply"])
@pytest.mark.parametrize(
    "make", [e3d.box, e3d.uv_sphere, e3d.torus, e3d.cylinder, e3d.plane, e3d.icosphere]
)
def test_primitives_are_stable_after_one_pass(make, extension, tmp_path):
    first = saved(make(), tmp_path / f"one.{extension}")
    again = saved(first, tmp_path / f"two.{extension}")
    assert differences(first, again, LACKS[extension]) == []
    if make is not e3d.cylinder:
        # The middle of its caps is no corner of a polygon.
        assert len(first.edges()) == len(make().edges())


@pytest.mark.parametrize("extension", ["obj", "ply"])
def test_colors(tmp_path, extension):
    colors = np.arange(1024, dtype=np.uint32).astype(np.uint8).reshape(256, 4)
    cloud = e3d.Mesh(np.zeros((256, 3)), points=np.arange(256), colors=colors)
    assert differences(cloud, saved(cloud, tmp_path / f"a.{extension}")) == []
    linear = e3d.Mesh(np.eye(3), [[0, 1, 2]], colors=e3d.linear([[0, 0.25, 1, 0.5]] * 3))
    again = saved(linear, tmp_path / f"b.{extension}")
    expected = [0, 0.25, 1, 0.5] if extension == "ply" else [0, 137, 255, 128]
    assert again.colors[0].tolist() == expected


def test_numbers_that_are_hard_to_write(tmp_path):
    values = np.array([0.1, 1e-45, 3.4e38, -0.0, 16777217, 1 / 3, np.nan, np.inf, 1e16], np.float32)
    mesh = e3d.Mesh(values.reshape(3, 3), [[0, 1, 2]])
    for name, options in (("a.obj", {}), ("a.ply", {"ascii": True}), ("a.ply", {})):
        again = saved(mesh, tmp_path / name, **options)
        assert np.array_equal(again.positions, mesh.positions, equal_nan=True)


def test_materials_and_textures(tmp_path):
    image = np.arange(24, dtype=np.uint8).reshape(2, 3, 4)
    texture = e3d.Texture(image, wrap="clamp")
    mesh = e3d.primitives.quad((0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0))
    mesh.materials = [
        e3d.Material(
            name="# skin",
            color=e3d.linear(0.5, 0.25, 0.125, 0.5),
            alpha_mode="blend",
            texture=texture,
            specular=e3d.linear(1, 0.5, 0),
            shininess=9.5,
            emissive=e3d.linear(0.0, 2.0, 0.0),
            extras={"Pm": 0.25, "maps": {"map_Ks": {"name": "s.png"}}},
        ),
        e3d.Material(name="# skin", texture=texture, color=(255, 0, 0)),
        e3d.Material(),
    ]
    again = saved(mesh, tmp_path / "a.obj")
    assert [m.name for m in again.materials] == ["_ skin", "_ skin_2", "material_2"]
    first = again.materials[0]
    lights = [linear_color(color).tolist() for color in (first.rgb, first.specular)]
    assert lights == [[0.5, 0.25, 0.125], [1, 0.5, 0]]
    assert (first.alpha, first.emissive) == (0.5, e3d.linear(0, 2, 0))
    assert first.shininess == 9.5
    assert first.extras["Pm"] == 0.25
    assert first.alpha_mode == "blend"
    assert first.extras["maps"]["map_Ks"]["name"] == "s.png"
    assert np.array_equal(first.texture.pixels, image)
    assert first.texture.wrap == "clamp"
    assert again.materials[1].color == (1, 0, 0)
    assert sorted(p.name for p in tmp_path.iterdir()) == ["a.mtl", "a.obj", "a_0.png"]


def test_a_plain_mesh_has_no_library(tmp_path):
    saved(e3d.Mesh(np.eye(3), [[0, 1, 2]]), tmp_path / "a.obj")
    assert [p.name for p in tmp_path.iterdir()] == ["a.obj"]


def test_names_of_materials_differ():
    named = [e3d.Material(name=name) for name in ("a", "a", "a_2", "a", "a_2_2")]
    assert material_names(named) == ["a", "a_2", "a_2_2", "a_3", "a_2_2_2"]
    many = material_names([e3d.Material(name="a")] * 100_000)
    assert many[-1] == "a_100000"


@pytest.mark.parametrize("name", ["a.obj", "a.stl", "a.ply"])
def test_names_that_no_encoding_has(tmp_path, name):
    """Of a path that is no UTF-8, say: they are written as Python escapes them."""
    odd = b"\xff \xfe".decode(errors="surrogateescape") + "\ud800"
    look = e3d.Material(name=odd, color=(1.0, 0.0, 0.0), extras={"Ka": (1, 1, 1), "why": odd})
    mesh = e3d.Mesh(np.eye(3), [[0, 1, 2]], materials=[look], name=odd)
    mesh.groups = {odd: np.array([0], np.int32)}
    again = saved(mesh, tmp_path / name, **({"ascii": True} if name == "a.stl" else {}))
    assert len(again.faces) == 1
    escaped = r"\udcff \udcfe\ud800"
    if name == "a.obj":
        assert again.materials[0].name == escaped
        assert list(again.groups) == [escaped.replace(" ", "_")]
    if name == "a.stl":
        assert list(again.groups) == [escaped]


def test_flat_materials_are_not_smooth(tmp_path):
    mesh = e3d.Mesh(np.eye(3), [[0, 1, 2]], materials=[e3d.Material(flat_shading=True)])
    saved(mesh, tmp_path / "a.obj")
    assert "s off\nf 1 2 3" in (tmp_path / "a.obj").read_text()


def test_wrong_arguments(house, tmp_path):
    with pytest.raises(InvalidArgumentError, match=r"extension '\.dae' .* \(\.glb, \.gltf, \.obj"):
        house.save(tmp_path / "a.dae")
    with pytest.raises(InvalidArgumentError, match="obj files have no option 'ascii'"):
        house.save(tmp_path / "a.obj", ascii=True)
    with pytest.raises(InvalidArgumentError, match="mesh must be a Mesh, not"):
        e3d.save_mesh(3, tmp_path / "a.obj")
    house.save(tmp_path / "model", format="obj")
    assert (tmp_path / "model").read_bytes().startswith(b"# written by engine3d")


def test_a_failure_leaves_nothing_behind(house, tmp_path):
    with pytest.raises(FileAccessError):
        house.save(tmp_path / "nowhere" / "a.ply")
    assert [p.name for p in tmp_path.iterdir()] == ["house.obj"]


@needs_conformance
@pytest.mark.parametrize("extension", ["obj", "ply"])
def test_the_corpus(tmp_path, extension):
    for case in (parameter.values[0] for parameter in cases_of("obj", "ply")):
        if case["expect"] != "ok" or case["size"] > 1 << 20:
            continue
        mesh, lacks = loaded(CONFORMANCE / case["file"]), LACKS[extension]
        if extension == "ply" and len(mesh.points) and len(mesh.faces):
            lacks = (*lacks, "points")
        elif extension == "ply" and len(mesh.points) > len(mesh.positions):
            continue  # points named twice
        again = saved(mesh, tmp_path / f"a.{extension}")
        assert differences(mesh, again, lacks) == [], case["file"]


def test_hostile_flags_still_give_all_triangles(tmp_path):
    choice = np.random.default_rng(4)
    for _ in range(100):
        faces = choice.integers(0, 6, (12, 3))
        mesh = e3d.Mesh(
            choice.random((6, 3)), faces, edge_visible=choice.integers(0, 2, (12, 3)).astype(bool)
        )
        for extension in ("obj", "ply"):
            again = saved(mesh, tmp_path / f"a.{extension}")
            assert np.array_equal(again.positions[again.faces], mesh.positions[mesh.faces])
