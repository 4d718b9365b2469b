"""Every triangle filled, in a colour of its own, in the order of the file."""

import engine3d as e3d
from lesson import MODELS, blank, earlier, main, told

lists = earlier("01_lists")
points = earlier("02_points")
wireframe = earlier("04_wireframe")
triangles = earlier("05_triangles")
TEAPOT = MODELS / "teapot.obj"


def cut_faces(model):
    """Return triangles of vertex indices: a face of n corners makes a fan of n - 2."""
    found = []
    for face in model["f"]:
        corners = wireframe.corners_of(face, model)
        found += [(corners[0], *corners[k : k + 2]) for k in range(1, len(corners) - 1)]
    return found


def on_screen(vertices, width, height):
    """Return each vertex as (x, y, z): pixels, and z in the same unit, larger when nearer."""
    scale, middle = points.fit(vertices, width, height)
    return [
        (*points.to_screen(vertex, scale, middle, width, height), scale * vertex[2])
        for vertex in vertices
    ]


def load(path, width, height):
    """Return the corners on the screen of every triangle of a model, three (x, y, z) each."""
    model = lists.read_lists(path)
    screen = on_screen(wireframe.turn(model["v"], wireframe.YAW, wireframe.PITCH), width, height)
    return [tuple(screen[corner] for corner in face) for face in cut_faces(model)]


def random_color(number):
    """Return a colour that looks random, and is the same in every run."""
    bits = (number * 2654435761) % 2**32
    return 64 + (bits >> 24) % 192, 64 + (bits >> 16) % 192, 64 + (bits >> 8) % 192


def fill(picture, corners, color):
    height, width = picture.shape[:2]
    for x, y in triangles.sweep(*(corner[:2] for corner in corners)):
        if 0 <= x < width and 0 <= y < height:
            picture[y, x] = color


def steps(width=240, height=180, model=TEAPOT, order="forwards"):
    faces = load(model, width, height)
    if order == "backwards":
        faces.reverse()
    picture = blank(width, height)
    drawn = 0
    for count in (len(faces) // 20, len(faces) // 3, len(faces)):
        for number in range(drawn, count):
            fill(picture, faces[number], random_color(number))
        drawn = count
        caption = "the first {count} triangles of the file"
        if order == "backwards":
            caption = "the last {count} triangles of the file, backwards"
        yield told(caption, count=count), picture.copy()

    view = wireframe.engine_view(model, width, height)
    frame = e3d.render(
        *view, size=(width, height), mode="random", look="plain", samples=1, cull="back"
    )
    yield "the engine's mode 'random': only what is in front shows", frame.color[:, :, :3]


if __name__ == "__main__":
    main(__file__, steps)
