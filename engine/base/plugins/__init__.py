"""Packages that extend engine3d by entry points: found by name, imported on first use."""
