"""What thousands of nodes cost: moving them, finding what a camera shows, drawing, rays.

In:  the installed engine3d.
Out: a table, or with --json one object: milliseconds of CPU time, the median of several rounds, on
     one thread.

A cube of boxes, 34 a side unless told otherwise, under one node.
"""

import argparse
import json
import os
import platform
import statistics
import sys
import time

import numpy as np

import engine3d as e3d
from engine3d import linalg

RAYS = 2000


def grid(side):
    """The scene, the node above all boxes, and the boxes."""
    scene = e3d.Scene()
    root, mesh = scene.add(), e3d.box((0.3, 0.3, 0.3))
    places = np.stack(np.meshgrid(*[np.arange(side)] * 3, indexing="ij"), -1).reshape(-1, 3)
    for place in places.tolist():
        scene.add(mesh, parent=root, translation=place)
    return scene, root, scene.select(scene.nodes[1:])


def milliseconds(work, rounds):
    times = []
    for number in range(rounds):
        start = time.process_time()
        work(number)
        times.append(1e3 * (time.process_time() - start))
    return statistics.median(times)


def measure(side, rounds):
    """Yield a row for each kind of work."""
    start = time.process_time()
    scene, root, boxes = grid(side)
    yield {"work": "make the scene", "milliseconds": 1e3 * (time.process_time() - start)}
    random = np.random.default_rng(1)
    camera = e3d.PerspectiveCamera(0.9, zfar=4.0 * side)
    middle = np.full(3, 0.5 * side)
    bits = np.empty((scene.data.arrays.count + 63) // 64, np.uint64)

    def look(eye, target):
        view = linalg.inverse(e3d.look_at(eye, target))
        return linalg.multiply(camera.projection((1920, 1080)), view)

    inside = look(middle, middle + (1, 2, 3))
    outside = look(middle - 1.6 * side, middle)

    def move_all(number):
        root.translation = (0.001 * number, 0, 0)
        scene.data.update()

    def wander(number):
        boxes.translations += random.normal(0, 0.05, (len(boxes), 3))
        scene.data.update()

    def move_one(number):
        boxes.nodes[0].translation = (0.001 * number, 0, 0)
        scene.data.update()

    def cast(number):
        origins = random.uniform(0, side, (RAYS, 3))
        scene.raycast_many(origins, middle + 0.01 - origins)

    def select(view):
        return lambda number: scene.data.arrays.select(view, 1.0, False, bits)

    renderer = e3d.Renderer((64, 36), look="plain", samples=1)

    def draw(eye, batching):
        def work(number):
            pose = e3d.look_at(eye + (0, 0, 0.001 * number), middle + (1, 2, 3))
            renderer.render(scene, (camera, pose), cull="back", batching=batching)

        return work

    works = {
        "select, camera inside": select(inside),
        "select, camera outside": select(outside),
        "move one node": move_one,
        "move all by their parent": move_all,
        "move each at random": wander,
        "draw, all in view": draw(middle - 1.6 * side, True),
        "draw, all in view, a draw a node": draw(middle - 1.6 * side, False),
        "draw, camera inside": draw(middle, True),
        "draw, camera inside, a draw a node": draw(middle, False),
        f"{RAYS} rays": cast,
    }
    scene.data.update()
    for name, work in works.items():
        work(0)
        yield {"work": name, "milliseconds": milliseconds(work, rounds)}


def main():
    parser = argparse.ArgumentParser(description="Measure scenes of thousands of nodes.")
    parser.add_argument("--json", action="store_true", help="print one JSON object")
    parser.add_argument("--side", type=int, default=34, help="boxes a side (default: 34)")
    parser.add_argument("--rounds", type=int, default=21, help="of each (default: 21)")
    arguments = parser.parse_args()
    os.environ["ENGINE3D_THREADS"] = "1"
    rows = measure(max(arguments.side, 1), max(arguments.rounds, 1))
    if arguments.json:
        machine = {"machine": platform.machine(), "python": platform.python_version()}
        report = {"engine3d": e3d.__version__, "nodes": arguments.side**3, **machine}
        json.dump({**report, "rows": list(rows)}, sys.stdout)
        return
    print(f"{arguments.side**3:,} nodes, one thread: {'ms':>20}")
    for row in rows:
        print(f"{row['work']:<36} {row['milliseconds']:>12.3f}", flush=True)


if __name__ == "__main__":
    main()
