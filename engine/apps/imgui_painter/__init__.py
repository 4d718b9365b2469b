"""Draws user interfaces: lists of textured 2-D triangles with scissor rectangles."""
