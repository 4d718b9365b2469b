"""A solution of the checked exercise of lesson 8, painter."""

import engine3d as e3d

triangles = [
    ([(40, 150, 9), (120, 10, 1), (210, 150, 2)], (90, 170, 250)),
    ([(20, 20, 5), (200, 60, 5), (60, 160, 5)], (240, 90, 80)),
    ([(100, 30, 7), (220, 40, 8), (180, 170, 0)], (255, 200, 0)),
]


def draw(depth):
    canvas = e3d.Canvas((240, 180))
    for corners, color in sorted(triangles, key=depth):
        canvas.triangle(*[(x, y) for x, y, z in corners], color)
    return canvas.pixels


middle = draw(lambda one: sum(z for x, y, z in one[0]) / 3)
nearest = draw(lambda one: max(z for x, y, z in one[0]))
print((middle != nearest).any(axis=2).sum())
