"""Triangles in clip space, drawn without a scene or a camera."""

from .rendering.rasterization import RasterizeResult, rasterize

__all__ = ["RasterizeResult", "rasterize"]
