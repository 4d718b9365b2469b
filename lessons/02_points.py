"""From numbers to pixels: the vertices of a model as points.

The simplest camera of all: leave out z, scale x and y so that the model fits, and turn y over, for
it grows upward in space and downward in a picture.
"""

import engine3d as e3d
from lesson import MODELS, blank, earlier, main, told

lists = earlier("01_lists")
TEAPOT = MODELS / "teapot.obj"
PAPER, DOT, FRONT, BACK = (30, 33, 40), (255, 200, 0), (255, 235, 160), (70, 80, 110)


def put_point(picture, x, y, color):
    """Colour the pixel that holds the point (x, y), unless it lies outside of the picture."""
    height, width = picture.shape[:2]
    column, row = int(x // 1), int(y // 1)
    if 0 <= column < width and 0 <= row < height:
        picture[row, column] = color


def fit(vertices, width, height, margin=0.05):
    """Return the scale and the middle that make a model fill a picture: s, (x, y)."""
    low = [min(vertex[k] for vertex in vertices) for k in (0, 1)]
    high = [max(vertex[k] for vertex in vertices) for k in (0, 1)]
    spans = [(high[k] - low[k]) or 1.0 for k in (0, 1)]
    scale = min(width / spans[0], height / spans[1]) * (1 - 2 * margin)
    return scale, [(low[k] + high[k]) / 2 for k in (0, 1)]


def to_screen(vertex, scale, middle, width, height):
    """Return the place of a vertex in the picture, in pixels from its top left corner."""
    x = width / 2 + scale * (vertex[0] - middle[0])
    y = height / 2 - scale * (vertex[1] - middle[1])
    return x, y


def about_vertical(vertices, yaw):
    """Return the vertices turned about the vertical axis, by radians."""
    c, s = e3d.linalg.cos(yaw), e3d.linalg.sin(yaw)
    return [(x * c + z * s, y, z * c - x * s) for x, y, z in vertices]


def steps(width=240, height=180, model=TEAPOT, yaw=0.0):
    vertices = about_vertical(lists.read_lists(model)["v"], yaw)

    picture = blank(width, height)
    for x, y, _ in vertices:
        put_point(picture, x, y, DOT)
    yield told("{count} vertices, their x and y taken for pixels", count=len(vertices)), picture

    scale, middle = fit(vertices, width, height)
    picture = blank(width, height)
    for x, y, _ in vertices:
        x = width / 2 + scale * (x - middle[0])
        put_point(picture, x, height / 2 + scale * (y - middle[1]), DOT)
    yield "scaled and moved, but y grows downward", picture

    picture = blank(width, height)
    for vertex in vertices:
        put_point(picture, *to_screen(vertex, scale, middle, width, height), DOT)
    yield "y turned over", picture

    picture = blank(width, height)
    near = max(z for _, _, z in vertices)
    far = min(z for _, _, z in vertices)
    for vertex in sorted(vertices, key=lambda vertex: vertex[2]):
        t = (vertex[2] - far) / ((near - far) or 1.0)
        color = [round(b + t * (f - b)) for f, b in zip(FRONT, BACK, strict=True)]
        put_point(picture, *to_screen(vertex, scale, middle, width, height), color)
    yield "z left out of the place, but shown as brightness", picture


if __name__ == "__main__":
    main(__file__, steps)
