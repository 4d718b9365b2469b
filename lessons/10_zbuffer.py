"""The z-buffer: a depth per pixel decides what is in front, in any order of drawing."""

import numpy as np

from lesson import MODELS, blank, earlier, main

faces_of = earlier("06_random_colors")
light = earlier("07_light")
painter = earlier("08_painter")
triangles = earlier("05_triangles")
TEAPOT = MODELS / "teapot.obj"
COLORS = ((240, 90, 80), (90, 170, 250), (255, 200, 0))


def depth_plane(corners):
    """Return a function of x and y: the depth of the triangle's plane there."""
    (ax, ay, az), (bx, by, bz), (cx, cy, cz) = corners
    area = (bx - ax) * (cy - ay) - (by - ay) * (cx - ax)
    dz_dx = ((bz - az) * (cy - ay) - (cz - az) * (by - ay)) / area
    dz_dy = ((cz - az) * (bx - ax) - (bz - az) * (cx - ax)) / area
    return lambda x, y: az + (x - ax) * dz_dx + (y - ay) * dz_dy


def draw(picture, zbuffer, corners, color):
    """Fill a triangle where it is nearer than what the buffer holds."""
    pixels = triangles.sweep(*(corner[:2] for corner in corners))
    if not pixels:
        return
    depth = depth_plane(corners)
    for x, y in pixels:
        z = depth(x + 0.5, y + 0.5)
        if z > zbuffer[y, x]:
            zbuffer[y, x] = z
            picture[y, x] = color


def empty_buffer(width, height):
    return np.full((height, width), -np.inf)


def gray(zbuffer):
    """Return the buffer as a picture: the nearer, the brighter; dark blue where nothing is."""
    picture = np.empty((*zbuffer.shape, 3), np.uint8)
    picture[:] = (16, 20, 50)
    known = np.isfinite(zbuffer)
    if known.any():
        far, near = zbuffer[known].min(), zbuffer[known].max()
        bright = 40 + 215 * (zbuffer[known] - far) / max(near - far, 1e-9)
        picture[known] = np.floor(bright).astype(np.uint8)[:, None]
    return picture


def steps(width=240, height=180, model=TEAPOT):
    picture, zbuffer = blank(width, height), empty_buffer(width, height)
    for k, bar in enumerate(painter.in_a_circle(width, height)):
        draw(picture, zbuffer, bar, COLORS[k])
        yield f"after triangle {k + 1}: picture and buffer", picture.copy(), gray(zbuffer)

    picture, zbuffer = blank(width, height), empty_buffer(width, height)
    faces = faces_of.load(model, width, height)
    drawn = 0
    for count in (len(faces) // 3, len(faces)):
        for corners in faces[drawn:count]:
            normal = light.normal_of(corners)
            if normal is not None:
                draw(picture, zbuffer, corners, light.shade(abs(light.brightness(normal))))
        drawn = count
        yield f"after {count} triangles of the model", picture.copy(), gray(zbuffer)
    marked, wrong = light.differences(picture, light.true_picture(faces, width, height))
    yield f"{wrong} pixels differ from the engine's", marked


if __name__ == "__main__":
    main(__file__, steps)
