"""Light and back faces: how bright a face is, which faces to leave out, and why that fails."""

import math

import numpy as np

import engine3d as e3d
from lesson import MODELS, blank, earlier, main, told

faces_of = earlier("06_random_colors")
TEAPOT = MODELS / "teapot.obj"
LIGHT = (0.0, 0.0, 1.0)  # towards the light: it shines from the viewer
CUBE_FACES = (
    (0, 2, 3, 1),
    (4, 5, 7, 6),
    (0, 1, 5, 4),
    (2, 6, 7, 3),
    (0, 4, 6, 2),
    (1, 3, 7, 5),
)


def normal_of(corners):
    """Return the unit normal of a triangle on the screen, z towards the viewer, or None."""
    a, b, c = corners
    u = [b[k] - a[k] for k in range(3)]
    v = [c[k] - a[k] for k in range(3)]
    # y grows downward on the screen: (b - a) x (c - a), turned over.
    n = (v[1] * u[2] - v[2] * u[1], v[2] * u[0] - v[0] * u[2], v[0] * u[1] - v[1] * u[0])
    length = math.sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2])
    return tuple(part / length for part in n) if length else None


def brightness(normal, light=LIGHT):
    """Return n.l: the cosine of the angle between normal and light."""
    return normal[0] * light[0] + normal[1] * light[1] + normal[2] * light[2]


def shade(value, color=(255, 215, 150)):
    """Return a colour times a brightness between 0 and 1."""
    return [round(part * max(0.0, min(1.0, value))) for part in color]


def light_from(angle):
    """Return the direction to a light that has gone round the model, to the right."""
    return e3d.linalg.sin(angle), 0.0, e3d.linalg.cos(angle)


def lit(normal, light=LIGHT):
    """Return the brightness of a face that may be seen from either side."""
    if normal[2] < 0:
        normal = [-part for part in normal]
    return max(0.0, brightness(normal, light))


def draw_lit(faces, width, height, cull=True, light=LIGHT):
    """Draw the faces in their order, as bright as they face the light."""
    picture = blank(width, height)
    drawn = 0
    for corners in faces:
        normal = normal_of(corners)
        if normal is None or (cull and normal[2] <= 0):
            continue
        drawn += 1
        faces_of.fill(picture, corners, shade(lit(normal, light)))
    return picture, drawn


def cube(width, height):
    """Return the triangles of a turned cube on the screen."""
    corners = [[(i >> axis & 1) - 0.5 for axis in range(3)] for i in range(8)]
    screen = faces_of.on_screen(faces_of.wireframe.turn(corners, 0.6, 0.5), width, height)
    cut = [(a, b, c) for a, b, c, _ in CUBE_FACES] + [(a, c, d) for a, _, c, d in CUBE_FACES]
    return [tuple(screen[corner] for corner in face) for face in cut]


def visible_faces(faces, width, height):
    """Return which face is in front at each pixel, -1 where none is, as the engine finds it."""
    corners = np.array(faces).reshape(-1, 3)
    clip = np.ones((len(corners), 4))
    clip[:, 0] = 2 * corners[:, 0] / width - 1
    clip[:, 1] = 1 - 2 * corners[:, 1] / height
    clip[:, 2] = -corners[:, 2] / (2 * max(width, height))
    order = np.arange(len(corners), dtype=np.int32).reshape(-1, 3)
    seen = e3d.rasterization.rasterize(clip.astype(np.float32), order, (width, height), cull="none")
    return seen.face_id


def true_picture(faces, width, height, light=LIGHT):
    """Return the picture with each pixel lit by the face that is in front there."""
    normals = [normal_of(corners) or (0, 0, 0) for corners in faces]
    colors = [shade(lit(normal, light)) for normal in normals]
    colors.append((30, 33, 40))
    return np.array(colors, np.uint8)[visible_faces(faces, width, height)]


def differences(picture, truth):
    """Return a picture with the wrong pixels in red, and how many there are."""
    wrong = (picture != truth).any(axis=2)
    marked = picture // 3
    marked[wrong] = (255, 60, 50)
    return marked, int(wrong.sum())


WRONG = "{wrong:no pixel is|# pixel is|# pixels are} wrong"


def steps(width=240, height=180, model=TEAPOT, angle=0.0):
    light = light_from(angle)
    box = cube(width, height)
    picture, drawn = draw_lit(box, width, height, cull=False, light=light)
    yield "a cube, all 12 triangles in the order of their list", picture
    picture, drawn = draw_lit(box, width, height, light=light)
    _, wrong = differences(picture, true_picture(box, width, height, light))
    yield told(f"only the {{count}} that face us: {WRONG}", count=drawn, wrong=wrong), picture

    faces = faces_of.load(model, width, height)
    picture, _ = draw_lit(faces, width, height, cull=False, light=light)
    yield told("the model, all {count} triangles", count=len(faces)), picture
    picture, drawn = draw_lit(faces, width, height, light=light)
    yield told("only the {count} that face us", count=drawn), picture
    marked, wrong = differences(picture, true_picture(faces, width, height, light))
    caption = "{wrong:no pixel shows|# pixel still shows|# pixels still show} what is behind"
    yield told(f"{caption} something else", wrong=wrong), marked


if __name__ == "__main__":
    main(__file__, steps)
