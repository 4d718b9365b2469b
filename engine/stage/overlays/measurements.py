"""Distances, angles and circles between points, over a picture.

In: points of the world. Out: what they measure as a text, and marks on a frame.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ...base import linalg
from ...base.language import translated
from ...model.measuring.mass import Measures
from ...rendering.frame import Frame
from .debug_lines import Lines, draw_lines
from .dimensions import write_on_block
from .lengths import length_text
from .theme import Theme

#: What can be measured, with the number of points that it takes.
KINDS = {"distance": 2, "angle": 3, "circle": 3}
COLOR = (255, 160, 40, 255)
#: Half the side of the square that marks a point, in pixels, times the scale.
_DOT = 3
_CIRCLE_STEPS = 96


class Circle(NamedTuple):
    """The circle through three points: its centre (3,), radius, and normal (3,) of length 1."""

    center: NDArray[np.float64]
    radius: float
    normal: NDArray[np.float64]


class Measurement(NamedTuple):
    """What is measured: a key of `KINDS`, and points (N, 3) in world space, perhaps too few yet."""

    kind: str
    points: NDArray[np.float64]

    @property
    def is_complete(self) -> bool:
        return len(self.points) == KINDS[self.kind]


def distance_of(points: NDArray[np.float64]) -> float:
    """Return the distance of two points, (2, 3)."""
    return float(linalg.length(points[1] - points[0]))


def angle_of(points: NDArray[np.float64]) -> float | None:
    """Return the angle at the second of three points, in radians; None where two are the same."""
    a, b = points[0] - points[1], points[2] - points[1]
    sine, cosine = float(linalg.length(linalg.cross(a, b))), float(linalg.dot(a, b))
    if not (float(linalg.length(a)) and float(linalg.length(b))):
        return None
    return math.atan2(sine, cosine)


def circle_of(points: NDArray[np.float64]) -> Circle | None:
    """Return the circle through three points; None where they lie on a line."""
    a, b = points[0] - points[2], points[1] - points[2]
    normal = linalg.cross(a, b)
    square, sides = float(linalg.dot(normal, normal)), linalg.dot(a, a) * linalg.dot(b, b)
    if not square > 1e-20 * float(sides):
        return None
    away = b * float(linalg.dot(a, a)) - a * float(linalg.dot(b, b))
    offset = linalg.cross(normal, away) / (-2.0 * square)
    radius = float(linalg.length(offset))
    return Circle(points[2] + offset, radius, normal / math.sqrt(square))


def measurement_text(measured: Measurement, unit: str) -> str:
    """Return what points measure, such as ``"distance 0.5 m"``."""
    kind, points = measured
    if kind == "distance":
        return translated("distance {length}", length=length_text(distance_of(points), unit))
    if kind == "angle":
        angle = angle_of(points)
        if angle is None:
            return translated("no angle")
        return translated("angle {degrees:.4g}°", degrees=math.degrees(angle))
    circle = circle_of(points)
    if circle is None:
        return translated("no circle")
    return translated("radius {length}", length=length_text(circle.radius, unit))


def draw_measurement(
    frame: Frame, measured: Measurement, unit: str, scale: float, theme: Theme
) -> None:
    """Draw points, the lines or the circle between them, and the text if there are all points."""
    points = measured.points
    if not len(points):
        return
    segments = np.stack([points[:-1], points[1:]], axis=1)
    at = points.mean(axis=0)
    if measured.is_complete and measured.kind == "circle":
        circle = circle_of(points)
        if circle is not None:
            segments, at = _segments(circle, points[0]), circle.center
    draw_lines(frame, [Lines(segments, COLOR)], 2 * scale)
    canvas = frame.canvas()
    pixels, _ = frame.project(points)
    for x, y in pixels[np.isfinite(pixels).all(axis=1)].tolist():
        reach = _DOT * scale
        canvas.rectangle(x - reach, y - reach, 2 * reach, 2 * reach, COLOR)
    place, _ = frame.project(at)
    if measured.is_complete and np.isfinite(place).all():
        text = measurement_text(measured, unit)
        write_on_block(frame, text, place + 8.0 * scale, scale, theme)


def _segments(circle: Circle, start: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return a circle as segments, (N, 2, 3)."""
    first = start - circle.center
    second = linalg.cross(circle.normal, first)
    angles = np.arange(_CIRCLE_STEPS + 1) * (2.0 * math.pi / _CIRCLE_STEPS)
    cosines, sines = linalg.cos(angles)[:, np.newaxis], linalg.sin(angles)[:, np.newaxis]
    around = circle.center + first * cosines + second * sines
    return np.stack([around[:-1], around[1:]], axis=1)


def surface_text(measures: Measures, unit: str) -> list[str]:
    """Return the area and the volume of a surface as texts."""
    area = translated("area {area}", area=length_text(measures.area, unit, 2))
    if measures.volume is None:
        return [area, translated("no volume: it is open")]
    volume = length_text(abs(measures.volume), unit, 3)
    return [area, translated("volume {volume}", volume=volume)]
