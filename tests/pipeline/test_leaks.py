"""Long lives: what is made, drawn and dropped thousands of times leaves nothing behind."""

import ctypes
import gc
import os
import sys
import threading
import weakref

import numpy as np
import pytest
from plain_picture import Renderer, render

import engine3d as e3d
from engine3d.rendering.draw_list import native_handles as native_handles

resource = pytest.importorskip("resource", reason="reads /proc")
pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="reads /proc")

LIBC = ctypes.CDLL(None)
ROUNDS = 2_000
ATTEMPTS = 8
# No round may leave 200 bytes.
ALLOWED_BYTES_A_ROUND = 200
# What the allocators of many threads keep goes up and down by more.
ALLOWED_BYTES = 2_000_000
POSITIONS = np.array([[-1, -1, 0], [1, -1, 0], [0, 1, 0], [0, 0, 1]], np.float32)
FACES = np.array([[0, 1, 2], [0, 1, 3], [1, 2, 3], [2, 0, 3]], np.int32)
UVS = np.array([[0, 0], [1, 0], [0, 1], [1, 1]], np.float32)
PIXELS = np.random.default_rng(1).integers(0, 256, (8, 8, 3), np.uint8)
CAMERA = e3d.PerspectiveCamera()
POSE = e3d.look_at((1, 2, 3), (0, 0, 0))
# What makes the core hold other things: the options of each round in turn.
OPTIONS = (
    {},
    {"outputs": ("color", "depth", "normal", "uv"), "shading": "forward"},
    {"wireframe": "overlay", "line_width": 2},
    {"mode": "depth", "hidden_surfaces": "painter"},
    {"normals": "flat", "outputs": ("face_id", "barycentric")},
    {"wireframe": "only"},
)


def resident_bytes():
    """The memory of the process, once what is free has been given back, where libc can do that."""
    gc.collect()
    if hasattr(LIBC, "malloc_trim"):
        LIBC.malloc_trim(0)
    with open("/proc/self/statm") as file:
        return int(file.read().split()[1]) * resource.getpagesize()


def held():
    """Threads of the process, and its open files."""
    return len(os.listdir("/proc/self/task")), len(os.listdir("/proc/self/fd"))


def live_once(number, threads=1):
    """Make a texture, a mesh, instances, a light, a scene and a renderer; draw; drop them all."""
    mesh = e3d.Mesh(POSITIONS, FACES, uvs=UVS)
    mesh.materials = [e3d.Material(texture=e3d.Texture(PIXELS))]
    scene = e3d.Scene()
    scene.add(mesh)
    if number % 3 == 0:
        scene.add(e3d.InstancedMesh(mesh, [[1, 0, 0, 0.5], [-1, 0, 0, 0.5]]))
        scene.add(e3d.PointLight(), translation=(1, 1, 1))
    with Renderer((9, 7), threads=threads, samples=4 if number % 5 == 0 else 1) as renderer:
        frame = renderer.render(scene, (CAMERA, POSE), **OPTIONS[number % len(OPTIONS)])
    return frame


def grows(live, warm_up, allowed=ALLOWED_BYTES):
    """Whether the process grows by so much each time it lives, once it has warmed up.

    The allocator's own holdings go up and down by some megabytes, between threads above all: four
    lives in a row may grow by chance. A leak makes every life grow.
    """
    warm_up()
    for _ in range(ATTEMPTS):
        before = resident_bytes()
        live()
        if resident_bytes() - before < allowed:
            return False
    return True


def test_thousands_of_rounds_leave_nothing():
    def live(rounds):
        for number in range(rounds):
            live_once(number, threads=1 + number % 2)

    threads_and_files = None

    def warm_up():
        nonlocal threads_and_files
        live(500)
        threads_and_files = held()

    assert not grows(lambda: live(ROUNDS), warm_up, ROUNDS * ALLOWED_BYTES_A_ROUND)
    assert held() == threads_and_files


def test_renderers_that_die_in_threads_leave_nothing():
    """Among them some that were made elsewhere, and frames that outlive thread and renderer."""
    kept = []

    def live_in_a_thread(renderer):
        for number in range(3):
            live_once(number, threads=2)
        renderer.render(e3d.Scene())
        kept[:] = [live_once(4)]

    def live(rounds):
        for _ in range(rounds):
            renderers = [Renderer((9, 7), threads=2) for _ in range(4)]
            threads = [threading.Thread(target=live_in_a_thread, args=(r,)) for r in renderers]
            del renderers
            for thread in threads:
                thread.start()
            for thread in threads:
                thread.join()

    assert not grows(lambda: live(40), lambda: live(20))
    assert kept[0].face_id.shape == (7, 9)


