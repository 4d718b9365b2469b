"""A solution of the checked exercise of lesson 23, solar."""

from math import pi

import engine3d as e3d

turn, move = e3d.linalg.rotation_y, e3d.linalg.translation
multiply = e3d.linalg.multiply


def moon(day):
    earth = multiply(turn(2 * pi * day / 365.25), move((3.2, 0, 0)))
    own = multiply(turn(2 * pi * day / 27.3), move((0.9, 0, 0)))
    return multiply(earth, own)[:3, 3]


print(min(range(28), key=lambda day: moon(day) @ moon(day)))
