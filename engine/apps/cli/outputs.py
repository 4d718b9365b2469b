"""Checks outputs before any work; also folders, and progress bars of long work.

In: the value of ``-o``. Out: its extension, or a usage error that lists the supported ones; its
folder, created when the first file is written.
"""

from __future__ import annotations

import errno
import os
import sys
from collections.abc import Callable, Iterable, Iterator

from ...base.files.folders_above import folders_above
from ...base.system import is_unread
from ...errors import FileAccessError
from . import quietness
from .usage import UsageError

STANDARD_OUTPUT = "-"
TERMINAL = "terminal:"
#: Work with fewer frames gets no progress bar.
FEW_FRAMES = 8
#: GIFs above this size in bytes get a remark.
LARGE_GIF = 4_000_000


def check_output(output: str, formats: Iterable[str], what: str) -> str:
    """Return the extension of ``output``.

    Raises `UsageError` if it names no format, `FileAccessError` if its folder cannot be made.
    """
    extension = os.path.splitext(output)[1]
    if extension.lower() not in tuple(formats):
        named = f"{extension!r} in {output!r}" if extension else f"{output!r} has none and"
        known = ", ".join(formats)
        raise UsageError(f"{what} needs one of the extensions {known}; {named} is not one of them")
    check_folder(output)
    return extension


def check_animation(output: str, *, transparent: bool = False) -> None:
    """Raise, before any work, if an animation cannot be written to ``output``."""
    from ...io.output.animation_files import (
        ANIMATION_SUFFIXES,
        OPAQUE_SUFFIXES,
        PICTURE_SUFFIXES,
        VIDEO_SUFFIX,
    )
    from ...io.output.frame_names import frame_name

    if frame_name(output).place is not None:
        extension = check_output(output, PICTURE_SUFFIXES, "a numbered picture").lower()
    else:
        extension = check_output(output, ANIMATION_SUFFIXES, "an animation").lower()
    if transparent and extension in (*OPAQUE_SUFFIXES, VIDEO_SUFFIX):
        raise UsageError(f"--no-background needs transparency, which {extension} lacks")
    if extension == VIDEO_SUFFIX:  # last: nobody should install ffmpeg and then be refused
        from ...io.output.video_files import find_ffmpeg

        find_ffmpeg(output)


def check_picture(output: str, *, transparent: bool = False, series: str) -> None:
    """Raise, before any work, if a picture cannot be written; ``series`` makes several."""
    from ...io.output.animation_files import OPAQUE_SUFFIXES, PICTURE_SUFFIXES
    from ...io.output.frame_names import frame_name

    if frame_name(output).place is not None:
        raise UsageError(f"{output!r} has a place for numbers: several pictures come of {series}")
    extension = check_output(output, PICTURE_SUFFIXES, "a picture").lower()
    if transparent and extension in OPAQUE_SUFFIXES:
        raise UsageError(f"--no-background needs transparency, which {extension} lacks")


def check_folder(output: str) -> None:
    """Raise `FileAccessError` if ``output`` has no folder and none can be created.

    `make_folder_of` creates it when something is written, so that failures leave no empty folder.
    """
    wanted = os.path.dirname(os.path.abspath(output))
    folder = next(filter(os.path.lexists, folders_above(wanted)), None)
    number = 0
    if folder is None:  # not even the drive is there
        number = errno.ENOENT
    elif not os.path.isdir(folder):
        number = errno.ENOENT if os.path.islink(folder) else errno.ENOTDIR
    elif folder != wanted and not os.access(folder, os.W_OK | os.X_OK):
        number = errno.EACCES
    if number:
        raise FileAccessError(f"cannot write: {os.strerror(number)}", output)


def remark_on_size(output: str) -> None:
    """Suggest smaller formats after writing a large GIF."""
    if not output.lower().endswith(".gif") or os.path.getsize(output) < LARGE_GIF:
        return
    size = os.path.getsize(output) / 1e6
    quietness.remark(f"{output} has {size:.1f} MB: as .webp it would be many times smaller")


def not_the_output(output: str | None) -> Callable[[str], bool]:
    """Return a test that a path is not the output file."""
    return lambda path: output is None or not is_same_file(path, output)


def is_same_file(path: str, output: str) -> bool:
    """Return whether ``output``, or standard output for ``-``, is the file ``path``."""
    try:
        written = sys.stdout.fileno() if output == STANDARD_OUTPUT else output
        return os.path.samestat(os.stat(path), os.stat(written))
    except (OSError, ValueError):
        return False  # it does not exist yet


def check_standard_output() -> None:
    """Raise `UsageError` if binary output would go to a terminal."""
    if sys.stdout.isatty():
        raise UsageError("-o - would write to the terminal; redirect standard output")


def write_standard_output(data: bytes) -> None:
    """Write all of ``data`` to standard output, which may accept less at a time."""
    rest = memoryview(data)
    try:
        while rest:
            rest = rest[sys.stdout.buffer.write(rest) :]
        sys.stdout.buffer.flush()
    except OSError as error:
        if is_unread(error):
            raise
        raise FileAccessError(f"cannot write: {error.strerror}", "standard output") from error


def with_progress(items: Iterable, total: int, label: str) -> Iterator:
    """Yield the items; show a progress bar if there are many and a terminal."""
    if total < FEW_FRAMES or not quietness.shows_progress():
        yield from items
        return
    from rich.console import Console
    from rich.progress import Progress

    with Progress(console=Console(stderr=True), transient=True) as progress:
        yield from progress.track(items, total=total, description=label)
