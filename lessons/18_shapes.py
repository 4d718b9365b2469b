"""Making shapes: quads, boxes from eight points, spheres of meridians and parallels."""

import engine3d as e3d
from lesson import DIFFER, blank, earlier, main, told

wireframe = earlier("04_wireframe")
faces_of = earlier("06_random_colors")
light = earlier("07_light")
zbuffer_of = earlier("10_zbuffer")
cube = earlier("14_cube")
PI = 3.141592653589793
LIGHT = (0.48, -0.6, 0.64)  # towards it: right, up (y grows downward), and in front


def quad(p0, p1, p2, p3):
    """Return vertices and faces of a quad; its corners go round counter-clockwise."""
    return [p0, p1, p2, p3], [(0, 1, 2, 3)]


def box(eight):
    """Return a box of any eight points: number i has bit 0 for x, bit 1 for y, bit 2 for z."""
    return list(eight), cube.faces()


def sphere(radius, segments, rings):
    """Return a sphere: `segments` wedges around, `rings` bands from pole to pole."""
    around = [2 * k / segments for k in range(segments)]
    vertices = [(0.0, -radius, 0.0)]
    for ring in range(1, rings):
        y, r = -e3d.linalg.cos(PI * ring / rings), e3d.linalg.sin(PI * ring / rings)
        for turn in around:
            x, z = e3d.linalg.sin(PI * turn), e3d.linalg.cos(PI * turn)
            vertices.append((radius * r * x, radius * y, radius * r * z))
    vertices.append((0.0, radius, 0.0))
    north = len(vertices) - 1
    faces = []
    for k in range(segments):
        after = (k + 1) % segments
        faces.append((0, 1 + after, 1 + k))
        for ring in range(rings - 2):
            low = 1 + ring * segments
            high = low + segments
            faces.append((low + k, low + after, high + after, high + k))
        last = north - segments
        faces.append((last + k, last + after, north))
    return vertices, faces


def diagonal_normal(corners):
    """Return the one normal of a quad, perpendicular to both diagonals."""
    p0, p1, p2, p3 = corners
    origin = (0.0, 0.0, 0.0)
    one = [b - a for a, b in zip(p0, p2, strict=True)]
    two = [b - a for a, b in zip(p1, p3, strict=True)]
    return light.normal_of([origin, one, two])


def draw(shape, width, height, by_diagonals=False):
    """Return a lit picture of a shape through the z-buffer."""
    vertices, faces = shape
    screen = faces_of.on_screen(wireframe.turn(vertices, 0.55, 0.4), width, height)
    picture, zbuffer = blank(width, height), zbuffer_of.empty_buffer(width, height)
    for face in faces:
        corners = [screen[corner] for corner in face]
        one = diagonal_normal(corners) if by_diagonals and len(corners) == 4 else None
        for k in range(1, len(corners) - 1):
            three = corners[0], corners[k], corners[k + 1]
            normal = one or light.normal_of(three)
            if normal is not None and normal[2] > 0:
                color = light.shade(0.15 + 0.85 * light.brightness(normal, LIGHT))
                zbuffer_of.draw(picture, zbuffer, three, color)
    return picture


def steps(width=200, height=160, wedges=32):
    """Draw shapes; wedges: of the finest sphere."""
    bent = quad((-1.0, -0.6, 0.3), (1.0, -0.6, -0.3), (1.0, 0.6, 0.3), (-1.0, 0.6, -0.3))
    yield "a quad is two triangles: bent, they have two normals", draw(bent, width, height)
    yield "one normal across both diagonals: one even shade", draw(bent, width, height, True)

    straight = cube.vertices()
    yield "a box from 8 points", draw(box(straight), width, height, True)
    tower = [(x * (1.2 - y), 1.6 * y, z * (1.2 - y)) for x, y, z in straight]
    picture = draw(box(tower), width, height, True)
    engine = e3d.primitives.hexahedron([tower[number] for number in (0, 1, 3, 2, 4, 5, 7, 6)])
    theirs = draw((engine.positions.tolist(), engine.faces.tolist()), width, height)
    other = int((picture != theirs).any(axis=2).sum())
    caption = "any 8 points; " + DIFFER + " from the engine's hexahedron"
    yield told(caption, differ=other), picture
    for segments, rings in ((6, 3), (12, 6), (wedges, wedges // 2)):
        shape = sphere(1.0, segments, rings)
        triangles = sum(len(face) - 2 for face in shape[1])
        engine = len(e3d.uv_sphere(1.0, (segments, rings)).faces)
        caption = "{wedges} x {bands}: {triangles} triangles, the engine's has {engine}"
        counts = {"wedges": segments, "bands": rings, "triangles": triangles, "engine": engine}
        yield told(caption, **counts), draw(shape, width, height, True)


if __name__ == "__main__":
    main(__file__, steps)
