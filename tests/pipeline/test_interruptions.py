"""Signal handlers and forks that come in the middle of anything: nothing hangs, nothing is missed.

Each case is a process of its own, so that a hang is a failure and a handler disturbs nobody.
"""

import os
import subprocess
import sys

import pytest

pytestmark = [
    pytest.mark.skipif(not hasattr(os, "fork"), reason="this system cannot fork"),
    pytest.mark.skipif(sys.platform != "linux", reason="timers of signals"),
]

BEGINNING = """
import os, signal, sys, threading, time, warnings
import numpy as np
import engine3d as e3d
warnings.simplefilter("ignore")
SIZE = (64, 48)

def long_frame():
    poses = np.zeros((90, 4))
    poses[:, 3] = 1 + np.arange(90) * 1e-4
    scene = e3d.Scene()
    scene.add(e3d.InstancedMesh(e3d.uv_sphere(0.5, (64, 32)), poses))
    camera = e3d.OrthographicCamera(0.2, znear=-9, zfar=9), np.eye(4)
    renderer = e3d.Renderer((2048, 2048), threads=2, backend="portable")
    return renderer, lambda: renderer.render(scene, camera, hidden_surfaces="painter")

def every(seconds, handler):
    signal.signal(signal.SIGALRM, handler)
    signal.setitimer(signal.ITIMER_REAL, seconds, seconds)

def no_more():
    signal.setitimer(signal.ITIMER_REAL, 0)

def small_frame(scene):
    return e3d.render(scene, size=SIZE, threads=1).color
"""

ASSIGNS = """
positions = [e3d.uv_sphere(r, (12, 6)).positions for r in (0.4, 0.5)]
faces = e3d.uv_sphere(0.4, (12, 6)).faces

def new_scene():
    scene = e3d.Scene()
    for x in (-1, 0, 1):
        scene.add(e3d.Mesh(positions[0], faces), translation=(x, 0, 0))
    scene.add(e3d.InstancedMesh(e3d.box((0.2, 0.2, 0.2)), [(0, 1, 0, 1)]))
    scene.add(e3d.PointLight(), translation=(0, 0, 2))
    scene.add(e3d.PerspectiveCamera(), translation=(0, 0, 4))
    return scene

def change(scene, number):
    meshes = [node.object for node in scene.nodes[:3]]
    for k, mesh in enumerate(meshes):
        mesh.positions = positions[(number + k) % 2]
        mesh.materials[0].color = (0.1 * (number % 10), 0.5, 0.1 * k)
    scene.nodes[3].object.poses = [(0, 0.1 * (number % 10), 0, 1)]
    scene.nodes[4].object.intensity = 1.0 + number % 7
    scene.nodes[5].object.yfov = 0.8 + 0.01 * (number % 20)
    scene.nodes[0].translation = (-1, 0.01 * (number % 9), 0)

scene, told, quiet, depth = new_scene(), [0], [False], [0]

def handler(*_):
    if quiet[0] or depth[0] > 2:  # one may come within another, but not for ever
        return
    told[0] += 1
    depth[0] += 1
    change(scene, told[0])
    depth[0] -= 1

renderer = e3d.Renderer(SIZE, threads=1)
every(0.0007, handler)
end, step = time.monotonic() + 2, 0
while time.monotonic() < end:
    step += 1
    if step % 3:
        change(scene, step)
    renderer.render(scene)
    scene.bounds
    scene.raycast((0, 0, 5), (0, 0, -1))
    if step % 25 == 0:  # all that was assigned shows
        quiet[0] = True
        other = new_scene()
        for node, there in zip(other.nodes, scene.nodes):
            node.pose = there.pose
            if isinstance(there.object, e3d.Mesh):
                node.object.positions = there.object.positions
                node.object.materials[0].color = there.object.materials[0].color
        other.nodes[3].object.poses = scene.nodes[3].object.poses
        other.nodes[4].object.intensity = scene.nodes[4].object.intensity
        other.nodes[5].object.yfov = scene.nodes[5].object.yfov
        assert np.array_equal(renderer.render(scene).color, small_frame(other)), step
        assert np.array_equal(scene.bounds, other.bounds), step
        quiet[0] = False
no_more()
assert told[0] > 100 and step > 50, (told, step)
"""

DRAWS = """
renderer, draw = long_frame()
small, other = e3d.Scene(), e3d.Scene()
small.add(e3d.box())
other.add(e3d.box())
expected, seen = small_frame(other), []

def handler(*_):
    no_more()
    for act in (draw, lambda: renderer.resize((8, 8)), renderer.close):
        try:
            act()
        except e3d.errors.RendererBusyError as error:
            seen.append(str(error))
    seen.append(np.array_equal(small_frame(small), expected))

every(0.1, handler)
whole = draw().color.tobytes()
assert len(seen) == 4 and seen[3], seen
assert all("signal handler" in text and "another Renderer" in text for text in seen[:3]), seen
assert draw().color.tobytes() == whole
"""

