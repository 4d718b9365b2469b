"""A solution of the checked exercise of lesson 13, rotations."""

from math import cos, sin

x, y, z = 1, 2, 3
x, z = x * cos(1) + z * sin(1), z * cos(1) - x * sin(1)
y, z = y * cos(1) - z * sin(1), y * sin(1) + z * cos(1)
print(round(100 * z))
