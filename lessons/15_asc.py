"""3D Studio's ASCII files: triangles that say which of their edges belong to the model."""

import re

import engine3d as e3d
from lesson import FOLDER, MODELS, blank, earlier, listing, main, told

points = earlier("02_points")
lines = earlier("03_lines")
wireframe = earlier("04_wireframe")
HOUSE, TRAIN = FOLDER / "house.asc", MODELS / "train.asc"
LINE = (255, 200, 0)

VERTEX = re.compile(r"Vertex \d+: +X: *(\S+) +Y: *(\S+) +Z: *(\S+)")
FACE = re.compile(
    r"Face \d+: +A: *(\d+) +B: *(\d+) +C: *(\d+) +AB: *([01]) +BC: *([01]) +CA: *([01])"
)


def read_asc(path):
    """Return the objects of a file: name, vertices, and faces as (a, b, c, ab, bc, ca)."""
    objects = []
    with open(path, encoding="latin-1") as file:
        for line in file:
            if line.startswith("Named object:"):
                objects.append((line.split('"')[1], [], []))
            elif found := VERTEX.match(line):
                objects[-1][1].append(tuple(float(number) for number in found.groups()))
            elif found := FACE.match(line):
                objects[-1][2].append(tuple(int(number) for number in found.groups()))
    return objects


def edges_of(faces, flagged=True):
    """Return the edges of an object, each once: those whose flag is 1, or all."""
    seen = {}
    for a, b, c, *flags in faces:
        for (p, q), flag in zip(((a, b), (b, c), (c, a)), flags, strict=True):
            if flag or not flagged:
                seen[min(p, q), max(p, q)] = None
    return list(seen)


def upright(vertices):
    """Turn z, which points up in these files, into y."""
    return [(x, z, -y) for x, y, z in vertices]


def draw_objects(objects, width, height, flagged, yaw=wireframe.YAW):
    """Return a picture of all edges, and their number."""
    turned = [wireframe.turn(upright(vertices), yaw, wireframe.PITCH) for _, vertices, _ in objects]
    scale, middle = points.fit([v for vertices in turned for v in vertices], width, height)
    picture, count = blank(width, height), 0
    for vertices, (_, _, faces) in zip(turned, objects, strict=True):
        places = [points.to_screen(vertex, scale, middle, width, height) for vertex in vertices]
        pixels = [(int(x // 1), int(y // 1)) for x, y in places]
        edges = edges_of(faces, flagged)
        count += len(edges)
        for a, b in edges:
            lines.draw(picture, lines.bresenham(*pixels[a], *pixels[b]), LINE)
    return picture, count


def steps(width=240, height=180, model=TRAIN, yaw=wireframe.YAW):
    rows = HOUSE.read_text(encoding="latin-1").splitlines()
    shown = [*rows[2:6], "...", *rows[15:19], "..."]
    yield "a file in this format", listing(shown)

    house = read_asc(HOUSE)
    picture, count = draw_objects(house, width, height, False, yaw)
    yield told("all {count} edges of the triangles", count=count), picture
    picture, count = draw_objects(house, width, height, True, yaw)
    engine = len(e3d.load_mesh(HOUSE).edges())
    caption = "the {count} whose flag is 1; the engine finds {found}"
    yield told(caption, count=count, found=engine), picture

    objects = read_asc(model)
    picture, count = draw_objects(objects, width, height, False, yaw)
    caption = "{objects:no object|# object|# objects}, all {count} edges"
    yield told(caption, objects=len(objects), count=count), picture
    picture, count = draw_objects(objects, width, height, True, yaw)
    yield told("the {count} edges of the model", count=count), picture


if __name__ == "__main__":
    main(__file__, steps)
