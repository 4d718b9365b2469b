"""A solution of the checked exercise of lesson 11, texture."""

import numpy as np

a, b, c = (10, 10), (150, 30), (60, 120)
uvs = np.array([(0, 0), (6, 0), (0, 6)])


def area(p, q, r):
    return (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0])


dark = 0
for y in range(130):
    for x in range(160):
        p = x + 0.5, y + 0.5
        parts = np.array([area(p, b, c), area(a, p, c), area(a, b, p)])
        if parts.min() >= 0:
            u, v = parts / area(a, b, c) @ uvs
            dark += (int(u) + int(v)) % 2
print(dark)
