"""The y-buffer: hidden lines in two dimensions, three triangles cut by a plane.

A horizontal plane cuts each triangle in a segment. Seen from the front, a row of the picture is all
that is left of the segments; a buffer of one depth per column decides which one shows where.
"""

from math import ceil

from lesson import DIFFER, blank, earlier, main, told

faces_of = earlier("06_random_colors")
lines = earlier("03_lines")
light = earlier("07_light")
COLORS = ((240, 90, 80), (90, 170, 250), (255, 200, 0))
FAR = float("-inf")


def scene(width, height):
    """Return three triangles on the screen: x, y, and z, which is larger when nearer."""
    shapes = (
        ((0.08, 0.2, 0.2), (0.75, 0.85, 0.35), (0.1, 0.9, 0.3)),
        ((0.25, 0.85, 0.9), (0.5, 0.08, 0.1), (0.9, 0.9, 0.05)),
        ((0.45, 0.25, 0.55), (0.95, 0.15, 0.8), (0.85, 0.8, 0.6)),
    )
    return [[(x * width, y * height, z * height) for x, y, z in shape] for shape in shapes]


def cut(corners, y):
    """Return the segment in which the plane at height y cuts a triangle: two (x, z), or None."""
    ends = []
    for a, b in zip(corners, corners[1:] + corners[:1], strict=True):
        if (a[1] <= y) != (b[1] <= y):
            t = (y - a[1]) / (b[1] - a[1])
            ends.append((a[0] + t * (b[0] - a[0]), a[2] + t * (b[2] - a[2])))
    return sorted(ends) if ends else None


def add_segment(ybuffer, row, segment, color):
    """Draw a segment into one row, where it is nearer than what the buffer holds."""
    (x0, z0), (x1, z1) = segment
    for column in range(ceil(x0 - 0.5), ceil(x1 - 0.5)):
        t = (column + 0.5 - x0) / (x1 - x0)
        z = z0 + t * (z1 - z0)
        if z > ybuffer[column]:
            ybuffer[column] = z
            row[column] = color


def from_above(segments, colors, width, height):
    """Draw segments as seen from above: x to the right, near below."""
    picture = blank(width, height)
    for (start, end), color in zip(segments, colors, strict=True):
        pixels = [(int(x), int(z)) for x, z in (start, end)]
        lines.draw(picture, lines.bresenham(*pixels[0], *pixels[1]), color)
    return picture


def buffer_picture(ybuffer, row, width, height):
    """Draw the buffer as bars from above down to the depth of each column, the row below."""
    picture = blank(width, height)
    for column, z in enumerate(ybuffer):
        if z != FAR:
            picture[int(z) : int(z) + 2, column] = row[column]
            picture[: int(z), column] = (52, 56, 66)
        picture[-12:, column] = row[column]
    return picture


def steps(width=240, height=180, plane=55):
    """Cut three triangles; plane: its height from the top, in percent of the picture's."""
    triangles = scene(width, height)
    middle = int(plane / 100 * height)
    y = middle + 0.5
    colors = list(COLORS)
    picture = blank(width, height)
    numbers = light.visible_faces(triangles, width, height)
    for k, color in enumerate(colors):
        picture[numbers == k] = color
    seen = picture[middle].tolist()
    picture[middle] = (255, 255, 255)
    yield "three triangles, and the plane that cuts them", picture

    cuts = [(cut(corners, y), color) for corners, color in zip(triangles, colors, strict=True)]
    segments = [segment for segment, _ in cuts if segment]
    colors = [color for segment, color in cuts if segment]
    yield "the cut from above: the viewer is below", from_above(segments, colors, width, height)

    ybuffer = [FAR] * width
    row = [(15, 16, 20)] * width
    for k, segment in enumerate(segments):
        add_segment(ybuffer, row, segment, colors[k])
        caption = told("buffer and row after segment {number}", number=k + 1)
        yield caption, buffer_picture(ybuffer, row, width, height)
    wrong = sum(
        tuple(pixel) != color for pixel, color in zip(seen, row, strict=True) if color in colors
    )
    strip = blank(width, height)
    strip[: height // 2] = row
    strip[height // 2 :] = seen
    yield told("the row, and below it that of the picture: " + DIFFER, differ=wrong), strip


if __name__ == "__main__":
    main(__file__, steps)
