"""Bresenham's line against the plain DDA: nanoseconds a line and a pixel, by length and direction.

In:  the canvas of the installed engine3d.
Out: a table, or with --json one object: what was run where, and a row a length and direction.

Each measurement draws a batch of lines in one call, so that Python's share is nothing; the two
algorithms take turns, and the fastest of the repetitions counts. Both draw as many pixels.
"""

import argparse
import json
import platform
import sys
import time

import numpy as np

import engine3d
from engine3d.rendering.canvas import Canvas

# Rows of 4,144 bytes: at a power of two the pixels of a steep line would share a few cache sets.
WIDTH, HEIGHT = 1036, 1024
LENGTHS = [4, 16, 64, 256, 1000]
# Direction -> (dx, dy) of a line of length 1 along its major axis.
DIRECTIONS = {
    "horizontal": (1, 0),
    "shallow": (1, 0.3),
    "diagonal": (1, 1),
    "steep": (0.3, 1),
    "vertical": (0, 1),
}
PIXELS_PER_BATCH = 200_000
ALGORITHMS = ["dda", "bresenham"]


def batch(length, direction, seed=7):
    """Lines of `length` pixels in one direction, at random places of the canvas: (N, 4)."""
    dx, dy = (round((length - 1) * part) for part in direction)
    count = max(PIXELS_PER_BATCH // length, 1)
    rng = np.random.default_rng(seed)
    start = rng.integers((0, 0), (WIDTH - dx, HEIGHT - dy), (count, 2))
    return np.concatenate([start, start + (dx, dy)], axis=1).astype(np.float64)


def seconds(canvas, lines, algorithm):
    start = time.perf_counter()
    canvas.lines(lines, (255, 200, 100), algorithm=algorithm)
    return time.perf_counter() - start


def measure(repeats):
    """Yield one row a length and direction: nanoseconds of each algorithm, and their ratio."""
    canvas = Canvas((WIDTH, HEIGHT))
    for name, direction in DIRECTIONS.items():
        for length in LENGTHS:
            lines = batch(length, direction)
            best = dict.fromkeys(ALGORITHMS, float("inf"))
            for _ in range(repeats):
                for algorithm in ALGORITHMS:
                    best[algorithm] = min(best[algorithm], seconds(canvas, lines, algorithm))
            row = {"direction": name, "pixels": length, "lines": len(lines)}
            for algorithm, time_taken in best.items():
                row[f"{algorithm}_ns_per_line"] = 1e9 * time_taken / len(lines)
                row[f"{algorithm}_ns_per_pixel"] = 1e9 * time_taken / len(lines) / length
            row["dda_over_bresenham"] = best["dda"] / best["bresenham"]
            yield row


def print_table(rows):
    print("                       ns a line            ns a pixel")
    print("direction   pixels      DDA  Bresenham      DDA  Bresenham   DDA / Bresenham")
    ratios = []
    for row in rows:
        print(
            f"{row['direction']:<11} {row['pixels']:>6} {row['dda_ns_per_line']:>8.1f} "
            f"{row['bresenham_ns_per_line']:>10.1f} {row['dda_ns_per_pixel']:>8.2f} "
            f"{row['bresenham_ns_per_pixel']:>10.2f} {row['dda_over_bresenham']:>17.2f}",
            flush=True,
        )
        ratios.append(row["dda_over_bresenham"])
    print(f"\nBresenham is {np.exp(np.mean(np.log(ratios))):.2f} times as fast (geometric mean)")


def main():
    parser = argparse.ArgumentParser(description="Compare Bresenham's line with the DDA.")
    parser.add_argument("--json", action="store_true", help="print one JSON object")
    parser.add_argument("--repeats", type=int, default=40, help="repetitions (default: 40)")
    arguments = parser.parse_args()
    rows = measure(max(arguments.repeats, 1))
    if not arguments.json:
        print_table(rows)
        return
    machine = {"machine": platform.machine(), "python": platform.python_version()}
    json.dump({"engine3d": engine3d.__version__, **machine, "rows": list(rows)}, sys.stdout)
    print()


if __name__ == "__main__":
    main()
