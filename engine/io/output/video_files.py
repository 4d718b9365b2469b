"""MP4 files: H.264 video, encoded by ffmpeg.

In: (H, W, 4) uint8 RGBA arrays. Out: a file, whole or not at all. ffmpeg is a separate program,
included in the package imageio-ffmpeg (``pip install engine3d[video]``); otherwise one on the PATH
is used. Videos have no alpha: transparent pictures are refused.
"""

from __future__ import annotations

import itertools
import os
import shutil
import subprocess
import tempfile
from collections.abc import Iterable
from typing import Any

import numpy as np

from ...base.files.atomic_write import atomic_write
from ...base.optional_packages import needed
from ...base.system import is_unread
from ...errors import FileAccessError, printable, warn
from ...rendering.transparency import refuse_transparency

#: Constant quality of x264: 18 is visually almost lossless.
QUALITY = 18
WAITS = 10.0


def find_ffmpeg(path: Any) -> str:
    """Return the path of ffmpeg.

    Parameters
    ----------
    path : path-like
        The video to write, for the error.

    Raises
    ------
    FileAccessError
        ffmpeg is missing; the text says what to install.
    """
    try:
        import imageio_ffmpeg

        return imageio_ffmpeg.get_ffmpeg_exe()
    except (ImportError, RuntimeError):
        program = shutil.which("ffmpeg")
    if program is None:
        message = needed("MP4 needs", "imageio-ffmpeg", "video")
        raise FileAccessError(f"cannot write: {message}", path)
    return program


def save_video(pictures: Iterable[np.ndarray], path: Any, seconds_a_frame: float) -> None:
    """Write a video.

    Parameters
    ----------
    pictures : iterable of (H, W, 4) ndarray of uint8
        At least one, all of one size; consumed one by one.
    path : path-like
    seconds_a_frame : float
        Duration of each picture.

    Raises
    ------
    FileAccessError
        There is no ffmpeg, or the file cannot be written.
    """
    program = find_ffmpeg(path)
    pictures = iter(pictures)
    first = next(pictures)
    height, width = first.shape[:2]
    even = width + width % 2, height + height % 2
    if even != (width, height):
        message = f"MP4 has even sides: {width}x{height} became {even[0]}x{even[1]}"
        warn(message)
    with atomic_write(path) as file, tempfile.TemporaryDirectory() as folder:
        temporary = os.path.join(folder, "video.mp4")
        command = [program, *_arguments(even, seconds_a_frame), temporary]
        _feed(command, itertools.chain([first], pictures), path)
        with open(temporary, "rb") as video:
            shutil.copyfileobj(video, file)


def _arguments(size: tuple[int, int], seconds_a_frame: float) -> list[str]:
    raw = ["-f", "rawvideo", "-pix_fmt", "rgb24", "-s", f"{size[0]}x{size[1]}"]
    video = ["-c:v", "libx264", "-crf", str(QUALITY), "-pix_fmt", "yuv420p"]
    colors = ["-vf", "scale=out_color_matrix=bt709:out_range=tv"]
    tags = ["-colorspace", "bt709", "-color_primaries", "bt709", "-color_trc", "bt709"]
    exact = ["-fflags", "+bitexact", "-flags:v", "+bitexact", "-movflags", "+faststart"]
    rate = ["-r", f"{1.0 / seconds_a_frame:.6g}"]
    return ["-v", "error", "-y", *raw, *rate, "-i", "-", *colors, *video, *tags, *exact]


def _feed(command: list[str], pictures: Iterable[np.ndarray], path: Any) -> None:
    """Run ffmpeg and feed it the pictures."""
    with tempfile.TemporaryFile() as said:
        process = subprocess.Popen(
            command, stdin=subprocess.PIPE, stdout=subprocess.DEVNULL, stderr=said
        )
        assert process.stdin is not None  # it was requested
        try:
            for pixels in pictures:
                refuse_transparency(pixels, ".mp4")
                process.stdin.write(_rgb(pixels))
            process.stdin.close()
            status = process.wait()
        except OSError as error:
            if not is_unread(error):
                raise
            status = process.wait(WAITS)
        finally:
            if process.poll() is None:
                process.kill()
                process.wait()
        if status != 0:
            said.seek(0)
            lines = said.read().decode("utf-8", "replace").strip().splitlines() or ["no reason"]
            raise FileAccessError(f"cannot write: ffmpeg says: {printable(lines[-1])}", path)


def _rgb(pixels: np.ndarray) -> bytes:
    """Return a picture's bytes without alpha; odd sides get their last row or column doubled."""
    height, width = pixels.shape[:2]
    odd = ((0, height % 2), (0, width % 2), (0, 0))
    return np.pad(pixels[..., :3], odd, mode="edge").tobytes()
