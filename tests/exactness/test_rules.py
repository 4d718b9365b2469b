"""Single rules of docs/exactness, from clip space to barycentrics, by oracles of their own.

Each test computes what a rule says in Python integers, fractions or float64 and compares it with
`engine3d.rasterization.rasterize`. Positions are given in 1/256 pixel, which clip space holds
exactly where the image's sides are powers of two.
"""

import itertools
from fractions import Fraction

import numpy as np
import pytest

import engine3d as e3d

SIZE = 16  # pixels a side; a power of two


@pytest.fixture(params=e3d.backends())
def backend(request):
    return request.param


def clip_at(points, *, z=0.0, w=1.0, size=SIZE):
    """Clip positions of points in 1/256 pixel, Y down, at depth z_ndc and distance w."""
    points = np.asarray(points, np.float64)
    z, w = np.broadcast_to(z, len(points)), np.broadcast_to(w, len(points))
    ndc = points / (128.0 * size) - 1.0
    return np.stack([ndc[:, 0] * w, -ndc[:, 1] * w, z * w, w], axis=1).astype(np.float32)


def covered(points, backend, *, size=SIZE):
    """Which pixels one triangle covers, (size, size) bool."""
    result = e3d.rasterization.rasterize(
        clip_at(points, size=size), [[0, 1, 2]], (size, size), backend=backend
    )
    return result.face_id == 0


def edge(origin, to, point):
    """Twice the signed area of three integer points."""
    (ox, oy), (tx, ty), (px, py) = origin, to, point
    return (tx - ox) * (py - oy) - (ty - oy) * (px - ox)


def covered_by_integers(points, size=SIZE):
    """R12 in Python integers: centres inside, or on a top or left edge."""
    a, b, c = [tuple(int(v) for v in p) for p in points]
    if edge(a, b, c) < 0:
        b, c = c, b
    inside = np.zeros((size, size), bool)
    if edge(a, b, c) == 0:
        return inside
    for row, column in itertools.product(range(size), range(size)):
        center = (256 * column + 128, 256 * row + 128)
        for start, end in ((a, b), (b, c), (c, a)):
            value = edge(start, end, center)
            goes_up = end[1] < start[1]
            goes_right = end[1] == start[1] and end[0] > start[0]
            if value < 0 or (value == 0 and not (goes_up or goes_right)):
                break
        else:
            inside[row, column] = True
    return inside


def test_top_left_rule_on_a_square_between_centers(backend):
    """Edges through centres: the left column and the top row are in, the right and bottom out."""
    corners = [(128, 128), (128 + 768, 128), (128 + 768, 128 + 768), (128, 128 + 768)]
    result = e3d.rasterization.rasterize(
        clip_at(corners), [[0, 1, 2], [0, 2, 3]], (SIZE, SIZE), backend=backend
    )
    expected = np.zeros((SIZE, SIZE), bool)
    expected[0:3, 0:3] = True
    assert np.array_equal(result.face_id >= 0, expected)


@pytest.mark.parametrize("order", list(itertools.permutations(range(3))))
def test_coverage_does_not_depend_on_the_order_of_vertices(backend, order):
    points = np.array([(128, 128), (2000, 640), (384, 3456)])
    assert np.array_equal(covered(points[list(order)], backend), covered_by_integers(points))


