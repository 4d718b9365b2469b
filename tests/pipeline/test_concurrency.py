"""Threads, forks and signals: many renderers at once, undisturbed. test_leaks has long lives."""

import os
import signal
import threading
import time
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest
from missing_here import interrupt
from patience import HUNG
from plain_picture import Renderer, render

import engine3d as e3d

SIZE = (160, 120)


@pytest.fixture
def scene():
    scene = e3d.Scene()
    scene.add(e3d.torus(0.6, 0.3, (64, 48)))
    scene.add(e3d.DirectionalLight((-1, -1, -1)))
    scene.add(e3d.PointLight(intensity=3.0 * np.pi), translation=(1, 1, 2))
    return scene


def test_renderers_in_several_threads_draw_the_same(scene):
    expected = render(scene, size=SIZE, threads=1).color

    def draw(threads):
        with Renderer(SIZE, threads=threads) as renderer:
            return all(np.array_equal(renderer.render(scene).color, expected) for _ in range(10))

    with ThreadPoolExecutor(6) as pool:
        assert all(pool.map(draw, [1, 2, 3, 1, 2, 3]))


def test_one_renderer_in_several_threads_draws_one_frame_after_the_other(scene):
    renderer = Renderer(SIZE)
    expected = {
        mode: render(scene, size=SIZE, mode=mode).color for mode in ("lit", "normal", "depth")
    }

    def draw(mode):
        return np.array_equal(renderer.render(scene, mode=mode).color, expected[mode])

    with ThreadPoolExecutor(6) as pool:
        assert all(pool.map(draw, list(expected) * 10))


def test_drawing_releases_the_gil(scene):
    counted = 0
    drawing = True

    def count():
        nonlocal counted
        while drawing:
            counted += 1
            time.sleep(0.001)

    counter = threading.Thread(target=count)
    renderer = Renderer((1920, 1080), threads=1, backend="scalar")
    counter.start()
    before = counted
    renderer.render(scene)
    during = counted - before
    drawing = False
    counter.join()
    # A frame that kept the interpreter's lock would let it count once or twice.
    assert during > 20


@pytest.mark.skipif(not hasattr(os, "fork"), reason="this system cannot fork")
@pytest.mark.filterwarnings("ignore:.*fork.*:DeprecationWarning")
def test_a_fork_draws_the_same(scene):
    renderer = Renderer(SIZE, threads=3)
    expected = renderer.render(scene).color.tobytes()
    child = os.fork()
    if child == 0:
        same = False
        try:
            signal.alarm(HUNG)
            same = renderer.render(scene).color.tobytes() == expected
            same = same and render(scene, size=SIZE, threads=2).color.tobytes() == expected
        finally:
            os._exit(0 if same else 1)
    _, status = os.waitpid(child, 0)
    assert os.waitstatus_to_exitcode(status) == 0
    assert renderer.render(scene).color.tobytes() == expected


@pytest.mark.parametrize("threads", [1, 2])
def test_ctrl_c_stops_a_long_frame(threads):
    scene = e3d.Scene()
    # The whole frame takes a minute of processor time.
    poses = np.zeros((800, 4))
    poses[:, 3] = 1 + np.arange(800) * 1e-4
    scene.add(e3d.InstancedMesh(e3d.uv_sphere(0.5, (64, 32)), poses))
    camera = (e3d.OrthographicCamera(0.2, znear=-9, zfar=9), np.eye(4))
    renderer = Renderer((4096, 4096), threads=threads, samples=4, backend="portable")
    timer = threading.Timer(0.3, interrupt)
    timer.start()
    start = time.process_time()
    with pytest.raises(KeyboardInterrupt):
        renderer.render(scene, camera, hidden_surfaces="painter")
    assert time.process_time() - start < 10
    timer.join()
    renderer.resize((8, 8))
    assert renderer.render(e3d.Scene()).color.shape == (8, 8, 4)


@pytest.mark.skipif(not hasattr(signal, "SIGUSR1"), reason="this system has no signals of users")
def test_a_signal_handler_that_does_not_raise_changes_nothing(scene):
    seen = []
    previous = signal.signal(signal.SIGUSR1, lambda *_: seen.append(1))
    try:
        renderer = Renderer((1920, 1080), threads=1)
        expected = renderer.render(scene).color.tobytes()
        timer = threading.Timer(0.001, os.kill, (os.getpid(), signal.SIGUSR1))
        timer.start()
        assert renderer.render(scene).color.tobytes() == expected
        timer.join()
    finally:
        signal.signal(signal.SIGUSR1, previous)
    assert seen == [1]


@pytest.mark.parametrize("change", ["add", "remove", None])
def test_a_scene_that_changes_meanwhile_is_named_as_the_cause(scene, change):
    node = scene.add(e3d.box())

    def change_nodes():
        if change == "add":
            scene.add(e3d.box())
        elif change == "remove":
            scene.remove(node)

    class Lens(e3d.PerspectiveCamera):
        """Fails once another thread has had its turn."""

        def projection(self, size):
            thread = threading.Thread(target=change_nodes)
            thread.start()
            thread.join()
            raise IndexError("out of range")

    with Renderer(SIZE) as renderer:
        with pytest.raises((e3d.errors.SceneChangedError, IndexError)) as error:
            renderer.render(scene, (Lens(), e3d.look_at((0, 0, 3), (0, 0, 0))))
        assert error.type is (IndexError if change is None else e3d.errors.SceneChangedError)
        assert error.match("out of range" if change is None else "from another thread")
        fresh = render(scene, size=SIZE)
        assert np.array_equal(renderer.render(scene).color, fresh.color)
