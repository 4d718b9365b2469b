"""PLY: each colour and alpha by its own type and range, and splats."""

import itertools
import warnings

import numpy as np
import pytest

import engine3d as e3d
from engine3d.loaders import load_mesh
from engine3d.model.materials.colors import linear_from_display

SHARES = np.array([(1.0, 0.0, 0.2), (0.0, 1.0, 0.6), (0.4, 0.8, 1.0)])
ALPHAS = np.array([1.0, 0.0, 0.6])
#: Types, and what stands for 1 in them.
KINDS = {
    "uchar": ("uchar", 255),
    "ushort": ("ushort", 65535),
    "short of 8 bits": ("short", 255),
    "ushort of 8 bits": ("ushort", 255),
    "int": ("int", 255),
    "int of 16 bits": ("int", 65535),
    "uint": ("uint", 4294967295),
    "float": ("float", 1.0),
    "float of 8 bits": ("float", 255.0),
    "double of 8 bits": ("double", 255.0),
}
FLOATS = ("float",)


def ply(properties, rows, encoding="ascii", comment=""):
    head = [f"ply\nformat {encoding} 1.0{comment}\nelement vertex {len(rows)}"]
    head += [f"property float {axis}" for axis in "xyz"]
    head += [f"property {kind} {name}" for name, kind in properties]
    lines = (f"{n} {n * n} 0 " + " ".join(map(str, row)) for n, row in enumerate(rows))
    return "\n".join([*head, "end_header", *lines, ""]).encode()


def quietly(data):
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        return load_mesh(data)


def written(shares, kind):
    name, full = KINDS[kind]
    values = shares * full
    return values if name in ("float", "double") else np.floor(values + 0.5).astype(np.int64)


@pytest.mark.parametrize(("color", "alpha"), [*itertools.product(KINDS, KINDS)])
def test_colours_and_alphas_of_any_two_types(color, alpha):
    columns = np.column_stack([written(SHARES, color), written(ALPHAS, alpha)]).tolist()
    if KINDS[color][0] not in ("float", "double"):
        columns = [[int(v) for v in row[:3]] + row[3:] for row in columns]
    if KINDS[alpha][0] not in ("float", "double"):
        columns = [row[:3] + [int(row[3])] for row in columns]
    names = [(name, KINDS[color][0]) for name in ("red", "green", "blue")]
    mesh = quietly(ply([*names, ("alpha", KINDS[alpha][0])], columns))
    if color in FLOATS:
        assert mesh.colors.dtype == np.float32
        np.testing.assert_array_equal(mesh.colors[:, :3], linear_from_display(SHARES))
        np.testing.assert_allclose(mesh.colors[:, 3], ALPHAS, atol=1e-6)
    else:
        expected = np.floor(np.column_stack([SHARES, ALPHAS]) * 255 + 0.5)
        np.testing.assert_array_equal(mesh.colors, expected)
        assert mesh.colors.dtype == np.uint8
    guessed = ("float of 8 bits", "double of 8 bits", "ushort of 8 bits")
    assert bool(mesh.warnings) == (color in guessed or alpha in guessed)


@pytest.mark.parametrize("kinds", [*itertools.permutations(["uchar", "ushort", "float of 8 bits"])])
def test_channels_of_different_types(kinds):
    columns = [written(SHARES[:, k], kind).tolist() for k, kind in enumerate(kinds)]
    names = [(name, KINDS[kind][0]) for name, kind in zip("rgb", kinds, strict=True)]
    mesh = quietly(ply(names, list(zip(*columns, strict=True))))
    np.testing.assert_array_equal(mesh.colors[:, :3], np.floor(SHARES * 255 + 0.5))


def test_floats_beside_bytes():
    mesh = quietly(ply([("r", "uchar"), ("g", "float"), ("b", "uchar")], [(255, 0.5, 188)]))
    assert mesh.colors.dtype == np.float32
    np.testing.assert_allclose(mesh.colors[0], [1, 0.214, 0.503, 1], atol=1e-3)


def test_bytes_whose_sign_was_not_meant():
    rows = np.array([[-56, 127, -1]], "i1")
    head = ply([(name, "char") for name in "rgb"], [(0, 0, 0)], "binary_little_endian")
    data = head[: head.index(b"end_header\n") + 11] + np.zeros(3, "<f4").tobytes() + rows.tobytes()
    assert quietly(data).colors[0].tolist() == [200, 127, 255, 255]


def test_light_beyond_one_stays_light_in_our_own_files(tmp_path):
    mesh = quietly(ply([(name, "float") for name in "rgb"], [(3.5, 0.5, 0), (0, 0, 12)]))
    assert mesh.colors[:, [0, 2]].tolist() == [[1, 0], [0, 1]] and not mesh.warnings
    bright = e3d.Mesh(np.eye(3), [[0, 1, 2]], colors=e3d.linear(np.float32([[99, 0, 1, 1]] * 3)))
    bright.save(tmp_path / "a.ply")  # our own files say that floats are light
    np.testing.assert_array_equal(load_mesh(tmp_path / "a.ply").colors, bright.colors)


def test_colours_of_faces():
    head = ply([], [(), (), ()]).decode().replace("0 0 0", "0 1 0", 1)
    face = "element face 1\nproperty list uchar int vertex_indices\nproperty float red\n"
    face += "property float green\nproperty float blue\nproperty uchar alpha\nend_header"
    mesh = quietly((head.replace("end_header", face) + "3 0 1 2 255 0 51.0 128\n").encode())
    assert mesh.colors[0].tolist() == [255, 0, 51, 128]


@pytest.mark.parametrize("opacity", [True, False])
def test_gaussian_splats(opacity):
    names = [f"f_dc_{k}" for k in range(3)] + ["opacity"] * opacity + ["scale_0", "rot_0"]
    rows = [(1.7725, -1.7725, 0.0, *[0.0] * opacity, 1, 1), (9, 0.5, -9, *[3.0] * opacity, 1, 1)]
    mesh = quietly(ply([(name, "float") for name in names], rows))
    expected = np.array([(255, 0, 128, 128), (255, 163, 0, 243)])
    expected[:, 3] = expected[:, 3] if opacity else 255
    np.testing.assert_array_equal(mesh.colors, expected)
    assert mesh.materials[0].alpha_mode == "blend"
    (message,) = mesh.warnings
    assert "3D Gaussian splats are drawn as points" in message and "left out" in message


def test_compressed_splats_are_named():
    data = ply([("packed_position", "uint")], [(1,)]).replace(b"property float x\n", b"")
    with pytest.raises(e3d.FileFormatError, match="compressed splats are not read"):
        load_mesh(data.replace(b"0 0 0 1", b"0 0 1"))
