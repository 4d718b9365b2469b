"""A solution of the checked exercise of lesson 22, octree."""

import random


def build(things, x, y, side, most):
    if len(things) <= most:
        return x, y, side, things, []
    half = side / 2
    quarters = []
    for left in (x, x + half):
        for low in (y, y + half):
            inside = [(a, b) for a, b in things if 0 <= a - left < half and 0 <= b - low < half]
            quarters.append(build(inside, left, low, half, most))
    return x, y, side, [], quarters


def tests(cell, reach):
    x, y, side, things, quarters = cell
    if x >= reach or y >= reach:
        return 1
    return 1 + len(things) + sum(tests(one, reach) for one in quarters)


random.seed(5)
things = [(random.random(), random.random()) for _ in range(1000)]
print(tests(build(things, 0, 0, 1, 64), 0.3))
