"""Less work: what is hidden, what is small, what is far, and what is many times the same."""

import math
import time

import numpy as np

import engine3d as e3d
from lesson import DIFFER, blank, main, told

WALL_Z = 2.0
COLORS = ((110, 190, 110), (90, 150, 230), (255, 200, 0), (240, 110, 90))
HIDDEN = (75, 80, 92)
#: One sample a pixel and the scene as it is, to compare every byte.
EXACT = {"look": "plain", "samples": 1, "cull": "back"}


def boxes(count=400, seed=3):
    """Return the middles of boxes behind a wall: (x, y, z)."""
    return np.random.default_rng(seed).uniform((-6, -3, -14), (6, 3, 0), (count, 3))


def on_screen(points, matrix, width, height):
    """Return columns, rows and depths of points."""
    clip = points @ matrix[:, :3].T + matrix[:, 3]
    ndc = clip[:, :3] / clip[:, 3:]
    return (ndc[:, 0] + 1) * width / 2, (1 - ndc[:, 1]) * height / 2, clip[:, 3]


def occluded(low, high, matrix, coarse, width, height):
    """Whether a box is behind the coarse depth buffer, in all cells that it may touch."""
    corners = np.array([[(low, high)[i >> k & 1][k] for k in range(3)] for i in range(8)])
    columns, rows, depth = on_screen(corners, matrix, width, height)
    cell = width / coarse.shape[1]
    left, right = int(max(columns.min(), 0) // cell), int(min(columns.max(), width - 1) // cell)
    top, bottom = int(max(rows.min(), 0) // cell), int(min(rows.max(), height - 1) // cell)
    return bool((coarse[top : bottom + 1, left : right + 1] < depth.min()).all())


def hidden_scene(width, height):
    """Return a scene with a wall, its boxes, and a camera."""
    scene = e3d.Scene(background=(30, 33, 40))
    wall, block = e3d.box((6.0, 4.0, 0.2)), e3d.box(0.4)
    wall.materials = [e3d.Material(color=(170, 120, 95))]
    block.materials = [e3d.Material(color=(120, 170, 220))]
    scene.add(wall, translation=(-1.0, 0.0, WALL_Z))
    nodes = [scene.add(block, translation=place) for place in boxes()]
    camera = e3d.PerspectiveCamera(0.9, znear=0.1, zfar=40.0)
    return scene, nodes, (camera, e3d.look_at((0, 0, 8), (0, 0, 0)))


def occlusion(width, height):
    """Draw the wall, keep the farthest depth of each 8 x 8 pixels, test the boxes against it."""
    scene, nodes, (camera, pose) = hidden_scene(width, height)
    for node in nodes:
        node.visible = False
    frame = e3d.render(
        scene, (camera, pose), size=(width, height), outputs=("color", "depth"), **EXACT
    )
    depth = np.where(frame.depth > 0, frame.depth, np.inf)
    coarse = depth.reshape(height // 8, 8, width // 8, 8).max(axis=(1, 3))
    yield "the wall alone, drawn first", frame.color[:, :, :3]

    matrix = e3d.linalg.multiply(camera.projection((width, height)), e3d.linalg.inverse(pose))
    kept = 0
    for node, place in zip(nodes, boxes(), strict=True):
        node.visible = not occluded(place - 0.2, place + 0.2, matrix, coarse, width, height)
        kept += node.visible
    some = e3d.render(scene, (camera, pose), size=(width, height), **EXACT).color
    for node in nodes:
        node.visible = True
    every = e3d.render(scene, (camera, pose), size=(width, height), **EXACT).color
    other = int((some != every).any(axis=2).sum())
    caption = "{kept} of {all} boxes may show; " + DIFFER + " from all of them"
    yield told(caption, kept=kept, all=len(nodes), differ=other), some[:, :, :3]


def level_of(distance, radius, yfov, height, errors, pixels=0.3):
    """Return the coarsest level whose error is at most `pixels` on the screen."""
    per_unit = height / 2 / math.tan(yfov / 2) / distance
    fitting = [level for level, error in enumerate(errors) if error * radius * per_unit <= pixels]
    return fitting[-1] if fitting else 0


def levels(width, height, pixels=0.3):
    """Draw balls in the detail that their distance needs, a colour for each level."""
    # How far a sphere of so many segments is from the true one, for radius 1.
    segments = (24, 16, 12, 8)
    errors = [0.0, *(1 - math.cos(math.pi / n) for n in segments[1:])]
    meshes = []
    for count, color in zip(segments, COLORS, strict=True):
        meshes.append(e3d.uv_sphere(1.0, (count, count // 2)))
        meshes[-1].materials = [e3d.Material(color=color, flat_shading=True)]
    scene = e3d.Scene(background=(30, 33, 40))
    triangles = full = 0
    for row in range(12):
        for column in range(-3, 4):
            place = np.array((2.6 * column, 0.0, -4.0 * row))
            distance = float(np.sqrt(((place - (0.0, 5.0, 10.0)) ** 2).sum()))
            level = level_of(distance, 1.0, 0.8, height, errors, pixels)
            scene.add(meshes[level], translation=place)
            triangles += len(meshes[level].faces)
            full += len(meshes[0].faces)
    camera = e3d.PerspectiveCamera(0.8, znear=0.1, zfar=100.0)
    pose = e3d.look_at((0.0, 5.0, 10.0), (0.0, 0.0, -8.0))
    frame = e3d.render(scene, (camera, pose), size=(width, height), **EXACT)
    caption = "levels of detail: {triangles} triangles instead of {full}"
    yield told(caption, triangles=triangles, full=full), frame.color[:, :, :3]


def due(number, frame, distance, full_rate):
    """Whether a thing at a distance moves in this frame: near ones always, far ones rarely."""
    period = 1
    while distance > full_rate * period and period < 64:
        period *= 2
    return (frame + number) % period == 0


def update_rate(side, frames=16):
    """Show how often each of 400 things moves in some frames, seen from above."""
    random = np.random.default_rng(6)
    places = random.uniform(-10, 10, (400, 2))
    picture, moves = blank(side, side), 0
    for number, (x, z) in enumerate(places):
        distance = math.sqrt(x * x + z * z)
        count = sum(due(number, frame, distance, 2.5) for frame in range(frames))
        moves += count
        column, row = (int((v / 20 + 0.5) * (side - 4)) for v in (x, z))
        bright = 60 + 195 * count // frames
        picture[row : row + 4, column : column + 4] = (bright, bright * 4 // 5, 40)
    picture[side // 2 - 2 : side // 2 + 2, side // 2 - 2 : side // 2 + 2] = (90, 150, 255)
    caption = "updates: {moves} moves in {frames} frames instead of {all}"
    yield told(caption, moves=moves, frames=frames, all=400 * frames), picture


def many(width, height, count=12):
    """Return a scene of count^3 nodes that share one mesh, and one of as many instances."""
    ball = e3d.icosphere(0.3, 1)
    places = np.mgrid[0:count, 0:count, 0:count].reshape(3, -1).T - (count - 1) / 2
    scenes = [e3d.Scene(background=(30, 33, 40)) for _ in range(2)]
    for place in places:
        scenes[0].add(ball, translation=place)
    scenes[1].add(e3d.InstancedMesh(ball, np.column_stack([places, np.ones(len(places))])))
    camera = e3d.PerspectiveCamera(0.8, znear=0.1, zfar=100.0)
    return scenes, (camera, e3d.look_at((9.0, 8.0, 17.0), (0.0, 0.0, 0.0)))


def batching(width, height):
    """Draw the same mesh many times: nodes one by one, in a batch, and as instances."""
    scenes, camera = many(width, height)
    first = None
    for scene, name, batched in (
        (scenes[0], "nodes one by one", False),
        (scenes[0], "nodes in a batch", True),
        (scenes[1], "instances", True),
    ):
        frame = e3d.render(scene, camera, size=(width, height), **EXACT, batching=batched)
        first = frame.color if first is None else first
        other = int((first != frame.color).any(axis=2).sum())
        caption = name + ": {draws:no draw|# draw|# draws}; " + DIFFER
        yield told(caption, draws=frame.stats["draws"], differ=other), frame.color[:, :, :3]


def measure():
    """Time nodes one by one, in a batch, and instances."""
    scenes, camera = many(640, 480, 24)
    for scene, name, batched in (
        (scenes[0], "one by one", False),
        (scenes[0], "batch", True),
        (scenes[1], "instances", True),
    ):
        with e3d.Renderer((640, 480), threads=1, look="plain", samples=1) as renderer:
            renderer.render(scene, camera, batching=batched)
            start = time.perf_counter()
            for _ in range(10):
                renderer.render(scene, camera, batching=batched)
            print(f"{name:<12}{100 * (time.perf_counter() - start):8.2f} ms per frame")


def steps(width=240, height=176, pixels=0.3):
    """Draw four ways to do less; pixels: the error that a level of detail may show."""
    width, height = width // 8 * 8, height // 8 * 8  # whole cells of the coarse buffer
    yield from occlusion(width, height)
    yield from levels(width, height, pixels)
    yield from update_rate(height)
    yield from batching(width, height)


if __name__ == "__main__":
    main(__file__, steps, time=measure)
