"""Line drawings of vectors: visible, hidden and outline edges, as SVG and PDF."""

from .apps.drawings.drawing_sheet import DrawingSheet, drawing_sheet
from .apps.drawings.line_drawing import LineDrawing, line_drawing

__all__ = ["DrawingSheet", "LineDrawing", "drawing_sheet", "line_drawing"]
