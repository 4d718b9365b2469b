"""Clusters (csrc/data/mesh/clusters.c) against what they promise of any mesh; boxes of points."""

import numpy as np
import pytest
from kernels.calls import at_address, of_core, record
from kernels.layouts import CLUSTER_TRIANGLES

from engine3d._native.rasterizer import bound_points

THREADS = (1, 2, 3, 8)


def clusters_of(positions, faces, threads):
    """What a mesh is cut into: the order of its faces, clusters and groups.

    Each cluster is (first, triangles, vertices, positions, indices, box, cone): first of its
    triangles in the order, their number and the vertices', plane after plane the positions' bytes,
    (3, 64) local indices as bytes, the box as six numbers or None, the cone as axis, cosine and
    least altitude or None. Each group is (first cluster, clusters, triangles, box).
    """
    made, (count, components) = np.zeros(1, np.uintp), positions.shape
    given = {"components": components, "vertices": count, "faces_count": len(faces)}
    desc = record("mesh_desc", positions=positions, faces=faces, **given)
    if of_core("e3d_mesh_create")(desc, threads, made) != 0:
        raise ValueError("the mesh is not valid, or too large")
    (mesh,) = at_address("e3d_mesh", int(made[0]))
    try:
        clusters = at_address("e3d_cluster", int(mesh["clusters"]), mesh["cluster_count"])
        groups = at_address("e3d_group_box", int(mesh["groups"]), mesh["group_count"])
        order = at_address("int32_t", int(mesh["faces"]), len(faces)).tolist()
        found = [parts_of(one, components) for one in clusters]
        names = ("first_cluster", "clusters", "triangles")
        return order, found, [(*(int(g[name]) for name in names), box(g)) for g in groups]
    finally:
        of_core("e3d_mesh_destroy")(int(made[0]))


def box(one):
    return (*one["lo"].tolist(), *one["hi"].tolist()) if one["any_finite"] else None


def parts_of(cluster, components):
    floats = components * int(cluster["stride"])
    memory = at_address("char", int(cluster["positions"]), 4 * floats + 3 * CLUSTER_TRIANGLES)
    planes, indices = memory[: 4 * floats].tobytes(), memory[4 * floats :].tobytes()
    axis, cosine, altitude = (cluster[name] for name in ("axis", "cosine", "altitude"))
    cone = (tuple(axis.tolist()), float(cosine), float(altitude)) if altitude > 0 else None
    counts = (int(cluster[name]) for name in ("first", "triangles", "vertices"))
    return (*counts, planes, indices, box(cluster), cone)


def bumpy_grid(side, rng):
    """A surface whose faces share vertices by index, in an order of no sense."""
    x, z = np.meshgrid(np.arange(side), np.arange(side))
    y = np.sin(x * 0.2) * np.cos(z * 0.3) * 5
    corner = (np.arange(side - 1)[:, None] * side + np.arange(side - 1)).reshape(-1, 1)
    quads = (corner + [0, side, 1], corner + [1, side, side + 1])
    faces = rng.permutation(np.concatenate(quads).astype(np.int32))
    return np.stack([x, y, z], axis=-1).reshape(-1, 3).astype(np.float32), faces


def split(positions, faces):
    """Every corner a vertex of its own, at a place that it shares."""
    return positions[faces].reshape(-1, 3), np.arange(faces.size, dtype=np.int32).reshape(-1, 3)


def soup(count, rng, scale=1.0):
    positions = rng.uniform(-scale, scale, (3 * count, 3)).astype(np.float32)
    return positions, np.arange(3 * count, dtype=np.int32).reshape(-1, 3)


def make(name):
    rng = np.random.default_rng(5)
    if name == "grid":
        return bumpy_grid(180, rng)  # three chunks, several ranges and buckets
    if name == "split":
        return split(*bumpy_grid(100, rng))
    if name == "outlier":
        positions, faces = bumpy_grid(180, rng)
        far = np.float32([(1e6, -3e5, 2e6), (1e6, -3e5, 3e6), (2e6, -3e5, 2e6)])
        corners = np.arange(3, dtype=np.int32) + len(positions)
        return np.concatenate([positions, far]), np.insert(faces, 777, corners, axis=0)
    if name == "soup":
        return soup(9000, rng)
    if name == "tiny":
        return soup(300, rng, 1e-30)
    if name == "huge":
        return soup(300, rng, 3e38)
    if name == "one place":
        return np.zeros((3, 3), np.float32), rng.integers(0, 3, (700, 3), dtype=np.int32)
    if name == "one face":
        return soup(1, rng)
    if name == "no face":
        return np.zeros((4, 3), np.float32), np.empty((0, 3), np.int32)
    positions, faces = soup(3000, rng)
    hostile = rng.random(positions.shape) < 0.05
    odd = np.array([np.nan, np.inf, -np.inf, 0.0, -0.0, 1e-40, 3e38], np.float32)
    positions[hostile] = rng.choice(odd, hostile.sum())
    faces[::7, 1] = faces[::7, 0]  # degenerate
    if name == "clip":
        positions = np.concatenate([positions, positions[:, :1]], axis=1)
    return positions, faces


MESHES = (
    "grid",
    "split",
    "outlier",
    "soup",
    "tiny",
    "huge",
    "one place",
    "one face",
    "no face",
    "hostile",
)


@pytest.fixture(scope="module", params=(*MESHES, "clip"))
def built(request):
    positions, faces = make(request.param)
    return request.param, positions, faces, *clusters_of(positions, faces, 1)


