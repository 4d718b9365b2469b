"""Filling a triangle: the sweep from row to row, and three edge functions.

Corners are rounded to 1/256 pixel first. Then everything is whole numbers, so that both ways cover
exactly the same pixels, and triangles side by side neither overlap nor leave a gap.
"""

import time

import numpy as np

import engine3d as e3d
from lesson import blank, magnify, main, told

FINE = 256  # parts of a pixel
HALF = FINE // 2
ROW_COLORS = ((255, 200, 0), (230, 150, 40))


def snap(corner):
    """Round a corner to 1/256 pixel; return whole numbers of such parts."""
    return round(corner[0] * FINE), round(corner[1] * FINE)


def divide_up(a, b):
    return -(-a // b)


def sweep(a, b, c):
    """Return the pixels of a triangle, row by row: those between its left and its right edge."""
    top, middle, bottom = sorted((snap(a), snap(b), snap(c)), key=lambda corner: corner[1])
    pixels = []
    for row in range(divide_up(top[1] - HALF, FINE), divide_up(bottom[1] - HALF, FINE)):
        y = row * FINE + HALF
        ends = [first_column(top, bottom, y)]
        if y < middle[1]:
            ends.append(first_column(top, middle, y))
        else:
            ends.append(first_column(middle, bottom, y))
        pixels += [(column, row) for column in range(min(ends), max(ends))]
    return pixels


def first_column(upper, lower, y):
    """Return the first column whose centre is not left of an edge, at height y."""
    rise = lower[1] - upper[1]
    across = (lower[0] - upper[0]) * (y - upper[1]) + (upper[0] - HALF) * rise
    return divide_up(across, rise * FINE)


def edge_function(a, b, x, y):
    """Twice the area of a, b, (x, y): positive where that turns clockwise on the screen."""
    return (b[0] - a[0]) * (y - a[1]) - (b[1] - a[1]) * (x - a[0])


def is_top_or_left(a, b):
    """Whether the inner side is below the edge, if it is level, or else on its right."""
    return b[1] < a[1] or (b[1] == a[1] and b[0] > a[0])


def edge_functions(a, b, c):
    """Return the pixels of a triangle: those on the inner side of all three edges."""
    a, b, c = snap(a), snap(b), snap(c)
    if edge_function(a, b, *c) < 0:
        b, c = c, b
    edges = ((a, b), (b, c), (c, a))
    least = [0 if is_top_or_left(*edge) else 1 for edge in edges]
    columns, rows = zip(a, b, c, strict=True)
    pixels = []
    for row in range(divide_up(min(rows) - HALF, FINE), divide_up(max(rows) + HALF, FINE)):
        for column in range(divide_up(min(columns) - HALF, FINE), max(columns) // FINE + 1):
            x, y = column * FINE + HALF, row * FINE + HALF
            if all(edge_function(*edges[k], x, y) >= least[k] for k in range(3)):
                pixels.append((column, row))
    return pixels


def engine_triangle(width, height, corners, algorithm):
    canvas = e3d.Canvas((width, height))
    canvas.triangle(*corners, (255, 255, 255), algorithm=algorithm)
    rows, columns = np.nonzero(canvas.pixels[:, :, 0])
    return set(zip(columns.tolist(), rows.tolist(), strict=True))


def compare(count=500, side=40):
    """Compare both ways with the engine's two, pixel by pixel."""
    random = np.random.default_rng(1)
    for _ in range(count):
        corners = random.uniform(0, side, (3, 2)).tolist()
        ways = [sweep(*corners), edge_functions(*corners), edge_functions(*corners[::-1])]
        sets = [set(pixels) for pixels in ways]
        sets += [engine_triangle(side, side, corners, name) for name in ("scanline", "edge")]
        assert all(len(pixels) == len(set(pixels)) for pixels in ways)
        assert all(pixels == sets[0] for pixels in sets)
    print(f"{count} triangles: the same pixels, in whichever order the corners are given")


def measure():
    """Time both ways over triangle sizes, in Python and in the engine's canvas."""
    canvas = e3d.Canvas((512, 512))
    print("nanoseconds per pixel     Python: sweep    edges     C: sweep    edges")
    for side in (2, 4, 8, 16, 32, 64, 128, 256):
        corners = ((0.3, 0.2), (0.8 * side, 0.4 * side), (0.2 * side, side + 0.1))
        pixels = len(sweep(*corners))
        times = [seconds_of(way, *corners) / pixels for way in (sweep, edge_functions)]
        many = np.tile(np.ravel(corners), (1000, 1))
        for algorithm in ("scanline", "edge"):
            took = seconds_of(canvas.triangles, many, (255, 200, 0), algorithm=algorithm)
            times.append(took / pixels / len(many))
        cells = "".join(f"{1e9 * took:12.1f}" for took in times)
        print(f"{side:>4} pixels high, {pixels:>6} in it {cells}")


def seconds_of(function, *arguments, **options):
    """Return the seconds of the fastest of five calls."""
    best = float("inf")
    for _ in range(5):
        start = time.perf_counter()
        function(*arguments, **options)
        best = min(best, time.perf_counter() - start)
    return best


def counts_picture(width, height, ways):
    """Return a picture of how often each pixel is covered: once grey, twice red."""
    counts = np.zeros((height, width), int)
    for pixels in ways:
        for x, y in pixels:
            counts[y, x] += 1
    return np.array([(30, 33, 40), (120, 125, 135), (255, 70, 60)], np.uint8)[counts]


def without_rule(a, b, c):
    """The edge functions without the top-left rule: a centre on an edge always counts."""
    a, b, c = snap(a), snap(b), snap(c)
    if edge_function(a, b, *c) < 0:
        b, c = c, b
    return [
        (column, row)
        for row in range(40)
        for column in range(40)
        if all(
            edge_function(p, q, column * FINE + HALF, row * FINE + HALF) >= 0
            for p, q in ((a, b), (b, c), (c, a))
        )
    ]


def turned(corners, angle, middle):
    """Return corners turned about a point, by radians."""
    c, s = e3d.linalg.cos(angle), e3d.linalg.sin(angle)
    away = [(x - middle[0], y - middle[1]) for x, y in corners]
    return [(middle[0] + c * x - s * y, middle[1] + s * x + c * y) for x, y in away]


def inside(pixels, width, height):
    return [(x, y) for x, y in pixels if 0 <= x < width and 0 <= y < height]


def steps(width=34, height=26, angle=0.0):
    corners = (3.2, 2.6), (30.4, 9.1), (11.7, 24.3)
    if angle:
        corners = turned(corners, angle, (15.1, 12.0))
    picture = blank(width, height)
    pixels = sweep(*corners)
    for x, y in inside(pixels, width, height):
        picture[y, x] = ROW_COLORS[y % 2]
    yield told("the sweep: {count} pixels, row by row", count=len(pixels)), magnify(picture, 7)

    picture = blank(width, height)
    a, b, c = (snap(corner) for corner in corners)
    for y in range(height):
        for x in range(width):
            place = x * FINE + HALF, y * FINE + HALF
            values = [edge_function(p, q, *place) for p, q in ((a, b), (b, c), (c, a))]
            picture[y, x] = [200 if value > 0 else 40 for value in values]
    yield (
        "edge functions: a colour for each edge; all three are positive inside",
        magnify(picture, 7),
    )

    square = [(5.5, 3.5), (28.5, 3.5), (28.5, 21.5), (5.5, 21.5)]
    halves = [square[:3], [square[0], *square[2:]]]
    picture = counts_picture(width, height, [without_rule(*half) for half in halves])
    yield "two triangles without the top-left rule: red pixels are drawn twice", magnify(picture, 7)
    picture = counts_picture(width, height, [edge_functions(*half) for half in halves])
    yield "with the rule: each pixel once, no holes", magnify(picture, 7)


if __name__ == "__main__":
    main(__file__, steps, compare=compare, time=measure)
