"""Tangents computed from texture coordinates: directions, splits, what files hold."""

import json

import numpy as np
import pytest
from shared_corpus import GLTF, needs_gltf

import engine3d as e3d

SQUARE = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)]
TWO = [(0, 1, 2), (0, 2, 3)]


def square(uvs, **more):
    return e3d.Mesh(SQUARE, TWO, normals=[(0, 0, 1)] * 4, uvs=uvs, **more)


def test_right_is_where_u_grows():
    plain = square([(0, 0), (2, 0), (2, 3), (0, 3)]).with_tangents()
    assert plain.tangents.tolist() == [[1, 0, 0, 1]] * 4
    turned = square([(0, 0), (0, 1), (-1, 1), (-1, 0)]).with_tangents()
    assert np.allclose(turned.tangents, [[0, -1, 0, 1]] * 4)
    mirrored = square([(0, 0), (-1, 0), (-1, 1), (0, 1)]).with_tangents()
    assert np.allclose(mirrored.tangents, [[-1, 0, 0, -1]] * 4)


def test_a_mirrored_half_splits_the_vertices_between():
    """The image of the left half goes left, that of the right half right."""
    positions = [(-1, 0, 0), (0, 0, 0), (1, 0, 0), (-1, 1, 0), (0, 1, 0), (1, 1, 0)]
    faces = [(0, 1, 4), (0, 4, 3), (1, 2, 5), (1, 5, 4)]
    uvs = [(abs(x), y) for x, y, _ in positions]
    colors = np.arange(24, dtype=np.uint8).reshape(6, 4)
    mesh = e3d.Mesh(positions, faces, normals=[(0, 0, 1)] * 6, uvs=uvs, colors=colors)
    made = mesh.with_tangents()
    assert (
        len(made.positions) == 8
        and made.position_ids.tolist() == [*range(6), 4, 1]
        or (made.position_ids.tolist() == [*range(6), 1, 4])
    )
    assert np.allclose(made.tangents[made.faces[:2]], [-1, 0, 0, -1])
    assert np.allclose(made.tangents[made.faces[2:]], [1, 0, 0, 1])
    for name in ("positions", "uvs", "colors", "normals"):
        old, new = getattr(mesh, name)[mesh.faces], getattr(made, name)[made.faces]
        assert np.array_equal(old, new), name
    assert len(made.edges()) == len(mesh.edges())


def test_seams_of_equal_vertices_are_joined():
    """A strip of triangles whose vertices are not shared gets the tangents of one whose are."""
    ball = e3d.uv_sphere(0.5, (12, 8))
    apart = e3d.Mesh(
        ball.positions[ball.faces.ravel()],
        np.arange(ball.faces.size).reshape(-1, 3),
        normals=ball.normals[ball.faces.ravel()],
        uvs=ball.uvs[ball.faces.ravel()],
    )
    one, other = ball.with_tangents(), apart.with_tangents()
    assert np.array_equal(one.tangents[one.faces], other.tangents[other.faces])


def test_faces_without_an_image_take_after_their_neighbours():
    made = square([(0, 0), (1, 0), (1, 1), (1, 1)]).with_tangents()
    assert np.allclose(made.tangents[made.faces[0]], [1, 0, 0, 1])
    assert np.isfinite(made.tangents).all()
    none = square([(0, 0)] * 4).with_tangents()
    assert none.tangents.tolist() == [[1, 0, 0, 1]] * 4


def test_what_is_not_finite_harms_nothing_else():
    positions = np.array(SQUARE, np.float32)
    positions[3] = np.nan
    made = e3d.Mesh(positions, TWO, normals=[(0, 0, 1)] * 4, uvs=[(0, 0), (1, 0), (1, 1), (0, 1)])
    made = made.with_tangents()
    assert np.allclose(made.tangents[made.faces[0]], [1, 0, 0, 1])
    assert np.isfinite(made.tangents).all()


def test_the_second_set_and_what_is_missing():
    mesh = square([(0, 0), (1, 0), (1, 1), (0, 1)], uvs1=[(0, 0), (0, 1), (-1, 1), (-1, 0)])
    assert np.allclose(mesh.with_tangents(1).tangents[0], [0, -1, 0, 1])
    with pytest.raises(e3d.InvalidArgumentError, match="but there are no uvs"):
        e3d.Mesh(SQUARE, TWO).with_tangents()
    with pytest.raises(e3d.InvalidArgumentError, match="uv_set must be 0 or 1"):
        mesh.with_tangents(2)
    assert len(e3d.Mesh([], uvs=[]).with_tangents().tangents) == 0


def attributes_of(path):
    """Every primitive with tangents of a GLB: its arrays by the names of the format."""
    content = path.read_bytes()
    length = int.from_bytes(content[12:16], "little")
    tree, binary = json.loads(content[20 : 20 + length]), content[28 + length :]

    def read(number):
        accessor = tree["accessors"][number]
        view = tree["bufferViews"][accessor["bufferView"]]
        start = view.get("byteOffset", 0) + accessor.get("byteOffset", 0)
        width = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4}[accessor["type"]]
        dtype = np.dtype({5123: "<u2", 5125: "<u4", 5126: "<f4"}[accessor["componentType"]])
        strides = view.get("byteStride", width * dtype.itemsize), dtype.itemsize
        return np.ndarray((accessor["count"], width), dtype, binary, start, strides)

    for mesh in tree["meshes"]:
        for primitive in mesh["primitives"]:
            if "TANGENT" in primitive["attributes"]:
                names = {**primitive["attributes"], "indices": primitive["indices"]}
                yield {name: read(number) for name, number in names.items()}


@needs_gltf
def test_as_files_have_them():
    path = next(GLTF.glob("models/**/AnisotropyStrengthTest.glb"))
    for held in attributes_of(path):
        uvs = held["TEXCOORD_0"] * np.float32([1, -1]) + np.float32([0, 1])
        faces = held["indices"].reshape(-1, 3).astype(np.int32)
        made = e3d.Mesh(held["POSITION"], faces, normals=held["NORMAL"], uvs=uvs).with_tangents()
        got, expected = made.tangents[made.faces], held["TANGENT"][faces]
        cosines = (got[..., :3] * expected[..., :3]).sum(axis=-1)
        assert cosines.min() > 0.999
        assert np.array_equal(got[..., 3], expected[..., 3])
