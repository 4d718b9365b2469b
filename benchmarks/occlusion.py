"""How near ambient occlusion comes to rays, and what it costs: workload W16.

In:  the installed engine3d; no files.
Out: a table, or with --json one object. For each scene of `occlusion_scenes.py`: the mean and the
     95th percentile of the difference between the visibility of a pixel and that of rays, and CPU
     milliseconds of each thread: of a frame without and with ambient occlusion.

The truth is cast: rays from the surface of pixels drawn by lot, in directions by the cosine about
the shading normal; what a ray meets counts by the distance as the radius says (R127 of
docs/exactness: in full up to 0.7 of it). Fast frames are the median of the repetitions.
"""

import argparse
import json
import statistics
import sys
import time

import numpy as np
from occlusion_scenes import SCENES
from progress import tracked

import engine3d as e3d

RAYS = 256
OUTPUTS = ("depth", "world_position", "world_normal")


def cosine_directions(normals, random):
    """Return RAYS directions for each normal, (N, RAYS, 3), by the cosine about it."""
    number = np.arange(RAYS)
    up = (number + 0.5) / RAYS
    turn = 2 * np.pi * (number * 0.6180339887498949 + random.random((len(normals), 1)))
    aside = np.where(np.abs(normals[:, :1]) < 0.9, [[1.0, 0, 0]], [[0, 1.0, 0]])
    tangent = np.cross(aside, normals)
    tangent /= np.linalg.norm(tangent, axis=1, keepdims=True)
    across = (np.sqrt(up) * np.cos(turn))[..., None] * tangent[:, None]
    along = (np.sqrt(up) * np.sin(turn))[..., None] * np.cross(normals, tangent)[:, None]
    return across + along + np.sqrt(1 - up)[None, :, None] * normals[:, None]


def cast(lit, places, normals, random):
    """Return the visibility of places with normals, (N,), by rays."""
    directions = cosine_directions(normals, random)
    origins = (places + 1e-3 * lit.radius * normals)[:, None] + 0 * directions
    rays = origins.reshape(-1, 3), directions.reshape(-1, 3)
    hits = lit.scene.raycast_many(*rays, max_distance=lit.radius, cull="none")
    weight = np.clip(2 - 2 * (hits.distance / lit.radius) ** 2, 0, 1)
    return 1 - weight.reshape(len(places), RAYS).mean(axis=1)


def differences(lit, renderer, count):
    """Return visibility less that of rays, (count,), at pixels drawn by lot."""
    random = np.random.default_rng(1)
    options = {"cull": "none", "ambient_occlusion_radius": lit.radius}
    surfaces = renderer.render(lit.scene, lit.view, outputs=OUTPUTS, **options)
    shown = renderer.render(lit.scene, lit.view, ambient_occlusion=True, **options)
    drawn = np.argwhere(surfaces.depth > 0)
    at = tuple(random.permutation(drawn)[:count].T)
    normals = surfaces.world_normal[at].astype(np.float64)
    truth = cast(lit, surfaces.world_position[at].astype(np.float64), normals, random)
    return shown.color[at][:, 0] / 255.0 - truth


def milliseconds(lit, renderer, threads, repeats, occluded):
    """Return CPU milliseconds of each thread for a frame."""
    options = {"cull": "none", "ambient_occlusion_radius": lit.radius}
    taken = []
    for _ in range(repeats + 1):
        start = time.process_time()
        renderer.render(lit.scene, lit.view, ambient_occlusion=occluded, **options)
        taken.append(1e3 * (time.process_time() - start) / threads)
    return statistics.median(taken[1:])


def measure(name, arguments):
    """Return the row of a scene."""
    lit = SCENES[name]()
    plain = {"look": "plain", "samples": 1, "antialiasing": "ssaa", "color_space": "linear"}
    threads = arguments.threads
    with e3d.Renderer(arguments.size, threads=threads, **plain) as renderer:
        off = differences(lit, renderer, arguments.pixels)
        row = {"scene": name, "mean": float(np.abs(off).mean())}
        row |= {"p95": float(np.quantile(np.abs(off), 0.95)), "bias": float(off.mean())}
        for key, occluded in (("without", False), ("with", True)):
            row[key] = milliseconds(lit, renderer, threads, arguments.repeats, occluded)
    return row


def main():
    parser = argparse.ArgumentParser(description="Compare ambient occlusion with rays.")
    parser.add_argument("--json", action="store_true", help="print one JSON object")
    parser.add_argument("--scene", action="append", choices=list(SCENES), help="only these")
    parser.add_argument("--size", type=int, nargs=2, default=(1280, 720), metavar=("W", "H"))
    parser.add_argument("--pixels", type=int, default=2000, help="with rays (default: 2000)")
    parser.add_argument("--threads", type=int, default=2, help="default: 2")
    parser.add_argument("--repeats", type=int, default=9, help="frames (default: 9)")
    arguments = parser.parse_args()
    arguments.size = tuple(arguments.size)
    names = arguments.scene or list(SCENES)
    rows = [measure(name, arguments) for name in tracked(names, len(names), "scenes")]
    if arguments.json:
        json.dump({"engine3d": e3d.__version__, "rows": rows}, sys.stdout)
        print()
        return
    print(f"{'scene':<8} {'mean':>7} {'p95':>7} {'bias':>7}   ms without, with")
    for row in rows:
        numbers = "{mean:7.4f} {p95:7.4f} {bias:+7.4f} {without:10.2f} {with:6.2f}".format(**row)
        print(f"{row['scene']:<8} {numbers}")


if __name__ == "__main__":
    main()
