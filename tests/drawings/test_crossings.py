"""Where triangles of different parts cross, against edges that pierce triangles."""

import time

import numpy as np
import pytest

import engine3d as e3d
from engine3d._native import drawing as native
from engine3d.drawings import line_drawing


def crossings(triangles, parts, thickness=1e-12, threads=1):
    places = np.ascontiguousarray(triangles.reshape(-1, 3), float)
    faces = np.arange(len(places), dtype=np.int32).reshape(-1, 3)
    return native.cross_surfaces(places, faces, np.asarray(parts, np.int32), thickness, threads)


def pierced(edges, triangle):
    """Return the points in which edges (N, 2, 3) pierce a triangle."""
    a, b, c = triangle
    found = []
    for p, q in edges:
        matrix = np.stack([p - q, b - a, c - a], axis=1)
        if abs(np.linalg.det(matrix)) < 1e-14:
            continue
        t, u, v = np.linalg.solve(matrix, p - a)
        if 0 <= t <= 1 and u >= 0 and v >= 0 and u + v <= 1:
            found.append(p + (q - p) * t)
    return found


def sides(triangle):
    return np.stack([triangle, np.roll(triangle, -1, axis=0)], axis=1)


@pytest.mark.parametrize("seed", range(15))
def test_segments_end_where_edges_pierce_triangles(seed):
    rng = np.random.default_rng(seed)
    triangles = rng.uniform(-1, 1, (24, 1, 3)) + rng.normal(0, 0.6, (24, 3, 3))
    parts = rng.integers(0, 5, 24)
    found = {tuple(one["faces"]): one["ends"].reshape(2, 3) for one in crossings(triangles, parts)}
    for i in range(24):
        for k in range(i + 1, 24):
            one, other = triangles[i], triangles[k]
            points = pierced(sides(one), other) + pierced(sides(other), one)
            if parts[i] == parts[k] or not points:
                assert (i, k) not in found
                continue
            assert len(points) == 2
            ends = found.pop((i, k))
            for point in points:
                assert np.linalg.norm(ends - point, axis=1).min() < 1e-9
    assert not found


def small_triangles(count):
    rng = np.random.default_rng(count)
    return rng.uniform(-1, 1, (count, 1, 3)) + rng.normal(0, 0.01, (count, 3, 3))


@pytest.mark.parametrize("bad", [np.nan, np.inf, -np.inf, 1e5])
def test_a_triangle_far_out_costs_no_time_and_changes_nothing(bad):
    # Triangles that all lay at one place of the curve were each compared with half of the others.
    triangles, parts = small_triangles(30000), np.arange(30000) % 2
    begin = time.process_time()
    alone = crossings(triangles[1:], parts[1:])
    usual = time.process_time() - begin
    triangles[0, 0] = bad
    begin = time.process_time()
    found = crossings(triangles, parts)
    assert time.process_time() - begin < 0.5 + 6 * usual
    found = found[found["faces"][:, 0] > 0]
    assert len(alone) > 100
    assert (found["faces"] - 1 == alone["faces"]).all()
    assert (found["ends"] == alone["ends"]).all()


@pytest.mark.parametrize("count", [1, 2, 5, 6, 7, 10, 21])
def test_places_beyond_float32_cross_as_near_ones_do(count):
    triangles = np.random.default_rng(count).uniform(-1, 1, (count, 3, 3))
    near = crossings(triangles, np.arange(count))
    for scale in (2.0**127, 2.0**140):
        far = crossings(triangles * scale, np.arange(count), 1e-12 * scale)
        assert np.array_equal(far["faces"], near["faces"])


def test_order_and_threads_change_nothing():
    rng = np.random.default_rng(1)
    triangles = rng.uniform(-1, 1, (3000, 1, 3)) + rng.normal(0, 0.1, (3000, 3, 3))
    parts = rng.integers(0, 9, 3000)
    one = crossings(triangles, parts)
    assert len(one) > 1000
    assert (np.diff(one["faces"][:, 0]) >= 0).all()
    for threads in (2, 5):
        assert (crossings(triangles, parts, threads=threads) == one).all()


def test_faces_that_touch_or_coincide_do_not_cross():
    triangle = np.array([[0, 0, 0], [4, 0, 0], [0, 4, 0]], float)
    flat = triangle + (1, 1, 0)
    above = triangle + (0, 0, 1)
    corner = np.array([[1, 1, 0], [1, 2, 1], [2, 1, 1]], float)
    broken = np.full((3, 3), np.nan)
    line = np.array([[0, 0, -1], [1, 1, 0], [2, 2, 1]], float)
    for other in (triangle, flat, above, corner, broken, line):
        assert len(crossings(np.stack([triangle, other]), [0, 1])) == 0


def test_outlines_stand_where_pixels_change():
    scene = e3d.Scene()
    scene.add(e3d.torus(1.0, 0.35), rotation=(0.3, 0.1, 0.2, 0.9))
    scene.add(e3d.box((0.7, 0.8, 2.4)), translation=(0.4, 0.1, 0))
    camera = e3d.frame_scene(scene)
    size = 300
    frame = e3d.render(scene, camera, size=(size, size), outputs=("object_id",), look="plain")
    drawing = line_drawing(scene, camera, size=(size, size))
    ends = drawing.pieces.of(hidden=False).ends * (96 / 25.4)
    a, way = ends[:, 0], ends[:, 1] - ends[:, 0]
    ids = frame.object_id
    rows, columns = np.nonzero(ids[:, 1:] != ids[:, :-1])
    assert len(rows) > 300
    points = np.stack([columns + 1.0, rows + 0.5], axis=1)
    squares = np.maximum((way * way).sum(axis=1), 1e-12)
    along = ((points[:, np.newaxis] - a) * way).sum(axis=2) / squares
    nearest = a + way * np.clip(along, 0, 1)[..., np.newaxis]
    away = np.linalg.norm(points[:, np.newaxis] - nearest, axis=2).min(axis=1)
    assert away.max() < 1.0


def test_bodies_of_one_mesh_cross_as_parts_do():
    torus, box = e3d.torus(1.0, 0.35), e3d.box((1.7, 0.8, 2.4))
    apart = e3d.Scene()
    apart.add(torus)
    apart.add(box)
    faces = np.concatenate([torus.faces, box.faces + len(torus.positions)])
    whole = e3d.Mesh(np.concatenate([torus.positions, box.positions]), faces)
    camera = e3d.frame_scene(apart)
    found = [line_drawing(one, camera).pieces.of("intersection") for one in (apart, whole)]
    assert found[0].length == pytest.approx(found[1].length, rel=1e-6) and found[0].length > 50


@pytest.mark.parametrize("seed", range(10))
def test_bodies_hang_together_by_vertices(seed):
    rng = np.random.default_rng(seed)
    faces = rng.integers(0, 60, (25, 3)).astype(np.int32)
    bodies = native.find_bodies(faces, 60)
    labels = np.arange(60)
    for _ in range(60):  # until nothing changes, for certain
        for face in faces:
            labels[face] = labels[face].min()
    assert (bodies == labels[faces[:, 0]]).all()
