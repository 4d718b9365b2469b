"""A solution of the checked exercise of lesson 21, frustum."""

import engine3d as e3d

camera = e3d.PerspectiveCamera(0.7, znear=0.1, zfar=60.0)
view = e3d.linalg.inverse(e3d.look_at((0, 2, 10), (0, 0, 0)))
x, y, z, w = e3d.linalg.multiply(camera.projection((320, 240)), view)
planes = [w + x, w - x, w + y, w - y, w + z, w - z]


def by_p_vertex(low, high):
    for a, b, c, d in planes:
        p = [high[k] if (a, b, c)[k] >= 0 else low[k] for k in range(3)]
        if a * p[0] + b * p[1] + c * p[2] + d < 0:
            return False
    return True


def by_center(low, high):
    x, y, z = [(p + q) / 2 for p, q in zip(low, high, strict=True)]
    return all(a * x + b * y + c * z + d >= 0 for a, b, c, d in planes)


chunks = [((i, 0, j), (i + 2, 1, j + 2)) for i in range(-12, 12, 2) for j in range(-12, 12, 2)]
kept = [chunk for chunk in chunks if by_p_vertex(*chunk)]
print(len(kept) - sum(by_center(*chunk) for chunk in kept))
