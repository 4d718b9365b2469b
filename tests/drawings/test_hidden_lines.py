"""Hidden lines against oracles: rational numbers on a lattice, and rays in space."""

import time
from fractions import Fraction

import numpy as np
import pytest

from engine3d._native import drawing as native

SEEDS = range(8)
EYE = np.array([0.0, 0.0, 1.0, 0.0])
THICKNESS, REACH, LEAST = 1e-6, 2e-7, 1e-6


def hide(places, faces, ends, *, eye=EYE, paper=None, threads=1):
    """Return the pieces of lines as seen from an eye; straight from above by default."""
    places, ends = np.ascontiguousarray(places, float), np.ascontiguousarray(ends, float)
    paper = paper or from_above
    return native.hide_lines(
        places,
        paper(places),
        np.ascontiguousarray(faces, np.int32),
        eye,
        THICKNESS,
        REACH,
        ends,
        paper(ends.reshape(-1, 3)).reshape(-1, 2, 4),
        LEAST,
        threads,
    )


def from_above(places):
    """Return x, y, 1 and a depth that is less for what is higher."""
    return np.ascontiguousarray(
        np.stack([places[:, 0], places[:, 1], np.ones(len(places)), -places[:, 2]], axis=1)
    )


def from_a_point(places):
    """Return places as seen from (0, 0, 10)."""
    inverse = 1.0 / (10.0 - places[:, 2])
    across, down = places[:, 0] * inverse, places[:, 1] * inverse
    return np.ascontiguousarray(np.stack([across, down, inverse, -inverse], axis=1))


def is_hidden_exactly(point, triangles):
    """Return whether a triangle has a point below it, in rational numbers; its border counts."""
    x, y, z = point
    for a, b, c in triangles:
        area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
        if area == 0:
            continue
        turns = [
            ((q[0] - p[0]) * (y - p[1]) - (q[1] - p[1]) * (x - p[0])) / area
            for p, q in ((b, c), (c, a), (a, b))
        ]
        if min(turns) >= 0 and sum(t * k[2] for t, k in zip(turns, (a, b, c), strict=True)) > z:
            return True
    return False


@pytest.mark.parametrize("seed", SEEDS)
def test_lines_among_triangles_of_a_lattice_are_hidden_exactly(seed):
    # A lattice has everything that is hard: faces that coincide, edges over edges, walls.
    rng = np.random.default_rng(seed)
    places = rng.integers(-3, 4, (24, 3))
    faces = rng.integers(0, 24, (14, 3))
    ends = places[rng.integers(0, 24, (30, 2))]
    pieces = hide(places, faces, ends)
    rational = [[Fraction(int(v)) for v in place] for place in places]
    triangles = [[rational[v] for v in face] for face in faces]
    checked = 0
    for line, hidden, start, end in pieces.tolist():
        if end - start < 1e-4:
            continue
        share = Fraction(start) + (Fraction(end) - Fraction(start)) * Fraction(3819, 10007)
        a, b = ([Fraction(int(v)) for v in one] for one in ends[line])
        point = [p + (q - p) * share for p, q in zip(a, b, strict=True)]
        assert is_hidden_exactly(point, triangles) == bool(hidden), (line, start, end)
        checked += 1
    assert checked >= 10


def ray_margins(point, toward, triangles):
    """Return how deep inside each triangle a ray passes, how far away, and its plane's distance."""
    a, b, c = np.moveaxis(triangles, 1, 0)
    normal = np.cross(b - a, c - a)
    normal /= np.linalg.norm(normal, axis=1)[:, np.newaxis]
    slope = (normal * toward).sum(axis=1)
    away = (normal * (a - point)).sum(axis=1) / slope
    met = point + away[:, np.newaxis] * toward
    inner = []
    for p, q in ((a, b), (b, c), (c, a)):
        side = np.cross(normal, q - p)
        side /= np.linalg.norm(side, axis=1)[:, np.newaxis]
        inner.append((side * (met - p)).sum(axis=1))
    return np.min(inner, axis=0), away, np.abs(away * slope)


