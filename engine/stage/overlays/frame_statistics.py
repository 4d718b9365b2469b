"""The statistics of frames in the words of courses: how fast, and what was drawn of all there is.

In: the times of recent frames, and `Frame.stats`. Out: lines of text. The times of a frame add up:
what the core draws, the rest of the drawing, the wait for the screen.
"""

from __future__ import annotations

from typing import Any

from ...base.language import translated, translated_number
from .draw_counts import count_names, count_table, told_tests
from .frame_times import FrameTimes

#: Milliseconds of the core's stages in the last frame, and other counters that are listed.
_STAGES = ("geometry", "raster", "shade", "resolve")
_LISTED = ("pixels_shaded", "materials", "lights", "shadow_maps", "threads", "backend")


def short_statistics(times: FrameTimes, stats: dict[str, Any]) -> str:
    """Return a one-line summary of the last frame's statistics."""
    drawn, total = stats["triangles_drawn"], stats["triangles"]
    parts = [
        translated("{ms:.1f} ms to draw", ms=times.drawing_seconds * 1000),
        translated("{drawn:,} of {total:,} triangles", drawn=drawn, total=total),
    ]
    if times.rate:
        parts.insert(0, translated("{rate:.0f} frames per second", rate=times.rate))
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
    lines.append(f"{size[0]}x{size[1]}")
    if samples > 1:
        lines[-1] += translated(", {count} samples per pixel", count=samples)
    lines += [place] * bool(place)
    if count_names() <= stats.keys():
        lines += ["", *count_table(stats), "", told_tests(stats, culling)]
    stages = [name for name in _STAGES if f"ms_{name}" in stats]
    if stages:
        lines += ["", translated("last frame in the core")]
        lines += [_entry(translated(name), _milliseconds(stats[f"ms_{name}"])) for name in stages]
    listed = [name for name in _LISTED if name in stats]
    return [
        *lines,
        "",
        *(_entry(translated(name.replace("_", " ")), _number(stats[name])) for name in listed),
    ]


def _time_lines(times: FrameTimes) -> list[str]:
    """Return how many frames a second, and what one takes: the parts add up to the whole."""
    whole, drawing, core = times.seconds, times.drawing_seconds, times.core_seconds
    parts = {
        _rate(times): whole,
        "  " + translated("core"): min(core, drawing),
        "  " + translated("rest of drawing"): drawing - min(core, drawing),
        "  " + translated("to the screen"): whole - drawing,
    }
    return [_entry(name, _milliseconds(1000 * seconds)) for name, seconds in parts.items()]


def _rate(times: FrameTimes) -> str:
    return translated("{rate:.1f} fps", rate=times.rate) if times.rate else translated("one frame")


def _entry(name: str, text: str) -> str:
    return f"{name:<22}{text:>12}"


def _milliseconds(value: float) -> str:
    return f"{translated_number(value, '.2f')} ms"


def _number(value: object) -> str:
    return translated_number(value, ",") if isinstance(value, int) else str(value)
