"""Lines: a first try, the DDA, Bresenham, and the Line() of old tutorials, pixel by pixel.

Each function returns the pixels of a line from one pixel to another. The engine's own lines are
beside them, to compare.
"""

import shutil
import subprocess
import tempfile
import time
from pathlib import Path

import numpy as np

import engine3d as e3d
from lesson import FOLDER, blank, magnify, main, told

COLORS = {
    "first try": (240, 90, 80),
    "DDA": (90, 170, 250),
    "Bresenham": (255, 200, 0),
    "tutorial Line()": (120, 220, 130),
}


def first_try(x0, y0, x1, y1):
    """y = a x + b, for each x from the left end to the right end."""
    if x1 == x0:
        return []
    slope = (y1 - y0) / (x1 - x0)
    return [(x, round_half_up(y0 + slope * (x - x0))) for x in range(x0, x1 + 1)]


def round_half_up(value):
    return int((value + 0.5) // 1)


def dda(x0, y0, x1, y1):
    """Digital differential analyser: 1 along the longer side, a fraction along the other."""
    count = max(abs(x1 - x0), abs(y1 - y0))
    step_x = (x1 - x0) / count if count else 0.0
    step_y = (y1 - y0) / count if count else 0.0
    x, y = x0 + 0.5, y0 + 0.5
    pixels = []
    for _ in range(count + 1):
        pixels.append((int(x // 1), int(y // 1)))
        x += step_x
        y += step_y
    return pixels


def bresenham(x0, y0, x1, y1):
    """Integers only: an error that grows by the shorter side, and is paid back at each step."""
    run, rise = abs(x1 - x0), abs(y1 - y0)
    step_x = 1 if x0 < x1 else -1
    step_y = 1 if y0 < y1 else -1
    x, y = x0, y0
    pixels = []
    if run >= rise:
        error = run - (step_y > 0)
        for _ in range(run + 1):
            pixels.append((x, y))
            x += step_x
            error += 2 * rise
            if error >= 2 * run:
                error -= 2 * run
                y += step_y
    else:
        error = rise - (step_x > 0)
        for _ in range(rise + 1):
            pixels.append((x, y))
            y += step_y
            error += 2 * run
            if error >= 2 * rise:
                error -= 2 * rise
                x += step_x
    return pixels


def tutorial_line(x0, y0, x1, y1):
    """The Line() that a tutorial of the 1990s passes on: without the first pixel."""
    run, rise = abs(x1 - x0), abs(y1 - y0)
    step_x = 1 if x0 < x1 else -1
    step_y = 1 if y0 < y1 else -1
    x, y = x0, y0
    pixels = []
    if run > rise:
        error = run // 2
        for _ in range(run):
            x += step_x
            error += rise
            if error > run:
                error -= run
                y += step_y
            pixels.append((x, y))
    else:
        error = rise // 2
        for _ in range(rise):
            y += step_y
            error += run
            if error > rise:
                error -= rise
                x += step_x
            pixels.append((x, y))
    return pixels


WAYS = {
    "first try": first_try,
    "DDA": dda,
    "Bresenham": bresenham,
    "tutorial Line()": tutorial_line,
}


def engine_line(width, height, *ends):
    """The pixels of the engine's Bresenham line, as a set."""
    canvas = e3d.Canvas((width, height))
    canvas.line(*ends, (255, 255, 255))
    rows, columns = np.nonzero(canvas.pixels[:, :, 0])
    return set(zip(columns.tolist(), rows.tolist(), strict=True))


def star(width, height, count):
    """Return the ends of lines from the middle to the border, 16 of them two in each octant."""
    x, y = width // 2, height // 2
    a, b = x - 2, y - 2
    part = count // 8
    right = [(a, b - 2 * b * k // (2 * part)) for k in range(2 * part + 1)]
    middle = [(a - 2 * a * k // (2 * part), b) for k in range(1, 2 * part)]
    return [(x, y, x + s * dx, y + s * dy) for dx, dy in right + middle for s in (1, -1)]


def draw(picture, pixels, color):
    for x, y in pixels:
        picture[y, x] = color


def steps(width=37, height=29, directions=16):
    for name, way in WAYS.items():
        picture = blank(width, height)
        for ends in star(width, height, directions):
            draw(picture, way(*ends), COLORS[name])
        caption = told(f"{name}: {{count}} directions from the middle", count=directions)
        yield caption, magnify(picture, 7)

    for first, second in (("DDA", "Bresenham"), ("tutorial Line()", "Bresenham")):
        picture = blank(width, height)
        for ends in star(width, height, directions):
            one, other = set(WAYS[first](*ends)), set(WAYS[second](*ends))
            draw(picture, one & other, (110, 115, 125))
            draw(picture, one - other, COLORS[first])
            draw(picture, other - one, COLORS[second])
        yield f"{first} against {second}: in colour where they differ", magnify(picture, 7)


def random_lines(count, side=200, seed=1):
    return np.random.default_rng(seed).integers(0, side, (count, 4)).tolist()


def compare(count=2000, side=200):
    """Compare every way with the engine's line, pixel by pixel."""
    print(f"{count} random lines: how many have other pixels than the engine's,")
    print("and how many have other pixels when drawn from the other end")
    for name, way in WAYS.items():
        other = turned = 0
        for x0, y0, x1, y1 in random_lines(count, side):
            pixels = set(way(x0, y0, x1, y1))
            other += pixels != engine_line(side, side, x0, y0, x1, y1)
            turned += pixels != set(way(x1, y1, x0, y0))
        print(f"{name:<16}{other:>6}{turned:>6}")


def measure():
    """Time each way: in Python, in C, and what the engine's canvas needs."""
    lines = random_lines(2000)
    for name, way in WAYS.items():
        start = time.perf_counter()
        pixels = sum(len(way(*ends)) for ends in lines)
        took = time.perf_counter() - start
        print(f"Python  {name:<16}{1e9 * took / pixels:8.1f} ns per pixel")
    with tempfile.TemporaryDirectory() as folder:
        program = compile_c(folder, "-O2")
        for line in subprocess.check_output([program], text=True).splitlines():
            print(f"C       {line}")
    canvas = e3d.Canvas((200, 200))
    many = np.array(random_lines(100_000), np.float64)
    pixels = np.abs(many[:, :2] - many[:, 2:]).max(axis=1).sum() + len(many)
    for algorithm in ("dda", "bresenham"):
        start = time.perf_counter()
        canvas.lines(many, (255, 200, 0), algorithm=algorithm)
        took = time.perf_counter() - start
        print(f"engine  {algorithm:<16}{1e9 * took / pixels:8.2f} ns per pixel")
    print("Why is the engine's Bresenham slower than the one in C above? The lesson's adds 1 to a")
    print("byte, and its lines are known to be inside. The engine's clips each line exactly, so it")
    print("counts in 64 bits; it sets four bytes a pixel, or mixes them for a translucent colour.")


def compile_c(folder, *flags):
    """Compile 03_lines.c; return the program."""
    program = Path(folder) / "lines"
    subprocess.run(["cc", *flags, "-o", program, FOLDER / "03_lines.c", "-lm"], check=True)
    return program


def profile():
    """Tell which function of 03_lines.c takes how long, by gprof and by perf."""
    for tool in ("gprof", "perf"):
        if shutil.which(tool) is None:
            print(f"{tool} is not installed")
    with tempfile.TemporaryDirectory() as folder:
        if shutil.which("gprof"):
            program = compile_c(folder, "-O1", "-pg")
            subprocess.run([program], cwd=folder, check=True, stdout=subprocess.DEVNULL)
            subprocess.run(["gprof", "-b", "-p", program, "gmon.out"], cwd=folder, check=True)
        if shutil.which("perf"):
            program = compile_c(folder, "-O1", "-g")
            record = ["perf", "record", "-q", "-o", "data", program]
            subprocess.run(record, cwd=folder, check=True, stdout=subprocess.DEVNULL)
            report = ["perf", "report", "-q", "-i", "data", "--stdio", "--sort", "symbol"]
            subprocess.run(report, cwd=folder, check=True)


if __name__ == "__main__":
    main(__file__, steps, compare=compare, time=measure, profile=profile)
