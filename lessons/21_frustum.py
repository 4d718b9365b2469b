"""Chunks and the frustum: leave out what no pixel can show, by one corner for each plane."""

import math

import numpy as np

import engine3d as e3d
from lesson import blank, earlier, main, told

lines = earlier("03_lines")
random_colors = earlier("06_random_colors")
CELLS = 24  # buildings along each side of the town
EYE, TARGET = (0.6, 2.4, 9.6), (5.5, 0.3, -4.0)
CAMERA = e3d.PerspectiveCamera(0.7, znear=0.1, zfar=60.0)
KEPT, LEFT_OUT, WRONG = (110, 190, 110), (75, 80, 92), (255, 70, 60)
MOST_CHUNKS = 20000


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


def load(model):
    """Load a model; return its mesh, as wide as the town and in its place, and the scale."""
    mesh = e3d.load_mesh(model)
    low, high = mesh.bounds
    scale = CELLS / max(high[0] - low[0], high[2] - low[2], 1e-30)
    middle = (low[0] + high[0]) / 2, low[1], (low[2] + high[2]) / 2
    return e3d.Mesh((mesh.positions - middle) * scale, mesh.faces, normals=mesh.normals), scale


def cut(mesh, side):
    """Cut a mesh into chunks: the triangles whose middles lie in one side x side square each."""
    middles = mesh.positions[mesh.faces].mean(axis=1, dtype=np.float64)
    squares, chunk_of = np.unique(middles[:, ::2] // side, axis=0, return_inverse=True)
    if len(squares) > MOST_CHUNKS:
        raise e3d.InvalidArgumentError(
            f"that makes more than {MOST_CHUNKS} chunks: take larger ones"
        )
    chunk_of = chunk_of.reshape(-1)
    faces = mesh.faces[np.argsort(chunk_of, kind="stable")]
    meshes = [part(mesh, some) for some in np.split(faces, np.bincount(chunk_of).cumsum()[:-1])]
    return [(one, *one.bounds) for one in meshes]


def part(mesh, faces):
    """Return some faces of a mesh as a mesh that holds no other vertices."""
    used, corners = np.unique(faces, return_inverse=True)
    return e3d.Mesh(mesh.positions[used], corners.reshape(-1, 3), normals=mesh.normals[used])


def clip_from_world(width, height, camera=CAMERA, eye=EYE):
    pose = e3d.look_at(eye, TARGET)
    view = e3d.linalg.inverse(pose)
    return e3d.linalg.multiply(camera.projection((width, height)), view)


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


def draw(chunks, size, eye=EYE, lens=CAMERA, color_of=lambda number: (255, 255, 255)):
    """Return the engine's picture of some chunks, and its counts."""
    scene = e3d.Scene(background=(30, 33, 40), ambient=e3d.linear(0.25, 0.25, 0.3))
    scene.add(e3d.DirectionalLight((-0.4, -0.8, -0.5), intensity=0.6 * math.pi))
    for number, (mesh, _, _) in enumerate(chunks):
        mesh.materials = [e3d.Material(color=color_of(number))]
        scene.add(mesh)
    camera = lens, e3d.look_at(eye, TARGET)
    frame = e3d.render(scene, camera, size=size, look="plain", samples=1, cull="back")
    return frame.color[:, :, :3], frame.stats


def to_map(point, height):
    scale = height / (CELLS + 4)
    return int(height / 2 + scale * point[0]), int(height / 2 + scale * point[2])


def from_above(chunks, kept, needed, height, matrix, eye=EYE):
    """Draw the chunks from above: kept, left out, or left out though they are needed.

    matrix: clip-from-world of the camera.
    """
    picture = blank(height, height)
    for (_, low, high), keep, need in zip(chunks, kept, needed, strict=True):
        (left, top), (right, bottom) = to_map(low, height), to_map(high, height)
        color = KEPT if keep else WRONG if need else LEFT_OUT
        picture[top : bottom - 1, left : right - 1] = color
    matrix = e3d.linalg.inverse(matrix)
    start = to_map(eye, height)
    for x in (-1.0, 1.0):
        far = e3d.linalg.transform_points(matrix, (x, 0.0, 0.98))
        way = lines.bresenham(*start, *to_map(far, height))
        inside = [(x, y) for x, y in way if 0 <= x < height and 0 <= y < height]
        lines.draw(picture, inside, (255, 200, 0))
    return picture


def steps(width=240, height=180, model=None, chunk=None, yfov=0.7):
    """Cut the town, or a model, into chunks of three sizes.

    chunk: the side of the smallest chunks; a 24th of a model, and 2 for the town, if left out.
    yfov: field of view of the camera, in radians.
    """
    eye, scale, size = EYE, 1, (width, height)
    lens = e3d.PerspectiveCamera(yfov, znear=0.1, zfar=60.0)
    if model is None:
        make, whole, smallest = make_chunks, buildings(), 2
    else:
        (whole, scale), make, smallest = load(model), cut, CELLS / 24
        eye = EYE[0], max(EYE[1], 1.2 * whole.bounds[1][1]), EYE[2]
    smallest = smallest if chunk is None else chunk * scale
    sides = [4 * smallest, 2 * smallest, smallest]
    chunks_of = {side: make(whole, side) for side in sides}
    matrix = clip_from_world(width, height, lens, eye)
    planes = planes_of(matrix)
    everything, _ = draw(chunks_of[sides[0]], size, eye, lens)
    for side, test, name in (
        (sides[0], by_center, "the centre"),
        (sides[0], by_corners, "the corners"),
        *((side, by_p_vertex, "the p-vertex") for side in sides),
    ):
        chunks = chunks_of[side]
        kept = [test(planes, low, high) for _, low, high in chunks]
        needed = [by_p_vertex(planes, low, high) for _, low, high in chunks]
        chosen = [chunk for chunk, keep in zip(chunks, kept, strict=True) if keep]
        picture, _ = draw(chosen, size, eye, lens)
        lost = int((picture != everything).any(axis=2).sum())
        triangles = sum(len(mesh.faces) for mesh, _, _ in chosen)
        counts = {"side": side / scale, "kept": len(chosen), "all": len(chunks)}
        caption = "chunks of {side:g} x {side:g} by " + name + ": {kept} of {all}, {triangles} "
        caption += "triangles; {lost:no pixel|# pixel|# pixels} lost"
        overview = from_above(chunks, kept, needed, height, matrix, eye)
        yield told(caption, **counts, triangles=triangles, lost=lost), picture, overview
    chunks = chunks_of[sides[-1]]
    picture, stats = draw(chunks, size, eye, lens)
    caption = "the engine, too, finds {found} of {all} chunks in the frustum"
    yield told(caption, found=stats["nodes_in_frustum"], all=len(chunks)), picture
    picture, _ = draw(chunks, size, eye, lens, random_colors.random_color)
    caption = "cut into {all} chunks of {side:g} x {side:g}, a colour each"
    yield told(caption, all=len(chunks), side=side / scale), picture


if __name__ == "__main__":
    main(__file__, steps, numbers={"chunk": "side of the smallest chunks, in the model's units"})
