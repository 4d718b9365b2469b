"""The cube: its 8 vertices, 12 edges and 6 faces from the bits of three numbers."""

from lesson import blank, earlier, main, told

points = earlier("02_points")
lines = earlier("03_lines")
wireframe = earlier("04_wireframe")
faces_of = earlier("06_random_colors")
light = earlier("07_light")
LINE, HIDDEN = (255, 200, 0), (95, 85, 60)


def vertices():
    """The corner number i has bit 0 for x, bit 1 for y, bit 2 for z."""
    return [tuple((i >> axis & 1) - 0.5 for axis in range(3)) for i in range(8)]


def edges():
    """An edge joins two corners whose numbers differ in one bit."""
    return [(i, i | bit) for i in range(8) for bit in (1, 2, 4) if not i & bit]


def faces():
    """A face holds the four corners that agree in one bit, counter-clockwise from outside."""
    found = []
    for axis in range(3):
        a, b = 1 << (axis + 1) % 3, 1 << (axis + 2) % 3
        found.append((0, b, a | b, a))  # where the bit is 0
        found.append(tuple(corner | 1 << axis for corner in (0, a, a | b, b)))
    return found


def color_of(corner):
    """The colour cube: red is x, green is y, blue is z."""
    return tuple(255 if corner >> axis & 1 else 70 for axis in range(3))


def facing(screen):
    """Return which faces look at the viewer."""
    seen = []
    for face in faces():
        normal = light.normal_of([screen[corner] for corner in face[:3]])
        seen.append(normal[2] > 0)
    return seen


def visible_edges(screen):
    """An edge of a convex body shows if one of its two faces looks at the viewer."""
    looking = [set(face) for face, seen in zip(faces(), facing(screen), strict=True) if seen]
    return [any({a, b} <= face for face in looking) for a, b in edges()]


def pixel(place):
    return int(place[0] // 1), int(place[1] // 1)


def draw_edges(picture, screen, show_hidden):
    shown = visible_edges(screen)
    for (a, b), seen in sorted(zip(edges(), shown, strict=True), key=lambda pair: pair[1]):
        if seen or show_hidden:
            way = lines.bresenham(*pixel(screen[a]), *pixel(screen[b]))
            lines.draw(picture, way, LINE if seen else HIDDEN)


def draw_faces(picture, screen):
    for number, (face, seen) in enumerate(zip(faces(), facing(screen), strict=True)):
        if seen:
            a, b, c, d = (screen[corner] for corner in face)
            axis = 1 << number // 2
            color = color_of(axis if number % 2 else 7 - axis)
            normal = light.normal_of([a, b, c])
            tint = [round(part * (0.4 + 0.6 * light.brightness(normal))) for part in color]
            faces_of.fill(picture, (a, b, c), tint)
            faces_of.fill(picture, (a, c, d), tint)


def steps(width=200, height=160, yaw=0.6):
    screen = faces_of.on_screen(wireframe.turn(vertices(), yaw, 0.45), width, height)
    picture = blank(width, height)
    for corner, (x, y, _) in enumerate(screen):
        for dx in range(-2, 3):
            for dy in range(-2, 3):
                points.put_point(picture, x + dx, y + dy, color_of(corner))
    yield "8 vertices: each bit is a coordinate", picture

    picture = blank(width, height)
    draw_edges(picture, screen, show_hidden=True)
    yield "12 edges: numbers that differ in one bit; dark ones are hidden", picture
    picture = blank(width, height)
    draw_edges(picture, screen, show_hidden=False)
    caption = told("the {count} that faces do not hide", count=sum(visible_edges(screen)))
    yield caption, picture
    picture = blank(width, height)
    draw_faces(picture, screen)
    seen = sum(facing(screen))
    caption = "6 faces, of which {seen:none looks|# looks|# look} at us"
    yield told(caption, seen=seen), picture
    for quarter in (1, 2, 3):
        turned = wireframe.turn(vertices(), yaw + 0.4 * quarter, 0.45)
        screen = faces_of.on_screen(turned, width, height)
        picture = blank(width, height)
        draw_faces(picture, screen)
        draw_edges(picture, screen, show_hidden=True)
        yield told("turned {times:never|once|# times}", times=quarter), picture


if __name__ == "__main__":
    main(__file__, steps)
