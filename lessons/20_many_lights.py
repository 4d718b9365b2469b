"""256 lights: forward shading against deferred shading, and what the G-buffer holds."""

import time

import numpy as np

import engine3d as e3d
from lesson import DIFFER, earlier, main, told

gray = earlier("10_zbuffer").gray
LIGHTS, BALLS = 256, 24
RANGE = 0.55


def make_scene(width, height, lights=LIGHTS, seed=4):
    """Return balls before a wall (x, y, z, radius, colour) and lights (x, y, z, colour)."""
    random = np.random.default_rng(seed)
    aspect = width / height
    balls = [
        (*random.uniform((-aspect, -1, 0.2), (aspect, 1, 1.0)), random.uniform(0.15, 0.45), color)
        for color in random.uniform(0.35, 1.0, (BALLS, 3))
    ]
    places = random.uniform((-aspect, -1, 0.1), (aspect, 1, 1.6), (LIGHTS, 3))
    colors = random.uniform(0.1, 1.0, (LIGHTS, 3))
    return balls, list(zip(places, colors, strict=True))[:lights]


def grid(width, height):
    """Return x and y of all pixels, seen without perspective."""
    y, x = np.mgrid[0:height, 0:width] + 0.5
    return (x - width / 2) / (height / 2), -(y - height / 2) / (height / 2)


def fragments(shape, x, y):
    """Return where a ball covers pixels, and depth and normal there."""
    cx, cy, cz, radius, _ = shape
    dx, dy = x - cx, y - cy
    rest = radius * radius - dx * dx - dy * dy
    covered = rest > 0
    dz = np.sqrt(np.maximum(rest, 0))
    return covered, cz + dz, np.stack([dx, dy, dz], axis=-1) / radius


def shade(position, normal, albedo, lights):
    """Return colours: the sum over all lights; (N, 3) arrays."""
    total = np.full(position.shape, 0.06)
    for place, color in lights:
        away = place - position
        squared = away[:, 0] ** 2 + away[:, 1] ** 2 + away[:, 2] ** 2
        facing = away[:, 0] * normal[:, 0] + away[:, 1] * normal[:, 1] + away[:, 2] * normal[:, 2]
        window = np.maximum(1 - squared / (RANGE * RANGE), 0)
        strength = window * window * np.maximum(facing, 0) / np.sqrt(squared)
        total += strength[:, None] * color
    return albedo * total


def empty(width, height):
    """Return the buffers with only the wall in them: depth, normal, albedo."""
    depth = np.zeros((height, width))
    normal = np.zeros((height, width, 3))
    normal[:, :, 2] = 1
    return depth, normal, np.full((height, width, 3), 0.6)


def positions(depth, x, y, where):
    return np.stack([x[where], y[where], depth[where]], axis=-1)


def forward(scene, width, height):
    """Shade each fragment as it is drawn; return the colours and the number of shadings."""
    balls, lights = scene
    x, y = grid(width, height)
    depth, normal, albedo = empty(width, height)
    every = np.ones(depth.shape, bool)
    color = shade(positions(depth, x, y, every), normal[every], albedo[every], lights)
    color, count = color.reshape(height, width, 3), depth.size
    for ball in balls:
        covered, z, n = fragments(ball, x, y)
        nearer = covered & (z > depth)
        depth[nearer] = z[nearer]
        albedo_of_it = np.broadcast_to(ball[4], (int(nearer.sum()), 3))
        color[nearer] = shade(positions(depth, x, y, nearer), n[nearer], albedo_of_it, lights)
        count += len(albedo_of_it)
    return color, count


def g_buffer(scene, width, height):
    """Draw only depth, normal and albedo; shade nothing yet."""
    x, y = grid(width, height)
    depth, normal, albedo = empty(width, height)
    for ball in scene[0]:
        covered, z, n = fragments(ball, x, y)
        nearer = covered & (z > depth)
        depth[nearer] = z[nearer]
        normal[nearer] = n[nearer]
        albedo[nearer] = ball[4]
    return depth, normal, albedo


def deferred(buffers, lights):
    """Shade every pixel once, from the buffers."""
    depth, normal, albedo = buffers
    height, width = depth.shape
    x, y = grid(width, height)
    every = np.ones(depth.shape, bool)
    color = shade(positions(depth, x, y, every), normal[every], albedo[every], lights)
    return color.reshape(height, width, 3), depth.size


def picture(color):
    return np.floor(255 * np.clip(color, 0, 1) + 0.5).astype(np.uint8)


def measure():
    """Time forward and deferred shading, here and in the engine."""
    scene = make_scene(320, 240)
    for name, draw in (
        ("forward", lambda: forward(scene, 320, 240)),
        ("deferred", lambda: deferred(g_buffer(scene, 320, 240), scene[1])),
    ):
        start = time.perf_counter()
        _, count = draw()
        print(f"here    {name:<9}{time.perf_counter() - start:7.3f} s, {count:,} shadings")
    world = e3d.Scene()
    for x, y, z, radius, color in scene[0]:
        ball = e3d.uv_sphere(radius)
        ball.materials = [e3d.Material(color=color)]
        world.add(ball, translation=(x, y, z))
    for place, color in scene[1]:
        light = e3d.PointLight(color=color, range=RANGE, falloff="window")
        world.add(light, translation=place)
    with e3d.Renderer((1280, 720), threads=1) as renderer:
        frames = {}
        for name in ("forward", "deferred"):
            frames[name] = renderer.render(world, shading=name)
            start = time.perf_counter()
            renderer.render(world, shading=name)
            print(f"engine  {name:<9}{time.perf_counter() - start:7.3f} s at 1280x720")
    same = np.array_equal(frames["forward"].color, frames["deferred"].color)
    print("the engine's pictures are the same" if same else "the engine's pictures differ")


def steps(width=160, height=120, lights=LIGHTS):
    scene = make_scene(width, height, lights)
    buffers = g_buffer(scene, width, height)
    depth, normal, albedo = buffers
    as_color = np.floor(127.5 * normal + 127.5).astype(np.uint8)
    yield "the G-buffer: depth, normal, albedo", gray(depth), as_color, picture(albedo)
    for count in (1, 16, lights):
        color, _ = deferred(buffers, scene[1][:count])
        yield told("deferred, {count:no light|# light|# lights}", count=count), picture(color)
    shaded, all_pixels = deferred(buffers, scene[1])
    color, count = forward(scene, width, height)
    other = int((picture(color) != picture(shaded)).any(axis=2).sum())
    caption = "forward, {lights} lights: {count} shadings instead of {all}; " + DIFFER
    counts = {"lights": lights, "count": count, "all": all_pixels, "differ": other}
    yield told(caption, **counts), picture(color)


if __name__ == "__main__":
    main(__file__, steps, time=measure)
