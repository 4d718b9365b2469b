"""Where a frame's time goes: stage by stage, and function by function with perf or gprof.

In:  the installed engine3d, best built with ENGINE3D_BUILD=profile. The functions of the core are
     named by perf on the same frames, or by gprof on the core's C driver, which is built for it and
     draws random scenes (gprof does not see into shared libraries).
Out: a table of milliseconds a stage for each workload, and the functions that take most; or with
     --json one object.
"""

import argparse
import functools
import json
import os
import re
import runpy
import shlex
import shutil
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from progress import tracked
from workloads import WORKLOADS

import engine3d as e3d

ROOT = Path(__file__).resolve().parents[1]
STAGES = ["geometry", "raster", "shade", "resolve"]
WARM_UP = 2
FUNCTIONS = 12
DRIVER_SCENES = 1200


def draw(scene, arguments, frames):
    """Draw frames; return the statistics and the wall-clock milliseconds of each."""
    width, height = arguments.size
    results = []
    with e3d.Renderer(
        (width, height),
        backend=arguments.backend,
        threads=arguments.threads,
        look="plain",
        samples=1,
    ) as renderer:
        frame = renderer.render(scene, cull="back")
        for _ in range(frames):
            start = time.perf_counter()
            frame = renderer.render(scene, out=frame, cull="back")
            results.append((dict(frame.stats), 1e3 * (time.perf_counter() - start)))
    return results


def stage_row(name, arguments):
    """The median milliseconds of each stage of a workload, and its counters."""
    results = draw(WORKLOADS[name][1](), arguments, WARM_UP + arguments.frames)[WARM_UP:]
    milliseconds = {
        stage: statistics.median(stats[f"ms_{stage}"] for stats, _ in results) for stage in STAGES
    }
    total = statistics.median(stats["ms_total"] for stats, _ in results)
    wall = statistics.median(wall for _, wall in results)
    milliseconds["other"] = max(total - sum(milliseconds.values()), 0.0)
    milliseconds["python"] = max(wall - total, 0.0)
    stats = results[-1][0]
    counters = {key: value for key, value in stats.items() if not key.startswith("ms_")}
    return {"workload": name, "milliseconds": milliseconds, "wall": wall, **counters}


def print_stages(rows):
    columns = [*STAGES, "other", "python"]
    print("Milliseconds a frame (and percent)")
    print(f"{'workload':<16}" + "".join(f"{name:>14}" for name in columns) + f"{'all':>9}")
    for row in rows:
        cells = [(row["milliseconds"][name], row["wall"]) for name in columns]
        shares = "".join(f"{took:>8.2f} ({100 * took / wall:2.0f}%)" for took, wall in cells)
        print(f"{row['workload']:<16}{shares}{row['wall']:>9.2f}")
    print(f"\n{'':<16}{'triangles':>12}{'drawn':>12}{'tile entries':>14}{'pixels':>12}")
    for row in rows:
        counts = f"{row['triangles']:>12,}{row['triangles_setup']:>12,}"
        print(f"{row['workload']:<16}{counts}{row['bin_entries']:>14,}{row['pixels_shaded']:>12,}")


def perf_works():
    if shutil.which("perf") is None:
        return False
    with tempfile.TemporaryDirectory() as folder:
        record = ["perf", "record", "-q", "-o", f"{folder}/data", "true"]
        return subprocess.run(record, capture_output=True).returncode == 0


