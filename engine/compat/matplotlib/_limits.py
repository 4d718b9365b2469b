"""Points that mplot3d does not show: beyond the axes' limits, or where a logarithm has no value."""

from __future__ import annotations

import numpy as np
from mpl_toolkits.mplot3d import art3d


def hidden_points(points: np.ndarray, artist) -> np.ndarray | None:
    """Return which points, (..., 3), are hidden, or None if none is."""
    xyz = points[..., 0], points[..., 1], points[..., 2]
    axes, hidden = artist.axes, None
    if any(axis.get_scale() != "linear" for axis in axes._axis_map.values()):
        hidden = art3d._scale_invalid_mask(*xyz, axes)
    if getattr(artist, "_axlim_clip", False):
        beyond = art3d._viewlim_mask(*xyz, axes)
        hidden = beyond if hidden is None else hidden | beyond
    return None if hidden is None else np.ma.filled(hidden, True)


def shown_points(points: np.ndarray, artist) -> np.ndarray:
    """Return points, those that are hidden as not a number."""
    hidden = hidden_points(points, artist)
    if hidden is not None and hidden.any():
        points = points.copy()
        points[hidden] = np.nan
    return points
