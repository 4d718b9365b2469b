"""Large worlds, side by side in one run: spheres by the ten thousand, a city of millions.

In:  the installed engine3d.
Out: a table, or with --json one object. Of 34^3 spheres: frames from inside the grid, with and
     without culling, and with all in view, moved one by one and all at once; how long it takes to
     find where they are and what shows of them. Of the city: the time to make it, frames at street
     level under 256 lights and from above, bytes a triangle, writing and reading its OBJ. Of the
     same street in cities of three sizes: what a frame costs. Where there is an aim, it stands
     beside the figure; the aims are for 1920x1080, two threads and nothing else at work.

--culling says what is left out before it is drawn: run it with each to compare.
"""

import argparse
import gc
import json
import os
import platform
import sys
import tempfile
import time
import warnings
from pathlib import Path

import numpy as np
from lights import picture_size
from progress import tracked

import engine3d as e3d
from engine3d import linalg
from engine3d.apps.scenes.city_views import (
    above_camera,
    city_scene,
    drive,
    street_camera,
    time_frames,
)

SIDE, SPACING = 34, 3.0
UPDATES = 40  # of all transforms: the tree is built again now and then
PARTS = ("spheres", "city", "obj", "sizes")
SIZES = (100_000, 1_000_000, 10_000_000)


def resident_bytes():
    """What the process occupies in memory."""
    pages = int(Path("/proc/self/statm").read_text().split()[1])
    return pages * os.sysconf("SC_PAGE_SIZE")


def timed(function, *arguments):
    """CPU milliseconds of a call, and what it returned."""
    start = time.process_time()
    result = function(*arguments)
    return 1e3 * (time.process_time() - start), result


class Spheres:
    """34^3 spheres of 400 triangles in a grid, as one instanced mesh or as a node each."""

    def __init__(self, side):
        axis = (np.arange(side) - (side - 1) / 2) * SPACING
        grid = np.stack(np.meshgrid(axis, axis, axis, indexing="ij"), axis=-1).reshape(-1, 3)
        self.poses = np.column_stack((grid, np.ones(len(grid))))
        self.reach = float(axis[-1])
        self.mesh = e3d.uv_sphere(1.0, (20, 11))

    def instanced(self):
        scene = e3d.Scene(ambient=e3d.linear(0.2, 0.2, 0.2))
        scene.add(e3d.DirectionalLight((-0.4, -0.7, -0.6)))
        return scene, scene.add(e3d.InstancedMesh(self.mesh, self.poses)).object

    def nodes(self):
        scene = e3d.Scene(ambient=e3d.linear(0.2, 0.2, 0.2))
        scene.add(e3d.DirectionalLight((-0.4, -0.7, -0.6)))
        return scene, [scene.add(self.mesh, translation=pose[:3]) for pose in self.poses]

    def inside(self, frame):
        eye = (0.5 * SPACING, 0.5 * SPACING, 0.01 * frame)
        camera = e3d.PerspectiveCamera(yfov=1.0, znear=0.05, zfar=8.0 * self.reach)
        return camera, e3d.look_at(eye, (0.3 * self.reach, 0.1 * self.reach, -self.reach))

    def all_in_view(self, frame):
        eye = (0.01 * frame, 0.6 * self.reach, 3.6 * self.reach)
        camera = e3d.PerspectiveCamera(yfov=0.7, znear=0.5 * self.reach, zfar=8.0 * self.reach)
        return camera, e3d.look_at(eye, (0.0, 0.0, 0.0))


