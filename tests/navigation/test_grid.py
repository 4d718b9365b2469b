"""Navigation grids against brute force: rays downward, points strewn over every triangle."""

import math

import numpy as np
import pytest

import engine3d as e3d
from engine3d.errors import InvalidArgumentError


def slab(low, high, name="stone"):
    """A box from corner to corner."""
    low, high = np.array(low, float), np.array(high, float)
    mesh = e3d.box(tuple(high - low))
    mesh.positions = mesh.positions + ((low + high) / 2).astype(np.float32)
    mesh.materials = [e3d.Material(name=name)]
    return mesh


def floor(x0, z0, x1, z1, y=0.0, name="stone"):
    mesh = e3d.primitives.quad((x0, y, z1), (x1, y, z1), (x1, y, z0), (x0, y, z0))
    mesh.materials = [e3d.Material(name=name)]
    return mesh


def triangles_of(meshes, solid=lambda material: True):
    """World corners (N, 3, 3), and the materials' names."""
    corners, names = [], []
    for mesh in meshes:
        kept = np.array([solid(material) for material in mesh.materials])[mesh.material_ids]
        corners.append(mesh.positions[mesh.faces[kept]].astype(np.float64))
        names += [mesh.materials[k].name for k in mesh.material_ids[kept]]
    return np.concatenate(corners), np.array(names)


def normals_of(corners):
    normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    return normal / np.sqrt((normal**2).sum(axis=1, keepdims=True))


def ground_below(corners, normals, x, z, max_slope):
    """Heights and numbers of the ground triangles that a vertical line meets, from below."""
    ground = normals[:, 1] >= math.cos(max_slope)
    a, b, c = (corners[:, k][:, [0, 2]] - (x, z) for k in range(3))
    sides = [p[:, 1] * q[:, 0] - p[:, 0] * q[:, 1] for p, q in ((a, b), (b, c), (c, a))]
    inside = (sides[0] >= 0) & (sides[1] >= 0) & (sides[2] >= 0)
    inside |= (sides[0] <= 0) & (sides[1] <= 0) & (sides[2] <= 0)
    hit = np.flatnonzero(ground & inside)
    n, p = normals[hit], corners[hit, 0]
    heights = p[:, 1] - (n[:, 0] * (x - p[:, 0]) + n[:, 2] * (z - p[:, 2])) / n[:, 1]
    order = np.argsort(heights, kind="stable")
    return heights[order], hit[order]


def expected_layers(corners, normals, x, z, max_slope, headroom):
    heights, hit = ground_below(corners, normals, x, z, max_slope)
    layers = []
    for k in range(len(heights)):
        above = heights[k + 1 :]
        above = above[above - heights[k] > 1e-3]
        if not len(above) or above[0] - heights[k] >= headroom:
            if not layers or heights[k] - layers[-1][0] > 1e-3:
                layers.append((heights[k], hit[k]))
    return layers


def test_a_floor():
    grid = e3d.navigation.NavigationGrid(floor(-2, -1, 2, 1), cell=0.5)
    assert grid.shape == (4, 8) and grid.origin.tolist() == [-2, -1]
    assert grid.walkable.all() and len(grid.heights) == 32
    assert grid.sample_ground(0.3, 0.2) == (0.0, True)
    for x, z in ((-2.1, 0), (2.0, 0), (0, 1.5), (math.nan, 0), (math.inf, 0)):
        height, walkable = grid.sample_ground(x, z)
        assert math.isnan(height) and not walkable
    heights, walkable = grid.sample_ground(np.array([[0.0, 9.0]]), 0.0)
    assert heights.shape == walkable.shape == (1, 2)
    assert walkable.tolist() == [[True, False]]


def test_materials_by_name_and_by_function():
    meshes = [floor(0, 0, 1, 1), floor(1, 0, 2, 1, name="water"), floor(2, 0, 3, 1, name="grass")]
    choices = ({"stone"}, ["stone"], lambda material: material.name == "stone")
    for choice in choices:
        grid = e3d.navigation.NavigationGrid(meshes, walkable=choice)
        heights, walkable = grid.sample_ground(np.array([0.5, 1.5, 2.5]), 0.5)
        assert heights.tolist() == [0, 0, 0] and walkable.tolist() == [True, False, False]
    everything = e3d.navigation.NavigationGrid(meshes)
    assert everything.walkable.all()


