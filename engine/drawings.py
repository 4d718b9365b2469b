"""Line drawings of vectors: visible, hidden and outline edges, as SVG and PDF."""

from .apps.drawings.line_drawing import LineDrawing, line_drawing
from .apps.drawings.drawing_sheet import DrawingSheet, drawing_sheet

__all__ = ["DrawingSheet", "LineDrawing", "drawing_sheet", "line_drawing"]
