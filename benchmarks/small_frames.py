"""Small frames, as robots and data sets draw them: moving bodies on a plane, and scenes made anew.

In:  the installed engine3d.
Out: a table, or with --json one object: milliseconds a frame of 60 moving bodies, with colours,
     depths and IDs, for each size with and without the maps of a light's shadows; milliseconds to
     make a random scene of data_set/things.py and to draw it.

Times are by the clock, medians, with one thread. Every third body moves before each frame.
"""

import argparse
import json
import math
import platform
import statistics
import sys
import time
from pathlib import Path

import engine3d as e3d
from engine3d.datasets import Generator

sys.path.append(str(Path(__file__).parent / "data_set"))
import things

BODIES = 60
SIZES = (84, 128, 256)
OUTPUTS = ("color", "depth", "object_id")
SCENE_SIZE = (320, 240)


def table_of_bodies(shadow):
    """Return a scene of boxes, cans and balls on a plane, and its bodies."""
    scene = e3d.Scene(background="skyblue", ambient=e3d.linear(0.3, 0.3, 0.3))
    scene.add(e3d.box((20, 0.1, 20)), translation=(0, -0.05, 0))
    scene.add(e3d.DirectionalLight((-0.4, -1, -0.3), shadow=shadow))
    shapes = e3d.box(0.4), e3d.icosphere(0.25, 2), e3d.cylinder(0.15, 0.5)
    generator = Generator(1)
    places = generator.uniform(-2.0, 2.0, (BODIES, 2)).tolist()
    bodies = [
        scene.add(shapes[number % 3], translation=(x, 0.3, z))
        for number, (x, z) in enumerate(places)
    ]
    return scene, bodies


def median(seconds):
    return 1e3 * statistics.median(seconds)


def time_frames(size, shadow, frames):
    """Return milliseconds a frame of moving bodies."""
    scene, bodies = table_of_bodies(shadow)
    camera = e3d.PerspectiveCamera(0.8), e3d.look_at((3.5, 2.5, 3.5), (0, 0.2, 0))
    taken = []
    with e3d.Renderer((size, size), threads=1, look="plain", samples=1) as renderer:
        for frame in range(frames + 2):
            for body in bodies[::3]:
                x, _, z = body.translation
                body.translation = x, 0.3 + 0.05 * math.sin(0.3 * frame + x), z
            begun = time.perf_counter()
            renderer.render(scene, camera, outputs=OUTPUTS)
            taken.append(time.perf_counter() - begun)
    return median(taken[2:])


def time_scenes(count):
    """Return milliseconds to make a random scene, and to draw it for the first time."""
    made, drawn = [], []
    with e3d.Renderer(SCENE_SIZE, threads=1) as renderer:
        for seed in range(count + 2):
            begun = time.perf_counter()
            scene = e3d.Scene()
            camera = things.build(scene, Generator(seed))["camera"]
            ready = time.perf_counter()
            renderer.render(scene, camera, outputs=OUTPUTS)
            made.append(ready - begun)
            drawn.append(time.perf_counter() - ready)
    return median(made[2:]), median(drawn[2:])


def main():
    parser = argparse.ArgumentParser(description="Time small frames and random scenes.")
    parser.add_argument("--json", action="store_true", help="print one JSON object")
    parser.add_argument("--frames", type=int, default=200, help="frames a figure (default: 200)")
    parser.add_argument("--scenes", type=int, default=100, help="random scenes (default: 100)")
    arguments = parser.parse_args()
    rows = [
        {
            "size": size,
            **{shadow: time_frames(size, shadow, arguments.frames) for shadow in ("none", "map")},
        }
        for size in SIZES
    ]
    made, drawn = time_scenes(arguments.scenes)
    if arguments.json:
        machine = {"machine": platform.machine(), "python": platform.python_version()}
        scenes = {"made": made, "drawn": drawn}
        found = {"engine3d": e3d.__version__, **machine, "rows": rows, "scenes": scenes}
        json.dump(found, sys.stdout)
        print()
        return
    print(f"{'size':>9} {'no shadow, ms':>14} {'shadow map, ms':>15}")
    for row in rows:
        print(f"{row['size']:>4}x{row['size']:<4} {row['none']:>14.2f} {row['map']:>15.2f}")
    print(f"a random scene: made in {made:.1f} ms, drawn in {drawn:.1f} ms")


if __name__ == "__main__":
    main()
