"""Benchmark figures and the machine's description as text.

In:  rows of `measuring.measure`. Out: text.
"""

from __future__ import annotations

import platform
import re
import sys
from pathlib import Path

from ... import __version__
from ...base.system import answer_of, usable_processors

#: Where Linux describes the processor.
CPUINFO = "/proc/cpuinfo"


def machine() -> dict:
    """Return the description of the measured machine."""
    return {
        "engine3d": __version__,
        "machine": platform.machine(),
        "processor": _processor(),
        "cpus": usable_processors(),
        "python": platform.python_version(),
        "system": platform.system(),
    }


def _processor() -> str:
    """Return the processor's name, as the system tells it, or else its kind."""
    return _told_processor() or platform.processor() or platform.machine() or "unknown processor"


def _told_processor() -> str:
    """Return what Linux or macOS says; elsewhere nothing."""
    if sys.platform == "darwin":  # platform.processor() says "arm" there
        return answer_of("/usr/sbin/sysctl", "-n", "machdep.cpu.brand_string")
    name = re.search(r"^model name.*?:(.*)", cpuinfo(), re.MULTILINE)
    return name[1].strip() if name else ""


def cpuinfo() -> str:
    """Return how Linux describes its processors; nothing elsewhere."""
    try:
        return Path(CPUINFO).read_text("utf-8", "replace")
    except OSError:
        return ""


def heading(size, picture: str = "default") -> list[str]:
    """Return the lines above the table; `picture` is default or plain, as in `workloads`."""
    about = machine()
    return [
        f"engine3d {about['engine3d']}, {about['processor']}, {about['cpus']} CPUs",
        f"{size[0]}x{size[1]}, {picture} picture, median milliseconds per frame, as an array",
    ]


def columns() -> str:
    """Return the table's header line."""
    first = f"{'workload':<15} {'backend':<9} {'threads':>7} {'ms':>8}"
    stages = f"{'geometry':>8} {'raster':>8} {'shade':>8} {'resolve':>8}"
    return f"{first}   {stages}   {'Mtri/s':>8} {'Mpixel/s':>8}"


def line(row: dict) -> str:
    """Return a row as a line of the table."""
    first = (
        f"{row['workload']:<15} {row['backend']:<9} {row['threads']:>7} {row['milliseconds']:>8.2f}"
    )
    names = ("ms_geometry", "ms_raster", "ms_shade", "ms_resolve")
    stages = " ".join(f"{row[name]:>8.2f}" for name in names)
    triangles, pixels = row["triangles_per_second"] / 1e6, row["pixels_per_second"] / 1e6
    return f"{first}   {stages}   {triangles:>8.2f} {pixels:>8.1f}"
