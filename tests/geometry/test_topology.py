"""Edges of faces, against a walk in plain Python; and what they cost."""

import numpy as np
import pytest

import engine3d as e3d
from engine3d.model.geometry.topology import visible_edges


def walk(faces, visible, points):
    """The first side of each pair of points, in the order of the faces."""
    met, edges = set(), []
    for face, flags in zip(faces.tolist(), visible.tolist(), strict=True):
        for k in range(3):
            side = face[k], face[(k + 1) % 3]
            ends = frozenset(points[vertex] for vertex in side)
            if flags[k] and len(ends) == 2 and ends not in met:
                met.add(ends)
                edges.append(side)
    return edges


@pytest.mark.parametrize("seed", range(20))
def test_edges_are_those_of_a_walk(seed):
    random = np.random.default_rng(seed)
    vertices = int(random.integers(1, 40))
    faces = random.integers(0, vertices, (int(random.integers(0, 300)), 3)).astype(np.int32)
    visible = random.random(faces.shape) < random.choice((0.2, 0.8, 1.0))
    points = random.integers(0, max(1, vertices // 2), vertices).astype(np.int32)
    for ids in (None, points):
        for flags in (None, visible):
            found = visible_edges(faces, flags, ids)
            expected = walk(
                faces,
                np.ones_like(visible) if flags is None else flags,
                range(vertices) if ids is None else points.tolist(),
            )
            assert found.dtype == np.int32 and found.shape == (len(expected), 2)
            assert list(map(tuple, found.tolist())) == expected


def test_many_edges_at_one_vertex():
    """A fan, whose lists are long: time grows with the number of faces."""
    rim = np.arange(1, 200_001, dtype=np.int32)
    faces = np.stack([np.zeros_like(rim[1:]), rim[:-1], rim[1:]], axis=1)
    assert len(visible_edges(np.concatenate([faces, faces[::-1]]))) == 2 * len(faces) + 1


def test_indices_out_of_range():
    for points in (np.array([0, 1], np.int32), np.array([0, 1, -1], np.int32)):
        with pytest.raises(e3d.InvalidArgumentError, match="out of range"):
            visible_edges(np.array([(0, 1, 2)], np.int32), None, points)
    with pytest.raises(e3d.InvalidArgumentError, match="out of range"):
        visible_edges(np.array([(0, 1, -2)], np.int32))
