"""The z-buffer: a depth per pixel decides what is in front, in any order of drawing."""

import numpy as np

from lesson import DIFFER, MODELS, blank, earlier, main, told

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


def rounded(z, bits, height):
    """Return a depth as a buffer of few bits keeps it: it holds depths of two pictures' heights."""
    part = 2 * height / 2**bits
    return z // part * part if bits < 32 else z


def draw(picture, zbuffer, corners, color, bits=32):
    """Fill a triangle where it is nearer than what the buffer holds."""
    pixels = triangles.sweep(*(corner[:2] for corner in corners))
    if not pixels:
        return
    depth = depth_plane(corners)
    for x, y in pixels:
        z = rounded(depth(x + 0.5, y + 0.5), bits, len(picture))
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


def steps(width=240, height=180, model=TEAPOT, bits=32):
    picture, zbuffer = blank(width, height), empty_buffer(width, height)
    for k, bar in enumerate(painter.in_a_circle(width, height)):
        draw(picture, zbuffer, bar, COLORS[k], bits)
        caption = told("after triangle {number}: picture and buffer", number=k + 1)
        yield caption, picture.copy(), gray(zbuffer)

    picture, zbuffer = blank(width, height), empty_buffer(width, height)
    faces = faces_of.load(model, width, height)
    drawn = 0
    for count in (len(faces) // 3, len(faces)):
        for corners in faces[drawn:count]:
            normal = light.normal_of(corners)
            if normal is not None:
                draw(picture, zbuffer, corners, light.shade(light.lit(normal)), bits)
        drawn = count
        caption = told("after {count} triangles of the model", count=count)
        yield caption, picture.copy(), gray(zbuffer)
    marked, wrong = light.differences(picture, light.true_picture(faces, width, height))
    yield told(DIFFER + " from the engine's", differ=wrong), marked


if __name__ == "__main__":
    main(__file__, steps)
