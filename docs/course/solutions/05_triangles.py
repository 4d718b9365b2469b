"""A solution of the checked exercise of lesson 5, triangles."""


def edge(a, b, x, y):
    return (b[0] - a[0]) * (y - a[1]) - (b[1] - a[1]) * (x - a[0])


def pixels(*corners):
    edges = list(zip(corners, corners[1:] + corners[:1], strict=True))
    grid = [(x, y) for y in range(26) for x in range(34)]
    return {(x, y) for x, y in grid if all(edge(*one, x + 0.5, y + 0.5) >= 0 for one in edges)}


upper = pixels((5.5, 3.5), (29.5, 3.5), (29.5, 21.5))
lower = pixels((5.5, 3.5), (29.5, 21.5), (5.5, 21.5))
print(len(upper & lower))