def test_steep_and_overturned_faces_are_no_ground():
    down = e3d.primitives.quad((0, 0, 0), (4, 0, 0), (4, 0, 4), (0, 0, 4))
    assert len(e3d.navigation.NavigationGrid(down).heights) == 0
    for angle, is_ground in ((39.0, True), (41.0, False)):
        rise = 4 * math.tan(math.radians(angle))
        ramp = e3d.primitives.quad((0, 0, 4), (4, 0, 4), (4, rise, 0), (0, rise, 0))
        grid = e3d.navigation.NavigationGrid(ramp, max_slope=math.radians(40))
        assert (len(grid.heights) > 0) == is_ground
        if is_ground:
            assert grid.walkable.all()
            assert grid.sample_ground(1.1, 1.3)[0] == pytest.approx(rise * 2.7 / 4, abs=1e-5)


def test_layers_over_a_cell():
    low, bridge = floor(0, 0, 6, 6), slab((2, 3, 0), (4, 3.4, 6))
    grid = e3d.navigation.NavigationGrid([low, bridge], radius=0.0)
    assert grid.sample_ground(3, 3) == (pytest.approx(3.4), True)
    assert grid.sample_ground(3, 3, y=0.0) == (0.0, True)
    assert grid.sample_ground(3, 3, y=3.2) == (pytest.approx(3.4), True)
    assert math.isnan(grid.sample_ground(3, 3, y=-1.0)[0])
    too_low = e3d.navigation.NavigationGrid([low, slab((2, 1.5, 0), (4, 1.6, 6))])
    assert not too_low.sample_ground(3, 3, y=0.0)[1]


def test_what_is_in_the_way():
    ground = floor(0, 0, 8, 8)
    for low, high, blocks in (
        ((4, 0, 4), (4.4, 0.3, 4.4), False),  # a step
        ((4, 0, 4), (4.4, 0.9, 4.4), True),
        ((4, 1.5, 4), (4.4, 2.5, 4.4), True),
        ((4, 2.0, 4), (4.4, 2.5, 4.4), False),  # over the head
    ):
        grid = e3d.navigation.NavigationGrid([ground, slab(low, high)], cell=0.5)
        assert grid.sample_ground(4.1, 4.1, y=0.0)[1] != blocks
        assert grid.sample_ground(4.6, 4.6, y=0.0)[1] != blocks  # nearer than the radius
        assert grid.sample_ground(5.1, 5.1, y=0.0)[1]


def test_materials_that_are_not_there():
    meshes = [floor(0, 0, 8, 8), slab((4, 0, 4), (5, 3, 5), name="leaves")]
    assert not e3d.navigation.NavigationGrid(meshes).sample_ground(4.5, 4.5, y=0.0)[1]
    grid = e3d.navigation.NavigationGrid(meshes, ignore={"leaves"})
    assert grid.sample_ground(4.5, 4.5) == (0.0, True)


def test_scenes_instances_and_poses():
    scene = e3d.Scene()
    group = scene.add(translation=(10, 1, 0))
    scene.add(floor(0, 0, 4, 4), parent=group)
    poses = np.array([(1.0, 0.0, 1.0, 0.5), (3.0, 0.0, 3.0, 0.5)])
    scene.add(e3d.InstancedMesh(slab((-0.5, 0, -0.5), (0.5, 4, 0.5), "post"), poses), parent=group)
    hidden = scene.add(slab((10, 0, 0), (14, 5, 4)))
    hidden.visible = False
    grid = e3d.navigation.NavigationGrid(scene, walkable={"stone"}, radius=0.1)
    assert grid.origin.tolist() == [10, 0]
    assert grid.sample_ground(12.1, 2.1) == (1.0, True)
    for x, z in ((11, 1), (13, 3)):
        assert not grid.sample_ground(x, z, y=1.0)[1]
    again = e3d.navigation.NavigationGrid(scene, walkable={"stone"}, radius=0.1)
    assert np.array_equal(grid.walkable, again.walkable)


def random_world(seed):
    rng = np.random.default_rng(seed)
    meshes = [floor(-8, -8, 8, 8, name="stone"), floor(-8, 2, 8, 4, y=0.05, name="water")]
    for _ in range(12):
        low = rng.uniform((-8, -0.5, -8), (7, 2.5, 7))
        size = rng.uniform((0.05, 0.05, 0.05), (4, 2, 4))
        meshes.append(slab(low, low + size, rng.choice(["stone", "wood"])))
    for _ in range(6):
        a = rng.uniform((-7, 0, -7), (7, 0.1, 7))
        side, up = rng.uniform(-1, 1, 3), rng.uniform(-1, 1, 3)
        ramp = e3d.primitives.quad(a, a + 3 * side, a + 3 * side + 3 * up, a + 3 * up)
        ramp.materials = [e3d.Material(name="stone")]
        meshes.append(ramp)
    return meshes


SLOPE, STEP, HEAD = math.radians(35), 0.35, 1.7


