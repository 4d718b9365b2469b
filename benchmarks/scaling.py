"""How the cost of a frame grows: with triangles, pixels, layers and threads.

In:  the installed engine3d.
Out: one table, or with --json one object; with --plot one chart of four panels. Growth says how the
     cost of one more grew from the row before: 1 is in proportion, and far more would be a cliff.

One thread and CPU time, but of the threads the time that passes; medians of several frames.
"""

import argparse
import json
import statistics
import sys
import time

import line_chart

from engine3d.apps.bench import figures, measuring
from engine3d.apps.scenes import workloads
from engine3d.base.system import usable_processors

SIZE = (1280, 720)
SIDES = (1, 2, 3, 6, 10, 18, 32, 56, 100, 178, 316)
SIZES = ((160, 120), (320, 240), (640, 480), (1280, 720), (1920, 1080), (3840, 2160), (7680, 4320))
LAYERS = (1, 2, 4, 8, 16, 32, 64)


def triangles(most):
    """Ever more and ever smaller triangles: the picture stays much the same."""
    for side in SIDES:
        made = workloads.spheres_on_a_plane(side)
        if made.triangles <= most:
            yield made.triangles, made, SIZE, 1


def pixels(most):
    made = workloads.make("textured")
    for width, height in SIZES:
        yield width * height, made, (width, height), 1


def layers(most):
    for count in LAYERS:
        yield count, workloads.layers(count), SIZE, 1


def threads(most):
    made = workloads.make("city-above")
    cpus = usable_processors()
    for count in sorted({2**power for power in range(cpus.bit_length())} | {cpus}):
        yield count, made, SIZE, count


# series -> (what grows, cases)
SERIES = {
    "triangles": ("triangles, 1280x720", triangles),
    "pixels": ("pixels, textured model", pixels),
    "layers": ("layers back to front, 1280x720", layers),
    "threads": ("threads, city from above", threads),
}


def milliseconds(made, size, count, seconds, clock):
    """The median of the frames of about so many seconds."""
    drawing = measuring.Drawing(made, size, threads=count)
    taken = []
    try:
        drawing.draw(0), drawing.draw(1)
        end = time.perf_counter() + seconds
        while len(taken) < measuring.LEAST or time.perf_counter() < end:
            start = clock()
            drawing.draw(2 + len(taken))
            taken.append(1e3 * (clock() - start))
    finally:
        drawing.close()
    return statistics.median(taken)


def measure(names, most, seconds):
    """Yield a row for each series and size."""
    for name in names:
        before = None
        clock = time.perf_counter if name == "threads" else time.process_time
        for size, made, resolution, count in SERIES[name][1](most):
            taken = milliseconds(made, resolution, count, seconds, clock)
            row = {"series": name, "size": size, "milliseconds": taken}
            if before is not None:
                row["growth"] = growth(before, (size, taken))
            before = size, taken
            yield row


def growth(before, after):
    """How many times as much one more costs as it did: 1 in proportion, less is better."""
    return (after[1] / before[1]) / (after[0] / before[0])


def line(row):
    cost = 1e6 * row["milliseconds"] / row["size"]
    step = f"{row['growth']:>8.2f}" if "growth" in row else ""
    cost = f"{cost:,.0f}" if cost > 1e3 else f"{cost:.2f}"
    cells = f"{row['size']:>12,} {row['milliseconds']:>10.3f} {cost:>14} {step}"
    return f"{row['series']:<10} {cells}".rstrip()


def plot(path, rows):
    panels = [
        (
            f"ms over {heading}",
            [(r["size"], r["milliseconds"]) for r in rows if r["series"] == name],
        )
        for name, (heading, _) in SERIES.items()
        if any(row["series"] == name for row in rows)
    ]
    line_chart.save(path, panels)


def main():
    parser = argparse.ArgumentParser(description="Measure how the cost of a frame grows.")
    parser.add_argument("--json", action="store_true", help="print one JSON object")
    parser.add_argument("--plot", metavar="FILE", help="a chart: .svg or .png")
    parser.add_argument("--series", action="append", choices=SERIES, help="by default all")
    parser.add_argument("--triangles", type=float, default=1e8, help="at most (default: 1e8)")
    parser.add_argument("--seconds", type=float, default=1.0, help="a row (default: 1)")
    arguments = parser.parse_args()
    rows = []
    if not arguments.json:
        print(f"{'':<10} {'size':>12} {'ms':>10} {'ns for each':>14} {'growth':>8}")
    for row in measure(arguments.series or SERIES, arguments.triangles, arguments.seconds):
        rows.append(row)
        if not arguments.json:
            print(line(row), flush=True)
    if arguments.plot:
        plot(arguments.plot, rows)
    if arguments.json:
        json.dump({**figures.machine(), "rows": rows}, sys.stdout)
        print()


if __name__ == "__main__":
    main()
