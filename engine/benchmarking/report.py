"""Rows of figures as lines of text, as a chart and as what JSON knows.

In:  rows of `measuring.measure` or `measuring.compare`. Out: text; a chart's bars.
"""

from __future__ import annotations

import os
import platform
from collections.abc import Iterable
from pathlib import Path

from .. import __version__

#: A picture is the peer's if coverage and mean colour differ by no more.
SAME_COVERED, SAME_MEAN = 0.002, 1.0


def machine() -> dict:
    """Return what the figures were measured on."""
    return {
        "engine3d": __version__,
        "machine": platform.machine(),
        "processor": _processor(),
        "cpus": len(os.sched_getaffinity(0)),
        "python": platform.python_version(),
        "system": platform.system(),
    }


def _processor() -> str:
    """The processor's name, as Linux knows it."""
    try:
        lines = Path("/proc/cpuinfo").read_text("utf-8", "replace").splitlines()
    except OSError:
        return platform.processor()
    names = [line.partition(":")[2].strip() for line in lines if line.startswith("model name")]
    return names[0] if names else platform.processor()


def heading(size, against: str | None) -> list[str]:
    """Return the lines above the table."""
    about = machine()
    picture = "plain picture" if against else "default picture"
    return [
        f"engine3d {about['engine3d']}, {about['processor']}, {about['cpus']} CPUs",
        f"{size[0]}x{size[1]}, {picture}, median milliseconds per frame, as an array",
    ]


def columns(against: bool) -> str:
    """Return the line of the table that names its columns."""
    first = f"{'workload':<15} {'backend':<9} {'threads':>7} {'ms':>8}"
    if against:
        return f"{first} {'peer ms':>9} {'times':>6}   covered, mean colour of both"
    stages = f"{'geometry':>8} {'raster':>8} {'shade':>8} {'resolve':>8}"
    return f"{first}   {stages}   {'Mtri/s':>8} {'Mpixel/s':>8}"


def line(row: dict) -> str:
    """Return a row as a line of the table."""
    first = (
        f"{row['workload']:<15} {row['backend']:<9} {row['threads']:>7} {row['milliseconds']:>8.2f}"
    )
    if "peer" in row:
        times = f"{row['peer']['milliseconds']:>9.2f} {row['times_as_fast']:>6.2f}"
        return f"{first} {times}   {_pictures(row)}"
    names = ("ms_geometry", "ms_raster", "ms_shade", "ms_resolve")
    stages = " ".join(f"{row[name]:>8.2f}" for name in names)
    triangles, pixels = row["triangles_per_second"] / 1e6, row["pixels_per_second"] / 1e6
    return f"{first}   {stages}   {triangles:>8.2f} {pixels:>8.1f}"


def _pictures(row: dict) -> str:
    texts = []
    for picture in (row["picture"], row["peer"]["picture"]):
        mean = " ".join(f"{value:.4g}" for value in picture["mean"])
        texts.append(f"{picture['covered']:.4f} ({mean})")
    return " ".join(texts) + ("" if same_picture(row) else "  the pictures differ")


def same_picture(row: dict) -> bool:
    """Return whether both drew the same, as far as coverage and mean tell."""
    ours, theirs = row["picture"], row["peer"]["picture"]
    covered = abs(ours["covered"] - theirs["covered"])
    means = zip(ours["mean"], theirs["mean"], strict=True)
    return covered <= SAME_COVERED and all(abs(a - b) <= SAME_MEAN for a, b in means)


def chart(rows: Iterable[dict]) -> tuple[str, list, list[str]]:
    """Return the title, the bars and their series, for `bar_chart.save`.

    Each workload is a group of bars: how many times as fast as the peer where there is one, else
    pictures per second.
    """
    rows = list(rows)
    against = any("peer" in row for row in rows)
    series = list(dict.fromkeys(_series(row) for row in rows))
    groups: dict[str, dict[str, float]] = {}
    for row in rows:
        value = row["times_as_fast"] if against else 1e3 / row["milliseconds"]
        groups.setdefault(row["workload"], {})[_series(row)] = value
    bars = [(name, [values.get(one) for one in series]) for name, values in groups.items()]
    title = "frames per second"
    if against:
        title = f"times as fast as {next(row['peer']['name'] for row in rows if 'peer' in row)}"
    return title, bars, series


def _series(row: dict) -> str:
    return f"{row['backend']} x{row['threads']}"
