"""What changed is found without looking at everything, and nothing that changed is missed."""

import gc
import os
import subprocess
import sys
import weakref

import numpy as np
import pytest
from patience import HUNG

import engine3d as e3d
from engine3d.base.dirty_tracking import Watch

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

    gc.collect()
    gc.disable()  # what an earlier scene leaves behind is not counted
    sys.setprofile(profile)
    try:
        function(*arguments)
    finally:
        sys.setprofile(None)
        gc.enable()
    return count


def test_python_does_not_look_at_every_mesh():
    """Neither in a frame without changes, nor where one comes, goes or changes."""
    counts = []
    for size in (20, 20, 400):  # what is imported at its first use does not count
        scene, meshes = spheres(size)
        with e3d.Renderer((64, 48), look="plain", threads=1) as renderer:
            for _ in range(3):
                renderer.render(scene, VIEW)
            row = [calls_of(renderer.render, scene, VIEW)]
            meshes[0].materials[0].color = (1, 0, 0)
            row.append(calls_of(renderer.render, scene, VIEW))
            shade_flat(scene, meshes[1])
            row.append(calls_of(renderer.render, scene, VIEW))
            give_a_texture(scene, meshes[2])
            row.append(calls_of(renderer.render, scene, VIEW))
            meshes[2].materials[0].texture.pixels = np.zeros((2, 2, 3), np.uint8)
            row.append(calls_of(renderer.render, scene, VIEW))
            row.append(calls_of(scene.data.update))
            meshes[0].positions = meshes[0].positions * 2
            row.append(calls_of(scene.data.update))
            row.append(calls_of(renderer.render, scene, VIEW))
            node = scene.add(e3d.uv_sphere(0.7, (8, 5)))
            row.append(calls_of(renderer.render, scene, VIEW))
            scene.remove(node)
            row.append(calls_of(renderer.render, scene, VIEW))
        counts.append(row)
    assert counts[1] == counts[2]


def change_color(scene, mesh):
    mesh.materials[0].color = e3d.linear(0.9, 0.1, 0.2)


def change_emissive_twice(scene, mesh):
    mesh.materials[0].emissive = e3d.linear(0.2, 0.5, 0.2)
    mesh.materials[0].emissive = e3d.linear(0.5, 0.1, 0.2)


def give_a_texture(scene, mesh):
    mesh.materials[0].texture = e3d.Texture(np.full((2, 2, 3), (20, 200, 90), np.uint8))


def change_the_texture(scene, mesh):
    give_a_texture(scene, mesh)
    e3d.render(scene, VIEW, size=(64, 48))
    mesh.materials[0].texture.pixels = np.full((2, 2, 3), (200, 20, 90), np.uint8)


def shade_flat(scene, mesh):
    mesh.materials[0].flat_shading = True


def put_another_in_the_list(scene, mesh):
    mesh.materials[0] = e3d.Material(color=e3d.linear(0.1, 0.9, 0.3))


def share_a_material(scene, mesh):
    mesh.materials = [scene.nodes[5].object.materials[0]]
    mesh.materials[0].color = e3d.linear(0.3, 0.2, 0.8)


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
    with e3d.Renderer((64, 48), threads=1) as renderer, e3d.Renderer((64, 48)) as fresh:
        before = renderer.render(scene, VIEW).color.copy()
        change(scene, meshes[3])
        after = renderer.render(scene, VIEW)
        assert (after.color != before).any()
        assert (after.color == fresh.render(scene, VIEW).color).all()


