"""Lights that shine from a surface: rectangles, discs and tubes."""

from .model.scene.lights import DiscLight, RectangleLight, TubeLight

__all__ = ["DiscLight", "RectangleLight", "TubeLight"]