def test_a_renderer_that_changes_forever_keeps_nothing():
    """One renderer, one scene: sizes, scenes' contents and arrays that come and go."""
    renderer = Renderer((9, 7), threads=1)
    scene = e3d.Scene()

    def live(rounds):
        for number in range(rounds):
            mesh = e3d.Mesh(POSITIONS, FACES, uvs=UVS)
            node = scene.add(mesh)
            renderer.resize((5 + number % 7, 5 + number % 11))
            renderer.render(scene, (CAMERA, POSE), **OPTIONS[number % len(OPTIONS)])
            mesh.positions = POSITIONS * 2
            mesh.materials[0].texture = e3d.Texture(PIXELS)
            renderer.render(scene)
            scene.remove(node)

    # All combinations of options and of sizes, of which no round may leave a kilobyte.
    assert not grows(lambda: live(500), lambda: live(200), 500_000)


def paint_anew(scene, number):
    """A texture of a MiB, in place of the one before."""
    pixels = np.full((512, 512, 3), number % 256, np.uint8)
    scene.nodes[0].object.materials[0].texture = texture = e3d.Texture(pixels)
    return texture


def bring_another_mesh(scene, number):
    """A mesh of instances, with a texture of its own, in place of the one before."""
    ball = e3d.uv_sphere(0.5, (64, 32))
    ball.materials = [e3d.Material(texture=e3d.Texture(np.zeros((256, 256, 3), np.uint8)))]
    scene.nodes[1].object.mesh = ball
    return ball


@pytest.mark.parametrize("replace", [paint_anew, bring_another_mesh])
def test_what_is_replaced_each_frame_is_let_go(replace):
    """A renderer that is kept, of a scene that is kept; a ray each frame as well."""
    scene = e3d.Scene()
    scene.add(e3d.Mesh(POSITIONS, FACES, uvs=UVS))
    scene.add(e3d.InstancedMesh(e3d.box(), [[1, 0, 0, 0.5], [-1, 0, 0, 0.5]]))
    for k in range(20):  # one change is little beside what stays
        scene.add(e3d.primitives.quad(), translation=(k, 0, -3))
    alive = weakref.WeakSet()

    def live(frames):
        for number in range(frames):
            alive.add(replace(scene, number))
            renderer.render(scene, (CAMERA, POSE))
            scene.raycast((0, 0, 5), (0, 0, -1))
            assert scene.bounds.shape == (2, 3)

    with Renderer((32, 24), threads=1) as renderer:
        live(20)
        gc.collect()
        assert len(alive) <= 2
        before = resident_bytes()
        live(200)
        gc.collect()
        assert len(alive) <= 2
        assert resident_bytes() - before < 40_000_000


def test_pictures_and_files_in_memory_leave_nothing():
    frame = live_once(0)
    png = frame.encode("png")

    def encode(rounds):
        assert all(frame.encode("png") == png for _ in range(rounds))

    assert not grows(lambda: encode(2000), lambda: encode(100))


def test_native_handles_go_with_their_objects():
    scene = e3d.Scene()
    texture = e3d.Texture(np.zeros((2, 2, 3), np.uint8))
    mesh = e3d.box()
    mesh.materials = [e3d.Material(texture=texture)]
    scene.add(mesh)
    render(scene, size=(4, 4))
    assert mesh in native_handles._meshes
    assert texture in native_handles._textures
    meshes, textures = len(native_handles._meshes), len(native_handles._textures)
    del scene, mesh, texture
    gc.collect()
    assert len(native_handles._meshes) < meshes
    assert len(native_handles._textures) < textures


@pytest.mark.parametrize("threads", [1, 2])
def test_steady_frames_take_no_memory(threads):
    """Frame after frame under a moving camera: the system hands over no page that it had not."""
    scene = e3d.Scene()
    scene.add(
        e3d.InstancedMesh(e3d.torus(), [[x, y, 0, 0.8] for x in range(-4, 5) for y in (0, 1)])
    )
    views = [e3d.look_at((0.01 * k, 1, 6), (0, 0, 0)) for k in range(10)]
    outputs = ("color", "depth", "face_id")

    def draw(renderer, frames):
        for frame in range(frames):
            renderer.render(scene, (CAMERA, views[frame % len(views)]), outputs=outputs)

    with Renderer((320, 180), threads=threads) as renderer:
        draw(renderer, 50)
        faults = []
        for _ in range(ATTEMPTS):
            before = resource.getrusage(resource.RUSAGE_SELF).ru_minflt
            draw(renderer, 50)
            faults.append(resource.getrusage(resource.RUSAGE_SELF).ru_minflt - before)
    # A picture made anew would be 56 pages a frame. A few for the allocator's own affairs.
    assert min(faults) < 10, faults
