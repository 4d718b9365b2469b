"""Threads that ask a scene for the first time, all at once: each gets what one alone would get."""

import sys
import threading

import numpy as np
import pytest
from plain_picture import Renderer, render

import engine3d as e3d
from engine3d.model.geometry import normals

THREADS = 8
SIZE = (64, 48)
RNG = np.random.default_rng(3)
POSES = np.concatenate([RNG.uniform(-1.4, 1.4, (40, 3)), np.full((40, 1), 0.2)], axis=1)
PIXELS = RNG.integers(0, 256, (32, 32, 3), np.uint8)
ACROSS, UP = np.meshgrid(np.linspace(-1.5, 1.5, 9), np.linspace(-1, 1, 9))
ORIGINS = np.stack([ACROSS.ravel(), UP.ravel(), np.full(ACROSS.size, 5.0)], axis=1)
DOWN = (0, 0, -1)


@pytest.fixture(autouse=True)
def switch_often():
    interval = sys.getswitchinterval()
    sys.setswitchinterval(1e-6)
    yield
    sys.setswitchinterval(interval)


def fresh_scene():
    """Everything is new: no normals, edges, clusters, mip levels, boxes or trees."""
    scene = e3d.Scene()
    mesh = e3d.Mesh(e3d.torus(0.3, 0.12, (24, 16)).positions, e3d.torus(0.3, 0.12, (24, 16)).faces)
    for k in range(6):
        node = scene.add(mesh, name=f"ring {k}", translation=(k % 3 - 1, k // 3 - 0.5, 0))
        node.collider = e3d.colliders.MeshCollider()
    ball = e3d.uv_sphere(0.4, (16, 8))
    ball.materials = [e3d.Material(texture=e3d.Texture(PIXELS), flat_shading=True)]
    scene.add(ball, name="ball", parent=node, translation=(0, 0, 0.5))
    scene.add(e3d.InstancedMesh(e3d.box((0.5, 0.5, 0.5)), POSES), name="crowd")
    return scene


def same(one, other):
    if isinstance(one, tuple | list):
        return len(one) == len(other) and all(map(same, one, other))
    return bool(np.array_equal(one, other, equal_nan=np.asarray(one).dtype.kind == "f"))


def draw(scene, **options):
    frame = render(scene, size=SIZE, threads=1, outputs=("color", "object_id"), **options)
    return frame.color, frame.object_id


def camera_of(scene):
    camera, pose = e3d.frame_scene(scene)
    return camera.projection(SIZE), pose


QUESTIONS = {
    "render": draw,
    "wireframe": lambda scene: draw(scene, wireframe="overlay", mode="normal"),
    "bounds": lambda scene: scene.bounds,
    "bounds of nodes": lambda scene: [node.bounds for node in scene.nodes],
    "raycast_many": lambda scene: tuple(scene.raycast_many(ORIGINS, DOWN)),
    "frame_scene": camera_of,
    "find": lambda scene: [scene.find(f"ring {k}").id for k in range(6)],
    "selection": lambda scene: (scene.select().world_poses, scene.select().bounds),
    "overlap_box": lambda scene: [node.id for node in scene.overlap_box((-1, -1, -1), (0, 1, 1))],
    "raycast_colliders": lambda scene: scene.raycast_colliders((-1.3, -0.5, 5), DOWN).distance,
    "instances": lambda scene: scene.find("crowd").object.bounds_in_node(),
    "normals": lambda scene: [node.object.mesh.normals for node in (scene.find("crowd"),)],
    "edges": lambda scene: scene.find("ball").object.edges(),
}


def ask_at_once(questions):
    """The answers of threads that all begin at the same time, or what they raised."""
    answers, barrier = [None] * len(questions), threading.Barrier(len(questions))

    def work(number, question):
        barrier.wait()
        try:
            answers[number] = question()
        except Exception as error:
            answers[number] = error

    threads = [threading.Thread(target=work, args=pair) for pair in enumerate(questions)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    return answers


@pytest.mark.parametrize("name", QUESTIONS)
def test_threads_that_ask_at_once_get_what_one_gets(name):
    expected = QUESTIONS[name](fresh_scene())
    for _ in range(12):
        scene = fresh_scene()
        for answer in ask_at_once([lambda scene=scene: QUESTIONS[name](scene)] * THREADS):
            assert not isinstance(answer, Exception), repr(answer)
            assert same(answer, expected)


def test_threads_that_ask_different_things_at_once():
    expected = {name: question(fresh_scene()) for name, question in QUESTIONS.items()}
    for _ in range(12):
        scene = fresh_scene()
        questions = [lambda ask=ask, scene=scene: ask(scene) for ask in QUESTIONS.values()]
        for name, answer in zip(QUESTIONS, ask_at_once(questions), strict=True):
            assert not isinstance(answer, Exception), (name, repr(answer))
            assert same(answer, expected[name]), name


def test_kept_renderers_after_a_change():
    """Several renderers, a thread each, of a scene that changes between their frames."""
    renderers = [Renderer(SIZE, threads=1) for _ in range(THREADS)]
    scene = fresh_scene()
    for step in range(20):
        crowd, mesh = scene.find("crowd").object, scene.nodes[0].object
        crowd.poses = POSES * (1 + 0.02 * step)
        mesh.positions = mesh.positions * np.float32(1.01)
        scene.find("ball").object.materials[0].color = (1, 0.05 * step, 0)
        answers = ask_at_once([lambda r=r: r.render(scene).color.copy() for r in renderers])
        expected = render(scene, size=SIZE, threads=1).color
        for answer in answers:
            assert not isinstance(answer, Exception), repr(answer)
            assert np.array_equal(answer, expected), step


def test_resources_are_shared_by_threads_that_load_at_once(tmp_path):
    path = tmp_path / "ball.obj"
    e3d.uv_sphere(0.5, (8, 4)).save(path)
    for _ in range(15):
        resources = e3d.resources.Resources()
        meshes = ask_at_once([lambda r=resources: r.load_mesh(path)] * THREADS)
        assert all(mesh is meshes[0] for mesh in meshes), meshes
        assert resources.stats.meshes == 1


def test_what_follows_from_arrays_is_never_of_others(monkeypatch):
    """Positions are assigned while normals are computed of the ones before."""
    faces = np.arange(300, dtype=np.int32).reshape(-1, 3)
    first, second = (RNG.uniform(-1, 1, (300, 3)).astype(np.float32) for _ in range(2))
    expected = e3d.Mesh(second, faces).normals
    mesh = e3d.Mesh(first, faces)
    sums = normals.smooth_sums

    def sums_and_a_change(*arguments):
        monkeypatch.setattr(normals, "smooth_sums", sums)
        thread = threading.Thread(target=lambda: setattr(mesh, "positions", second))
        thread.start()
        thread.join()
        return sums(*arguments)

    monkeypatch.setattr(normals, "smooth_sums", sums_and_a_change)
    draw_alone(mesh)
    assert np.array_equal(mesh.normals, expected)
    assert same(draw_alone(mesh), draw_alone(e3d.Mesh(second, faces)))


def test_arrays_that_grow_and_shrink_while_others_draw():
    """A thread changes a mesh while others draw it and cast rays: part of it may show; no crash."""
    small, large = e3d.uv_sphere(0.4, (6, 4)), e3d.uv_sphere(0.4, (40, 20))
    mesh = e3d.Mesh(small.positions, small.faces)
    scene = e3d.Scene()
    scene.add(mesh)
    done = threading.Event()

    def look():
        while not done.is_set():
            render(scene, size=(16, 16), threads=1)
            scene.raycast_many(ORIGINS, DOWN)

    def change():
        for step in range(200):
            mesh.faces = ()
            mesh.positions = (large if step % 2 else small).positions
            mesh.faces = (large if step % 2 else small).faces
        done.set()

    answers = ask_at_once([change, look, look])
    assert not any(isinstance(answer, Exception) for answer in answers), answers
    assert np.array_equal(draw(scene)[0], draw_alone(e3d.Mesh(large.positions, large.faces))[0])


def draw_alone(mesh):
    scene = e3d.Scene()
    scene.add(mesh)
    return draw(scene)