class Guests:
    """A scene in which meshes and sets of instances come, go and change at random."""

    def __init__(self, seed):
        self.random = np.random.default_rng(seed)
        self.scene, meshes = spheres(30)
        self.materials = [mesh.materials[0] for mesh in meshes]
        self.texture = e3d.Texture(np.zeros((2, 2, 3), np.uint8))
        self.nodes = list(self.scene.nodes)

    def do(self):
        comes_and_goes = [self.come, self.come, self.go, self.go]
        self.random.choice([*comes_and_goes, self.change, self.gather, self.shade, self.paint])()

    def come(self):
        obj = e3d.uv_sphere(0.5, (6, 4))
        if self.random.random() < 0.5:
            obj.materials = [self.random.choice(self.materials)]
        if self.random.random() < 0.3:
            obj = e3d.InstancedMesh(obj, self.random.uniform(-3, 3, (4, 4)))
        if self.random.random() < 0.3:
            obj = self.random.choice(self.nodes).object
        self.nodes.append(self.scene.add(obj, translation=self.random.uniform(-3, 3, 3)))

    def go(self):
        self.scene.remove(self.nodes.pop(self.random.integers(len(self.nodes))))

    def change(self):
        obj = self.random.choice(self.nodes).object
        if isinstance(obj, e3d.InstancedMesh):
            obj.poses = self.random.uniform(-3, 3, (3, 4))
        else:
            obj.positions = obj.positions * 1.1

    def shade(self):
        material = self.random.choice(self.materials)
        material.flat_shading = not material.flat_shading

    def paint(self):
        """A texture comes, changes under the materials that share it, or goes from one."""
        material, pixels = (
            self.random.choice(self.materials),
            self.random.integers(0, 256, (2, 2, 3)),
        )
        if material.texture is None:
            material.texture = self.texture
        elif self.random.random() < 0.5:
            material.texture = None
        self.texture.pixels = pixels.astype(np.uint8)

    def gather(self):
        """A mesh that is drawn by itself is drawn as instances, too."""
        obj = self.random.choice(self.nodes).object
        if isinstance(obj, e3d.Mesh):
            crowd = e3d.InstancedMesh(obj, self.random.uniform(-3, 3, (2, 4)))
            self.nodes.append(self.scene.add(crowd))


@pytest.mark.parametrize("seed", range(4))
def test_whatever_comes_and_goes(seed, monkeypatch):
    """By a renderer that looks at each frame, one that looks now and then, and a new one."""
    monkeypatch.setattr(
        "engine3d.rendering.draw_list.instance_trees.MANY", 3
    )  # instances that get a tree
    guests, outputs = Guests(seed), ("color", "object_id", "instance_id")
    camera, shows = VIEW[0], set()
    with e3d.Renderer((64, 48), threads=1) as always, e3d.Renderer((64, 48), threads=1) as seldom:
        for step in range(120):
            if step % 6 < 2:  # between them, instances settle
                guests.do()
            view = camera, e3d.look_at((0.2 * (step % 5), 0, 6), (0.3 * (step % 4), 0, 0))
            looking = (always, seldom) if step % 13 == 0 else (always,)
            fresh = e3d.render(guests.scene, view, size=(64, 48), threads=1, outputs=outputs)
            shows.update(fresh.object_id.ravel().tolist())
            for renderer in looking:
                frame = renderer.render(guests.scene, view, outputs=outputs)
                for name in outputs:
                    assert np.array_equal(getattr(frame, name), getattr(fresh, name)), name
    assert len(shows) > 30


def test_what_went_is_let_go():
    scene, meshes = spheres(40)
    nodes = list(scene.nodes)
    with e3d.Renderer((64, 48), threads=1) as renderer:
        renderer.render(scene, VIEW)
        gone = weakref.ref(meshes.pop(7))
        scene.remove(nodes.pop(7))
        renderer.render(scene, VIEW)
        gc.collect()
        assert gone() is None
        materials = [weakref.ref(mesh.materials[0]) for mesh in meshes]
        while len(meshes) > 20:
            meshes.pop()
            scene.remove(nodes.pop())
            renderer.render(scene, VIEW)
        gc.collect()
        held = sum(material() is not None for material in materials)
        assert held <= 20 + 40 // 4


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


FORK = """
import os
import engine3d as e3d
from engine3d.base.dirty_tracking import Watch
things = [e3d.Material() for _ in range(3)]
watch = Watch(things)
things[2].name = "before"
child = os.fork()
if not child:
    things[0].name = "after"
    os._exit(0 if set(watch.changed()) == {things[0], things[2]} else 1)
assert os.waitpid(child, 0)[1] == 0
assert watch.changed() == [things[2]]
"""


@pytest.mark.skipif(not hasattr(os, "fork"), reason="this system cannot fork")
def test_a_forked_process_misses_nothing():
    """The one that forks is a process of its own: this one may have threads by now."""
    environment = {**os.environ, "OPENBLAS_NUM_THREADS": "1"}
    done = subprocess.run([sys.executable, "-c", FORK], env=environment, timeout=HUNG)
    assert done.returncode == 0
