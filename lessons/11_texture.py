"""Texture: where each pixel lies in its triangle, and so which texel it shows."""

import numpy as np

import engine3d as e3d
from lesson import MODELS, blank, earlier, main, told

lists = earlier("01_lists")
wireframe = earlier("04_wireframe")
triangles = earlier("05_triangles")
faces_of = earlier("06_random_colors")
light = earlier("07_light")
zbuffer_of = earlier("10_zbuffer")
TEAPOT, TEXTURE = MODELS / "teapot.obj", MODELS / "teapot.tga"


def barycentric(corners, x, y):
    """Return the weights of the corners at a point: they add up to 1."""
    (ax, ay, _), (bx, by, _), (cx, cy, _) = corners
    area = (bx - ax) * (cy - ay) - (by - ay) * (cx - ax)
    of_b = ((x - ax) * (cy - ay) - (y - ay) * (cx - ax)) / area
    of_c = ((bx - ax) * (y - ay) - (by - ay) * (x - ax)) / area
    return 1 - of_b - of_c, of_b, of_c


def mix(weights, values):
    """Return the weighted sum of the corners' values, number by number."""
    first, second, third = weights
    return [first * a + second * b + third * c for a, b, c in zip(*values, strict=True)]


def nearest_texel(texture, u, v):
    """Return the texel that holds (u, v); the picture repeats, and v grows upward."""
    rows, columns = texture.shape[:2]
    return texture[rows - 1 - int(v * rows // 1) % rows, int(u * columns // 1) % columns, :3]


def load(path, width, height):
    """Return each triangle with its texture coordinates: three (x, y, z), three (u, v)."""
    model = lists.read_lists(path)
    turned = wireframe.turn(model["v"], wireframe.YAW, wireframe.PITCH)
    screen = faces_of.on_screen(turned, width, height)
    found = []
    for face in model["f"]:
        corners = [lists.resolve(corner, model) for corner in face]
        for k in range(1, len(corners) - 1):
            three = corners[0], corners[k], corners[k + 1]
            places = [screen[v] for v, _, _ in three]
            uvs = [(0.0, 0.0) if vt is None else model["vt"][vt][:2] for _, vt, _ in three]
            found.append((places, uvs))
    return found


def draw(seen, zbuffer, corners, uvs, bright):
    """Note for each pixel of a triangle that is in front: its (u, v), and how bright it is."""
    for x, y in triangles.sweep(*(corner[:2] for corner in corners)):
        weights = barycentric(corners, x + 0.5, y + 0.5)
        (z,) = mix(weights, [corner[2:] for corner in corners])
        if z > zbuffer[y, x]:
            zbuffer[y, x] = z
            seen[x, y] = (*mix(weights, uvs), bright)


def color(seen, width, height, color_of):
    """Return a picture of what was noted; `color_of(u, v, brightness)`."""
    picture = blank(width, height)
    for (x, y), values in seen.items():
        picture[y, x] = color_of(*values)
    return picture


def steps(width=200, height=150, model=TEAPOT, repeat=1):
    """Draw a texture on a model; repeat: how many times it lies on it, in each direction."""
    texture = e3d.load_texture(TEXTURE).pixels
    step = texture.shape[0] // height + 1
    caption = told("the texture, every texel in {step}", step=step)
    yield caption, texture[::step, ::step, :3][:height, :width]

    seen, zbuffer = {}, zbuffer_of.empty_buffer(width, height)
    for corners, uvs in load(model, width, height):
        normal = light.normal_of(corners)
        if normal is not None:
            repeated = [(repeat * u, repeat * v) for u, v in uvs]
            draw(seen, zbuffer, corners, repeated, light.lit(normal))

    def as_color(u, v, _):
        return int(255 * (u % 1)), int(255 * (v % 1)), 90

    def texel(u, v, _):
        return nearest_texel(texture, u, v)

    def lit_texel(u, v, bright):
        return (nearest_texel(texture, u, v) * bright).astype(np.uint8)

    yield "u as red, v as green", color(seen, width, height, as_color)
    yield "the nearest texel of each pixel", color(seen, width, height, texel)
    yield "times the light", color(seen, width, height, lit_texel)


if __name__ == "__main__":
    main(__file__, steps)
