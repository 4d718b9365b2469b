"""Settings of this module that pyrender lacks.

Each setting is read whenever a picture is drawn, and may be set by an environment variable before
the module is imported.
"""

from __future__ import annotations

import os

from ...errors import InvalidArgumentError
from ._held import held

_SAMPLES = (1, 4)


def _checked_samples(value) -> int:
    if value not in _SAMPLES:
        raise InvalidArgumentError(f"samples must be 1 or 4, not {value!r}")
    return int(value)


def _one_of(name: str, usual: str) -> property:
    """Return a property with the values `usual` and "pyrender"."""

    def made(value) -> str:
        if value not in (usual, "pyrender"):
            raise InvalidArgumentError(f'{name} must be "{usual}" or "pyrender", not {value!r}')
        return value

    return held(name, made, f'"{usual}" or "pyrender".')


class Settings:
    """The settings of the process.

    Attributes
    ----------
    samples : {4, 1}
        Samples of a pixel's colour: 4 as pyrender has them, or 1, at the centre.
        ``ENGINE3D_PYRENDER_SAMPLES``.
    orthographic_depth : {"metric", "pyrender"}
        What depths of an `OrthographicCamera` are: distances along the view axis, or the numbers
        that pyrender's formula for perspectives makes of them.
        ``ENGINE3D_PYRENDER_ORTHOGRAPHIC_DEPTH``.
    depth_place : {"centre", "pyrender"}
        Where in a pixel of four samples its depth is found: at the centre, as programs take it, or
        at the first sample, 1/8 pixel to the left and 3/8 below, as pyrender with EGL has it. With
        one sample, and with ``SEG``, it is at the centre.
        ``ENGINE3D_PYRENDER_DEPTH_PLACE``.
    """

    def __init__(self) -> None:
        environment = os.environ
        samples = environment.get("ENGINE3D_PYRENDER_SAMPLES") or "4"
        self.samples = int(samples) if samples.isdecimal() else samples
        self.orthographic_depth = (
            environment.get("ENGINE3D_PYRENDER_ORTHOGRAPHIC_DEPTH") or "metric"
        )
        self.depth_place = environment.get("ENGINE3D_PYRENDER_DEPTH_PLACE") or "centre"

    samples = held("samples", _checked_samples, "Samples of a pixel's colour, 4 or 1.")
    orthographic_depth = _one_of("orthographic_depth", "metric")
    depth_place = _one_of("depth_place", "centre")


settings = Settings()
