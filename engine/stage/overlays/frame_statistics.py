"""The statistics of frames in the words of courses: how fast, and what was drawn of all there is.

In: the times of recent frames, and `Frame.stats`. Out: lines of text. The times of a frame add up:
what the core draws, the rest of the drawing, the wait for the screen.
"""

from __future__ import annotations

from typing import Any

from .draw_counts import count_names, count_table, told_tests
from .frame_times import FrameTimes

#: Milliseconds of the core's stages in the last frame, and other counters that are listed.
_STAGES = ("geometry", "raster", "shade", "resolve")
_LISTED = ("pixels_shaded", "materials", "lights", "shadow_maps", "threads", "backend")


def short_statistics(times: FrameTimes, stats: dict[str, Any]) -> str:
    """Return a one-line summary of the last frame's statistics."""
    drawn, total = stats["triangles_drawn"], stats["triangles"]
    parts = [f"{times.drawing_seconds * 1000:.1f} ms to draw", f"{drawn:,} of {total:,} triangles"]
    if times.count > 1:
        parts.insert(0, f"{1.0 / times.seconds:.0f} frames per second")
    return ", ".join(parts)


def statistics_lines(
    times: FrameTimes,
    size: tuple[int, int],
    samples: int,
    stats: dict[str, Any],
    place: str = "",
    culling: str = "all",
) -> list[str]:
    """Return the statistics of the last frame, line by line; tables are 46 characters wide.

    Parameters
    ----------
    times : FrameTimes
        Of the recent frames.
    size : (int, int)
        Width and height in pixels.
    samples : int
        Samples a pixel.
    stats : dict
        `Frame.stats`: counters and milliseconds of each stage.
    place : str
        Where the camera is.
    culling : str
        The culling method.
    """
    lines = _time_lines(times)
    lines.append(f"{size[0]}x{size[1]}" + (f", {samples} samples per pixel" * (samples > 1)))
    lines += [place] * bool(place)
    if count_names() <= stats.keys():
        lines += ["", *count_table(stats), "", told_tests(stats, culling)]
    stages = [name for name in _STAGES if f"ms_{name}" in stats]
    if stages:
        lines += ["", "last frame in the core"]
        lines += [_entry(name, f"{stats[f'ms_{name}']:.2f} ms") for name in stages]
    listed = [name for name in _LISTED if name in stats]
    return [*lines, "", *(_entry(name.replace("_", " "), _number(stats[name])) for name in listed)]


def _time_lines(times: FrameTimes) -> list[str]:
    """Return how many frames a second, and what one takes: the parts add up to the whole."""
    whole, drawing, core = times.seconds, times.drawing_seconds, times.core_seconds
    rate = f"{1.0 / whole:.1f} fps" if times.count > 1 and whole > 0.0 else "one frame"
    parts = {
        rate: whole,
        "  core": min(core, drawing),
        "  rest of drawing": drawing - min(core, drawing),
        "  to the screen": whole - drawing,
    }
    return [_entry(name, f"{1000 * seconds:.2f} ms") for name, seconds in parts.items()]


def _entry(name: str, text: str) -> str:
    return f"{name:<22}{text:>12}"


def _number(value: object) -> str:
    return f"{value:,}" if isinstance(value, int) else str(value)