@pytest.mark.parametrize("seed", range(4))
def test_layers_against_rays(seed):
    meshes = random_world(seed)
    grid = e3d.navigation.NavigationGrid(
        meshes, cell=0.31, max_slope=SLOPE, step=STEP, headroom=HEAD
    )
    corners, _ = triangles_of(meshes)
    normals = normals_of(corners)
    rows, columns = grid.shape
    for k in np.random.default_rng(seed).choice(rows * columns, 400, replace=False).tolist():
        x = grid.origin[0] + (k % columns + 0.5) * grid.cell
        z = grid.origin[1] + (k // columns + 0.5) * grid.cell
        found = grid.heights[grid.starts[k] : grid.starts[k + 1]]
        expected = [y for y, _ in expected_layers(corners, normals, x, z, SLOPE, HEAD)]
        assert np.allclose(found, expected, atol=1e-4) if len(found) == len(expected) else False


def strewn(corners, count, rng):
    """Points all over triangles (N, 3, 3): the corners, edges and inside."""
    weights = rng.dirichlet((0.6, 0.6, 0.6), (len(corners), count))
    weights[:, :3] = np.eye(3)
    return np.einsum("nkc,ncx->nkx", weights, corners).reshape(-1, 3)


@pytest.mark.parametrize("seed", range(4))
@pytest.mark.parametrize("radius", [0.0, 0.2])
def test_no_walkable_cell_has_anything_in_it(seed, radius):
    meshes = random_world(seed + 10)
    grid = e3d.navigation.NavigationGrid(
        meshes,
        cell=0.5,
        walkable={"stone"},
        max_slope=SLOPE,
        step=STEP,
        headroom=HEAD,
        radius=radius,
    )
    corners, _ = triangles_of(meshes)
    points = strewn(corners, 800, np.random.default_rng(seed))
    rows, columns = grid.shape
    blocked = ~grid.walkable
    must_block = np.zeros(len(grid.walkable), bool)
    may_block = np.zeros(len(grid.walkable), bool)
    for k in range(rows * columns):
        x, z = grid.origin + (np.array((k % columns, k // columns)) + 0.5) * grid.cell
        reach = grid.cell / 2 + radius
        far = np.maximum(np.abs(points[:, 0] - x), np.abs(points[:, 2] - z))
        near = points[far <= reach]
        for layer in range(grid.starts[k], grid.starts[k + 1]):
            above = near[:, 1] - grid._height(
                layer, k // columns, k % columns, near[:, 0], near[:, 2]
            )
            must_block[layer] = ((above > STEP + 1e-6) & (above < HEAD - 1e-6)).any()
    assert not (must_block & ~blocked).any()
    # And where nothing at all is near, nothing is blocked but water and wood.
    corner_low, corner_high = corners.min(axis=1), corners.max(axis=1)
    names = triangles_of(meshes)[1]
    normals = normals_of(corners)
    for k in range(0, rows * columns, 3):
        x, z = grid.origin + (np.array((k % columns, k // columns)) + 0.5) * grid.cell
        reach = grid.cell / 2 + radius + 1e-9
        layers = expected_layers(corners, normals, x, z, SLOPE, HEAD)
        for layer, (y, face) in zip(range(grid.starts[k], grid.starts[k + 1]), layers, strict=True):
            touches = (corner_low[:, 0] <= x + reach) & (corner_high[:, 0] >= x - reach)
            touches &= (corner_low[:, 2] <= z + reach) & (corner_high[:, 2] >= z - reach)
            touches &= (corner_high[:, 1] > y + STEP - 1) & (corner_low[:, 1] < y + HEAD + 1)
            touches[face] = False
            may_block[layer] = touches.any() or names[face] != "stone"
    chosen = np.concatenate(
        [np.arange(grid.starts[k], grid.starts[k + 1]) for k in range(0, rows * columns, 3)]
    )
    flat = np.isin(chosen, np.flatnonzero(blocked & ~may_block))
    assert not flat.any()


def test_the_city_is_walkable_in_its_streets_not_in_its_houses():
    world = e3d.worlds.city(100_000)
    grid = e3d.navigation.NavigationGrid(
        world.districts, walkable=world.walkable, ignore=world.foliage
    )
    assert grid.sample_ground(1.0, 30.0) == (pytest.approx(0.0), True)
    assert grid.sample_ground(7.5, 30.3) == (pytest.approx(0.15), True)
    assert not grid.sample_ground(8.5, 30.3, y=0.1)[1]  # a wall
    assert grid.sample_ground(108.0, -40.0) == (pytest.approx(-5.2), False)  # water
    assert grid.sample_ground(108.0, 1.0) == (pytest.approx(0.0), True)  # a bridge over it
    assert grid.sample_ground(82.0, 1.0, y=-4.3)[1]  # the quay under the bridge
    assert not grid.sample_ground(-90.0, -20.0)[1]  # grass


@pytest.mark.parametrize(
    ("options", "words"),
    [
        ({"cell": 0}, "cell"),
        ({"cell": math.nan}, "cell"),
        ({"cell": 1e-6}, "too many"),
        ({"step": 2.0}, "step"),
        ({"headroom": math.inf}, "headroom"),
        ({"radius": -1}, "radius"),
        ({"max_slope": 2.0}, "max_slope"),
        ({"bounds": ((0, 0), (0, 1))}, "bounds"),
        ({"bounds": (1, 2)}, "bounds"),
    ],
)
def test_bad_parameters(options, words):
    with pytest.raises(InvalidArgumentError, match=words):
        e3d.navigation.NavigationGrid(floor(0, 0, 4, 4), **options)


def test_bad_things():
    for thing in (None, 3, [floor(0, 0, 1, 1), "wall"]):
        with pytest.raises(InvalidArgumentError, match="meshes"):
            e3d.navigation.NavigationGrid(thing)
    with pytest.raises(InvalidArgumentError, match="no faces"):
        e3d.navigation.NavigationGrid(e3d.Scene())


def test_vertices_that_are_not_finite_count_for_nothing():
    mesh = floor(0, 0, 4, 4)
    broken = floor(0, 0, 4, 4, y=1.0)
    positions = broken.positions.copy()
    positions[0], positions[2] = math.nan, math.inf
    broken.positions = positions
    grid = e3d.navigation.NavigationGrid([mesh, broken], bounds=((0, 0), (4, 4)))
    assert grid.walkable.all() and set(grid.heights.tolist()) == {0.0}


@pytest.mark.parametrize("seed", range(6))
def test_very_many_heights_over_one_cell(seed):
    """Layers are those of a sorted list: of what is nearer than a head the upper stays."""
    rng = np.random.default_rng(seed)
    count = (3, 17, 40, 1000, 5000, 20_000)[seed]
    heights = rng.uniform(0, 40 * count**0.5, count).astype(np.float32)
    heights[rng.random(count) < 0.3] = rng.choice(heights, 5)[rng.integers(0, 5)]
    corners = np.array([(-9, 0, -9), (-9, 0, 9), (9, 0, 0)], np.float32)
    positions = np.tile(corners, (count, 1, 1))
    positions[:, :, 1] = heights[:, np.newaxis]
    mesh = e3d.Mesh(positions.reshape(-1, 3), np.arange(3 * count).reshape(-1, 3))
    grid = e3d.navigation.NavigationGrid(
        mesh, bounds=((-0.5, -0.5), (0.5, 0.5)), cell=1.0, radius=0.0
    )
    expected, levels = [], np.unique(heights)
    for k, height in enumerate(levels):
        above = levels[k + 1 :][levels[k + 1 :] - height > 1e-4][:1]
        if len(above) == 0 or above[0] - height >= np.float32(grid.headroom):
            if not expected or height - expected[-1] > 1e-4:
                expected.append(height)
    np.testing.assert_allclose(grid.heights, expected, rtol=1e-5)


@pytest.mark.parametrize("seed", range(20))
def test_hostile_triangles_do_no_harm(seed):
    rng = np.random.default_rng(seed)
    positions = rng.uniform(-6, 6, (40, 3)).astype(np.float32)
    odd = rng.random((40, 3)) < 0.1
    positions[odd] = rng.choice([math.nan, math.inf, -math.inf, 1e30, -3e38, 1e-40], odd.sum())
    mesh = e3d.Mesh(positions, rng.integers(0, 40, (60, 3)))
    bounds, cell = ((-4, -4), (5, 6)), rng.uniform(0.05, 1.0)
    options = {"bounds": bounds, "cell": cell, "max_slope": 1.5}
    grid = e3d.navigation.NavigationGrid(mesh, radius=rng.uniform(0, 1), **options)
    assert grid.starts[0] == 0 and grid.starts[-1] == len(grid.heights)
    assert (np.diff(grid.starts) >= 0).all() and np.isfinite(grid.heights).all()
    for k in np.flatnonzero(np.diff(grid.starts) > 1):
        heights = grid.heights[grid.starts[k] : grid.starts[k + 1]].astype(np.float64)
        assert (np.diff(heights) > grid.headroom - 1e-3).all()
    free = e3d.navigation.NavigationGrid(mesh, radius=0.0, **options)
    assert not (grid.walkable & ~free.walkable).any()


@pytest.mark.parametrize("place", [("a", 0), ([1, 2], [1, 2, 3]), (None, [[1], [2, 3]])])
def test_places_that_are_no_numbers(place):
    with pytest.raises(InvalidArgumentError, match="must be numbers|equally many|broadcast"):
        e3d.navigation.NavigationGrid(floor(-5, -5, 5, 5)).sample_ground(*place)