def corners_of(cluster, components):
    """Positions that a cluster's own indices give, (triangles, 3, components), and its vertices."""
    _, triangles, vertices, planes, indices, _, _ = cluster
    planes = np.frombuffer(planes, np.float32).reshape(components, -1)
    indices = np.frombuffer(indices, np.uint8).reshape(3, 64)[:, :triangles]
    assert indices.size == 0 or indices.max() < vertices
    return planes.T[indices.T], planes.T


def box_of(points):
    finite = points[np.isfinite(points[:, :3]).all(axis=1), :3]
    return (*finite.min(axis=0), *finite.max(axis=0)) if len(finite) else None


def test_every_face_is_in_one_cluster(built):
    _, _, faces, order, clusters, _ = built
    assert sorted(order) == list(range(len(faces)))
    first = 0
    for cluster in clusters:
        assert cluster[0] == first
        first += cluster[1]
    assert first == len(faces)


def test_limits_are_kept(built):
    for cluster in built[4]:
        assert 1 <= cluster[1] <= 64
        assert 1 <= cluster[2] <= 128


def test_clusters_are_full(built):
    """But for the last of 8192 faces, the only reason to stop is that three more do not fit."""
    for cluster, following in zip(built[4], built[4][1:], strict=False):
        assert cluster[1] == 64 or cluster[2] > 125 or following[0] % 8192 == 0


def test_corners_have_the_bits_of_the_mesh_and_share_their_places(built):
    _, positions, faces, order, clusters, _ = built
    for cluster in clusters:
        corners, planes = corners_of(cluster, positions.shape[1])
        expected = positions[faces[order[cluster[0] : cluster[0] + cluster[1]]]]
        assert corners.tobytes() == np.ascontiguousarray(expected).tobytes()
        places = {row.tobytes() for row in planes[: cluster[2]]}
        assert len(places) == cluster[2]
        assert {row.tobytes() for row in expected.reshape(-1, positions.shape[1])} == places
        assert {row.tobytes() for row in planes[cluster[2] :]} <= {planes[0].tobytes()}  # padding


def test_boxes_are_those_of_the_finite_vertices(built):
    _, positions, _, _, clusters, groups = built
    for cluster in clusters:
        assert cluster[5] == box_of(corners_of(cluster, positions.shape[1])[1])
    for number, (first, count, triangles, box) in enumerate(groups):
        members = clusters[first : first + count]
        assert first == 8 * number
        assert len(members) == count == min(8, len(clusters) - first)
        assert triangles == sum(cluster[1] for cluster in members)
        boxes = [cluster[5] for cluster in members if cluster[5] is not None]
        points = np.array(boxes, np.float32).reshape(-1, 3)
        assert box == box_of(points)
    assert sum(group[1] for group in groups) == len(clusters)


def test_cones_hold_all_normals(built):
    """In float64: no normal is outside of the cone, no altitude below the least."""
    name, positions, _, _, clusters, _ = built
    cones = 0
    for cluster in clusters:
        if cluster[6] is None:
            continue
        cones += 1
        axis, cosine, altitude = cluster[6]
        corners = corners_of(cluster, positions.shape[1])[0].astype(np.float64)
        a, b = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
        c = a - b
        normals = np.cross(a, b)
        area = np.linalg.norm(normals, axis=1)
        longest = np.sqrt(np.max([(edge * edge).sum(axis=1) for edge in (a, b, c)], axis=0))
        assert abs(np.linalg.norm(axis) - 1) < 1e-6
        assert ((normals / area[:, None]) @ np.array(axis)).min() >= cosine
        assert (area / longest).min() >= altitude
    if name in ("grid", "split"):
        assert cones > 0.9 * len(clusters)
    if name == "clip":
        assert cones == 0


def test_threads_change_nothing(built):
    _, positions, faces, *parts = built
    for threads in THREADS[1:]:
        assert repr(clusters_of(positions, faces, threads)) == repr(tuple(parts))


@pytest.mark.parametrize("name", ["grid", "outlier"])
def test_neighbours_come_together(name):
    """Of a grid in random order, clusters are small: sorting has found who is whose neighbour.

    So it does where one face lies a million times farther out than the others are apart.
    """
    positions, faces = make(name)
    boxes = np.array([cluster[5] for cluster in clusters_of(positions, faces, 2)[1]])
    sides = np.sort(boxes[:, 3:] - boxes[:, :3], axis=1)
    assert np.median(sides[:, 2]) < 0.1 * 180


def test_negative_and_too_large_indices_are_refused():
    positions = np.zeros((3, 3), np.float32)
    for index in (-1, 3, -(2**31), 2**31 - 1):
        with pytest.raises(ValueError, match="not valid"):
            clusters_of(positions, np.array([(0, 1, index)], np.int32), 1)


@pytest.mark.parametrize("count", [0, 1, 127, 128, 129, 1000])
def test_box_of_points(count):
    rng = np.random.default_rng(count)
    points = rng.normal(size=(count, 3)).astype(np.float32)
    expected = np.array(box_of(points) or np.zeros(6)).reshape(2, 3)
    assert np.array_equal(np.array(bound_points(points)), expected)
    for odd in (np.nan, np.inf, -np.inf):
        some = points.copy()
        some[rng.random((count, 3)) < 0.01] = odd
        expected = np.array(box_of(some) or np.zeros(6)).reshape(2, 3)
        assert np.array_equal(np.array(bound_points(some)), expected)
    points[:] = np.nan
    assert np.array_equal(np.array(bound_points(points)), np.zeros((2, 3)))
