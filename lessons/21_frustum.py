"""Chunks and the frustum: leave out what no pixel can show, by one corner for each plane."""

import numpy as np

import engine3d as e3d
from lesson import blank, earlier, main

lines = earlier("03_lines")
CELLS = 24  # buildings along each side of the town
EYE, TARGET = (0.6, 2.4, 9.6), (5.5, 0.3, -4.0)
CAMERA = e3d.PerspectiveCamera(0.7, znear=0.1, zfar=60.0)
KEPT, LEFT_OUT, WRONG = (110, 190, 110), (75, 80, 92), (255, 70, 60)


def buildings(seed=2):
    """Return the buildings of a town, a box each: (x, z, width, height)."""
    random = np.random.default_rng(seed)
    places = [
        (column - CELLS / 2, row - CELLS / 2) for row in range(CELLS) for column in range(CELLS)
    ]
    sizes = random.uniform((0.4, 0.3), (0.9, 2.2), (len(places), 2))
    return [(x + 0.5, z + 0.5, *size) for (x, z), size in zip(places, sizes, strict=True)]


def join(heap):
    """Return one mesh of some buildings: the vertices of a box each, and its faces."""
    one = e3d.box(1.0)
    vertices = [one.positions * (w, h, w) + (x, h / 2, z) for x, z, w, h in heap]
    faces = [one.faces + k * len(one.positions) for k in range(len(heap))]
    return e3d.Mesh(np.concatenate(vertices), np.concatenate(faces))


def make_chunks(town, side):
    """Join the buildings of side x side squares into one mesh each; return (mesh, low, high)."""
    heaps = {}
    for building in town:
        x, z, _, _ = building
        heaps.setdefault((x // side, z // side), []).append(building)
    meshes = [join(heap) for heap in heaps.values()]
    return [(mesh, *mesh.bounds) for mesh in meshes]


def clip_from_world(width, height, camera=CAMERA):
    pose = e3d.look_at(EYE, TARGET)
    view = e3d.linalg.inverse(pose)
    return e3d.linalg.multiply(camera.projection(width, height), view)


def planes_of(matrix):
    """Return the six planes (a, b, c, d); a point is inside where a x + b y + c z + d >= 0.

    -w <= x means 0 <= x + w: the sum of two rows of the matrix (Gribb and Hartmann 2001).
    """
    x, y, z, w = matrix
    return [w + x, w - x, w + y, w - y, w + z, w - z]


def distance(plane, point):
    return plane[0] * point[0] + plane[1] * point[1] + plane[2] * point[2] + plane[3]


def p_vertex(plane, low, high):
    """Return the corner of a box that is farthest on the inner side of a plane."""
    return [high[k] if plane[k] >= 0 else low[k] for k in range(3)]


def by_p_vertex(planes, low, high):
    """A box is left out if, for some plane, even its p-vertex is outside."""
    return all(distance(plane, p_vertex(plane, low, high)) >= 0 for plane in planes)


def by_center(planes, low, high):
    """Wrong: a box whose centre is outside may still reach in."""
    center = [(a + b) / 2 for a, b in zip(low, high, strict=True)]
    return all(distance(plane, center) >= 0 for plane in planes)


def by_corners(planes, low, high):
    """Wrong, too: none of the corners need be inside of a box that is large or near."""
    for number in range(8):
        corner = [(low, high)[number >> k & 1][k] for k in range(3)]
        if all(distance(plane, corner) >= 0 for plane in planes):
            return True
    return False


def draw(chunks, width, height):
    """Return the engine's picture of some chunks, and its counts."""
    scene = e3d.Scene(background=(30, 33, 40), ambient=(0.25, 0.25, 0.3))
    scene.add(e3d.DirectionalLight((-0.4, -0.8, -0.5), intensity=0.6))
    for mesh, _, _ in chunks:
        scene.add(mesh)
    camera = CAMERA, e3d.look_at(EYE, TARGET)
    frame = e3d.render(scene, camera, size=(width, height))
    return frame.color[:, :, :3], frame.stats


def to_map(point, height):
    scale = height / (CELLS + 4)
    return int(height / 2 + scale * point[0]), int(height / 2 + scale * point[2])


def from_above(chunks, kept, needed, height, width):
    """Draw the chunks from above: kept, left out, or left out though they are needed."""
    picture = blank(height, height)
    for (_, low, high), keep, need in zip(chunks, kept, needed, strict=True):
        (left, top), (right, bottom) = to_map(low, height), to_map(high, height)
        color = KEPT if keep else WRONG if need else LEFT_OUT
        picture[top : bottom - 1, left : right - 1] = color
    matrix = e3d.linalg.inverse(clip_from_world(width, height))
    eye = to_map(EYE, height)
    for x in (-1.0, 1.0):
        far = e3d.linalg.transform_points(matrix, (x, 0.0, 0.98))
        way = lines.bresenham(*eye, *to_map(far, height))
        inside = [(x, y) for x, y in way if 0 <= x < height and 0 <= y < height]
        lines.draw(picture, inside, (255, 200, 0))
    return picture


def steps(width=240, height=180):
    town = buildings()
    planes = planes_of(clip_from_world(width, height))
    chunks_of = {side: make_chunks(town, side) for side in (8, 4, 2)}
    everything, _ = draw(chunks_of[8], width, height)
    for side, test, name in (
        (8, by_center, "the centre"),
        (8, by_corners, "the corners"),
        (8, by_p_vertex, "the p-vertex"),
        (4, by_p_vertex, "the p-vertex"),
        (2, by_p_vertex, "the p-vertex"),
    ):
        chunks = chunks_of[side]
        kept = [test(planes, low, high) for _, low, high in chunks]
        needed = [by_p_vertex(planes, low, high) for _, low, high in chunks]
        chosen = [chunk for chunk, keep in zip(chunks, kept, strict=True) if keep]
        picture, _ = draw(chosen, width, height)
        lost = int((picture != everything).any(axis=2).sum())
        triangles = sum(len(mesh.faces) for mesh, _, _ in chosen)
        caption = f"chunks of {side} x {side} by {name}: {len(chosen)} of {len(chunks)}"
        overview = from_above(chunks, kept, needed, height, width)
        yield f"{caption}, {triangles} triangles; {lost} pixels lost", picture, overview
    picture, stats = draw(chunks_of[2], width, height)
    found = f"{stats['nodes_in_frustum']} of {len(chunks_of[2])} chunks"
    yield f"the engine, too, finds {found} in the frustum", picture


if __name__ == "__main__":
    main(__file__, steps)
