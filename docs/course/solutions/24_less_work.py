"""A solution of the checked exercise of lesson 24, less work."""

from math import cos, pi, tan

ERRORS = 0, *(1 - cos(pi / wedges) for wedges in (16, 12, 8))


def level_of(distance, pixels=0.3, height=176, yfov=0.8):
    per_unit = height / 2 / tan(yfov / 2) / distance
    return max(level for level, error in enumerate(ERRORS) if error * per_unit <= pixels)


distance = 1
while level_of(distance) < 3:
    distance += 1
print(distance)
