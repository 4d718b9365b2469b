"""The public function that saves animations.

In: frames, or their pixels, in drawing order. Out: an animated file, whole or not at all.
`animation_files` encodes; this module checks the arguments.
"""

from __future__ import annotations

import math
import numbers
import os
from collections.abc import Iterable, Iterator

import numpy as np
from numpy.typing import NDArray

from ...base.calls import checks_types
from ...base.files.atomic_write import checked_path
from ...base.numbers import as_array
from ...errors import InvalidArgumentError
from ...rendering.frame import Frame
from . import animation_files
from .frame_names import frame_name


@checks_types
def save_animation(
    frames: Iterable[Frame | NDArray[np.uint8]],
    path: str | os.PathLike[str],
    *,
    fps: float = 25.0,
) -> None:
    """Write frames to an animated file, whole or not at all, or to numbered pictures.

    Parameters
    ----------
    frames : iterable of Frame or of (H, W, 4) uint8
        At least one, all of one size. A frame contributes its colour; an array is RGBA, top row
        first. They are consumed one by one, so a generator may draw them.
    path : str or path-like
        The suffix decides the format: .gif, .webp and .apng repeat forever; .mp4 needs ``pip
        install engine3d[video]``, drops alpha, and requires even sides (a warning says if a row or
        column is doubled). A picture's name with a place for a number, such as ``frame_{:04}.png``
        or ``frame_%04d.png``, writes a picture for each frame, from number 0; ``{{:04}}`` and
        ``%%04d`` are literal.
    fps : float
        Frames per second, above 0 and at most 50, since GIF players are no faster; at most 240 for
        .mp4.

    Raises
    ------
    InvalidArgumentError
        The suffix is unknown, there is no frame, or the frames differ in size.
    FileAccessError
        The file cannot be written, or ffmpeg for MP4 is missing.
    """
    path = frame_name(checked_path(path))
    numbered = path.place is not None
    formats = animation_files.PICTURE_SUFFIXES if numbered else animation_files.ANIMATION_SUFFIXES
    suffix = os.path.splitext(path)[1].lower()
    if suffix not in formats:
        what = "a numbered picture" if numbered else "an animation"
        raise InvalidArgumentError(
            f"{what}'s suffix is one of {', '.join(formats)}, not {suffix!r}"
        )
    most = 240.0 if suffix == animation_files.VIDEO_SUFFIX else 50.0
    if not isinstance(fps, numbers.Real) or not 0.0 < fps <= most or not math.isfinite(1.0 / fps):
        raise InvalidArgumentError(f"fps must be greater than 0 and at most {most:g}, not {fps!r}")
    if isinstance(frames, Frame) or not isinstance(frames, Iterable):
        raise InvalidArgumentError(f"frames must be an iterable of frames, not {frames!r}")
    animation_files.save_animation(_pictures(frames), path, 1.0 / float(fps))


def _pictures(frames: Iterable[Frame | NDArray[np.uint8]]) -> Iterator[NDArray[np.uint8]]:
    """Yield the pixels of frames, checked."""
    shape = None
    for frame in frames:
        pixels = frame.color if isinstance(frame, Frame) else as_array(frame, "a frame")
        if pixels.dtype != np.uint8 or pixels.ndim != 3 or pixels.shape[2] != 4:
            raise InvalidArgumentError(
                f"a frame must be a Frame or (H, W, 4) uint8, not {pixels.shape} {pixels.dtype}"
            )
        if pixels.shape != (shape or pixels.shape):
            raise InvalidArgumentError(
                f"the frames of an animation must have one size: {shape} and {pixels.shape}"
            )
        shape = pixels.shape
        yield pixels
    if shape is None:
        raise InvalidArgumentError("an animation needs at least one frame")
