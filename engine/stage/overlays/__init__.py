"""Overlays on a picture: axes, grids, labels, scales, counts."""
