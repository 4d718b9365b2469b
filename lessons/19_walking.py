"""A camera that walks: look-at, steps along the view, walls, water, stairs."""

import math

import numpy as np

import engine3d as e3d
from lesson import blank, earlier, main, told

lines = earlier("03_lines")
# Each letter is a square of one metre: wall, floor, water, a step, a platform too high to climb.
MAP = (
    "##########",
    "#....#...#",
    "#....#.~.#",
    "#..~.#...#",
    "#........#",
    "#.--..==.#",
    "#........#",
    "##########",
)
HEIGHTS = {"#": 2.0, ".": 0.0, "~": 0.0, "-": 0.3, "=": 0.9}
COLORS = {
    "#": (120, 110, 105),
    ".": (150, 150, 140),
    "~": (60, 110, 190),
    "-": (180, 160, 110),
    "=": (190, 120, 80),
}
STEP, RADIUS, EYES = 0.4, 0.25, 1.0
#: Four whole samples a pixel, of the scene as it is.
EXACT = {"look": "plain", "samples": 4, "antialiasing": "ssaa", "cull": "back"}


def look_at(eye, target):
    """Return the axes of a camera: right, up, and backward (it looks along -z)."""
    back = unit([e - t for e, t in zip(eye, target, strict=True)])
    right = unit(cross((0.0, 1.0, 0.0), back))
    return right, cross(back, right), back


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def unit(v):
    length = math.sqrt(dot(v, v))
    return [part / length for part in v]


def to_camera(point, eye, axes):
    """Return a point of the world in the camera's axes: three scalar products."""
    away = [p - e for p, e in zip(point, eye, strict=True)]
    return [dot(axis, away) for axis in axes]


def sample_ground(x, z):
    """Return the height of the ground, and what it is made of."""
    column, row = int(x // 1), int(z // 1)
    letter = MAP[row][column] if 0 <= row < len(MAP) and 0 <= column < len(MAP[0]) else "#"
    return HEIGHTS[letter], letter


def can_stand(x, z, height, step=STEP):
    """Whether there is ground that carries, all around, at most a step higher or lower."""
    for dx in (-RADIUS, RADIUS):
        for dz in (-RADIUS, RADIUS):
            ground, letter = sample_ground(x + dx, z + dz)
            if letter == "~" or abs(ground - height) > step:
                return False
    return True


def walk(x, z, dx, dz, step=STEP):
    """Go by (dx, dz); where that is blocked, along what blocks the way."""
    height, _ = sample_ground(x, z)
    for step_x, step_z in ((dx, dz), (dx, 0.0), (0.0, dz)):
        if can_stand(x + step_x, z + step_z, height, step):
            return x + step_x, z + step_z
    return x, z


def direction(yaw):
    """Return where one looks who has turned by yaw: (x, z)."""
    return -e3d.linalg.sin(yaw), -e3d.linalg.cos(yaw)


#: Metres to go, and degrees to turn to the left before.
ROUTE = ((4.0, 0), (3.0, -90), (2.0, -90), (5.5, 90), (3.5, 90), (3.0, 90))


def follow(route, x, z, step=STEP, pace=0.1):
    """Return all places on a route, and the yaw at each."""
    yaw, places = 0.0, [(x, z, 0.0)]
    for metres, degrees in route:
        yaw += math.radians(degrees)
        ahead = direction(yaw)
        for _ in range(round(metres / pace)):
            x, z = walk(x, z, pace * ahead[0], pace * ahead[1], step)
            places.append((x, z, yaw))
    return places


def from_above(places, width, height):
    """Draw the map and a path."""
    side = min(width // len(MAP[0]), height // len(MAP))
    picture = blank(width, height)
    for row, letters in enumerate(MAP):
        for column, letter in enumerate(letters):
            top, left = row * side, column * side
            picture[top : top + side - 1, left : left + side - 1] = COLORS[letter]
    pixels = [(int(x * side), int(z * side)) for x, z, _ in places]
    for a, b in zip(pixels, pixels[1:], strict=False):
        lines.draw(picture, lines.bresenham(*a, *b), (255, 240, 80))
    return picture


def build_scene():
    """Return the map as a scene of the engine; materials are named by their letters."""
    scene = e3d.Scene(background=(150, 180, 210), ambient=e3d.linear(0.35, 0.35, 0.4))
    scene.add(e3d.DirectionalLight((-0.4, -0.8, -0.3), intensity=0.8 * math.pi))
    materials = {name: e3d.Material(color=color, name=name) for name, color in COLORS.items()}
    for row, letters in enumerate(MAP):
        for column, letter in enumerate(letters):
            block = e3d.box((1.0, 1.0 + HEIGHTS[letter], 1.0))
            block.materials = [materials[letter]]
            middle = (column + 0.5, (HEIGHTS[letter] - 1.0) / 2, row + 0.5)
            scene.add(block, translation=middle)
    return scene


def engine_path(scene, route, x, z, step=STEP):
    """Return the path of the engine's walker on the same route."""
    walkable = set(HEIGHTS) - {"~"}
    grid = e3d.navigation.NavigationGrid(
        scene, cell=0.1, walkable=walkable, step=step, radius=RADIUS
    )
    walker = e3d.navigation.Walker(grid, x, z, y=0.0, eye_height=EYES)
    yaw, places = 0.0, [(x, z, 0.0)]
    for metres, degrees in route:
        yaw += math.radians(degrees)
        ahead = direction(yaw)
        for _ in range(round(metres / 0.1)):
            walker.move(0.1 * ahead[0], 0.1 * ahead[1])
            places.append((walker.x, walker.z, yaw))
    return places


def view(scene, place, width, height):
    """Return what one sees who stands at a place."""
    x, z, yaw = place
    eye = (x, sample_ground(x, z)[0] + EYES, z)
    ahead = direction(yaw)
    axes = look_at(eye, (x + ahead[0], eye[1] - 0.25, z + ahead[1]))
    pose = np.eye(4)
    pose[:3, :3] = np.transpose(axes)
    pose[:3, 3] = eye
    camera = e3d.PerspectiveCamera(1.1, znear=0.05, zfar=50.0)
    return e3d.render(scene, (camera, pose), size=(width, height), **EXACT).color[:, :, :3]


def steps(width=240, height=180, step=STEP):
    """Walk over a map; step: how high one climbs at once, in metres."""
    start = 1.5, 6.5
    places = follow(ROUTE, *start, step)
    scene = build_scene()
    yield "a map, and the path of one who walks", from_above(places, width, height)
    for number in (0, 44, 92, 183):
        x, z, _ = places[number]
        caption = "after {count:no step|# step|# steps}, at x = {x:.1f}, z = {z:.1f}"
        yield told(caption, count=number, x=x, z=z), view(scene, places[number], width, height)
    theirs = engine_path(scene, ROUTE, *start, step)
    away = max(
        math.hypot(x - a, z - b) for (x, z, _), (a, b, _) in zip(places, theirs, strict=True)
    )
    caption = told("the engine's Walker: {away:.2f} m from there at most", away=away)
    yield caption, from_above(theirs, width, height)


if __name__ == "__main__":
    main(__file__, steps)
