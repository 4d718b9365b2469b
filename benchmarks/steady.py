"""What a frame of a loop that has warmed up takes from the system, and what the first one costs.

In:  the installed engine3d.
Out: a table, or with --json one object. For each workload: minor page faults and growth of the
     process a frame, over frames after warm-up; milliseconds of the first frame of a new renderer
     of a scene never drawn, of the second, and their ratio; the same ratio after
     `Renderer.prepare`, the median of three scenes. It is the time that passes: helpers that wait
     count as CPU time.
"""

import argparse
import gc
import json
import os
import resource
import statistics
import sys
import time
from pathlib import Path

from engine3d.apps.bench import figures, measuring
from engine3d.apps.scenes import workloads

SIZE = (1280, 720)
WORKLOADS = ("textured", "mesh", "grid", "city-street", "city-above", "spheres-inside")
#: Frames until the camera is back where it was.
WARM_UP = 105


def resident_bytes():
    """What the process occupies in memory."""
    pages = int(Path("/proc/self/statm").read_text().split()[1])
    return pages * os.sysconf("SC_PAGE_SIZE")


def faults():
    """Minor page faults of the process so far, all threads counted."""
    return resource.getrusage(resource.RUSAGE_SELF).ru_minflt


def milliseconds(function, *arguments):
    start = time.perf_counter()
    function(*arguments)
    return 1e3 * (time.perf_counter() - start)


def measure(name, frames, threads):
    """A row of figures."""
    made = workloads.make(name)
    drawing = measuring.Drawing(made, SIZE, threads=threads)
    first, second, *_ = (milliseconds(drawing.draw, frame) for frame in range(WARM_UP))
    gc.collect()
    before = faults(), resident_bytes()
    taken = [milliseconds(drawing.draw, WARM_UP + frame) for frame in range(frames)]
    after = faults(), resident_bytes()
    drawing.close()
    prepared = statistics.median(prepared_ratio(name, threads) for _ in range(3))
    return {
        "workload": name,
        "faults_a_frame": (after[0] - before[0]) / frames,
        "bytes_a_frame": (after[1] - before[1]) / frames,
        "first_milliseconds": first,
        "second_milliseconds": second,
        "steady_milliseconds": statistics.median(taken),
        "first_over_second": first / second,
        "prepared_over_second": prepared,
    }


def prepared_ratio(name, threads):
    """The first frame over the second, of a scene that was prepared."""
    made = workloads.make(name)
    drawing = measuring.Drawing(made, SIZE, threads=threads)
    drawing.renderer.prepare(made.scene, mode=made.options.get("mode", "lit"))
    first, second = (milliseconds(drawing.draw, frame) for frame in range(2))
    drawing.close()
    return first / second


def line(row):
    return (
        f"{row['workload']:<15} {row['faults_a_frame']:>10.2f} {row['bytes_a_frame']:>11.0f} "
        f"{row['first_milliseconds']:>9.1f} {row['second_milliseconds']:>9.1f} "
        f"{row['steady_milliseconds']:>9.1f} {row['first_over_second']:>12.2f} "
        f"{row['prepared_over_second']:>9.2f}"
    )


def main():
    parser = argparse.ArgumentParser(description="Measure frames of a loop, and the first.")
    parser.add_argument("--json", action="store_true", help="print one JSON object")
    parser.add_argument("--workload", action="append", choices=WORKLOADS, help="by default all")
    parser.add_argument("--frames", type=int, default=50, help="after warm-up (default: 50)")
    parser.add_argument("--threads", type=int, default=0, help="by default all CPUs")
    arguments = parser.parse_args()
    rows = []
    if not arguments.json:
        print(
            f"{'a frame':<15} {'faults':>10} {'bytes':>11} {'1st ms':>9} {'2nd ms':>9} "
            f"{'steady':>9} {'first/second':>12} {'prepared':>9}"
        )
    for name in arguments.workload or WORKLOADS:
        rows.append(measure(name, arguments.frames, arguments.threads))
        if not arguments.json:
            print(line(rows[-1]), flush=True)
    if arguments.json:
        json.dump({**figures.machine(), "rows": rows}, sys.stdout)
        print()


if __name__ == "__main__":
    main()