def test_coverage_is_that_of_integers(backend):
    rng = np.random.default_rng(1)
    for number in range(60):
        grid = (1, 64, 128)[number % 3]  # coarse grids put vertices and edges on centres
        points = rng.integers(-1024 // grid, (256 * SIZE + 1024) // grid, (3, 2)) * grid
        assert np.array_equal(covered(points, backend), covered_by_integers(points)), points


def test_triangles_far_outside_the_image_are_exact(backend):
    """Up to the guard band nothing is clipped, so that the integers still tell every pixel."""
    rng = np.random.default_rng(2)
    for _ in range(20):
        points = rng.integers(-(2**22), 2**22, (3, 2))
        assert np.array_equal(covered(points, backend), covered_by_integers(points)), points


@pytest.mark.parametrize("w", [1.0, 0.25, 8.0])
@pytest.mark.parametrize(
    ("left", "first"), [(127.5, 0), (128.5, 0), (129.5, 1), (129, 1), (128, 0)]
)
def test_positions_snap_to_nearest_even(backend, left, first, w):
    """Left edges at halves of 1/256 pixel go to the even neighbour; 128 is the first centre."""
    size = 2
    corners = [(left, 0), (512, 0), (512, 512), (left, 512)]
    clip = clip_at(corners, w=w, size=size)
    result = e3d.rasterization.rasterize(
        clip, [[0, 1, 2], [0, 2, 3]], (size, size), backend=backend
    )
    columns = np.nonzero((result.face_id >= 0).all(axis=0))[0]
    assert columns[0] == first


def test_a_mesh_covers_every_pixel_once(backend):
    """A grid of jittered vertices, some on centres: one triangle a pixel, no hole."""
    rng = np.random.default_rng(3)
    step = 2
    lattice = np.stack(np.meshgrid(*[np.arange(-step, SIZE + 2 * step, step)] * 2), axis=-1) * 256
    lattice = lattice + 64 * rng.integers(-3, 4, lattice.shape)
    rows, columns = lattice.shape[:2]
    layers = np.zeros((SIZE, SIZE), int)
    for r, c in itertools.product(range(rows - 1), range(columns - 1)):
        a, b = lattice[r, c], lattice[r, c + 1]
        d, e = lattice[r + 1, c], lattice[r + 1, c + 1]
        layers += covered([a, b, d], backend)
        layers += covered([d, b, e], backend)
    assert (layers == 1).all()


def test_culling_goes_by_the_winding_on_the_screen(backend):
    counter_clockwise = clip_at([(0, 4096), (4096, 4096), (0, 0)])
    for cull, faces, visible in [
        ("back", [[0, 1, 2]], True),
        ("back", [[0, 2, 1]], False),
        ("front", [[0, 1, 2]], False),
        ("front", [[0, 2, 1]], True),
        ("none", [[0, 2, 1]], True),
    ]:
        result = e3d.rasterization.rasterize(
            counter_clockwise, faces, (SIZE, SIZE), cull=cull, backend=backend
        )
        assert (result.face_id >= 0).any() == visible


def test_not_finite_vertices_drop_their_triangles_only(backend):
    clip = clip_at([(0, 0), (4096, 0), (0, 4096)] * 2)
    for component, value in itertools.product(range(4), (np.nan, np.inf, -np.inf)):
        broken = clip.copy()
        broken[4, component] = value
        result = e3d.rasterization.rasterize(
            broken, [[3, 4, 5], [0, 1, 2]], (SIZE, SIZE), backend=backend
        )
        assert set(np.unique(result.face_id)) == {-1, 1}
        assert not np.isnan(result.depth).any() and np.isfinite(result.barycentric).all()


def exact_barycentrics(points, w, row, column):
    """Perspective-correct weights of a centre, as fractions of the snapped positions."""
    center = (256 * column + 128, 256 * row + 128)
    points = [tuple(int(v) for v in p) for p in points]
    weights = [
        Fraction(edge(points[(k + 1) % 3], points[(k + 2) % 3], center)) / Fraction(float(w[k]))
        for k in range(3)
    ]
    return [float(weight / sum(weights)) for weight in weights]


def test_barycentrics_are_perspective_correct(backend):
    rng = np.random.default_rng(4)
    for _ in range(8):
        points = np.array([(-500, 4300), (4600, 3900), (2000, -700)])
        points = (points + rng.integers(-400, 400, (3, 2)))[rng.permutation(3)]
        w = 2.0 ** rng.integers(-3, 4, 3)
        clip = clip_at(points, w=w)
        result = e3d.rasterization.rasterize(clip, [[0, 1, 2]], (SIZE, SIZE), backend=backend)
        for row, column in zip(*np.nonzero(result.face_id == 0), strict=True):
            expected = exact_barycentrics(points, w, row, column)
            assert np.abs(result.barycentric[row, column] - expected).max() < 2e-6


def test_depth_is_linear_on_the_screen_and_within_its_vertices(backend):
    points = [(-600, 4500), (4700, 4400), (1800, -900)]
    z = np.array([-0.75, 0.5, 0.125], np.float32)
    clip = clip_at(points, z=z, w=[1.0, 4.0, 0.5])
    result = e3d.rasterization.rasterize(clip, [[0, 1, 2]], (SIZE, SIZE), backend=backend)
    for row, column in zip(*np.nonzero(result.face_id == 0), strict=True):
        weights = exact_barycentrics(points, [1, 1, 1], row, column)
        assert abs(result.depth[row, column] - np.dot(weights, z)) < 1e-6
    seen = result.depth[result.face_id == 0]
    assert len(seen) > 100 and seen.min() >= z.min() and seen.max() <= z.max()


@pytest.mark.parametrize("z", [-1.0, -0.375, 0.0, 0.7, 1.0])
def test_constant_depth_is_kept_to_the_bit(backend, z):
    clip = clip_at([(-99, -77), (9001, 3), (5, 8999)], z=np.float32(z))
    result = e3d.rasterization.rasterize(clip, [[0, 1, 2]], (SIZE, SIZE), backend=backend)
    assert (result.face_id == 0).all() and (result.depth == np.float32(z)).all()


def test_nearer_wins_and_a_tie_goes_to_the_first(backend):
    square = [(0, 0), (4096, 0), (4096, 4096), (0, 4096)]
    clip = np.concatenate([clip_at(square, z=z) for z in (0.5, 0.25, 0.25, 0.75)])
    quads = [[[4 * q, 4 * q + 1, 4 * q + 2], [4 * q, 4 * q + 2, 4 * q + 3]] for q in range(4)]
    for order in itertools.permutations(range(4)):
        faces = np.concatenate([quads[q] for q in order])
        result = e3d.rasterization.rasterize(clip, faces, (SIZE, SIZE), backend=backend)
        first = min(order.index(1), order.index(2))
        assert set(np.unique(result.face_id)) == {2 * first, 2 * first + 1}
        assert (result.depth == 0.25).all()


def test_ties_between_slanted_triangles_go_to_the_first(backend):
    """The same triangle three times: one depth everywhere, and only the first shows."""
    clip = clip_at([(-600, 4500), (4700, 4400), (1800, -900)], z=[-0.7, 0.5, 0.1], w=[1, 4, 0.5])
    result = e3d.rasterization.rasterize(clip, [[0, 1, 2]] * 3, (SIZE, SIZE), backend=backend)
    assert set(np.unique(result.face_id)) <= {-1, 0}


def test_far_plane_drops_fragments(backend):
    """z_ndc falls from 1.5 at the left edge to 0.5 at the right one: the right half is seen."""
    corners = [(0, 0), (4096, 0), (4096, 4096), (0, 4096)]
    clip = clip_at(corners, z=[1.5, 0.5, 0.5, 1.5])
    result = e3d.rasterization.rasterize(
        clip, [[0, 1, 2], [0, 2, 3]], (SIZE, SIZE), backend=backend
    )
    seen = result.face_id >= 0
    assert not seen[:, : SIZE // 2].any() and seen[:, SIZE // 2 :].all()
    assert result.depth[seen].max() <= 1.0 and np.isposinf(result.depth[~seen]).all()


def test_beyond_the_far_plane_nothing_shows(backend):
    beyond = float(np.nextafter(np.float32(1), np.float32(2)))
    clip = clip_at([(-99, -77), (9001, 3), (5, 8999)], z=beyond)
    result = e3d.rasterization.rasterize(clip, [[0, 1, 2]], (SIZE, SIZE), backend=backend)
    assert (result.face_id == -1).all()


def visible_weights(clip, size, row, column):
    """Float64: the vertices' weights at a pixel's centre, scaled so that w = 1, and z_ndc."""
    clip = clip.astype(np.float64)
    ndc = np.array([(2 * column + 1) / size - 1, 1 - (2 * row + 1) / size, 1.0])
    weights = np.linalg.solve(clip[:, [0, 1, 3]].T, ndc)
    return weights, weights @ clip[:, 2]


@pytest.mark.parametrize("seed", range(6))
def test_triangles_that_cross_the_near_plane(backend, seed):
    """Vertices behind the eye: what is seen, and its barycentrics, are those of the plane."""
    rng = np.random.default_rng(10 + seed)
    size, znear, zfar = 32, 0.25, 50.0
    view = np.array([[-3.0, -1.0, 4.0], [5.0, -1.5, 2.0], [0.5, 0.5, -9.0]])
    view = (view + rng.uniform(-0.5, 0.5, (3, 3)))[rng.permutation(3)]
    scale, shift = (zfar + znear) / (znear - zfar), 2 * zfar * znear / (znear - zfar)
    clip = np.stack([view[:, 0], view[:, 1], scale * view[:, 2] + shift, -view[:, 2]], axis=1)
    clip = clip.astype(np.float32)
    result = e3d.rasterization.rasterize(clip, [[0, 1, 2]], (size, size), backend=backend)
    compared = 0
    for row, column in itertools.product(range(size), range(size)):
        weights, z = visible_weights(clip, size, row, column)
        share = weights / weights.sum()
        depth_margin = min(1 + z, 1 - z)
        if min(np.abs(share).min(), abs(depth_margin)) < 0.02:
            continue  # near an edge: snapping decides
        inside = weights.sum() > 0 and share.min() > 0 and depth_margin > 0
        assert (result.face_id[row, column] == 0) == inside
        if inside:
            compared += 1
            assert np.abs(result.barycentric[row, column] - share).max() < 2e-3
    assert compared > 20


def test_no_cracks_along_edges_cut_by_the_near_plane(backend):
    """A plane under the eye, in triangles that share edges, some behind: each pixel once."""
    rng = np.random.default_rng(5)
    ticks = np.linspace(-40, 40, 9)
    x, z = np.meshgrid(ticks, ticks)
    x, z = x + rng.uniform(-2, 2, x.shape), z + rng.uniform(-2, 2, z.shape)
    clip = np.stack([x, -np.ones_like(x), -z * 1.0 - 0.5, -z], axis=-1).reshape(-1, 4)
    layers = np.zeros((64, 64), int)
    for row, column in itertools.product(range(8), range(8)):
        a = 9 * row + column
        for face in ([a, a + 1, a + 9], [a + 9, a + 1, a + 10]):
            result = e3d.rasterization.rasterize(clip, [face], (64, 64), backend=backend)
            layers += result.face_id == 0
    below = layers[36:60, :]  # from near the horizon to near the near plane's line
    assert layers.max() == 1 and (below[:, 12:52] == 1).all()


@pytest.mark.parametrize("size", [(1, 1), (16384, 1), (1, 16384), (3, 257)])
def test_a_triangle_over_everything_fills_every_size(backend, size):
    clip = np.array([[-1, -1, 0, 1], [3, -1, 0, 1], [-1, 3, 0, 1]], np.float32)
    result = e3d.rasterization.rasterize(clip, [[0, 1, 2]], size, backend=backend)
    assert (result.face_id == 0).all() and (result.depth == 0).all()
    assert np.abs(result.barycentric.sum(axis=-1) - 1).max() < 1e-6


@pytest.mark.parametrize("huge", [1e4, 1e6, 1e9, 1e12])
def test_huge_coordinates_are_clipped_not_lost(backend, huge):
    """A half-plane whose vertices are far beyond the guard band still ends where it should."""
    clip = np.array([[0, -huge, 0, 1], [huge, 0, 0, 1], [0, huge, 0, 1]], np.float32)
    result = e3d.rasterization.rasterize(clip, [[0, 1, 2]], (SIZE, SIZE), backend=backend)
    seen = result.face_id == 0
    assert seen[:, SIZE // 2 :].all() and not seen[:, : SIZE // 2].any()
