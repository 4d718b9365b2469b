"""The patterns of common LiDARs as plain numbers, in degrees, metres and hertz.

Elevations are nominal, from the lowest beam up; each unit's calibration differs by some hundredths
of a degree. All beams start in one point here: the few centimetres between a real sensor's lasers
are left out. Sources: the makers' data sheets and manuals (Velodyne VLP-16 63-9243, VLP-32C
63-9325, HDL-32E 63-9113, HDL-64E S2 63-HDL64ES2; Ouster OS0, OS1, OS2, revisions 6 and 7).
"""

from __future__ import annotations

from typing import NamedTuple


class Pattern(NamedTuple):
    """A spinning sensor's pattern.

    Attributes
    ----------
    elevations : tuple of float
        Degrees above the horizon, a beam each, from the lowest up.
    offsets : tuple of float
        Degrees by which each beam looks to the right of the column; empty: none.
    steps : int
        Columns of a turn, at ``rate``.
    rate : float
        Turns a second.
    least, most : float
        The nearest and farthest distances that give a return, in metres.
    """

    elevations: tuple[float, ...]
    offsets: tuple[float, ...]
    steps: int
    rate: float
    least: float
    most: float


def _even(low: float, high: float, count: int) -> tuple[float, ...]:
    return tuple(low + (high - low) * k / (count - 1) for k in range(count))


# The VLP-32C's beams are close together around the horizon, and look to four sides.
_VLP_32C = (
    (-25.0, 1.4), (-15.639, -1.4), (-11.31, 1.4), (-8.843, -1.4), (-7.254, 1.4), (-6.148, -1.4),
    (-5.333, 4.2), (-4.667, 1.4), (-4.0, -1.4), (-3.667, -4.2), (-3.333, 4.2), (-3.0, 1.4),
    (-2.667, -1.4), (-2.333, -4.2), (-2.0, 4.2), (-1.667, 1.4), (-1.333, -1.4), (-1.0, -4.2),
    (-0.667, 4.2), (-0.333, 1.4), (0.0, -1.4), (0.333, -4.2), (0.667, 4.2), (1.0, 1.4),
    (1.333, -1.4), (1.667, -4.2), (2.333, 1.4), (3.333, -1.4), (4.667, 1.4), (7.0, -1.4),
    (10.333, 1.4), (15.0, -1.4),
)  # fmt: skip

#: The patterns by the names that `Lidar.of` takes.
PATTERNS = {
    "vlp-16": Pattern(_even(-15.0, 15.0, 16), (), 1800, 10.0, 0.5, 100.0),
    "hdl-32e": Pattern(_even(-30.67, 10.67, 32), (), 2172, 10.0, 1.0, 100.0),
    "vlp-32c": Pattern(
        tuple(elevation for elevation, _ in _VLP_32C),
        tuple(offset for _, offset in _VLP_32C),
        1800, 10.0, 1.0, 200.0,
    ),
    # Two blocks of 32 lasers: half a degree apart below, a third of a degree above.
    "hdl-64e": Pattern(
        _even(-24.33, -8.83, 32) + _even(-8.33, 2.0, 32), (), 2083, 10.0, 0.9, 120.0
    ),
    "os0-32": Pattern(_even(-45.0, 45.0, 32), (), 1024, 10.0, 0.5, 75.0),
    "os0-64": Pattern(_even(-45.0, 45.0, 64), (), 1024, 10.0, 0.5, 75.0),
    "os0-128": Pattern(_even(-45.0, 45.0, 128), (), 1024, 10.0, 0.5, 75.0),
    "os1-32": Pattern(_even(-22.5, 22.5, 32), (), 1024, 10.0, 0.5, 170.0),
    "os1-64": Pattern(_even(-22.5, 22.5, 64), (), 1024, 10.0, 0.5, 170.0),
    "os1-128": Pattern(_even(-22.5, 22.5, 128), (), 1024, 10.0, 0.5, 170.0),
    "os2-64": Pattern(_even(-11.25, 11.25, 64), (), 1024, 10.0, 0.8, 350.0),
    "os2-128": Pattern(_even(-11.25, 11.25, 128), (), 1024, 10.0, 0.8, 350.0),
}  # fmt: skip
