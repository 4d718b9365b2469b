"""What the instruction sets bring: each backend's time on single kernels and on whole frames.

In:  the installed engine3d, this CPU; no compiler and no files. Single kernels are measured where
     engine3d was installed with `pip install -e .`, which builds what calls them. One thread,
     unless --threads says otherwise (frames only).
Out: two tables, or with --json one object: nanoseconds (kernels) and milliseconds (frames), and how
     many times as fast each backend is as `portable`, the same code one lane wide, and frames also
     as `scalar`, the reference. With --plot a bar chart as well.

Backends take turns, and the fastest of the repetitions counts.
"""

import argparse
import importlib.util
import json
import math
import platform
import sys
import time
from pathlib import Path

import bar_chart
from progress import tracked
from workloads import WORKLOADS

import engine3d as e3d
from engine3d._native import rasterizer

KERNEL_WORKLOADS = {}
if importlib.util.find_spec("engine3d._native.kernels_testing"):
    from kernel_workloads import KERNEL_WORKLOADS
    from kernels.kernels import Kernels

# Seconds that one measurement of a kernel lasts at least: Windows' clock of threads ticks 64 times
# a second.
ENOUGH = 0.0625 if sys.platform == "win32" else 0.001
REFERENCES = ("scalar", "portable")
# name of a row -> (workload, options of the frame)
FRAMES = {
    "many triangles, lit": ("small_triangles", {}),
    "instances, lit": ("instances", {}),
    "textured, lit": ("texture", {}),
    "eight lights, shiny": ("lights", {}),
    "overdraw, lit": ("overdraw", {}),
    "many triangles, visibility": ("small_triangles", {"outputs": ("face_id",)}),
    "overdraw, visibility": ("overdraw", {"outputs": ("face_id",)}),
}


def seconds(function, *arguments):
    """Of this thread's own time: what else the machine does counts for little."""
    start = time.thread_time()
    function(*arguments)
    return time.thread_time() - start


def measure_kernel(name, backends, repeats):
    """A row: nanoseconds an element for each backend that has kernels."""
    unit, make = KERNEL_WORKLOADS[name]
    elements, run = make()
    tables = {
        backend: Kernels(rasterizer.BACKENDS[backend])
        for backend in backends
        if backend != "scalar"
    }
    for kernels in tables.values():
        while seconds(run, kernels) < ENOUGH:
            kernels.rounds *= 2
    best = dict.fromkeys(tables, math.inf)
    for _ in range(repeats):
        for backend, kernels in tables.items():
            taken = seconds(run, kernels) / kernels.rounds / elements
            best[backend] = min(best[backend], 1e9 * taken)
    return {"workload": name, "unit": f"ns a {unit}", "time": best}


def measure_frame(name, backends, arguments):
    """A row: milliseconds of a frame for each backend."""
    workload, options = FRAMES[name]
    options = {"cull": "back", **options}
    scene = WORKLOADS[workload][1]()
    renderers = {
        backend: e3d.Renderer(
            arguments.size,
            backend=backend,
            threads=arguments.threads,
            look="plain",
            samples=1,
        )
        for backend in backends
    }
    frames = {backend: each.render(scene, **options) for backend, each in renderers.items()}
    best = dict.fromkeys(renderers, math.inf)
    for repeat in range(arguments.repeats):
        for backend, renderer in renderers.items():
            if backend == "scalar" and repeat > 1:
                continue
            stats = renderer.render(scene, out=frames[backend], **options).stats
            best[backend] = min(best[backend], stats["ms_total"])
    for renderer in renderers.values():
        renderer.close()
    return {"workload": name, "unit": "ms a frame", "time": best}


def add_speedups(row):
    """How many times as fast as each of REFERENCES that was measured."""
    times = row["time"]
    row["over"] = {
        reference: {backend: times[reference] / taken for backend, taken in times.items()}
        for reference in REFERENCES
        if reference in times
    }
    return row


def measure(arguments):
    """Yield the rows of the kernels, then those of the frames."""
    if "kernels" in arguments.what:
        for name in KERNEL_WORKLOADS:
            yield add_speedups(measure_kernel(name, arguments.backend, arguments.repeats))
    if "frames" in arguments.what:
        for name in FRAMES:
            yield add_speedups(measure_frame(name, arguments.backend, arguments))


def print_row(row, backends):
    cells = "".join(f"{row['time'].get(backend, math.nan):>10.3f}" for backend in backends)
    text = f"{row['workload']:<28}{row['unit']:<14}{cells}"
    for reference in REFERENCES:
        ratios = row["over"].get(reference, {})
        shown = [backend for backend in backends if backend not in REFERENCES]
        text += "  |" + "".join(f"{ratios.get(name, math.nan):>8.2f}" for name in shown)
    print(text.replace("nan", "  -"), flush=True)


def print_head(backends):
    shown = [backend for backend in backends if backend not in REFERENCES]
    over = "".join(f"  |{' times over ' + reference:<{8 * len(shown)}}" for reference in REFERENCES)
    print(f"{'':<{42 + 10 * len(backends)}}{over}")
    names = "".join(f"{name:>8}" for name in shown)
    heads = "".join(f"{name:>10}" for name in backends)
    print(f"{'':<42}{heads}" + f"  |{names}" * len(REFERENCES))


def plot(path, rows, backends):
    """The speed-ups over portable of all rows, and of the reference where it was measured."""
    bars = [
        (row["workload"], [row["over"]["portable"].get(backend) for backend in backends])
        for row in rows
    ]
    title = f"times as fast as portable, one lane wide ({platform.machine()})"
    bar_chart.save(path, title, bars, backends)


def size(text):
    width, height = text.lower().split("x")
    return int(width), int(height)


def parse():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--backend", action="append", choices=e3d.backends(), help="only these")
    parser.add_argument("--what", action="append", choices=["kernels", "frames"])
    parser.add_argument("--size", type=size, default=(640, 360), metavar="WxH")
    parser.add_argument("--threads", type=int, default=1, help="of frames; 0: all CPUs")
    parser.add_argument("--repeats", type=int, default=15)
    parser.add_argument("--plot", type=Path, metavar="FILE", help="also draw a chart: .svg or .png")
    parser.add_argument("--json", action="store_true", help="print one JSON object")
    arguments = parser.parse_args()
    arguments.backend = arguments.backend or e3d.backends()
    arguments.what = arguments.what or ["kernels", "frames"]
    if "kernels" in arguments.what and not KERNEL_WORKLOADS:
        print("kernels: not measured; `pip install -e .` builds what calls them", file=sys.stderr)
        arguments.what.remove("kernels")
    if arguments.plot and "portable" not in arguments.backend:
        parser.error("--plot shows times over portable, which must be measured")
    return arguments


def main():
    arguments = parse()
    rows = []
    if not arguments.json:
        print_head(arguments.backend)
    lists = {"kernels": KERNEL_WORKLOADS, "frames": FRAMES}
    total = sum(len(lists[what]) for what in arguments.what)
    measured = measure(arguments)
    for row in tracked(measured, total, "measuring") if arguments.json else measured:
        rows.append(row)
        if not arguments.json:
            print_row(row, arguments.backend)
    if arguments.plot:
        plot(arguments.plot, rows, arguments.backend)
    if arguments.json:
        machine = {"machine": platform.machine(), "python": platform.python_version()}
        settings = {"threads": arguments.threads, "size": arguments.size}
        json.dump({"engine3d": e3d.__version__, **machine, **settings, "rows": rows}, sys.stdout)
        print()


if __name__ == "__main__":
    main()
