"""Limits the memory of a frame, since a scene or an option may demand much in a few bytes.

In: the sizes of what a frame is about to allocate. Out: nothing, or one error, before any
allocation, that lists the largest parts and says what to change.

A frame's outputs may take all the machine's memory. Everything else is limited by `MAX_FRAME_BYTES`
of options.py, which a program may raise, plus `BYTES_A_PIXEL` for each pixel, which always covers
what scales with the picture. What mirrors show counts as well, with its own pixels.
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Iterable
from typing import NamedTuple

from .._native.rasterizer import thread_count
from ..base.system import machine_memory
from ..errors import InvalidArgumentError
from . import options as limits
from ._output_pool import shapes_of

#: Bytes allowed per pixel in addition. Bloom, ambient occlusion and refraction together need fewer.
BYTES_A_PIXEL = 96

_FLOAT = 4
_KEPT_SAMPLE = 8  # a depth and an ID: csrc/frame/tile/kept.c
_MOST_KEPT = 1 << 25  # samples of a picture: E3D_MOST_KEPT_SAMPLES of csrc/frame/pass/plan.h
_TILE_PLANE = 24 * 4096  # depth, ID, colour and count for each sample of a tile
# Approximate bytes per face that casts exact shadows: its corners; and for each light, these again
# and the boxes of the grid cells it is in; for soft lights, the nodes of a tree.
_CASTER, _CASTER_OF_LIGHT, _CASTER_OF_TREE = 37, 160, 68
_SHOWN = 20  # an error names each part that takes at least 1/20 of the total


class Use(NamedTuple):
    """One consumer of memory."""

    size: int  # bytes
    what: str
    advice: str


class FrameMemory:
    """The memory that the next frame of one renderer will allocate.

    Parameters
    ----------
    axis, multiple : int
        Samples of a pixel along each axis; multisamples of each, 0 without.
    threads : int
        0: all.
    around : FrameMemory, optional
        That of the picture which shows this one in a mirror.
    """

    def __init__(
        self, axis: int, multiple: int, threads: int, around: FrameMemory | None = None
    ) -> None:
        self._axis, self._multiple, self._threads = axis, multiple, threads or thread_count()
        self._size = 0, 0
        self._of_options: list[Use] = []
        self._of_maps: list[Use] = []
        self._around = around
        self._of_mirrors: list[Use] = []
        self._mirrored_pixels = 0

    def check(self, outputs: tuple[str, ...], size: tuple[int, int], uses: list[Use]) -> list[Use]:
        """Return the memory of a frame with given outputs, and of its passes.

        Raises
        ------
        InvalidArgumentError
            The outputs exceed the machine's memory, or the rest exceeds the limit of a frame.
        """
        _check_outputs(outputs, *size)
        uses = uses + self._uses_of(*size)
        self.begin(size, uses)
        self._check()
        return uses

    def begin(self, size: tuple[int, int], uses: list[Use]) -> None:
        """Begin a frame with this memory and no shadow maps so far."""
        self._size, self._of_options, self._of_maps = size, uses, []
        self._of_mirrors, self._mirrored_pixels = [], 0
        if self._around is not None:
            self._check()

    def add_mirror(self, shown: FrameMemory) -> None:
        """Add the memory of a picture that a mirror shows."""
        self._of_mirrors += shown._uses
        self._mirrored_pixels += shown._pixels

    def add(self, use: Use) -> None:
        """Add memory that a pass found to need.

        Raises
        ------
        InvalidArgumentError
            The frame would exceed the limit.
        """
        self._of_maps.append(use)
        self._check()

    def add_maps(self, lights: Iterable[tuple[str, int, int]]) -> None:
        """Add shadow maps: for each light its kind, the number of maps, and texels per side.

        Raises
        ------
        InvalidArgumentError
            The frame would exceed the limit.
        """
        for (kind, maps, side), times in Counter(lights).items():
            size = _FLOAT * maps * side * side * times
            what = f"shadow maps of {side}x{side} ({times} of kind {kind}, {maps} maps each)"
            self._of_maps.append(Use(size, what, "a smaller shadow_map_size"))
        self._check()

    def add_exact(self, lights: int, soft: int, faces: int) -> None:
        """Add exact shadows of given numbers of faces, and of lights without and with a size.

        Raises
        ------
        InvalidArgumentError
            The frame would exceed the limit.
        """
        tree = _CASTER_OF_TREE if soft else 0
        size = faces * (_CASTER + lights * _CASTER_OF_LIGHT + tree)
        what = f"exact shadows ({lights + soft} lights, {faces} faces that may hide them)"
        self.add(Use(size, what, "shadow='map', or fewer nodes that cast shadows"))

    @property
    def _uses(self) -> list[Use]:
        return self._of_options + self._of_maps + self._of_mirrors

    @property
    def _pixels(self) -> int:
        return math.prod(self._size) + self._mirrored_pixels

    def _uses_of(self, width: int, height: int) -> list[Use]:
        planes = self._multiple or 1
        samples = width * height * self._axis**2 * planes
        uses = []
        if samples <= _MOST_KEPT:
            uses.append(Use(_KEPT_SAMPLE * samples, f"{samples} samples", "fewer samples"))
        if self._multiple:
            size = _TILE_PLANE * planes * self._threads
            what = f"multisampling by {self._threads} threads"
            uses.append(Use(size, what, "fewer samples or threads"))
        return uses

    def _check(self) -> None:
        uses, pixels, whole = self._uses, self._pixels, self
        while whole._around is not None:
            whole = whole._around
            uses, pixels = uses + whole._uses, pixels + whole._pixels
        width, height = whole._size
        total = sum(use.size for use in uses)
        limit = limits.MAX_FRAME_BYTES + BYTES_A_PIXEL * pixels
        if total <= limit:
            return
        largest = sorted((use for use in uses if use.size * _SHOWN >= total), reverse=True)
        parts = ", ".join(f"{_readable(use.size)} for {use.what}" for use in largest)
        raise InvalidArgumentError(
            f"a frame of {width}x{height} pixels may take {_readable(limit)} of memory beside its "
            f"outputs, not {_readable(total)}: {parts}. Choose {largest[0].advice}, or raise "
            "engine3d.rendering.options.MAX_FRAME_BYTES"
        )


def _check_outputs(outputs: tuple[str, ...], width: int, height: int) -> None:
    room = machine_memory()
    shapes = shapes_of(outputs, width, height).values()
    size = sum(dtype.itemsize * math.prod(shape) for shape, dtype in shapes)
    if room is not None and size > room:
        raise InvalidArgumentError(
            f"the outputs of a frame of {width}x{height} pixels take {_readable(size)}, but this "
            f"machine has {_readable(room)} of memory. Ask for fewer outputs, or fewer pixels"
        )


def _readable(size: int) -> str:
    """Return a number of bytes in MiB or GiB."""
    return f"{size / 2**30:.1f} GiB" if size >= 2**30 else f"{size / 2**20:.1f} MiB"
