"""Animation files: GIF, animated WebP, APNG, MP4, or numbered pictures.

In: (H, W, 4) uint8 RGBA arrays. Out: a file that loops forever (for MP4, the player decides),
written to a temporary file and renamed when complete; or numbered pictures. Pillow encodes; it is
imported on first use. `Frame.save` writes single pictures.
"""

from __future__ import annotations

import os
from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

import numpy as np

from ...base.files.atomic_write import atomic_write
from ...rendering.frame import Frame
from .frame_names import frame_name

if TYPE_CHECKING:
    from pathlib import Path

#: Extensions of pictures that `Frame.save` writes.
PICTURE_SUFFIXES = (".png", ".jpg", ".jpeg", ".tga", ".webp")
OPAQUE_SUFFIXES = (".jpg", ".jpeg")
#: Pillow's name of each animated format.
ANIMATION_FORMATS = {".gif": "GIF", ".webp": "WEBP", ".apng": "PNG"}
VIDEO_SUFFIX = ".mp4"
ANIMATION_SUFFIXES = (*ANIMATION_FORMATS, VIDEO_SUFFIX)
WEBP_QUALITY = 90
TRANSPARENT_INDEX = 255
#: GIF players treat shorter durations as errors and show a tenth of a second instead.
SHORTEST_MILLISECONDS = 20


def save_animation(pictures: Iterable[np.ndarray], path: Any, seconds_a_frame: float) -> None:
    """Write an endless animation in the format of the path's extension.

    Parameters
    ----------
    pictures : iterable of (H, W, 4) ndarray of uint8
        At least one; consumed one by one, so they may be drawn on demand.
    path : path-like
        Ends in one of `ANIMATION_SUFFIXES`; or a picture's name with a place for the frame number
        (`frame_name`): then each frame is a file, from number 0.
    seconds_a_frame : float
        Duration of each picture.

    Raises
    ------
    FileAccessError
        A file cannot be written, or ffmpeg for MP4 is missing.
    """
    path = frame_name(path)
    if path.place is not None:
        for number, pixels in enumerate(pictures):
            height, width = pixels.shape[:2]
            Frame((width, height), {"color": pixels}).save(path.of_frame(number))
        return
    suffix = os.path.splitext(path)[1].lower()
    if suffix == VIDEO_SUFFIX:
        from .video_files import save_video  # here: what runs programs takes milliseconds to import

        save_video(pictures, path, seconds_a_frame)
    else:
        _save_images(pictures, path, ANIMATION_FORMATS[suffix], seconds_a_frame)


def _save_images(
    pictures: Iterable[np.ndarray], path: Any, image_format: str, seconds_a_frame: float
) -> None:
    images = (_image(pixels) for pixels in pictures)
    if image_format == "GIF":
        images = (_with_palette(image) for image in images)
    first, *others = images
    milliseconds = max(SHORTEST_MILLISECONDS, round(seconds_a_frame * 1000))
    options = {"save_all": True, "append_images": others, "loop": 0, "duration": milliseconds}
    if image_format == "GIF":
        options |= {"disposal": 2, "optimize": False}
    if image_format == "WEBP":
        options |= {"quality": WEBP_QUALITY, "method": 2}
    with atomic_write(path) as file:
        first.save(file, image_format, **options)


def numbered_path(folder: Path, stem: str, suffix: str) -> Path:
    """Return ``folder/stem-NNN.suffix`` with the first unused number."""
    number = 1
    while (path := folder / f"{stem}-{number:03d}{suffix}").exists():
        number += 1
    return path


def _image(pixels: np.ndarray) -> Any:
    """Return a Pillow image: RGB if every pixel is opaque, else RGBA."""
    from PIL import Image

    if (pixels[..., 3] == 255).all():
        return Image.fromarray(np.ascontiguousarray(pixels[..., :3]))
    return Image.fromarray(np.ascontiguousarray(pixels))


def _with_palette(image: Any) -> Any:
    """Return ``image`` with its own 256-colour palette for GIF; the last may be transparent."""
    from PIL import Image

    if image.mode == "RGB":
        return _dithered(image, 256)
    colors = _dithered(image.convert("RGB"), TRANSPARENT_INDEX)
    indices = np.array(colors)
    indices[np.asarray(image)[..., 3] < 128] = TRANSPARENT_INDEX
    result = Image.frombytes("P", image.size, indices.tobytes())
    result.putpalette(colors.getpalette())
    result.info["transparency"] = TRANSPARENT_INDEX
    return result


def _dithered(image: Any, count: int) -> Any:
    """Return an RGB image in ``count`` colours, by the Pillow method with least banding."""
    from PIL import Image

    palette = image.quantize(count, method=Image.Quantize.MAXCOVERAGE)
    return image.quantize(palette=palette, dither=Image.Dither.FLOYDSTEINBERG)
