"""Line drawings of vectors: visible, hidden and outline edges, as SVG and PDF.

`line_drawing` draws a scene for a camera, `drawing_sheet` a model from several sides on a page.
"""