def measure_spheres(renderer, arguments, options):
    spheres = Spheres(arguments.side)
    count = f"{len(spheres.poses):,} spheres"
    views = {"inside": spheres.inside, "all in view": spheres.all_in_view}
    scene, instances = spheres.instanced()
    frames = {}
    for name, view in views.items():
        frames[name] = time_frames(renderer, scene, view, arguments.frames, **options)
        aim = frame_rate_aim(frames[name], 15) if name == "all in view" else {}
        yield f"{count}, instances, {name}", {**frames[name], **aim}
    without = {**options, "culling": "none"}
    row = time_frames(renderer, scene, spheres.inside, arguments.frames, **without)
    times = row["milliseconds"] / frames["inside"]["milliseconds"]
    aim = {"aim": "culling against none: 10 times less time", "reached": f"{times:.1f}"}
    yield f"{count}, instances, inside, no culling", {**row, **aim}

    def swing(frame):
        poses = spheres.poses.copy()
        poses[:, 1] += 0.3 * np.sin(poses[:, 0] + 0.1 * frame)
        instances.poses = poses

    row = time_frames(renderer, scene, spheres.inside, arguments.frames, swing, **options)
    yield f"{count}, instances, all moving, inside", row
    taken, (scene, nodes) = timed(spheres.nodes)
    yield f"{count}, nodes, made", {"cpu_milliseconds": taken}
    for name, view in views.items():
        row = time_frames(renderer, scene, view, arguments.frames, **options)
        yield f"{count}, nodes, {name}", row

    def move(frame):
        x, y, z = spheres.poses[:, :3].T
        places = np.stack((x, y + 0.3 * np.sin(x + 0.1 * frame), z), axis=1)
        for node, place in zip(nodes, places, strict=True):
            node.translation = place

    row = time_frames(renderer, scene, spheres.inside, arguments.frames, move, **options)
    yield f"{count}, nodes, all moving, inside", row
    yield from measure_nodes(scene, nodes, spheres, arguments.threads, count)


