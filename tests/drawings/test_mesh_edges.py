"""The edges of meshes: sound ones, and those of bad meshes, which must be the same."""

import math

import numpy as np
import pytest

import engine3d as e3d
from engine3d.apps.drawings.line_kinds import BORDER, CREASE
from engine3d.apps.drawings.mesh_edges import mesh_edges
from engine3d.model.geometry.derived import arrays_of

ANGLE = math.radians(35.0)


def edges_of(mesh, what):
    """Return the ends of a mesh's creases or borders, each edge sorted, in order."""
    found = mesh_edges(arrays_of(mesh), ANGLE)
    ends = found.positions[found.ends[found.kinds == what]]
    return sorted(tuple(sorted(map(tuple, pair))) for pair in ends.tolist())


def soup(mesh):
    """Return the mesh with three vertices of its own for each face."""
    return e3d.Mesh(
        mesh.positions[mesh.faces].reshape(-1, 3), np.arange(3 * len(mesh.faces)).reshape(-1, 3)
    )


def bare(mesh):
    """Return the mesh without normals and hidden edges."""
    return e3d.Mesh(mesh.positions, mesh.faces)


BOX = bare(e3d.box((2.0, 1.0, 3.0)))


def test_a_box_has_twelve_creases():
    assert len(edges_of(BOX, CREASE)) == 12
    assert edges_of(BOX, BORDER) == []


def doubled(mesh):
    return e3d.Mesh(mesh.positions, np.concatenate([mesh.faces, mesh.faces[:, ::-1]]))


def flipped(mesh):
    faces = mesh.faces.copy()
    faces[::2] = faces[::2, ::-1]
    return e3d.Mesh(mesh.positions, faces)


def with_points_and_lines_as_faces(mesh):
    bad = np.array([[0, 0, 0], [0, 1, 1], [2, 3, 2]])
    return e3d.Mesh(mesh.positions, np.concatenate([bad, mesh.faces]))


def with_nan(mesh):
    count = len(mesh.positions)
    positions = np.concatenate([mesh.positions, [[np.nan, 0, 0]]])
    return e3d.Mesh(positions, np.concatenate([mesh.faces, [[0, 1, count]]]))


@pytest.mark.filterwarnings("ignore:.*positions are not finite")
@pytest.mark.parametrize(
    "spoil", [soup, doubled, flipped, with_points_and_lines_as_faces, with_nan]
)
def test_bad_meshes_have_the_same_creases(spoil):
    assert edges_of(spoil(BOX), CREASE) == edges_of(BOX, CREASE)
    assert edges_of(spoil(BOX), BORDER) == []


@pytest.mark.parametrize("seed", range(10))
def test_flat_triangles_separate_nothing(seed):
    # Each face's first side is split at a point, and a triangle without height closes the gap.
    rng = np.random.default_rng(seed)
    positions, faces = BOX.positions.astype(float).tolist(), []
    chosen = rng.random(len(BOX.faces)) < 0.5
    for (a, b, c), is_split in zip(BOX.faces.tolist(), chosen, strict=True):
        if not is_split:
            faces.append((a, b, c))
            continue
        # Halves are exact in float32.
        positions.append([(p + q) / 2 for p, q in zip(positions[a], positions[b], strict=True)])
        middle = len(positions) - 1
        faces += [(a, middle, c), (middle, b, c), (a, b, middle)]
    mesh = e3d.Mesh(np.array(positions), faces)
    assert edges_of(mesh, BORDER) == []
    lengths = {"box": 0.0, "mesh": 0.0}
    for name, one in (("box", BOX), ("mesh", mesh)):
        for a, b in edges_of(one, CREASE):
            lengths[name] += math.dist(a, b)
    assert lengths["mesh"] == pytest.approx(lengths["box"])


def test_an_open_box_has_borders():
    mesh = e3d.Mesh(BOX.positions, BOX.faces[2:])
    assert len(edges_of(mesh, BORDER)) == 4
    assert len(edges_of(mesh, CREASE)) == 8


def test_three_faces_at_an_edge_make_a_crease():
    mesh = e3d.Mesh(
        [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, -1, 0.01], [0, 0, 1]],
        [[0, 1, 2], [1, 0, 3], [0, 1, 4]],
    )
    assert len(edges_of(mesh, CREASE)) == 1
    assert len(edges_of(mesh, BORDER)) == 6


def test_smooth_normals_and_hidden_edges_are_no_creases():
    smooth = e3d.Mesh(BOX.positions, BOX.faces, normals=BOX.positions)
    if len(BOX.positions) == 8:
        assert edges_of(smooth, CREASE) == []
    hidden = e3d.Mesh(BOX.positions, BOX.faces, edge_visible=np.zeros((12, 3), bool))
    assert edges_of(hidden, CREASE) == []


def test_round_meshes_have_no_creases():
    assert edges_of(bare(e3d.icosphere(subdivisions=3)), CREASE) == []
    assert len(edges_of(bare(e3d.cylinder()), CREASE)) > 20


@pytest.mark.parametrize("scale", [1e-5, 1e5])
def test_size_does_not_matter(scale):
    mesh = bare(e3d.cylinder())
    scaled = e3d.Mesh(mesh.positions * np.float32(scale), mesh.faces)
    assert len(edges_of(scaled, CREASE)) == len(edges_of(mesh, CREASE))
