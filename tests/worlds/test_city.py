"""The city: the same bytes everywhere, as many triangles as asked for, sound geometry."""

import hashlib
import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from patience import HUNG
from plain_picture import render

import engine3d as e3d
from engine3d.errors import InvalidArgumentError

ARRAYS = ("positions", "normals", "uvs", "faces", "material_ids", "edge_visible")
#: SHA-256 of all arrays, by (triangles, seed). They change where the city is changed on purpose.
DIGESTS = {
    (20_000, 0): "186a566dba8ccffca89ed986aff1b19b2b24302c9417e12016e1dc1ab0f8624d",
    (100_000, 0): "5a2a3898a00184b9a0834921b5269131e8512e770b13c021701645b35af87109",
    (150_000, 3): "196963609dd9813f24b4a960f0c2f4d8693623ab6ff48bdce4d28ad1fa251cbf",
    (1_000_000, 1): "5ab378a38b1132ee6f637253ebe293332514e09a1c2a7750a5e46b3e40b7cc08",
}


def digest(world):
    sums = hashlib.sha256()
    for mesh in world.districts:
        for name in ARRAYS:
            sums.update(getattr(mesh, name).tobytes())
    for material in world.materials:
        if material.texture is not None:
            sums.update(material.texture.pixels.tobytes())
    sums.update(world.lamps.tobytes())
    return sums.hexdigest()


@pytest.fixture(scope="module")
def town():
    return e3d.worlds.city(150_000, seed=3)


@pytest.mark.parametrize(("triangles", "seed"), DIGESTS)
def test_bytes(triangles, seed):
    assert digest(e3d.worlds.city(triangles, seed)) == DIGESTS[triangles, seed]


def test_bytes_do_not_depend_on_instruction_sets():
    program = (
        "import sys; sys.path.insert(0, sys.argv[1]); import engine3d as e3d; from worlds import"
        " test_city as t; "
        "print(t.digest(e3d.worlds.city(100_000)))"
    )
    old = {
        "NPY_DISABLE_CPU_FEATURES": "AVX2 FMA3 AVX512F AVX512CD AVX512_SKX X86_V3 X86_V4",
        "GLIBC_TUNABLES": "glibc.cpu.hwcaps=-FMA,-AVX2,-AVX512F",
        "OPENBLAS_CORETYPE": "Nehalem",
    }
    done = subprocess.run(
        [sys.executable, "-W", "ignore", "-c", program, str(Path(__file__).parents[1])],
        env={**os.environ, **old},
        capture_output=True,
        text=True,
        timeout=HUNG,
    )
    if done.returncode != 0 and "NPY_DISABLE_CPU_FEATURES" in done.stderr:
        pytest.skip("this NumPy can't do without those instructions")
    assert done.stdout.strip() == DIGESTS[100_000, 0], done.stderr


@pytest.mark.parametrize("triangles", [20_000, 50_000, 100_000, 333_333, 1_000_000])
@pytest.mark.parametrize("seed", [0, 7])
def test_as_many_triangles_as_asked_for(triangles, seed):
    found = e3d.worlds.city(triangles, seed).triangles
    assert 0.99 * triangles <= found <= triangles


@pytest.mark.slow
def test_ten_million_triangles():
    world = e3d.worlds.city(10_000_000)
    assert 9_999_000 <= world.triangles <= 10_000_000
    assert len(world.districts) > 50


def whole_tiles(world, reach):
    """The quads of streets and pavements with all corners nearer to the origin than ``reach``."""
    found = set()
    names = [material.name for material in world.materials]
    flat = [names.index(name) for name in ("asphalt", "stone", "marking")]
    for mesh in world.districts:
        corners = mesh.positions[mesh.faces]
        near = (np.abs(corners) < reach).all(axis=(1, 2)) & np.isin(mesh.material_ids, flat)
        found |= {corner.tobytes() for corner in corners[near]}
    return found


def test_a_larger_city_has_the_same_middle():
    small, large = (whole_tiles(e3d.worlds.city(n, seed=5), 70.0) for n in (120_000, 600_000))
    assert len(small) > 100
    assert small == large


def test_seeds_differ():
    assert digest(e3d.worlds.city(50_000, 1)) != digest(e3d.worlds.city(50_000, 2))


def test_triangles_have_areas_and_normals_of_their_side(town):
    for mesh in town.districts:
        a, b, c = mesh.positions[mesh.faces].astype(np.float64).transpose(1, 0, 2)
        cross = np.cross(b - a, c - a)
        double_area = np.sqrt((cross**2).sum(axis=1))
        assert np.isfinite(mesh.positions).all() and (double_area > 1e-6).all()
        lengths = np.sqrt((mesh.normals.astype(np.float64) ** 2).sum(axis=1))
        assert np.allclose(lengths, 1.0, atol=1e-6)
        towards = (cross * mesh.normals[mesh.faces].sum(axis=1)).sum(axis=1)
        assert (towards > 0).all()


def test_streets_river_and_houses_are_where_they_should_be(town):
    low = np.min([mesh.bounds[0] for mesh in town.districts], axis=0)
    high = np.max([mesh.bounds[1] for mesh in town.districts], axis=0)
    assert low[1] < -5 and high[1] > 20
    assert {"stone", "asphalt"} <= town.walkable and not {"water", "grass"} & town.walkable
    names = {material.name for material in town.materials}
    assert town.walkable < names
    assert {"water", "grass"} <= names
    used = {town.materials[k].name for mesh in town.districts for k in set(mesh.material_ids)}
    assert {"water", "grass", "stone", "asphalt", "window", "roof tiles", "leaves"} <= used


def test_lamps_shine_above_pavements(town):
    assert len(town.lamps) > 50
    assert (town.lamps[:, 1] > 4).all() and (town.lamps[:, 1] < 6).all()
    glass = [material.name for material in town.materials].index("lamp glass")
    tops = np.concatenate(
        [
            mesh.positions[mesh.faces[mesh.material_ids == glass]].reshape(-1, 3)
            for mesh in town.districts
        ]
    )
    for lamp in town.lamps[::7]:
        assert (np.abs(tops - lamp).max(axis=1) < 0.5).any()


def test_added_to_a_scene_it_is_a_node_a_district(town):
    scene = e3d.Scene()
    group = scene.add(town)
    assert group.name == "city"
    assert [node.object for node in group.children] == list(town.districts)
    frame = render(scene, size=(64, 48), outputs=("color", "object_id"))
    assert len(np.unique(frame.object_id)) > 3


def test_written_as_obj_it_reads_back_the_same(tmp_path):
    mesh = e3d.worlds.city(20_000).mesh()
    mesh.save(tmp_path / "city.obj")
    again = e3d.load_mesh(tmp_path / "city.obj")
    for name in ARRAYS:
        assert np.array_equal(getattr(mesh, name), getattr(again, name)), name
    assert [m.name for m in again.materials] == [m.name for m in mesh.materials]
    for old, new in zip(mesh.materials, again.materials, strict=True):
        assert (old.texture is None) == (new.texture is None)
        if old.texture is not None:
            assert np.array_equal(old.texture.pixels, new.texture.pixels)


@pytest.mark.parametrize("arguments", [(0,), (19_999,), (50_000_001,), (1.5e5,), ("many",)])
def test_bad_sizes(arguments):
    with pytest.raises(InvalidArgumentError, match="triangles"):
        e3d.worlds.city(*arguments)


def test_bad_seed():
    with pytest.raises(InvalidArgumentError, match="seed"):
        e3d.worlds.city(100_000, seed=0.5)
