"""Numbers on meshes in files: every kind of elements in every format, written and read again."""

import io
import itertools
import warnings

import numpy as np
import pytest

import engine3d as e3d

FORMATS = [("ply", {}), ("ply", {"ascii": True}), ("glb", {}), ("gltf", {})]
TYPES = ["f4", "f8", "i1", "u1", "i2", "u2", "i4", "u4", "i8", "u8"]
GLTF = {"f4", "i1", "u1", "i2", "u2"}


def base(kind):
    if kind == "cloud":
        return e3d.Mesh(np.arange(12.0).reshape(4, 3), points=[2, 0, 3])
    box = e3d.box()
    if kind == "triangles":
        box.edge_visible = None
    return box


def again(mesh, format, options):
    file = io.BytesIO()
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        mesh.save(file, format=format, **options)
        file.seek(0)
        read = e3d.load_mesh(file, format=format)
    return read, " ".join(str(one.message) for one in caught)


@pytest.mark.parametrize(("format", "options"), FORMATS)
@pytest.mark.parametrize("kind", ["triangles", "polygons", "cloud"])
@pytest.mark.parametrize("code", TYPES)
def test_every_kind_of_numbers(format, options, kind, code):
    mesh, rng = base(kind), np.random.default_rng(len(kind))
    counts = {"vertices": len(mesh.positions), "faces": len(mesh.faces), "points": len(mesh.points)}
    for (on, count), width in itertools.product(counts.items(), (0, 1, 3, 4)):
        if count:
            shape = (count, width) if width else (count,)
            array = rng.integers(0, 100, shape).astype(code)
            array = array / np.dtype(code).type(7) if code[0] == "f" else array
            mesh.values[f"{on}{width}"] = e3d.Values(array, on=on)
    read, told = again(mesh, format, options)
    in_ply = format == "ply"
    for name, (array, on) in mesh.values.held().items():
        word = name if in_ply else f"_{name}"
        if on == "faces" and not in_ply:
            assert word not in read.values and repr(name) in told
            continue
        place = "faces" if on == "faces" else "vertices"
        assert read.values.on(word) == place
        expected = array[mesh.points] if on == "vertices" and kind == "cloud" else array
        expected = expected.reshape(-1) if expected.shape[1:] == (1,) and not in_ply else expected
        if code == "f8" and not in_ply:
            assert "all digits" in told
            expected = expected.astype(np.float32)
        assert np.array_equal(read.values[word], expected)
        if code in (GLTF if in_ply is False else {*TYPES} - {"i8", "u8"}):
            assert read.values[word].dtype == np.dtype(code)


def test_polygons_are_cut_where_their_triangles_differ():
    box = e3d.box()
    box.values["side"] = np.arange(12) // 2
    read, told = again(box, "ply", {})
    assert "hidden edges" not in told and (read.edge_visible == box.edge_visible).all()
    box.values["triangle"] = np.arange(12)
    read, told = again(box, "ply", {})
    assert "hidden edges" in told
    assert read.values["triangle"].tolist() == [*range(12)]


@pytest.mark.parametrize("ascii", [False, True])
def test_numbers_that_are_none(ascii):
    box = e3d.box()
    for code in ("f4", "f8"):
        array = np.linspace(-1, 1, 24).astype(code)
        array[:3] = np.nan, np.inf, -np.inf
        box.values[code] = array
    read, _ = again(box, "ply", {"ascii": ascii})
    for code in ("f4", "f8"):
        np.testing.assert_array_equal(read.values[code], box.values[code])
    read, _ = again(box, "glb", {})
    np.testing.assert_array_equal(read.values["_f4"], box.values["f4"])


def test_names_with_a_meaning():
    box = e3d.box()
    names = ["t", "u", "x", "red", "alpha", "two words", "größe", "texture_u", "f_dc_0", "quality"]
    for name in names:
        box.values[name] = np.arange(24)
    box.values["quality (faces)"] = np.arange(12)
    read, told = again(box, "ply", {})
    # Texture coordinates go to names that are free.
    assert (read.uvs == box.uvs).all() and (read.positions == box.positions).all()
    kept = ["t", "u", "red", "texture_u", "f_dc_0", "quality", "quality (faces)"]
    assert list(read.values) == kept
    assert all(repr(name) in told for name in set(names) - set(kept))
    box.values = {"t": np.arange(24), "_t": np.arange(24), "wide": np.zeros((24, 5))}
    read, told = again(box, "glb", {})
    assert list(read.values) == ["_t"] and "'_t' of vertices" in told and "'wide'" in told


def test_formats_without_numbers_say_so():
    box = e3d.box()
    box.values["t"] = np.arange(12)
    for format in ("obj", "stl"):
        read, told = again(box, format, {})
        assert read.values == {} and "values" in told


@pytest.mark.parametrize("code", TYPES)
def test_scene_files(tmp_path, code):
    box = e3d.box()
    box.values["v"] = np.arange(24).astype(code)
    box.values["f"] = e3d.Values(np.arange(24).reshape(12, 2).astype(code), on="faces")
    scene = e3d.Scene()
    scene.add(box)
    scene.save(tmp_path / "box.e3d")
    read = e3d.load_scene(tmp_path / "box.e3d")
    mesh = next(node.object for node in read.nodes)
    for name, (array, on) in box.values.held().items():
        assert mesh.values.on(name) == on and mesh.values[name].dtype == array.dtype
        assert np.array_equal(mesh.values[name], array)


def test_parts_of_gltf_with_other_numbers_stay_one_mesh(tmp_path):
    box = e3d.box()
    box.edge_visible = None
    box.materials = [e3d.Material(name="a"), e3d.Material(name="b")]
    box.material_ids = np.arange(12) % 2
    box.values["t"] = np.arange(24)
    read, _ = again(box, "glb", {})
    assert len(read.values["_t"]) == len(read.positions)
    pairs = dict(
        zip(map(tuple, np.c_[box.positions, box.normals].tolist()), range(24), strict=True)
    )
    keys = map(tuple, np.c_[read.positions, read.normals].tolist())
    assert [pairs[key] for key in keys] == read.values["_t"].tolist()
