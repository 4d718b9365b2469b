"""Speed: frames per second, what compiler flags bring, and several pixels in one instruction."""

import subprocess
import tempfile
import time
from pathlib import Path

import numpy as np

import engine3d as e3d
from lesson import DIFFER, FOLDER, MODELS, blank, earlier, magnify, main, told

wireframe = earlier("04_wireframe")
triangles = earlier("05_triangles")
TEAPOT = MODELS / "teapot.obj"
FLAGS = ("-O0", "-O1", "-O2", "-O3", "-O3 -march=native", "-Ofast -march=native")
USEFUL, WASTED = (255, 200, 0), (90, 60, 30)
CORNERS = (9.4, 1.6), (36.7, 6.2), (19.1, 22.8)


def visited(corners, lanes):
    """Return the pixels that a loop over the bounding box visits, `lanes` at a time."""
    columns, rows = zip(*corners, strict=True)
    left = int(min(columns)) // lanes * lanes
    steps = range(left, int(max(columns)) + 1, lanes)
    return [
        (column + k, row)
        for row in range(int(min(rows)), int(max(rows)) + 1)
        for column in steps
        for k in range(lanes)
    ]


def flags():
    """Table of compiler flags: frames per second of 12_speed.c, one pixel at a time and several."""
    print("frames per second                one   lanes   picture")
    with tempfile.TemporaryDirectory() as folder:
        program = Path(folder) / "speed"
        source = FOLDER / "12_speed.c"
        for words in FLAGS:
            for lanes in (4, 8):
                define = [f"-DLANES={lanes}", "-Wno-psabi"]
                subprocess.run(["cc", *words.split(), *define, "-o", program, source], check=True)
                figures = subprocess.check_output([program], text=True).rstrip()
                print(f"{words:<22}{lanes:>2} lanes{figures}")


def frames_per_second(renderer, view, seconds=1.0):
    """Draw for a while; return how many frames a second that makes."""
    frame = renderer.render(*view, cull="back")
    frames, start = 0, time.perf_counter()
    while time.perf_counter() - start < seconds:
        frame = renderer.render(*view, cull="back", out=frame)
        frames += 1
    return frames / (time.perf_counter() - start), frame


def measure():
    """Frames per second of each of the engine's backends, with one thread."""
    view = wireframe.engine_view(TEAPOT, 640, 360)
    first = None
    for backend in e3d.backends():
        with e3d.Renderer(
            (640, 360), backend=backend, threads=1, look="plain", samples=1
        ) as renderer:
            rate, frame = frames_per_second(renderer, view)
        first = frame.color.copy() if first is None else first
        same = "same" if np.array_equal(first, frame.color) else "other"
        print(f"{backend:<10}{rate:8.0f} frames per second, {same} picture")


def steps(width=48, height=24, percent=100):
    """Visit the pixels of a triangle; percent: of its size."""
    corners = [tuple(part * percent / 100 for part in corner) for corner in CORNERS]
    inside = set(triangles.edge_functions(*corners))
    for lanes in (1, 4, 8, 16):
        pixels = visited(corners, lanes)
        picture = blank(width, height)
        for x, y in pixels:
            if x >= width:
                continue
            picture[y, x] = USEFUL if (x, y) in inside else WASTED
            if x % lanes == 0 and lanes > 1:
                picture[y, x] = picture[y, x] * 0.8
        caption = "{lanes} at a time: {steps} steps, {vain:no pixel|# pixel|# pixels} in vain"
        counts = {"steps": len(pixels) // lanes, "vain": len(pixels) - len(inside)}
        yield told(caption, lanes=lanes, **counts), magnify(picture, 5)

    size = width * 5, height * 7
    view = wireframe.engine_view(TEAPOT, *size)
    frames = [
        e3d.render(
            *view, size=size, backend=name, threads=threads, look="plain", samples=1, cull="back"
        ).color
        for name, threads in (("portable", 1), ("auto", 0))
    ]
    other = int((frames[0] != frames[1]).any(axis=2).sum())
    yield "the engine, one lane and one thread", frames[0][:, :, :3]
    caption = told("the engine, all lanes and threads: " + DIFFER, differ=other)
    yield caption, frames[1][:, :, :3]


if __name__ == "__main__":
    main(__file__, steps, flags=flags, time=measure)
