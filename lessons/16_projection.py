"""Perspective: the virtual screen, what is behind the camera, and textures that are right."""

import numpy as np

import engine3d as e3d
from lesson import blank, earlier, main, told

lines = earlier("03_lines")
triangles = earlier("05_triangles")
cube = earlier("14_cube")
texture_of = earlier("11_texture")
YFOV = 1.0  # radians
NEAR = 0.2
LINE = (255, 200, 0)
LIGHT, DARK = (236, 232, 222), (64, 84, 120)


def screen_distance(height, yfov=YFOV):
    """Return how far in front of the eye a screen of `height` pixels fills the field of view."""
    return height / 2 / e3d.linalg.tan(yfov / 2)


def project(point, width, height, yfov=YFOV):
    """Return where the ray from the eye to a point meets the virtual screen: x, y and 1/z.

    The eye is the origin and looks along -z.
    """
    x, y, z = point
    scale = screen_distance(height, yfov) / -z
    return width / 2 + scale * x, height / 2 - scale * y, 1 / -z


def clip_near(polygon):
    """Cut off what is nearer than NEAR or behind the eye; corners are (x, y, z, u, v)."""
    kept = []
    for a, b in zip(polygon, polygon[1:] + polygon[:1], strict=True):
        if inside(a):
            kept.append(a)
        if inside(a) != inside(b):
            t = (-NEAR - a[2]) / (b[2] - a[2])
            kept.append(tuple(p + t * (q - p) for p, q in zip(a, b, strict=True)))
    return kept


def inside(corner):
    return corner[2] <= -NEAR


def checker(u, v):
    return LIGHT if (u // 1 + v // 1) % 2 else DARK


def draw_polygon(picture, polygon, corrected, yfov=YFOV):
    """Fill a fan of triangles with a chess board: u and v as they are, or divided by z."""
    height, width = picture.shape[:2]
    corners = [(*project(corner[:3], width, height, yfov), *corner[3:]) for corner in polygon]
    for k in range(1, len(corners) - 1):
        three = corners[0], corners[k], corners[k + 1]
        places = [corner[:3] for corner in three]
        for x, y in triangles.sweep(*(place[:2] for place in places)):
            if 0 <= x < width and 0 <= y < height:
                weights = texture_of.barycentric(places, x + 0.5, y + 0.5)
                if corrected:
                    over_z = [w * place[2] for w, place in zip(weights, places, strict=True)]
                    total = over_z[0] + over_z[1] + over_z[2] or 1.0  # 0: corners behind the eye
                    weights = [w / total for w in over_z]
                picture[y, x] = checker(*texture_of.mix(weights, [c[3:] for c in three]))


def floor(near, far):
    """Return a floor below the eye, from z = near to z = far, a texel per unit."""
    return [(x, -1.0, z, x, -z) for x, z in ((-3, near), (3, near), (3, far), (-3, far))]


def draw_cubes(width, height, perspective, yfov=YFOV):
    """Draw the edges of three cubes, one behind the other."""
    picture = blank(width, height)
    for z in (-3.0, -5.0, -9.0):
        moved = [(x + 0.8, y - 0.8, z + part) for x, y, part in cube.vertices()]
        if perspective:
            screen = [project(point, width, height, yfov) for point in moved]
        else:
            scale = screen_distance(height, yfov) / 4.0
            screen = [(width / 2 + scale * x, height / 2 - scale * y) for x, y, _ in moved]
        for a, b in cube.edges():
            way = lines.bresenham(*cube.pixel(screen[a]), *cube.pixel(screen[b]))
            kept = [(x, y) for x, y in way if 0 <= x < width and 0 <= y < height]
            lines.draw(picture, kept, LINE)
    return picture


def engine_floor(width, height, yfov=YFOV):
    """Return the engine's picture of a floor that goes on behind the camera."""
    corners = np.array(floor(4.0, -12.0))
    pixels = np.array([[LIGHT, DARK], [DARK, LIGHT]], np.uint8)
    texture = e3d.Texture(pixels, filter="nearest")
    material = e3d.Material(texture=texture, two_sided=True)
    faces = [(0, 1, 2), (0, 2, 3)]
    mesh = e3d.Mesh(corners[:, :3], faces, uvs=corners[:, 3:] / 2, materials=[material])
    scene = e3d.Scene(background=(30, 33, 40))
    scene.add(mesh)
    camera = e3d.PerspectiveCamera(yfov, znear=NEAR), np.eye(4)
    return e3d.render(
        scene, camera, size=(width, height), mode="unlit", look="plain", samples=1, cull="back"
    ).color[:, :, :3]


def steps(width=200, height=150, yfov=YFOV):
    yield "without perspective: three cubes in a row", draw_cubes(width, height, False, yfov)
    yield "on the virtual screen: divided by z", draw_cubes(width, height, True, yfov)

    picture = blank(width, height)
    draw_polygon(picture, floor(-1.5, -12.0), False, yfov)
    yield "a floor, u and v mixed as on the screen: bent", picture
    picture = blank(width, height)
    draw_polygon(picture, floor(-1.5, -12.0), True, yfov)
    yield "u/z, v/z and 1/z mixed, then divided: straight", picture

    picture = blank(width, height)
    draw_polygon(picture, floor(4.0, -12.0), True, yfov)
    yield "the floor goes on behind the eye: corners there are mirrored", picture
    picture = blank(width, height)
    draw_polygon(picture, clip_near(floor(4.0, -12.0)), True, yfov)
    yield "cut off at the near plane first", picture
    engine = engine_floor(width, height, yfov)
    other = int((engine != picture).any(axis=2).sum())
    caption = "the engine's: {count:none|#|#} of {all} pixels {count:differs|differs|differ}"
    yield told(caption, count=other, all=width * height), engine


if __name__ == "__main__":
    main(__file__, steps)