def perf_functions(name, arguments):
    """[(percent of the core's time, function)] of one workload, by perf's samples."""
    width, height = arguments.size
    again = [sys.executable, str(Path(__file__)), "--draw-only", "--workload", name]
    again += ["--backend", arguments.backend, "--threads", str(arguments.threads)]
    again += ["--frames", str(arguments.frames), "--size", f"{width}x{height}"]
    library = Path(e3d._native.rasterizer.__file__).name
    with tempfile.TemporaryDirectory() as folder:
        data = f"{folder}/data"
        record = ["perf", "record", "-q", "-F", "1999", "-o", data, "--", *again]
        subprocess.run(record, check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        report = ["perf", "report", "-i", data, "--stdio", "--no-children", "--sort", "symbol"]
        report += ["--dsos", library, "--percentage", "relative"]
        done = subprocess.run(report, check=True, capture_output=True, text=True)
    found = re.findall(r"^\s*([\d.]+)%\s+\[.\]\s+(\S+)", done.stdout, re.MULTILINE)
    return [(float(percent), function) for percent, function in found]


def gprof_functions(backend, scenes):
    """[(percent, function)] of the C driver's random scenes on one backend, built with -pg."""
    build = runpy.run_path(str(ROOT / ".ci" / "build_driver.py"), run_name="rules")
    compiler = shlex.split(os.environ.get("CC", "cc"))
    os.chdir(ROOT)
    with tempfile.TemporaryDirectory() as folder:
        rules = build["rules_for"](compiler)
        told = functools.partial(tracked, what="compiling the core and its driver")
        objects = build["compile_all"](compiler, rules, False, folder, ["-pg"], told)
        program = f"{folder}/driver"
        linked = [*compiler, "-pg", "-pthread", *objects.values(), "-lm", "-o", program]
        subprocess.run(linked, check=True)
        run = [program, "--scenes", str(scenes), "--threads", "1", "--backend", backend]
        draw_scenes(run, scenes, folder)
        report = ["gprof", "-b", "-p", program, f"{folder}/gmon.out"]
        done = subprocess.run(report, check=True, capture_output=True, text=True)
        own = functions_of(
            o for source, o in objects.items() if source.startswith("csrc/check/driver/")
        )
    found = re.findall(r"^\s*([\d.]+)\s+[\d.]+\s+[\d.]+\s.*?(\S+)$", done.stdout, re.MULTILINE)
    core = [(float(percent), function) for percent, function in found if function not in own]
    whole = sum(percent for percent, _ in core) or 1.0
    return [(100 * percent / whole, function) for percent, function in core]


def draw_scenes(command, count, folder):
    """Run the driver, whose lines begin with the kind and the number of what was drawn."""
    with (
        tempfile.TemporaryFile("w+", dir=folder) as said,
        subprocess.Popen(command, cwd=folder, stdout=-1, stderr=said, text=True) as driver,
    ):
        scenes = (line for line in driver.stdout if line.startswith("scene "))
        for _ in tracked(scenes, count, "drawing random scenes"):
            pass
        if driver.wait() != 0:
            said.seek(0)
            sys.exit(f"profile: the driver found a fault: {said.read().strip()}")


def functions_of(objects):
    """The names of the functions that object files define."""
    done = subprocess.run(["nm", *objects], check=True, capture_output=True, text=True)
    return set(re.findall(r" [tT] (\S+)$", done.stdout, re.MULTILINE))


def profile_functions(arguments, backend):
    """Return {workload: [(percent, function)]}, by the tool that was asked for or that runs."""
    tool = arguments.functions
    if tool == "auto":
        tool = "perf" if perf_works() else "gprof" if shutil.which("gprof") else "none"
    if tool == "perf":
        named = tracked(arguments.workload, len(arguments.workload), "drawing under perf")
        return {name: perf_functions(name, arguments)[:FUNCTIONS] for name in named}
    if tool == "gprof":
        return {
            "random scenes of the C driver": gprof_functions(backend, arguments.scenes)[:FUNCTIONS]
        }
    return {}


def print_functions(functions):
    for name, found in functions.items():
        print(f"\nHot spots of {name} (percent of the core's time)")
        for percent, function in found:
            print(f"{percent:>7.1f}  {function}")


def picture_size(text):
    match = re.fullmatch(r"(\d+)[x,](\d+)", text)
    if match is None:
        raise argparse.ArgumentTypeError(f"expected a size such as 1280x720, not {text}")
    return int(match[1]), int(match[2])


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--workload", action="append", choices=list(WORKLOADS), help="only these")
    parser.add_argument("--backend", default="auto")
    parser.add_argument("--threads", type=int, default=1, help="0: all (default: 1)")
    parser.add_argument("--frames", type=int, default=20)
    parser.add_argument("--size", type=picture_size, default=(1280, 720))
    parser.add_argument("--functions", choices=["auto", "perf", "gprof", "none"], default="auto")
    parser.add_argument(
        "--scenes", type=int, default=DRIVER_SCENES, help="random ones, for gprof (default: 1200)"
    )
    parser.add_argument("--json", action="store_true", help="print one JSON object")
    parser.add_argument("--draw-only", action="store_true", help=argparse.SUPPRESS)
    arguments = parser.parse_args()
    arguments.workload = arguments.workload or list(WORKLOADS)
    arguments.frames = max(arguments.frames, 1)
    if arguments.functions in ("perf", "gprof") and shutil.which(arguments.functions) is None:
        parser.error(f"{arguments.functions} is not installed")
    return arguments


def main():
    arguments = parse_arguments()
    if arguments.draw_only:  # what perf records
        for name in arguments.workload:
            draw(WORKLOADS[name][1](), arguments, arguments.frames)
        return
    named = tracked(arguments.workload, len(arguments.workload), "drawing")
    rows = [stage_row(name, arguments) for name in named]
    if not arguments.json:
        print(f"backend {rows[0]['backend']}, {rows[0]['threads']} threads\n")
        print_stages(rows)
    functions = profile_functions(arguments, rows[0]["backend"])
    if arguments.json:
        json.dump({"stages": rows, "functions": functions}, sys.stdout)
        print()
    else:
        print_functions(functions)


if __name__ == "__main__":
    try:
        main()
    except FileNotFoundError as error:
        sys.exit(f"profile: {error.filename} is not installed")
    except subprocess.CalledProcessError as error:
        sys.exit(f"profile: {error}")
