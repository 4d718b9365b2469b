"""A solution of the checked exercise of lesson 10, zbuffer."""

import numpy as np

surfaces = [
    (1, range(5, 45), range(5, 30), lambda x, y: 10 + 0.2 * x),
    (2, range(15, 55), range(10, 40), lambda x, y: 20 - 0.2 * y),
    (3, range(60), range(45), lambda x, y: 0.25 * (x + y)),
]


def draw(surfaces):
    zbuffer = np.full((45, 60), -np.inf)
    shown = np.zeros((45, 60), int)
    for number, columns, rows, depth in surfaces:
        for y in rows:
            for x in columns:
                z = depth(x + 0.5, y + 0.5) // 1
                if z > zbuffer[y, x]:
                    zbuffer[y, x], shown[y, x] = z, number
    return shown


print((draw(surfaces) != draw(surfaces[::-1])).sum())
