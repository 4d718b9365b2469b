"""What changed is found without looking at everything, and nothing that changed is missed."""

import os
import sys

import numpy as np
import pytest

import engine3d as e3d
from engine3d.changes import Watch

VIEW = e3d.PerspectiveCamera(yfov=0.9), e3d.look_at((0, 0, 9), (0, 0, 0))


def spheres(count):
    """A scene of that many meshes, each with a material of its own."""
    scene = e3d.Scene()
    meshes = [e3d.uv_sphere(0.7, (8, 5)) for _ in range(count)]  # each has a material of its own
    places = np.random.default_rng(1).uniform(-3, 3, (count, 3))
    for mesh, place in zip(meshes, places, strict=True):
        scene.add(mesh, translation=place, scale=0.6)
    return scene, meshes


def calls_of(function, *arguments):
    """How many calls of Python functions, and of C from Python, a call makes."""
    count = 0

    def profile(frame, event, argument):
        nonlocal count
        count += event in ("call", "c_call")

    sys.setprofile(profile)
    try:
        function(*arguments)
    finally:
        sys.setprofile(None)
    return count


def test_python_does_not_look_at_every_mesh():
    """Neither in a frame without changes, nor where one material or one mesh's arrays change."""
    counts = []
    for size in (20, 20, 400):  # what is imported at its first use does not count
        scene, meshes = spheres(size)
        with e3d.Renderer(64, 48, threads=1) as renderer:
            for _ in range(3):
                renderer.render(scene, VIEW)
            row = [calls_of(renderer.render, scene, VIEW)]
            meshes[0].materials[0].color = (1, 0, 0)
            row.append(calls_of(renderer.render, scene, VIEW))
            row.append(calls_of(scene._update))
            meshes[0].positions = meshes[0].positions * 2
            row.append(calls_of(scene._update))
        counts.append(row)
    assert counts[1] == counts[2]


def change_color(scene, mesh):
    mesh.materials[0].color = (0.9, 0.1, 0.2)


def change_emissive_twice(scene, mesh):
    mesh.materials[0].emissive = (0.2, 0.5, 0.2)
    mesh.materials[0].emissive = (0.5, 0.1, 0.2)


def give_a_texture(scene, mesh):
    mesh.materials[0].texture = e3d.Texture(np.full((2, 2, 3), (20, 200, 90), np.uint8))


def change_the_texture(scene, mesh):
    give_a_texture(scene, mesh)
    e3d.render(scene, VIEW, size=(64, 48))
    mesh.materials[0].texture.pixels = np.full((2, 2, 3), (200, 20, 90), np.uint8)


def shade_flat(scene, mesh):
    mesh.materials[0].flat_shading = True


def put_another_in_the_list(scene, mesh):
    mesh.materials[0] = e3d.Material(color=(0.1, 0.9, 0.3))


def share_a_material(scene, mesh):
    mesh.materials = [scene.nodes[5].object.materials[0]]
    mesh.materials[0].color = (0.3, 0.2, 0.8)


def move_vertices(scene, mesh):
    mesh.positions = mesh.positions * 1.5


def change_much_at_once(scene, mesh):
    """More than is remembered, the oldest first."""
    change_color(scene, mesh)
    other = e3d.Material()
    for k in range(5000):
        other.shininess = k


CHANGES = [change_color, change_emissive_twice, give_a_texture, change_the_texture, shade_flat]
CHANGES += [put_another_in_the_list, share_a_material, move_vertices, change_much_at_once]


@pytest.mark.parametrize("change", CHANGES)
def test_a_change_shows(change):
    """As in a scene that is drawn for the first time, by a renderer that saw it before."""
    scene, meshes = spheres(12)
    with e3d.Renderer(64, 48, threads=1) as renderer, e3d.Renderer(64, 48) as fresh:
        before = renderer.render(scene, VIEW).color.copy()
        change(scene, meshes[3])
        after = renderer.render(scene, VIEW)
        assert (after.color != before).any()
        assert (after.color == fresh.render(scene, VIEW).color).all()


def test_instances_of_another_mesh_have_another_box():
    scene = e3d.Scene()
    crowd = e3d.InstancedMesh(e3d.box(), [(0, 0, 0, 1), (4, 0, 0, 1)])
    scene.add(crowd)
    assert scene.bounds.tolist() == [[-0.5, -0.5, -0.5], [4.5, 0.5, 0.5]]
    other = e3d.box((2, 2, 2))
    crowd.mesh = other
    assert scene.bounds.tolist() == [[-1, -1, -1], [5, 1, 1]]
    other.positions = other.positions * 2
    assert scene.bounds.tolist() == [[-2, -2, -2], [6, 2, 2]]
    crowd.poses = [(0, 0, 0, 1), (5, 0, 0, 1)]
    assert scene.bounds.tolist() == [[-2, -2, -2], [7, 2, 2]]


def test_a_watch_tells_once():
    things = [e3d.Material() for _ in range(4)]
    watch, other = Watch(things), Watch(things[:2])
    things[1].name = "a"
    things[1].name = "b"
    things[3].name = "c"
    assert set(watch.changed()) == {things[1], things[3]}
    assert watch.changed() == []
    assert other.changed() == [things[1]]
    later = e3d.Material()
    watch.add(later)
    assert watch.changed() == []
    later.name = "d"
    assert watch.changed() == [later]


def test_a_forked_process_misses_nothing():
    things = [e3d.Material() for _ in range(3)]
    watch = Watch(things)
    things[2].name = "before"
    child = os.fork()
    if not child:
        things[0].name = "after"
        os._exit(0 if set(watch.changed()) == {things[0], things[2]} else 1)
    assert os.waitpid(child, 0)[1] == 0
    assert watch.changed() == [things[2]]
