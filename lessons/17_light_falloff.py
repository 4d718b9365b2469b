"""E = I / d^2 cos t: the light of a point, once for each face, or once for each pixel."""

import math

import numpy as np

import engine3d as e3d
from lesson import blank, main, told

SIDE = 4.0  # of the floor
PLACE, HEIGHT, INTENSITY = (0.6, -0.4), 0.7, 0.8
CLAMP = (0.1, 1.0)
COLORED = (
    ((-0.9, 0.5, 0.3), (1.0, 0.35, 0.25)),
    ((0.9, 0.5, 0.3), (0.3, 1.0, 0.35)),
    ((0.0, 0.5, -0.9), (0.35, 0.45, 1.0)),
)


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def illuminance(point, normal, light, intensity):
    """Return E = I / d^2 cos t: what a point of a surface gets from a light."""
    to_light = [light[k] - point[k] for k in range(3)]
    squared = dot(to_light, to_light)
    distance = math.sqrt(squared)
    cosine = dot(normal, to_light) / distance
    return intensity / squared * max(0.0, cosine)


def clamp(value, low, high):
    return min(max(value, low), high)


def encode(value):
    """Return a value as a byte; what is above 1 wraps around, as in C."""
    return math.floor(255 * value + 0.5) % 256


def place(column, row, width, height):
    """Return the point of the floor that a pixel shows, seen from above."""
    scale = SIDE / height
    x = (column + 0.5 - width / 2) * scale
    return x, 0.0, (row + 0.5 - height / 2) * scale


def per_pixel(width, height, light_of):
    """Return a picture of the floor; `light_of(point)` gives three bytes."""
    picture = blank(width, height)
    for row in range(height):
        for column in range(width):
            picture[row, column] = light_of(place(column, row, width, height))
    return picture


def per_face(width, height, faces, lamp, limits=CLAMP):
    """Return the floor cut into faces x faces squares, each lit at its middle.

    lamp: its place, and its intensity.
    """
    picture = blank(width, height)
    edges_x = [width * k // faces for k in range(faces + 1)]
    edges_y = [height * k // faces for k in range(faces + 1)]
    for top, bottom in zip(edges_y, edges_y[1:], strict=False):
        for left, right in zip(edges_x, edges_x[1:], strict=False):
            middle = place((left + right - 1) / 2, (top + bottom - 1) / 2, width, height)
            value = illuminance(middle, (0.0, 1.0, 0.0), *lamp)
            picture[top:bottom, left:right] = encode(clamp(value, *limits))
    return picture


def white(limits, lamp):
    """Return a function from a point to its grey, with or without limits."""

    def light_of(point):
        value = illuminance(point, (0.0, 1.0, 0.0), *lamp)
        return encode(clamp(value, *limits) if limits else value)

    return light_of


def colored(point):
    """Return the sum of three coloured lights at a point."""
    sums = [0.0, 0.0, 0.0]
    for light, color in COLORED:
        value = illuminance(point, (0.0, 1.0, 0.0), light, 0.35)
        sums = [total + value * part for total, part in zip(sums, color, strict=True)]
    return [encode(clamp(total, *CLAMP)) for total in sums]


def engine_floor(width, height, lamp, segments=1, normals="auto"):
    """Return the engine's picture of the floor under the white light."""
    scene = e3d.Scene(background=(0, 0, 0), ambient=(0, 0, 0), light_clamp=CLAMP)
    scene.add(e3d.plane((SIDE * width / height, SIDE), segments))
    place, intensity = lamp
    scene.add(e3d.PointLight(intensity=math.pi * intensity), translation=place)
    camera = e3d.OrthographicCamera(SIDE / 2), e3d.look_at((0, 5, 0), (0, 0, 0), (0, 0, -1))
    how = {"color_space": "linear", "normals": normals}
    frame = e3d.render(
        scene, camera, size=(width, height), look="plain", samples=1, cull="back", **how
    )
    return frame.color[:, :, :3]


def steps(width=180, height=132, lamp=HEIGHT, intensity=INTENSITY):
    """Light a floor; lamp: how high it hangs."""
    light = (PLACE[0], lamp, PLACE[1]), intensity
    yield "one E for each of 6 x 6 faces", per_face(width, height, 6, light)
    yield "24 x 24 faces", per_face(width, height, 24, light)
    picture = per_pixel(width, height, white(None, light))
    yield "more than 1 does not fit into a byte: it wraps", picture
    picture = per_pixel(width, height, white(CLAMP, light))
    caption = told("one E for each pixel, between {low} and {high:g}", low=CLAMP[0], high=CLAMP[1])
    yield caption, picture
    engine = engine_floor(width, height, light)
    off = int(np.abs(engine.astype(int) - picture).max())
    yield told("the engine's: {off:the same|off by # at most|off by # at most}", off=off), engine
    faceted = engine_floor(width, height, light, 6, "facet")
    yield "the engine's, one E for each of 72 triangles", faceted
    yield "three lights add up", per_pixel(width, height, colored)


if __name__ == "__main__":
    main(__file__, steps)
