"""Drawing user interfaces: lists of two-dimensional, textured triangles with scissor rectangles."""
