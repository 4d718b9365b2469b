"""A solution of the checked exercise of lesson 16, projection."""

from math import tan

width, height, yfov = 200, 150, 1.0
distance = height / 2 / tan(yfov / 2)
n = 1
while distance / n >= 10:
    n += 1
print(n)
