"""A solution of the checked exercise of lesson 19, walking."""

MAP = ("##########", "#....#...#", "#..=.#...#", "#........#", "##########")
HEIGHTS = {"#": 2.0, ".": 0.0, "=": 0.9}


def height(x, z):
    return HEIGHTS[MAP[int(z)][int(x)]]


def can_stand(x, z, now, radius=0.25, step=0.4):
    return all(
        abs(height(x + dx, z + dz) - now) <= step
        for dx in (-radius, radius)
        for dz in (-radius, radius)
    )


def walk(x, z, dx, dz):
    for step_x, step_z in ((dx, dz), (dx, 0), (0, dz)):
        if can_stand(x + step_x, z + step_z, height(x, z)):
            return x + step_x, z + step_z
    return x, z


x, z, blocked = 1.5, 1.5, 0
for _ in range(80):
    before = x, z
    x, z = walk(x, z, 0.1, 0.03)
    blocked += x == before[0] or z == before[1]
print(blocked)