@pytest.mark.parametrize("view", ["parallel", "perspective"])
@pytest.mark.parametrize("seed", SEEDS)
def test_pieces_agree_with_rays(seed, view):
    rng = np.random.default_rng(1000 + seed)
    size = rng.choice([0.2, 1.0, 3.0])
    middles = rng.uniform(-2, 2, (60, 1, 3))
    triangles = middles + rng.normal(0, size, (60, 3, 3))
    triangles[..., 2] = np.clip(triangles[..., 2], -4, 4)
    places, faces = triangles.reshape(-1, 3), np.arange(180).reshape(-1, 3)
    sides = np.stack([triangles, np.roll(triangles, -1, axis=1)], axis=2).reshape(-1, 2, 3)
    is_parallel = view == "parallel"
    paper = from_above if is_parallel else from_a_point
    eye = EYE if is_parallel else np.array([0.0, 0.0, 10.0, 1.0])
    pieces = hide(places, faces, sides, eye=eye, paper=paper)
    flat = paper(sides.reshape(-1, 3)).reshape(-1, 2, 4)
    checked = 0
    for line, hidden, start, end in pieces.tolist():
        share = start + (end - start) * rng.uniform(0.1, 0.9)
        # A place on the drawing, back in space: ends weigh as much as they are near.
        weights = np.array([1 - share, share]) * flat[line, :, 2]
        point = (sides[line] * weights[:, np.newaxis]).sum(axis=0) / weights.sum()
        toward = np.array([0, 0, 1.0]) if is_parallel else np.array([0, 0, 10.0]) - point
        toward = toward / np.linalg.norm(toward)
        inner, away, height = ray_margins(point, toward, triangles)
        surely = (inner > 1e-4) & (away > 0) & (height > 1e-4)
        perhaps = (inner > -1e-4) & (away > -1e-4)
        perhaps[line // 3] = False  # its own face
        if surely.any():
            assert hidden, (line, share)
        elif not perhaps.any():
            assert not hidden, (line, share)
        else:
            continue
        checked += 1
    assert checked > 0.8 * len(pieces)


def test_pieces_cover_each_line_once_in_order():
    rng = np.random.default_rng(5)
    places = rng.uniform(-1, 1, (300, 3))
    pieces = hide(places, rng.integers(0, 300, (150, 3)), places.reshape(-1, 2, 3))
    for line in range(150):
        own = pieces[pieces["line"] == line]
        assert own["from"][0] == 0.0 and own["to"][-1] == 1.0
        assert (own["from"][1:] == own["to"][:-1]).all()
        assert (np.diff(own["is_hidden"]) != 0).all()


def test_threads_change_nothing():
    rng = np.random.default_rng(6)
    places = rng.uniform(-1, 1, (6000, 3))
    faces, ends = places.reshape(-1, 3, 3), places.reshape(-1, 2, 3)
    assert len(faces) == 2000
    arguments = places, np.arange(6000).reshape(-1, 3), ends
    one = hide(*arguments)
    for threads in (2, 3, 8):
        assert (hide(*arguments, threads=threads) == one).all()


def test_what_is_not_finite_hides_nothing():
    places = np.array([[-9, -9, 5], [9, -9, 5], [0, 9, np.nan], [0, 9, np.inf], [0, 9, 5]])
    ends = np.array([[[-1, 0, 0], [1, 0, 0]], [[0, 0, 0], [np.nan, 0, 0]], [[0, 0, 0], [0, 0, 1]]])
    pieces = hide(places, [[0, 1, 2], [0, 1, 3]], ends)
    assert pieces.tolist() == [(0, 0, 0.0, 1.0)]
    pieces = hide(places, [[0, 1, 4]], ends[:1])
    assert pieces.tolist() == [(0, 1, 0.0, 1.0)]


NOT_FINITE = [np.nan, np.inf, -np.inf]


def many(seed, count=200):
    """Return random triangles (count, 3, 3) and lines (count, 2, 3), the triangles smaller."""
    rng = np.random.default_rng(seed)
    triangles = rng.uniform(-1, 1, (count, 1, 3)) + rng.normal(0, 0.2, (count, 3, 3))
    return triangles, rng.uniform(-1, 1, (count, 2, 3))


@pytest.mark.parametrize("bad", NOT_FINITE)
@pytest.mark.parametrize("axis", range(3))
def test_lines_that_are_not_finite_change_no_others(bad, axis):
    triangles, ends = many(axis)
    places, faces = triangles.reshape(-1, 3), np.arange(600).reshape(-1, 3)
    alone = hide(places, faces, ends)
    assert 0 < alone["is_hidden"].sum() < len(alone)
    others = np.repeat(ends[:9], 2, axis=0)
    others[:, 1, axis] = bad
    others[::3, 0, axis] = bad
    together = hide(places, faces, np.concatenate([ends, others]))
    assert (together[together["line"] < len(ends)] == alone).all()


@pytest.mark.parametrize("bad", NOT_FINITE)
@pytest.mark.parametrize("column", range(4))
def test_triangles_that_are_not_finite_change_nothing(bad, column):
    # Half of the triangles, among the others in depth: none of these may be taken for farther.
    triangles, ends = many(10 + column)
    places, faces = triangles.reshape(-1, 3), np.arange(600).reshape(-1, 3)
    paper = from_above(places)
    paper[300::3, column] = bad

    def hide_by(faces):
        lines = from_above(ends.reshape(-1, 3)).reshape(-1, 2, 4)
        faces = np.ascontiguousarray(faces, np.int32)
        return native.hide_lines(places, paper, faces, EYE, THICKNESS, REACH, ends, lines, LEAST, 1)

    if column != 2:  # the inverse of w matters for lines alone
        assert (hide_by(faces) == hide_by(faces[:100])).all()
    assert (hide_by(faces[:100]) == hide(places, faces[:100], ends)).all()


@pytest.mark.parametrize("bad", NOT_FINITE)
@pytest.mark.parametrize("column", range(4))
def test_strokes_that_are_not_finite_change_no_others(bad, column):
    rng = np.random.default_rng(column)
    segments = np.repeat(rng.uniform(0, 9, (40, 4)), 2, axis=0)
    other = segments[:1].copy()
    other[0, column] = bad
    pieces = native.hide_repeated(np.concatenate([segments, other]), 1e-6, 1)
    assert pieces["line"].tolist() == list(range(80))
    assert pieces["is_hidden"].tolist() == [0, 1] * 40


@pytest.mark.parametrize("scale", [1e-320, 1e-300, 1e-200, 1e200, 1e300])
def test_sizes_at_the_ends_of_doubles_take_no_time(scale):
    # Their squares are 0 or infinite. Cells that did not become larger took minutes.
    triangles, ends = many(3)
    begin = time.monotonic()
    hide(triangles.reshape(-1, 3) * scale, np.arange(600).reshape(-1, 3), ends * scale)
    native.hide_repeated(ends[:, :, :2].reshape(-1, 4) * scale, 0.02 * scale, 1)
    assert time.monotonic() - begin < 1.0


@pytest.mark.parametrize("scale", [1e-30, 1e-6, 1e6, 1e30])
def test_size_does_not_matter(scale):
    rng = np.random.default_rng(8)
    places = rng.uniform(-1, 1, (90, 3))
    faces, ends = np.arange(90).reshape(-1, 3), places.reshape(-1, 2, 3)

    def hide_at(scale):
        scaled, lines = places * scale, ends * scale
        return native.hide_lines(
            scaled,
            from_above(scaled),
            faces.astype(np.int32),
            EYE,
            THICKNESS * scale,
            REACH * scale,
            lines,
            from_above(lines.reshape(-1, 3)).reshape(-1, 2, 4),
            LEAST * scale,
            1,
        )

    one, other = hide_at(1.0), hide_at(scale)
    assert (one["is_hidden"] == other["is_hidden"]).all() and (one["line"] == other["line"]).all()
    assert np.abs(one["from"] - other["from"]).max() < 1e-9


def covered_before(segments, number, share, tolerance):
    """Return whether an earlier segment passes through a place of a segment, in its direction."""
    a, b = segments[number].reshape(2, 2)
    point = a + (b - a) * share
    for c, d in segments[:number].reshape(-1, 2, 2):
        along = np.dot(point - c, d - c) / max(np.dot(d - c, d - c), 1e-30)
        lateral = abs(np.cross(np.append(d - c, 0), np.append(b - a, 0))[2])
        is_near = np.linalg.norm(point - c - (d - c) * np.clip(along, 0, 1)) < tolerance
        if is_near and lateral < tolerance * np.linalg.norm(b - a):
            return True
    return False


@pytest.mark.parametrize("seed", SEEDS)
def test_strokes_are_drawn_once(seed):
    rng = np.random.default_rng(2000 + seed)
    starts = rng.integers(0, 5, (60, 2)).astype(float)
    steps = np.array([[1, 0], [0, 1], [1, 1], [1, -1]])[rng.integers(0, 4, 60)]
    segments = np.hstack([starts, starts + steps * rng.integers(1, 4, (60, 1))])
    pieces = native.hide_repeated(segments, 1e-6, 1)
    for line, repeated, start, end in pieces.tolist():
        middle = (start + end) / 2
        assert covered_before(segments, line, middle, 1e-6) == bool(repeated)
    assert (native.hide_repeated(segments, 1e-6, 3) == pieces).all()
