"""A grid around the scene with numbers and units along its edges.

In: the box around a scene, and the view direction. Out: lines on the three sides of the box behind
the scene, as a `Mesh`; and text over the picture.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple, TypeAlias

import numpy as np

from ...model.geometry.mesh import Mesh
from ...rendering.canvas import Canvas
from ...rendering.frame import Frame
from ..views.free_region import NOTHING, Taken
from .lettering import text_font
from .theme import Theme
from .ticks import label as number_text
from .ticks import ticks

_MOST_TICKS = 6
_LINE, _EDGE = (120, 125, 135, 255), (165, 170, 180, 255)
#: Distance from an edge to its numbers, in letters.
_GAP = 1.5
#: Distance between numbers above each other, in letter heights.
_APART = 1.4

#: Pixels: left, top, right and bottom.
Box: TypeAlias = tuple[float, float, float, float]


class AxesGrid(NamedTuple):
    """The grid of a box.

    Attributes
    ----------
    low, high : (3,) float64
        The box, in world space.
    origin : (3,) float64
        Offset from world space to the file's coordinates.
    unit : str
    """

    low: np.ndarray
    high: np.ndarray
    origin: np.ndarray
    unit: str

    def numbers(self, axis: int) -> list[float]:
        """Return the file coordinates of the grid lines across an axis."""
        low = float(self.low[axis] + self.origin[axis])
        high = float(self.high[axis] + self.origin[axis])
        return ticks(low, high, _MOST_TICKS) if low < high else [low]

    def far_sides(self, toward_eye: np.ndarray) -> tuple[bool, bool, bool]:
        """Return, for each axis, whether its higher side is behind the scene.

        Parameters
        ----------
        toward_eye : (3,) float
            Direction from the box's centre, in world space.
        """
        x, y, z = (bool(value < 0.0) for value in toward_eye)
        return x, y, z

    def lines(self, far: tuple[bool, bool, bool]) -> Mesh:
        """Return the lines on the far sides."""
        points, colors = [], []
        for across in range(3):  # the axis perpendicular to the side
            for along in range(3):
                if along == across:
                    continue
                other = 3 - across - along
                places = [value - self.origin[along] for value in self.numbers(along)]
                ends = float(self.low[along]), float(self.high[along])
                for place in sorted({*places, *ends}):
                    for end in (self.low, self.high):
                        point = np.empty(3)
                        point[across] = (self.high if far[across] else self.low)[across]
                        point[along], point[other] = place, end[other]
                        points.append(point)
                        colors.append(_EDGE if place in ends else _LINE)
        lines = np.arange(len(points), dtype=np.int32).reshape(-1, 2)
        rows = np.array(colors, np.uint8)
        return Mesh(np.array(points), lines=lines, colors=rows, name="axes grid")

    def label(
        self,
        frame: Frame,
        far: tuple[bool, bool, bool],
        scale: float,
        theme: Theme,
        beside: Taken = NOTHING,
    ) -> None:
        """Write the numbers along one edge of each axis, with the axis's name and unit.

        They stay in the picture, beside the part that something else takes.
        """
        canvas = frame.canvas()
        free = canvas.width * (1.0 - beside.right), canvas.height * (1.0 - beside.bottom)
        middle, _ = frame.project((self.low + self.high) / 2)
        taken: list[Box] = []
        for axis in range(3):
            edge = self._edge(frame, axis, far)
            if edge is not None:
                for label in self._labels(frame, axis, edge, middle, scale):
                    self._write(label, canvas, np.array(free), taken, scale, theme)

    def _edge(self, frame: Frame, axis: int, far: tuple[bool, bool, bool]) -> np.ndarray | None:
        """Return the labelled edge along an axis, (2, 3); None if none is visible.

        It chooses, among the two edges between a far and a near side, the lower one or, for an
        upright axis, the left one.
        """
        first, second = (other for other in range(3) if other != axis)
        edges = []
        for high_first, high_second in ((0, 0), (0, 1), (1, 0), (1, 1)):
            if (high_first == far[first]) == (high_second == far[second]):
                continue
            ends = np.stack([self.low, self.high])
            ends[:, first] = (self.low, self.high)[high_first][first]
            ends[:, second] = (self.low, self.high)[high_second][second]
            pixels, _ = frame.project(ends)
            if np.isfinite(pixels).all():
                edges.append((ends, pixels))
        if not edges:
            return None
        along = np.abs(edges[0][1][1] - edges[0][1][0])
        sign, column = (1.0, 1) if along[0] > along[1] else (-1.0, 0)
        return max(edges, key=lambda edge: sign * edge[1][:, column].mean())[0]

    def _labels(
        self, frame: Frame, axis: int, edge: np.ndarray, middle: np.ndarray, scale: float
    ) -> list[_Label]:
        """Return the labels of an axis: its name, and the numbers that fit."""
        numbers = self.numbers(axis)
        step = numbers[1] - numbers[0] if len(numbers) > 1 else 1.0
        texts = [(value - self.origin[axis], number_text(value, step)) for value in numbers]
        name = "XYZ"[axis] + (f" [{self.unit}]" if self.unit else "")
        font = text_font(scale)
        letter, line = font.size / 2, font.line_height
        pixels, _ = frame.project(edge)
        direction = pixels[1] - pixels[0]
        outward = np.array([direction[1], -direction[0]])
        length = float(np.sqrt((outward * outward).sum()))
        if length < 2 * letter:
            return []  # seen end on
        outward *= np.sign((outward * (pixels.mean(axis=0) - middle)).sum() or 1.0) / length
        widest = max(font.width(text) for _, text in texts)
        gap = _GAP * letter
        aside = np.abs(outward)
        room = float((aside * (widest, line)).sum())
        labels = [_Label(name, pixels.mean(axis=0), outward, 2 * gap + room)]
        for place, text in texts[:: self._stride(texts, length, aside, widest, line)]:
            point = edge[0].copy()
            point[axis] = place
            labels.append(_Label(text, frame.project(point)[0], outward, gap))
        return labels

    def _stride(
        self,
        texts: Sequence[tuple[float, str]],
        length: float,
        outward: np.ndarray,
        wide: float,
        high: float,
    ) -> int:
        """Return the stride at which numbers fit along an edge of a given length in pixels."""
        needed = outward[1] * (wide + high) + outward[0] * high * _APART
        return max(1, math.ceil(needed * (len(texts) - 1) / length))

    def _write(
        self,
        label: _Label,
        canvas: Canvas,
        free: np.ndarray,
        taken: list[Box],
        scale: float,
        theme: Theme,
    ) -> None:
        """Write a text outward from a point, unless it would overlap or touch another, or be cut.

        Beside a point in the picture it is moved inward.
        """
        font = text_font(scale)
        size = np.array(font.text_size(label.text), np.float64)
        reach = label.gap + abs(label.outward[0]) * size[0] / 2
        corner = np.asarray(label.at) + label.outward * reach - size / 2
        if not np.isfinite(corner).all() or (size > free).any():
            return
        inside = corner.clip(0, free - size)
        shows = ((label.at >= 0) & (label.at < free)).all()
        if not shows and (inside != corner).any():
            return  # it would be cut
        corner = inside
        box = (*corner.tolist(), *(corner + size).tolist())
        if any(_overlap(box, other) for other in taken):
            return
        letter = font.size / 2
        taken.append((box[0] - letter, box[1], box[2] + letter, box[3]))
        canvas.text(round(box[0]), round(box[1]), label.text, theme.text, font=font)


class _Label(NamedTuple):
    """A text, its anchor pixel, and the direction and distance of its offset."""

    text: str
    at: np.ndarray
    outward: np.ndarray
    gap: float


def _overlap(a: Box, b: Box) -> bool:
    return a[0] < b[2] and b[0] < a[2] and a[1] < b[3] and b[1] < a[3]
