"""What a frame costs before a pixel is drawn, and what the first picture costs: the fixed prices.

In:  the installed engine3d.
Out: two tables, or with --json one object: microseconds of CPU time a call of `Renderer.render`, of
     which the C core's own; milliseconds of CPU time and of waiting of commands from a cold start.

A call draws 16x16 pixels on one thread, so that nearly all of its time is spent around the core.
The fastest of several rounds counts; what else the machine does lengthens only the waiting.
"""

import argparse
import json
import math
import os
import platform
import subprocess
import sys
import tempfile
import time
from importlib.resources import files
from pathlib import Path

import engine3d as e3d

SIDE = 16
ROUNDS = 5
PLACES = 256  # of what moves, before it is back where it was


def _views():
    return [e3d.look_at((3 + 0.001 * k, 2, 4), (0, 0, 0)) for k in range(PLACES)]


def _scene(count):
    """A scene of some boxes and a camera, and the nodes of both."""
    scene = e3d.Scene()
    mesh = e3d.box()
    nodes = [scene.add(mesh, translation=(k % 10, k // 10 % 10, -k // 100)) for k in range(count)]
    camera = scene.add(e3d.PerspectiveCamera(), pose=_views()[0])
    return scene, nodes, camera


def unchanged(count=1):
    scene, _, _ = _scene(count)
    return lambda renderer, k: renderer.render(scene, cull="back")


def moving_camera(count=1):
    scene, _, camera = _scene(count)
    views = _views()

    def draw(renderer, k):
        camera.pose = views[k % PLACES]
        return renderer.render(scene, cull="back")

    return draw


def camera_by_look_at():
    scene, _, _ = _scene(1)
    camera = e3d.PerspectiveCamera()

    def draw(renderer, k):
        pose = e3d.look_at((3 + 0.001 * (k % PLACES), 2, 4), (0, 0, 0))
        return renderer.render(scene, (camera, pose), cull="back")

    return draw


def moving_node(count=1):
    scene, nodes, _ = _scene(count)

    def draw(renderer, k):
        nodes[count // 2].translation = (0.001 * (k % PLACES), 0, 0)
        return renderer.render(scene, cull="back")

    return draw


def moving_lights():
    scene, _, _ = _scene(1)
    lights = [scene.add(e3d.DirectionalLight()) for _ in range(3)]
    views = _views()

    def draw(renderer, k):
        for light in lights:
            light.pose = views[k % PLACES]
        return renderer.render(scene, cull="back")

    return draw


def automatic_framing():
    scene = e3d.Scene()
    scene.add(e3d.box())
    return lambda renderer, k: renderer.render(scene, cull="back")


# name of a row -> function that makes what is called
CALLS = {
    "unchanged": unchanged,
    "moving camera": moving_camera,
    "look_at, moving camera": camera_by_look_at,
    "moving node": moving_node,
    "3 moving lights": moving_lights,
    "automatic framing, unchanged": automatic_framing,
    "1,000 nodes, unchanged": lambda: unchanged(1000),
    "1,000 nodes, moving camera": lambda: moving_camera(1000),
    "1,000 nodes, one moving": lambda: moving_node(1000),
}


def measure_calls(calls):
    """Yield a row for each kind of call."""
    for name, make in CALLS.items():
        draw = make()
        with e3d.Renderer((SIDE, SIDE), threads=1, look="plain", samples=1) as renderer:
            core = min(draw(renderer, k).stats["ms_total"] for k in range(20))
            best = math.inf
            for _ in range(ROUNDS):
                start = time.process_time()
                for k in range(calls):
                    draw(renderer, k)
                best = min(best, (time.process_time() - start) / calls)
        yield {"call": name, "microseconds": 1e6 * best, "core_microseconds": 1e3 * core}


def _commands(folder):
    """name of a row -> command."""
    run = [sys.executable, "-m", "engine3d"]
    teapot = str(files("engine3d.data") / "models" / "teapot.obj")
    return {
        "python": [sys.executable, "-c", "pass"],
        "import numpy": [sys.executable, "-c", "import numpy"],
        "engine3d --version": [*run, "--version"],
        "engine3d info teapot.obj": [*run, "info", teapot],
        "engine3d render teapot.obj": [*run, "render", teapot, "-o", str(folder / "teapot.png")],
    }


def measure_starts(rounds):
    """Yield a row for each command: the least CPU time and the least waiting."""
    with tempfile.TemporaryDirectory() as folder:
        for name, command in _commands(Path(folder)).items():
            cpu, wall = math.inf, math.inf
            for _ in range(rounds):
                start = time.perf_counter()
                process = subprocess.Popen(command, stdout=subprocess.DEVNULL)
                _, status, usage = os.wait4(process.pid, 0)
                process.returncode = os.waitstatus_to_exitcode(status)
                wall = min(wall, time.perf_counter() - start)
                cpu = min(cpu, usage.ru_utime + usage.ru_stime)
                if status:
                    raise SystemExit(f"{' '.join(command)} failed")
            yield {"command": name, "cpu_milliseconds": 1e3 * cpu, "milliseconds": 1e3 * wall}


def print_tables(calls, starts):
    print(f"{'Renderer.render, 16x16, one thread':<36} {'us a call':>10} {'core':>8}")
    for row in calls:
        figures = f"{row['microseconds']:>10.1f} {row['core_microseconds']:>8.1f}"
        print(f"{row['call']:<36} {figures}", flush=True)
    print(f"\n{'cold start':<36} {'ms of CPU':>10} {'ms':>8}")
    for row in starts:
        figures = f"{row['cpu_milliseconds']:>10.0f} {row['milliseconds']:>8.0f}"
        print(f"{row['command']:<36} {figures}", flush=True)


def main():
    parser = argparse.ArgumentParser(description="Measure what does not depend on pixels.")
    parser.add_argument("--json", action="store_true", help="print one JSON object")
    parser.add_argument("--calls", type=int, default=300, help="calls a round (default: 300)")
    parser.add_argument("--starts", type=int, default=7, help="cold starts each (default: 7)")
    arguments = parser.parse_args()
    calls = measure_calls(max(arguments.calls, 1))
    starts = measure_starts(max(arguments.starts, 1))
    if not arguments.json:
        print_tables(calls, starts)
        return
    machine = {"machine": platform.machine(), "python": platform.python_version()}
    rows = {"calls": list(calls), "starts": list(starts)}
    json.dump({"engine3d": e3d.__version__, **machine, **rows}, sys.stdout)
    print()


if __name__ == "__main__":
    main()