FORK_BESIDE = """
renderer, draw = long_frame()
thread = threading.Thread(target=draw)
thread.start()
time.sleep(0.1)
assert thread.is_alive()
child = os.fork()
if not child:
    signal.alarm(30)
    try:
        draw()
    except e3d.errors.RendererBusyError as error:
        assert "forked" in str(error)
        renderer.close()
        del renderer, draw
        scene = e3d.Scene()
        scene.add(e3d.box())
        assert small_frame(scene).any()
        with e3d.Renderer(SIZE, threads=2) as fresh:
            fresh.render(scene)
        os._exit(0)
    os._exit(1)
assert thread.is_alive(), "the fork waited for the frame"
assert os.waitpid(child, 0)[1] == 0
thread.join()
assert draw().color.any()
"""

FORK_WITHIN = """
renderer, draw = long_frame()
children = []

def handler(*_):
    no_more()
    children.append(os.fork())

every(0.1, handler)
try:
    picture = draw().color
except e3d.errors.RendererBusyError as error:
    assert children == [0] and "forked" in str(error)
    scene = e3d.Scene()
    scene.add(e3d.box())
    with e3d.Renderer(SIZE, threads=2) as fresh:
        assert fresh.render(scene).color.any()
    os._exit(0)
assert children[0] > 0 and os.waitpid(children[0], 0)[1] == 0
assert np.array_equal(draw().color, picture)
"""

FORK_ANYWHERE = """
def calls(at=None, act=None):
    count = 0
    def profile(frame, event, argument):
        nonlocal count
        count += 1
        if count == at:
            sys.setprofile(None)
            act()
    sys.setprofile(profile)
    try:
        picture = renderer.render(scene, view).color.tobytes()
    finally:
        sys.setprofile(None)
    return count, picture

scene = e3d.Scene()
scene.add(e3d.box())
floor = scene.add(e3d.box((9, 9, 0.1)), translation=(0, 0, -2)).object
floor.materials = [e3d.Material(mirror=True)]
scene.add(e3d.DirectionalLight(shadow="map", shadow_map_size=64))
scene.add(e3d.SpotLight(shadow="map", shadow_map_size=64), translation=(0, 0, 3))
pose = np.eye(4)
pose[2, 3] = 4
renderer, told = None, [0, 0]
for camera in (e3d.PerspectiveCamera(), e3d.FisheyeCamera(30, 30, 32, 24)):
    def fresh():
        global renderer
        renderer = e3d.Renderer(SIZE, threads=1)
    view = camera, pose
    for _ in range(2):  # the first fills what all renderers share
        fresh()
        count, picture = calls()
    for at in range(1, count, max(1, count // 40)):
        fresh()
        children = []
        try:
            seen = calls(at, lambda: children.append(os.fork()))[1]
        except e3d.errors.RendererBusyError as error:
            assert children == [0] and "forked" in str(error)
            os._exit(7)
        assert seen == picture
        if children == [0]:
            os._exit(0)
        code = os.waitstatus_to_exitcode(os.waitpid(children[0], 0)[1])
        assert code in (0, 7), (at, code)
        told[code == 7] += 1
assert told[0] and told[1] > 50, told
"""

FORK_WHILE_CHANGING = """
material, stop = e3d.Material(), threading.Event()

def change():
    while not stop.is_set():
        material.shininess = 3.0

threads = [threading.Thread(target=change) for _ in range(3)]
sys.setswitchinterval(1e-6)
for thread in threads:
    thread.start()
for _ in range(12):
    child = os.fork()
    if not child:
        signal.alarm(20)
        scene = e3d.Scene()
        scene.add(e3d.primitives.quad()).object.materials = [material]
        material.color = (1, 0, 0)
        os._exit(0)
    assert os.waitpid(child, 0)[1] == 0
stop.set()
for thread in threads:
    thread.join()
"""

CASES = {
    "a handler assigns": ASSIGNS,
    "a handler draws": DRAWS,
    "a fork beside a frame": FORK_BESIDE,
    "a fork within a frame": FORK_WITHIN,
    "a fork anywhere in a frame": FORK_ANYWHERE,
    "a fork while others change": FORK_WHILE_CHANGING,
}


@pytest.mark.slow
@pytest.mark.parametrize("case", CASES)
def test_nothing_hangs(case):
    environment = {**os.environ, "OPENBLAS_NUM_THREADS": "1"}
    command = [sys.executable, "-c", BEGINNING + CASES[case]]
    done = subprocess.run(command, env=environment, timeout=120, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