def measure_nodes(scene, nodes, spheres, threads, count):
    """Where nodes are that all wander at random, and which of them a camera shows."""
    selection, random = scene.select(nodes), np.random.default_rng(1)
    places, times = spheres.poses[:, :3].copy(), []
    for _ in range(UPDATES):
        places += random.normal(0, 0.05 * SPACING, places.shape)
        start = time.process_time(), time.perf_counter()
        selection.translations = places
        scene.data.update(threads)
        times.append((time.process_time() - start[0], time.perf_counter() - start[1]))
    rows = {"median": np.median(times, axis=0), "worst": np.max(times, axis=0)}
    for name, (cpu, wall) in rows.items():
        row = {"cpu_milliseconds": 1e3 * cpu, "milliseconds": 1e3 * wall}
        aim = {"aim": "under 10 ms", "reached": f"{1e3 * wall:.1f} ms"}
        yield f"{count}: transforms, bounds and tree, {name}", {**row, **aim}
    bits = np.empty((scene.data.arrays.count + 63) // 64, np.uint64)
    for name, look in {"inside": spheres.inside, "all in view": spheres.all_in_view}.items():
        camera, pose = look(0)
        view = linalg.multiply(camera.projection((1920, 1080)), linalg.inverse(pose))
        start = time.perf_counter()
        for _ in range(UPDATES):
            scene.data.arrays.select(view, 1.0, False, bits)
        taken = 1e3 * (time.perf_counter() - start) / UPDATES
        row = {"cpu_milliseconds": taken, "milliseconds": taken}
        aim = {"aim": "under 1 ms", "reached": f"{taken:.2f} ms"}
        yield f"{count}: which may show, {name}", {**row, **aim}


def frame_rate_aim(row, least):
    """What a row is meant to reach, in frames a second, and does."""
    rate = 1e3 / row["milliseconds"]
    return {"aim": f"at least {least} frames/s", "reached": f"{rate:.1f}"}


def measure_city(renderer, arguments, options):
    before = resident_bytes()
    taken, world = timed(e3d.worlds.city, arguments.triangles)
    count = f"city of {world.triangles:,}"
    made = (resident_bytes() - before) / world.triangles
    yield f"{count}, made", {"cpu_milliseconds": taken, "bytes_a_triangle": made}
    scene, cars = city_scene(world, 256)
    for name, view in {"street": street_camera, "above": above_camera}.items():
        row = time_frames(
            renderer, scene, view, arguments.frames, lambda frame: drive(cars, frame), **options
        )
        row["bytes_a_triangle"] = (resident_bytes() - before) / world.triangles
        aim = frame_rate_aim(row, 30 if name == "street" else 10)
        yield f"{count}, 256 lights, {name}", {**row, **aim}
    made = (resident_bytes() - before) / world.triangles
    aim = {"aim": "under 120 bytes a triangle", "reached": f"{made:.0f}"}
    yield f"{count}, memory", {"bytes_a_triangle": made, **aim}


def measure_obj(renderer, arguments, options):
    world = e3d.worlds.city(arguments.triangles)
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "city.obj"
        taken, _ = timed(lambda: world.mesh().save(path))
        size = path.stat().st_size
        name = f"city of {world.triangles:,}, OBJ of {size / 1e6:,.0f} MB"
        yield f"{name}, written", {"cpu_milliseconds": taken}
        world = None
        gc.collect()
        before = resident_bytes()
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            start = time.perf_counter()
            taken, mesh = timed(e3d.load_mesh, path)
            wall = 1e3 * (time.perf_counter() - start)
        used = (resident_bytes() - before) / len(mesh.faces)
        row = {"cpu_milliseconds": taken, "milliseconds": wall, "bytes_a_triangle": used}
        yield f"{name}, read", row


def measure_sizes(renderer, arguments, options):
    smallest = None
    for count in SIZES:
        if count > arguments.largest:
            break
        world = e3d.worlds.city(count)
        scene, cars = city_scene(world, 256)
        row = time_frames(
            renderer,
            scene,
            street_camera,
            arguments.frames,
            lambda frame, cars=cars: drive(cars, frame),
            **options,
        )
        aim = {}
        if smallest:
            times = row["milliseconds"] / smallest
            aim = {"aim": "less than twice the smallest's", "reached": f"{times:.2f} times"}
        smallest = smallest or row["milliseconds"]
        yield f"the same street, city of {world.triangles:,}", {**row, **aim}
        world = scene = cars = None
        gc.collect()


COLUMNS = {
    "cpu_milliseconds": (9, ".2f"),
    "milliseconds": (9, ".2f"),
    "triangles_setup": (9, ","),
    "bytes_a_triangle": (10, ".0f"),
}
MEASURES = {
    "spheres": measure_spheres,
    "city": measure_city,
    "obj": measure_obj,
    "sizes": measure_sizes,
}


def measure(arguments):
    """Yield a row for each figure."""
    width, height = arguments.size
    options = {"culling": arguments.culling, "cull": "back"}
    for part in arguments.part or PARTS:
        gc.collect()
        with e3d.Renderer(
            (width, height), threads=arguments.threads, look="plain", samples=1
        ) as renderer:
            for name, row in MEASURES[part](renderer, arguments, options):
                yield {"what": name, **row}


def print_table(rows):
    print(f"{'':<56} {'CPU ms':>9} {'ms':>9} {'set up':>9} {'B/triangle':>10}  aim: reached")
    for row in rows:
        numbers = [
            f"{row[name]:{form}}".rjust(width) if name in row else " " * width
            for name, (width, form) in COLUMNS.items()
        ]
        aim = f"{row['aim']}: {row['reached']}" if "aim" in row else ""
        print(f"{row['what']:<56} {' '.join(numbers)}  {aim}".rstrip(), flush=True)


def main():
    parser = argparse.ArgumentParser(description="Measure large worlds.")
    parser.add_argument("--json", action="store_true", help="print one JSON object")
    parser.add_argument("--part", choices=PARTS, action="append", help="by default all")
    parser.add_argument("--triangles", type=int, default=7_000_000, help="of the city")
    parser.add_argument(
        "--largest", type=int, default=SIZES[-1], help="of the same street's cities"
    )
    parser.add_argument("--side", type=int, default=SIDE, help="spheres along each side")
    parser.add_argument("--frames", type=int, default=10, help="frames a figure (default: 10)")
    parser.add_argument("--threads", type=int, default=2, help="(default: 2)")
    parser.add_argument("--culling", default="all", help="as for Renderer.render (default: all)")
    parser.add_argument("--size", type=picture_size, default=(1920, 1080), metavar="WxH")
    arguments = parser.parse_args()
    rows = measure(arguments)
    if not arguments.json:
        print_table(rows)
        return
    rows = tracked(rows, None, "measuring")
    machine = {"machine": platform.machine(), "python": platform.python_version()}
    settings = {"threads": arguments.threads, "culling": arguments.culling}
    result = {"engine3d": e3d.__version__, **machine, **settings, "rows": list(rows)}
    json.dump(result, sys.stdout)
    print()


if __name__ == "__main__":
    main()
