"""What a camera sees of shapes in space, found with NumPy and without drawing.

In: axes, and shapes: triangles, lines and markers with names and colours. Out: pixels at which one
answer is certain: which shape is nearest there.
"""

from typing import NamedTuple

import numpy as np


class Shape(NamedTuple):
    """Triangles (N, 3, 3), segments (N, 2, 3) or points (N, 1, 3), with a radius in pixels.

    ``certain`` is False of what may look as it likes, such as the heads of arrows: no probe there.
    """

    color: tuple[float, float, float]
    corners: np.ndarray
    radius: float = 0.0
    certain: bool = True


class Probe(NamedTuple):
    x: int
    y: int
    color: tuple[float, float, float] | None


def sheet(color, x, y, z) -> Shape:
    """The cells of a grid, two triangles each."""
    p = np.stack(np.broadcast_arrays(*(np.asarray(one, float) for one in (x, y, z))), -1)
    a, b, c, d = p[:-1, :-1], p[1:, :-1], p[1:, 1:], p[:-1, 1:]
    halves = [np.stack(one, -2).reshape(-1, 3, 3) for one in ((a, b, c), (a, c, d))]
    return Shape(color, np.concatenate(halves))


def line(color, points, radius, **more) -> Shape:
    points = np.asarray(points, float)
    return Shape(color, np.stack([points[:-1], points[1:]], 1), radius, **more)


def places_of(ax, points: np.ndarray) -> np.ndarray:
    """Pixels from the picture's top left corner, and depth, which is greater farther away."""
    points = np.asarray(points, float)
    h = np.concatenate([points, np.ones((*points.shape[:-1], 1))], -1) @ ax.get_proj().T
    h = h[..., :3] / h[..., 3:]
    xy = ax.transData.transform(h[..., :2].reshape(-1, 2)).reshape(*points.shape[:-1], 2)
    height = ax.get_figure().canvas.get_width_height()[1]
    return np.concatenate([xy[..., :1], height - xy[..., 1:], h[..., 2:]], -1)


def depths_at(places: np.ndarray, radius: float, spot: np.ndarray) -> np.ndarray:
    """The depths of a shape's parts at a spot, where they are."""
    a = places[:, 0]
    if places.shape[1] == 3:
        e, f, d = places[:, 1] - a, places[:, 2] - a, spot - a[:, :2]
        area = e[:, 0] * f[:, 1] - e[:, 1] * f[:, 0]
        with np.errstate(all="ignore"):
            u = (d[:, 0] * f[:, 1] - d[:, 1] * f[:, 0]) / area
            v = (e[:, 0] * d[:, 1] - e[:, 1] * d[:, 0]) / area
        inside = (u >= -1e-9) & (v >= -1e-9) & (u + v <= 1 + 1e-9)
        return (a[:, 2] + u * e[:, 2] + v * f[:, 2])[inside]
    e = places[:, -1] - a
    t = ((spot - a[:, :2]) * e[:, :2]).sum(1) / np.maximum((e[:, :2] ** 2).sum(1), 1e-12)
    t = np.clip(t, 0, 1)
    gap = np.linalg.norm(spot - (a[:, :2] + t[:, None] * e[:, :2]), axis=1)
    return (a[:, 2] + t * e[:, 2])[gap <= radius]


def probes_of(ax, shapes: list[Shape], count: int = 40) -> list[Probe]:
    """Pixels whose neighbourhood has one answer, half of them where shapes hide others."""
    rng = np.random.default_rng(7)
    placed = [places_of(ax, shape.corners) for shape in shapes]
    every = np.concatenate([one.reshape(-1, 3) for one in placed])
    span = np.ptp(every[:, 2])
    low, high = every[:, :2].min(0), every[:, :2].max(0)
    contested, plain = [], []
    for x, y in np.floor(rng.uniform(low, high, (500, 2))).astype(int):
        answers = {
            _answer(placed, shapes, x, y, dx, dy, rim, span)
            for dx in (-1.5, 0, 1.5)
            for dy in (-1.5, 0, 1.5)
            for rim in (-1, 1)
        }
        if len(answers) == 1 and (answer := answers.pop()) != "unsure":
            layers, color = answer
            (contested if layers > 1 else plain).append(Probe(int(x), int(y), color))
        if min(len(contested), len(plain)) >= count // 2:
            break
    return contested[: count // 2] + plain[: count // 2]


def _answer(placed, shapes, x, y, dx, dy, rim, span):
    spot, found = np.array([x + 0.5 + dx, y + 0.5 + dy]), []
    for places, shape in zip(placed, shapes, strict=True):
        depths = depths_at(places, shape.radius + rim, spot)
        if len(depths):
            found.append((float(depths.min()), shape.color if shape.certain else None))
    found.sort(key=lambda one: (one[0], one[1] is None))
    if found and found[0][1] is None:
        return "unsure"
    # Close ones must not decide, unless they look alike.
    if len(found) > 1 and found[1][0] - found[0][0] < 0.015 * span and found[0][1] != found[1][1]:
        return "unsure"
    return len(found), found[0][1] if found else None
