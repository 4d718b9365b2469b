"""Walkers: random walks against rays through every triangle, sliding, steps, heights."""

import math

import numpy as np
import pytest
from navigation.test_grid import (
    HEAD,
    SLOPE,
    STEP,
    floor,
    normals_of,
    random_world,
    slab,
    triangles_of,
)

import engine3d as e3d
from engine3d.errors import InvalidArgumentError


def hits(corners, start, end):
    """Whether any triangle (N, 3, 3) crosses the segment."""
    way = end - start
    e1, e2 = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    p = np.cross(way, e2)
    det = (e1 * p).sum(axis=1)
    with np.errstate(all="ignore"):
        s = start - corners[:, 0]
        u = (s * p).sum(axis=1) / det
        q = np.cross(s, e1)
        v = (way * q).sum(axis=1) / det
        t = (e2 * q).sum(axis=1) / det
        inside = (u >= 0) & (v >= 0) & (u + v <= 1) & (t >= 0) & (t <= 1)
    return ((np.abs(det) > 1e-12) & inside).any()


def walk(grid, corners, names, walkable, seed, steps, longest):
    """Wander about; whatever is passed is looked for with rays."""
    rng = np.random.default_rng(seed)
    normals = normals_of(corners)
    layer = rng.choice(np.flatnonzero(grid.walkable))
    cell = np.searchsorted(grid.starts, layer, side="right") - 1
    x, z = grid.origin + (np.array((cell % grid.shape[1], cell // grid.shape[1])) + 0.5) * grid.cell
    walker = e3d.navigation.Walker(grid, x, z, float(grid.heights[layer]))
    heading, moved = 0.0, 0
    for _ in range(steps):
        heading += rng.normal(0.0, 0.5)
        length = rng.uniform(0.0, longest)
        before = np.array((walker.x, walker.y, walker.z))
        if not walker.move(length * math.cos(heading), length * math.sin(heading)):
            heading += math.pi / 2
            continue
        moved += 1
        after = np.array((walker.x, walker.y, walker.z))
        assert math.hypot(*(after - before)[[0, 2]]) <= length * 1.0001
        stood = corners[(np.abs(normals[:, 1]) > 1e-3) & np.isin(names, list(walkable))]
        down, up = after - (0, 1e-3, 0), after + (0, 1e-3, 0)
        assert hits(stood, up, down) or grid.sample_ground(after[0], after[2], after[1])[1]
        if length <= grid.cell / 2:
            # One straight step: nothing stands between the step's height and the head's.
            for height in np.linspace(STEP + 0.01, HEAD - 0.01, 4):
                lift = np.array((0.0, height, 0.0))
                low = max(before[1], after[1])
                a, b = before.copy(), after.copy()
                a[1] = b[1] = low
                assert not hits(corners, a + lift, b + lift)
    return moved


@pytest.mark.parametrize("seed", range(6))
def test_random_walks_pass_through_nothing(seed):
    meshes = random_world(seed)
    walkable = {"stone"}
    grid = e3d.navigation.NavigationGrid(
        meshes, cell=0.4, walkable=walkable, max_slope=SLOPE, step=STEP, headroom=HEAD, radius=0.1
    )
    corners, names = triangles_of(meshes)
    assert walk(grid, corners, names, walkable, seed, 150, 0.2) > 30
    assert walk(grid, corners, names, walkable, seed + 100, 60, 5.0) > 10


def test_random_walks_through_the_city():
    world = e3d.worlds.city(60_000)
    bounds = ((-60, -60), (130, 60))
    grid = e3d.navigation.NavigationGrid(
        world.districts,
        walkable=world.walkable,
        ignore=world.foliage,
        bounds=bounds,
        step=STEP,
        headroom=HEAD,
    )
    corners, names = triangles_of(world.districts, lambda m: m.name not in world.foliage)
    near = (corners.min(axis=1)[:, 1] < 3) & (corners.max(axis=1)[:, [0, 2]] > -61).all(axis=1)
    for seed in range(3):
        assert walk(grid, corners[near], names[near], world.walkable, seed, 60, 0.25) > 10


def test_a_maze_cannot_be_left():
    walls = [slab((-3, 0, -3), (3, 2, -2.98)), slab((-3, 0, 2.98), (3, 2, 3))]
    walls += [slab((-3, 0, -3), (-2.98, 2, 3)), slab((2.98, 0, -3), (3, 2, 3))]
    grid = e3d.navigation.NavigationGrid([floor(-9, -9, 9, 9), *walls], radius=0.0, cell=0.7)
    rng = np.random.default_rng(1)
    walker = e3d.navigation.Walker(grid, 0.0, 0.0)
    for _ in range(500):
        walker.move(*rng.normal(0.0, 20.0, 2))
        assert max(abs(walker.x), abs(walker.z)) < 2.98


def test_a_diagonal_wall_is_not_passed_at_the_corners():
    wall = e3d.primitives.quad((-4, 0, 4), (4, 0, -4), (4, 2, -4), (-4, 2, 4))
    back = e3d.primitives.quad((4, 0, -4), (-4, 0, 4), (-4, 2, 4), (4, 2, -4))
    grid = e3d.navigation.NavigationGrid([floor(-4, -4, 4, 4), wall, back], radius=0.0)
    walker = e3d.navigation.Walker(grid, -2.0, -2.0)
    for _ in range(50):
        walker.move(3.0, 3.0)
        walker.move(0.3, -0.1)
        assert walker.x + walker.z < 0


def test_nobody_leaves_the_grid():
    grid = e3d.navigation.NavigationGrid(floor(0, 0, 5, 5), cell=0.5)
    walker = e3d.navigation.Walker(grid, 2.5, 2.5)
    assert walker.move(100.0, 1.0)
    assert 4.5 <= walker.x < 5.0 and walker.z > 2.5
    walker.move(-100.0, -100.0)
    assert 0.0 <= walker.x < 0.5 and 0.0 <= walker.z < 0.5
    for bad in ((math.nan, 0.0), (math.inf, 0.0), (1e308, 1e308), (0.0, 0.0)):
        assert not walker.move(*bad)


def test_walls_are_slid_along():
    grid = e3d.navigation.NavigationGrid(
        [floor(0, 0, 10, 10), slab((5, 0, 0), (5.2, 3, 10))], radius=0.2
    )
    walker = e3d.navigation.Walker(grid, 2.0, 2.0)
    assert walker.move(6.0, 6.0)
    assert 4.0 < walker.x < 4.8
    assert walker.z == pytest.approx(8.0, abs=0.01)
    assert not walker.move(3.0, 0.0)


def test_steps_are_climbed_and_ledges_are_not_jumped():
    stairs = [slab((2 + 0.5 * k, 0, 0), (8, 0.3 * (k + 1), 4)) for k in range(5)]
    grid = e3d.navigation.NavigationGrid([floor(0, 0, 8, 4), *stairs], cell=0.25, radius=0.0)
    walker = e3d.navigation.Walker(grid, 1.0, 2.0)
    assert walker.y == 0.0
    walker.move(5.0, 0.0)
    assert walker.y == pytest.approx(1.5) and walker.x == pytest.approx(6.0)
    assert walker.eye[1] == pytest.approx(1.5 + 1.7)
    walker.move(-5.0, 0.0)
    assert walker.y == 0.0
    ledge = e3d.navigation.NavigationGrid(
        [floor(0, 0, 8, 4), slab((4, 0, 0), (8, 1, 4))], radius=0.0
    )
    high = e3d.navigation.Walker(ledge, 6.0, 2.0)
    high.move(-6.0, 0.0)
    assert high.y == 1.0 and high.x >= 4.0
    low = e3d.navigation.Walker(ledge, 1.0, 2.0)
    low.move(6.0, 0.0)
    assert low.y == 0.0 and low.x < 4.0


def test_a_ramp_is_followed_and_a_bridge_passed_over_and_under():
    ramp = e3d.primitives.quad((0, 0, 4), (6, 3, 4), (6, 3, 2), (0, 0, 2))
    meshes = [floor(-2, -4, 14, 8), ramp, slab((6, 2.7, 2), (12, 3, 4))]
    for mesh in meshes:
        mesh.materials = [e3d.Material(name="stone")]
    grid = e3d.navigation.NavigationGrid(meshes, cell=0.4, radius=0.0)
    over = e3d.navigation.Walker(grid, -1.0, 3.0)
    over.move(4.0, 0.0)
    assert over.y == pytest.approx(1.5, abs=1e-5)
    over.move(7.0, 0.0)
    assert over.y == pytest.approx(3.0)
    under = e3d.navigation.Walker(grid, 10.0, -1.0)
    under.move(0.0, 4.0)
    assert under.y == 0.0 and under.z == pytest.approx(3.0)
    assert (under.x, over.x) == (pytest.approx(10.0), pytest.approx(10.0))


def test_starting_beside_what_is_walkable():
    grid = e3d.navigation.NavigationGrid(
        [floor(0, 0, 6, 6), floor(2, 2, 4, 4, y=0.1, name="water")], walkable={"stone"}
    )
    walker = e3d.navigation.Walker(grid, 3.0, 3.0, 0.0)
    assert grid.sample_ground(walker.x, walker.z, walker.y) == (0.0, True)
    assert max(abs(walker.x - 3), abs(walker.z - 3)) > 1
    assert e3d.navigation.Walker(grid, 1.1, 1.2).x == 1.1
    assert e3d.navigation.Walker(grid, -50.0, 1.2).x < 0.5
    with pytest.raises(InvalidArgumentError, match="nothing"):
        e3d.navigation.Walker(e3d.navigation.NavigationGrid(floor(0, 0, 1, 1), walkable=()), 0, 0)


def test_walking_over_many_grids_is_walking_over_one():
    """Every step of a long way, on small grids made on the way and on one large grid."""
    random = np.random.default_rng(7)
    meshes = [floor(-150, -150, 150, 150)]
    for x, z in random.uniform(-145, 145, (200, 2)):
        meshes.append(slab((x, 0, z), (x + 4, random.choice([0.3, 3.0]), z + 3)))
    whole = e3d.navigation.NavigationGrid(meshes, bounds=((-150, -150), (150, 150)))
    asked = []

    def survey(x, z):
        middle = np.rint((x, z))
        low, high = np.maximum(middle - 60, -150), np.minimum(middle + 60, 150)
        asked.append((x, z))
        return e3d.navigation.NavigationGrid(meshes, bounds=(low, high))

    one = e3d.navigation.Walker(whole, 0.0, 0.0)
    many = e3d.navigation.Walker(survey(one.x, one.z), one.x, one.z, survey=survey)
    farthest = 0.0
    for step in range(400):
        if step % 20 == 0:
            way = random.normal(size=2) * 1.5 + 0.5
        assert one.move(*way) == many.move(*way)
        assert (one.x, one.y, one.z) == (many.x, many.y, many.z)
        farthest = max(farthest, abs(one.x), abs(one.z))
    assert len(asked) > 3 and farthest > 100


def test_a_survey_that_finds_no_ground_changes_nothing():
    grid = e3d.navigation.NavigationGrid(floor(0, 0, 100, 100))
    nowhere = e3d.navigation.NavigationGrid(floor(500, 500, 510, 510))
    walker = e3d.navigation.Walker(grid, 50.0, 50.0, survey=lambda x, z: nowhere)
    assert walker.move(45.0, 0.0) and walker.x == 95.0
    assert walker.grid is grid


@pytest.mark.parametrize(
    "place", [{"x": math.nan, "z": 0}, {"x": 0, "z": math.inf}, {"x": 0, "z": 0, "y": math.nan}]
)
def test_a_place_that_is_none(place):
    with pytest.raises(InvalidArgumentError, match="must be a finite number"):
        e3d.navigation.Walker(e3d.navigation.NavigationGrid(floor(-5, -5, 5, 5)), **place)
    with pytest.raises(InvalidArgumentError, match="grid must be a NavigationGrid"):
        e3d.navigation.Walker(None, x=0.0, z=0.0)
