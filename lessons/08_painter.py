"""The painter's algorithm: from far to near, so that what is near is painted over what is far."""

from lesson import MODELS, blank, earlier, main, told

faces_of = earlier("06_random_colors")
light = earlier("07_light")
TEAPOT = MODELS / "teapot.obj"


def middle_depth(corners):
    """Return the depth of a triangle's middle, larger when nearer."""
    return (corners[0][2] + corners[1][2] + corners[2][2]) / 3


def nearest_depth(corners):
    return max(z for _, _, z in corners)


def farthest_depth(corners):
    return min(z for _, _, z in corners)


DEPTHS = {"middle": middle_depth, "nearest": nearest_depth, "farthest": farthest_depth}


def painter_order(faces, depth=middle_depth):
    """Return the triangles from far to near."""
    return sorted(faces, key=depth)


def in_a_circle(width, height):
    """Return three bars of which each lies over the next: no order is right."""
    x, y, r = width / 2, height / 2, min(width, height) * 0.25
    corners = [(x, y - r), (x + 0.87 * r, y + 0.5 * r), (x - 0.87 * r, y + 0.5 * r)]
    bars = []
    for k in range(3):
        (ax, ay), (bx, by) = corners[k], corners[(k + 1) % 3]
        dx, dy = bx - ax, by - ay
        foot = ax - 0.25 * dx, ay - 0.25 * dy
        left = (foot[0] + 0.25 * dy, foot[1] - 0.25 * dx, -50.0)
        right = (foot[0] - 0.25 * dy, foot[1] + 0.25 * dx, -50.0)
        bars.append((left, right, (bx + 0.6 * dx, by + 0.6 * dy, 50.0)))
    return bars


def draw_colored(faces, colors, width, height):
    picture = blank(width, height)
    for corners, color in zip(faces, colors, strict=True):
        faces_of.fill(picture, corners, color)
    return picture


def steps(width=240, height=180, model=TEAPOT, depth="middle"):
    faces = painter_order(faces_of.load(model, width, height), DEPTHS[depth])
    for part in (0.4, 0.6):
        picture, _ = light.draw_lit(faces[: int(part * len(faces))], width, height, cull=False)
        yield told("the farthest {part:.0f}% of the triangles", part=100 * part), picture
    picture, _ = light.draw_lit(faces, width, height, cull=False)
    yield "all of them", picture
    marked, wrong = light.differences(picture, light.true_picture(faces, width, height))
    yield told(light.WRONG, wrong=wrong), marked

    bars = in_a_circle(width, height)
    colors = [(240, 90, 80), (90, 170, 250), (255, 200, 0)]
    for first in range(2):
        order = [(first + k) % 3 for k in range(3)]
        picture = draw_colored([bars[k] for k in order], [colors[k] for k in order], width, height)
        caption = "three triangles over each other in a circle, order {order}"
        yield told(caption, order=", ".join(str(k + 1) for k in order)), picture
    numbers = light.visible_faces(bars, width, height)
    picture = blank(width, height)
    for k, color in enumerate(colors):
        picture[numbers == k] = color
    yield "what it should be", picture


if __name__ == "__main__":
    main(__file__, steps)
